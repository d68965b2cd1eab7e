// Pages of studies: what they read of each kind of folder, and that no text of a folder ends the page's own.
#include "engine/record/report/study_page.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "engine/base/error.h"
#include "engine/record/plot/unit.h"
#include "tests/support/folder.h"

using namespace erbs;
namespace fs = std::filesystem;

namespace {

void write(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path) << text;
}

const std::string page = "<title>{{title}}</title>{{style}}{{kind}}{{cards}}{{figures}}{{files}}<script>{{study}}</script>";

}  // namespace

TEST_CASE("the page of a sweep shows its points over its params", "[record][report][study_page]") {
  const test::Folder dir;
  write(dir.path / "results.csv",
        "index,shake_m_s2,height,collapsed,runs,status,reason,study\n0,1.5,2,0,1,completed,,k\n1,3,2,1,1,failed,\"</script><b>\",k\n");
  write(dir.path / "study.json",
        R"({"scene": "wall.lua", "study": {"axes": [{"params": ["shake"]}, {"params": ["height"]}], "collect": ["metrics.collapsed"]}})");
  write(dir.path / "results.svg", "<svg xmlns='http://www.w3.org/2000/svg'/>");
  write(dir.path / "runs/000001/metrics.json", "{}");
  const std::string path = study_page_path(dir.path.string());
  CHECK(path == (dir.path / "report.html").string());
  REQUIRE(is_study_folder(dir.path.string()));
  const ReportedStudy study = read_reported_study(dir.path.string(), path);
  REQUIRE(study.tables.size() == 1);
  CHECK(study.kind == "sweep");
  CHECK(study.tables[0].x == 1);
  CHECK(study.tables[0].y == 2);
  CHECK(study.tables[0].colour == 3);
  CHECK(study.tables[0].links == std::vector<std::string>{"", "runs/000001"});
  CHECK(study.figures.size() == 1);
  CHECK(study.answers[1].second == "2, 1 completed");
  CHECK(study.answers[2] == std::pair<std::string, std::string>{"collapsed", "0 to 1"});
  const std::string html = study_html(study, page, "body{}");
  CHECK(html.find("shake [m") != std::string::npos);
  CHECK(html.find("</script><b>") == std::string::npos);
  CHECK(html.find("data:image/svg+xml;base64,") != std::string::npos);
  CHECK(html.find("<a href=\"results.csv\">") != std::string::npos);
}

TEST_CASE("the page of a bisection shows what was found over the params", "[record][report][study_page]") {
  const test::Folder dir;
  write(dir.path / "results.csv",
        "index,height,pga_m_s2,pga_lo_m_s2,pga_hi_m_s2,runs,status,reason,study\n0,2,3.5,3.4,3.6,9,completed,,k\n"
        "1,3,2.5,2.4,2.6,9,completed,,k\n");
  write(dir.path / "study.json",
        R"({"scene": "wall.lua", "study": {"axes": [{"params": ["height"]}], "collect": [], "bisect": {"param": "pga"}}})");
  const ReportedStudy study = read_reported_study(dir.path.string(), study_page_path(dir.path.string()));
  CHECK(study.tables[0].x == 1);
  CHECK(study.tables[0].y == 2);
  CHECK(study.answers[2].second == "2.5 to 3.5");
}

TEST_CASE("the title of a sweep is not its kind once more", "[record][report][study_page]") {
  const test::Folder dir;
  for (const auto& [folder, title] : {std::pair{"sweep", "wall"}, {"two_walls", "two_walls"}}) {
    const fs::path place = dir.path / folder;
    write(place / "results.csv", "index,shake_m_s2,collapsed,runs,status,reason,study\n0,1.5,0,1,completed,,k\n");
    write(place / "study.json",
          R"({"scene": "scenes/wall.lua", "study": {"axes": [{"params": ["shake"]}], "collect": ["metrics.collapsed"]}})");
    CHECK(read_reported_study(place.string(), study_page_path(place.string())).title == title);
  }
}

TEST_CASE("the page of a sweep has the title that the study gives", "[record][report][study_page]") {
  const test::Folder dir;
  write(dir.path / "results.csv", "index,shake_m_s2,collapsed,runs,status,reason,study\n0,1.5,0,1,completed,,k\n");
  write(dir.path / "study.json", R"({"scene": "wall.lua", "title": "Walls & <b>piers</b>", "study": {"axes": [], "collect": []}})");
  const ReportedStudy study = read_reported_study(dir.path.string(), study_page_path(dir.path.string()));
  CHECK(study.title == "Walls & <b>piers</b>");
  CHECK(study_html(study, page, "").find("<title>Walls &amp; &lt;b&gt;piers&lt;/b&gt;</title>") != std::string::npos);
}

TEST_CASE("the page of accuracy has errors over cost, on logarithmic axes", "[record][report][study_page]") {
  const test::Folder dir;
  write(dir.path / "accuracy.csv",
        "knob,setting,quantity,unit,value,reference,uncertainty,error,cpu_s,point_updates,command,reason\n"
        "time step,0.5,metrics.period,s,1,1.01,0,0.01,2,1000,erbs run,\ntime step,0.25,metrics.period,s,1,1.0025,0,0.0025,4,2000,erbs "
        "run,\n");
  write(dir.path / "results.csv", "index,setting,runs,status,reason,study\n0,the scene as it is,1,completed,,0\n");  // of its runs
  const ReportedStudy study = read_reported_study(dir.path.string(), study_page_path(dir.path.string()));
  REQUIRE(study.tables.size() == 1);
  const StudyTable& table = study.tables[0];
  CHECK(table.table.names[std::size_t(table.x)] == "cpu_s");
  CHECK(table.table.names[std::size_t(table.y)] == "error");
  CHECK(table.table.names[std::size_t(table.colour)] == "knob");
  CHECK(table.logarithmic);
  CHECK(table.table.names[std::size_t(table.only)] == "quantity");  // one is shown at a time
  CHECK(study.answers ==
        std::vector<std::pair<std::string, std::string>>{{"first quantity", "metrics.period"}, {"quantities", "1"}, {"settings", "2"}});
}

TEST_CASE("axes of a study carry the unit of their column", "[record][report][study_page]") {
  CHECK(plot::label_of("shake_m_s2") == "shake [m/s²]");
  CHECK(plot::label_of("top_drift_m") == "top drift [m]");
  CHECK(plot::label_of("base_shear_N") == "base shear [N]");
  CHECK(plot::label_of("overturned") == "overturned");
}

TEST_CASE("a folder without a study is refused with what would do", "[record][report][study_page][bad_input]") {
  const test::Folder dir;
  CHECK_FALSE(is_study_folder(dir.path.string()));
  CHECK_THROWS_WITH(read_reported_study(dir.path.string(), dir.file("x.html")), Catch::Contains("it holds no study"));
  write(dir.path / "results.csv", "");
  CHECK_THROWS_AS(read_reported_study(dir.path.string(), dir.file("x.html")), Error);
}
