// Data read from a run folder, and the times and curves shown.
#include "render/run/run.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <set>

#include "engine/base/error.h"
#include "engine/record/folder/colors.h"
#include "render/draw/figures.h"
#include "render/movie/movie.h"
#include "tests/support/folder.h"

using namespace erbs;
using namespace erbs::render;

namespace {

struct Folder : test::Folder {
  void write(const std::string& name, const std::string& text) const { std::ofstream(path / name) << text; }
};

std::vector<double> recorded() {
  std::vector<double> t;
  for (int i = 0; i <= 100; ++i) t.push_back(0.04 * i);
  return t;
}

}  // namespace

TEST_CASE("a run folder is read", "[render][run]") {
  const Folder dir;
  CHECK_THROWS_WITH(read_run(dir.path.string()), Catch::Contains("manifest.json"));
  CHECK_THROWS_WITH(read_run((dir.path / "absent").string()), Catch::Contains("no such folder"));
  Manifest manifest;
  manifest.scene_name = "house";
  manifest.title = "A house";
  manifest.cameras.resize(1);
  manifest.cameras[0].name = "front";
  manifest.cameras[0].eye = Vec3(1, 2, 3);
  manifest.cameras[0].fov = 0.5;
  manifest.materials.resize(1);
  manifest.materials[0].color = Vec3(0.5, 0.2, 0.1);
  manifest.output_dt = 0.01, manifest.frame_dt = 0.04;
  manifest.settings = {{"analysis", {{"energy_gate", {{"value", 1e-3}}}}}};
  write_manifest(dir.path.string(), manifest);
  dir.write("histories.csv", "time_s,ground_ax_m_s2,ground_ay_m_s2\n0,0,0\n0.1,0,-3\n0.2,0,1\n0.3,5");
  const Run run = read_run(dir.path.string());
  CHECK(run.title == "A house");
  REQUIRE(run.cameras.size() == 1);
  CHECK(run.cameras[0].eye == Vec3(1, 2, 3));
  CHECK(run.cameras[0].fov == 0.5);
  CHECK(run.materials[0].color.z() == Approx(std::pow(0.1, 2.2)));  // linear light, from a screen colour
  CHECK(run.record.axis == "y");
  CHECK(run.record.peak == 3);
  CHECK(run.record.t.size() == 3);  // the incomplete last line is ignored
  dir.write("histories.csv", "time_s,ground_ax_m_s2,ground_ay_m_s2\n0,0,0\n0.1,1,1\n0.2,-2,-2\n");
  const Run diagonal = read_run(dir.path.string());
  CHECK(diagonal.record.axis == "45\u00b0 from x");
  CHECK(diagonal.record.peak == Approx(std::sqrt(8.0)));
  CHECK(diagonal.record.a.back() == Approx(-std::sqrt(8.0)));
  CHECK(run.energy_tolerance == 1e-3);
  CHECK(run.marks.empty());
  dir.write("events.csv",
            "time_s,event,name,value,unit\n0.1,open,a | b,1e-3,m\n0.2,crack,a | b,0.5,share\n0.3,crack,b | c,0.5,share\n0.4,collapse,,,\n");
  const std::vector<Mark> marks = read_run(dir.path.string()).marks;
  REQUIRE(marks.size() == 2);
  CHECK(marks[0].name == "first crack");
  CHECK(marks[0].t == 0.2);
  CHECK(marks[0].when == "between 0.190 and 0.200 s");
  CHECK(marks[1].name == "collapse");
  CHECK(read_run(dir.path.string()).verdict.empty());
  dir.write("metrics.json", R"({"status": "completed", "collapse": {"time_s": 0.4, "course": "gives way between 1 and 2 m"}})");
  CHECK(read_run(dir.path.string()).verdict == "collapse between 0.390 and 0.400 s: gives way between 1 and 2 m");
  manifest.cameras[0].target = manifest.cameras[0].eye;
  write_manifest(dir.path.string(), manifest);
  CHECK_THROWS_WITH(read_run(dir.path.string()), Catch::Contains("camera front looks nowhere"));
  dir.write("manifest.json", "{ \"scene\": ");
  CHECK_THROWS_WITH(read_run(dir.path.string()), Catch::Contains("manifest.json"));
}

TEST_CASE("a movie shows the instants asked for", "[render][schedule]") {
  Movie movie;
  Schedule s = schedule_of(movie, recorded());
  CHECK(s.times.size() == 101);
  CHECK(s.times.back() == Approx(4));
  std::vector<double> stopped = recorded();  // by a collapse
  stopped.push_back(4.025);
  s = schedule_of(movie, stopped);
  CHECK(s.times.size() == 102);
  CHECK(s.times.back() == 4.025);
  stopped.back() = 4.001;  // by a last step that is not quite at the duration
  CHECK(schedule_of(movie, stopped).times.size() == 101);
  movie.slow = 4;
  s = schedule_of(movie, recorded());
  CHECK(s.times.size() == 401);
  movie.range = {1, 2};
  s = schedule_of(movie, recorded());
  CHECK(s.times.size() == 101);
  CHECK(s.times.front() == 1);
  movie.frames = "every";
  s = schedule_of(movie, recorded());
  CHECK(s.times.size() == 26);
  CHECK(s.slow == Approx(1));  // 25 steps of 0.04 s at 25 frames a second
  movie.frames = "51";
  s = schedule_of(movie, recorded());
  CHECK(s.times.size() == 51);
  CHECK(s.slow == Approx(2));
  movie.frames = "few";
  CHECK_THROWS_AS(schedule_of(movie, recorded()), Error);
  movie.frames = "";
  movie.range = {5, 6};
  CHECK_THROWS_AS(schedule_of(movie, recorded()), Error);
  movie.stills = {0.5, 4.01};
  CHECK_THROWS_WITH(schedule_of(movie, recorded()), Catch::Contains("4.01"));
  movie.stills = {4.001};  // the last step of a run need not meet the duration
  CHECK(schedule_of(movie, recorded()).times.size() == 1);
  CHECK_THROWS_AS(schedule_of(movie, {}), Error);
}

TEST_CASE("columns know their unit", "[render][figures]") {
  CHECK(unit_of("floor3_ux_rel_m") == "m");
  CHECK(unit_of("floor3_ax_abs_m_s2") == "m_s2");
  CHECK(unit_of("base_moment_N_m") == "N_m");
  CHECK(unit_of("wall_kg_m_s") == "kg_m_s");
  CHECK(plot::label_of("spin_kg_m2_s") == "spin [kg m²/s]");
  CHECK(plot::label_of("kn_Pa_m") == "kn [Pa/m]");
  CHECK(plot::label_of("c_1_s") == "c [1/s]");
  CHECK(unit_of("contacts") == "");
  CHECK(words_of("floor3_ux_rel_m") == "floor3 ux rel");
}

TEST_CASE("curves share a panel when they share unit and direction", "[render][figures]") {
  const Folder dir;
  dir.write("h.csv",
            "time_s,floor1_ux_rel_m,ground_ax_m_s2,ground_ay_m_s2,floor2_ux_rel_m,floor1_uy_rel_m,base_fx_N\n"
            "0,0,0,0,0,0,0\n1,0.01,2,0,0.03,0.001,7e3\n");
  const std::vector<Panel> panels = history_panels(read_csv((dir.path / "h.csv").string()));
  REQUIRE(panels.size() == 4);
  CHECK(panels[0].label == "ground [g]");
  CHECK(panels[0].columns == std::vector<int>{2});  // no motion along y
  CHECK(panels[1].label == "displacement x rel [mm]");
  CHECK(panels[1].columns == std::vector<int>{1, 4});
  CHECK(panels[1].factor == 1000);
  CHECK(panels[2].columns == std::vector<int>{5});
  CHECK(panels[3].label == "force x [kN]");
}

TEST_CASE("curves fill their panel", "[render][figures]") {
  const Folder dir;
  const auto range = [&](double low, double high) {
    dir.write("h.csv", fmt::format("time_s,base_fz_N\n0,{0:.17g}\n1,{1:.17g}\n2,{0:.17g}\n", low, high));
    return shown_range(read_csv((dir.path / "h.csv").string()), {"force", 1, {1}});
  };
  const std::pair<double, double> signs[] = {{-4.1, 4.1}, {-1, 99},      {0, 8.1},       {-13.6, 0},
                                             {20, 80},    {95e3, 100e3}, {-7e5, -6.9e5}, {-3, 0.1}};
  for (const auto& [low, high] : signs) {
    const auto [from, to] = range(low, high);
    INFO(low << " " << high << " in " << from << " " << to);
    CHECK(from <= low);
    CHECK(to >= high);
    CHECK((high - low) / (to - from) > 0.66);
  }
  CHECK(range(20, 80).first == 0);  // zero is near
  CHECK(range(0, 8.1).first == 0);
  for (const double flat : {0.0, 5.0, -5.0}) {
    const auto [from, to] = range(flat, flat);
    CHECK(from <= std::min(0.0, flat));
    CHECK(to >= std::max(0.0, flat));
    CHECK(to > from);
  }
}

TEST_CASE("a direction in which next to nothing happens is named, not drawn", "[render][figures]") {
  const Folder dir;
  dir.write("h.csv", "time_s,top_ux_rel_m,top_uy_rel_m,top_ux_abs_m,top_uy_abs_m\n0,0,0,0,0\n1,0.03,0.0005,0.1,0.003\n");
  std::vector<std::string> left_out;
  const std::vector<Panel> panels = history_panels(read_csv((dir.path / "h.csv").string()), &left_out);
  CHECK(left_out == std::vector<std::string>{"displacement y rel"});
  REQUIRE(panels.size() == 3);
  CHECK(panels[2].label == "displacement y abs [mm]");  // 3 % of x
}

TEST_CASE("a run folder from anywhere is drawn, and runs nothing", "[render][figures][attack]") {
  const test::Folder folder;
  const std::string bad = "x'; system('touch pwned') #";
  std::ofstream(folder.path / "histories.csv") << "time_s,\"" << bad << "\",`touch pwned`,<b>]]>\n0,0,1,2\n1,1,2,3\n";
  std::ofstream(folder.path / "energy.csv") << "time_s,\"" << bad << "_J\",residual_relative\n0,0,0\n1,1,1e-9\n";
  Run run;
  run.dir = folder.path.string();
  run.title = bad + "\nsystem('touch pwned')";
  run.marks = {{0.5, bad, bad}};
  CHECK(write_figures(run).size() == 2);
  CHECK_FALSE(std::filesystem::exists(folder.path / "pwned"));
  CHECK_FALSE(std::filesystem::exists("pwned"));
}

TEST_CASE("names of many curves stand below each other, and what is more is told", "[render][figures]") {
  for (const int curves : {8, 10, 16, 30}) {
    const test::Folder dir;
    Run run;
    run.dir = dir.path.string();
    {
      std::ofstream csv(dir.path / "histories.csv");
      for (const char* row : {"time_s", "0", "1"}) {
        csv << row;
        for (int i = 10; i < 10 + curves; ++i) csv << (*row == 't' ? fmt::format(",course{}_ux_rel_m", i) : fmt::format(",{}.{}", row, i));
        csv << '\n';
      }
    }
    REQUIRE(write_figures(run).size() == 1);
    std::ifstream in(dir.path / "histories.svg");
    const std::string svg{std::istreambuf_iterator<char>(in), {}};
    std::set<std::string> columns, rows;  // places of names
    for (std::size_t at = svg.find(">course"); at != std::string::npos; at = svg.find(">course", at + 1)) {
      if (svg.compare(svg.rfind('<', at), 6, "<title") == 0) continue;
      const std::size_t from = svg.rfind("translate(", at) + 10, comma = svg.find(',', from);
      columns.insert(svg.substr(from, comma - from));
      rows.insert(svg.substr(comma + 1, svg.find(')', comma) - comma - 1));
    }
    CHECK(columns.size() == 1);
    CHECK(rows.size() == std::size_t(curves > 16 ? 15 : curves));
    CHECK((svg.find("and 15 more") != std::string::npos) == (curves == 30));
  }
}

TEST_CASE("energies that are small beside a fall have a panel of their own", "[render][figures]") {
  const test::Folder dir;
  Run run;
  run.dir = dir.path.string();
  const auto drawn = [&](const std::string& rows) {
    std::ofstream(dir.path / "energy.csv") << "time_s,gravity_J,fracture_J,residual_relative\n" << rows;
    REQUIRE(write_figures(run).size() == 1);
    std::ifstream in(dir.path / "energy.svg");
    return std::string{std::istreambuf_iterator<char>(in), {}};
  };
  CHECK(drawn("0,0,0,0\n1,-1000,49,1e-9\n").find("energy, small terms [J]") != std::string::npos);
  CHECK(drawn("0,0,0,0\n1,-1000,51,1e-9\n").find("small terms") == std::string::npos);
}

TEST_CASE("the clock of a push tells its states, and then the fall", "[render][run]") {
  Run run;
  CHECK(clock_text(run, 1.234) == "1.23 s");
  run.multipliers = {0, 0.1, 0.15}, run.state_dt = 0.04, run.multiplier_unit = "g";
  CHECK(clock_text(run, 0.041) == "state 1: 0.100 g");
  CHECK(clock_text(run, 0.08) == "state 2: 0.150 g");
  CHECK(clock_text(run, 0.48) == "fall + 0.40 s");
  run.multiplier_unit = "tan";
  CHECK(clock_text(run, 0.04) == "state 1: 5.71\u00b0");
  run.multiplier_unit = "";
  CHECK(clock_text(run, -1) == "state 0: 0.000");
}

TEST_CASE("materials without a colour are told apart, where there are several", "[render][run]") {
  std::vector<Material> materials(1);
  tell_apart(materials);
  CHECK(materials[0].color == Material{}.color);
  const Vec3 own(0.1, 0.2, 0.3);
  for (const char* name : {"Brick", "stone", "red tile", "granite"}) materials.emplace_back().name = name;
  materials.resize(27);
  materials.emplace_back().color = own;
  tell_apart(materials);
  CHECK(materials[1].color == Material{}.color);  // what is fired stays red
  CHECK(materials.back().color == own);
  for (std::size_t i = 0; i < materials.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) CHECK((materials[i].color - materials[k].color).norm() > 0.02);
}
