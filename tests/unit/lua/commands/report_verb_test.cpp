// The command erbs report DIR: one page that loads nothing, used in a browser where there is one.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <regex>

#include "engine/base/system/process.h"
#include "engine/record/format/json.h"
#include "lua/page/page.h"
#include "tests/support/places.h"
#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;
namespace fs = std::filesystem;

namespace {

const char* const dry = "joint{ law = dry{ kn = 5e9, ks = 2e9, mu = 0.6 } }\n";

std::string titled_pier(double duration) {
  return "-- A pier's \"fall\" <b>über</b>\n" + four_bricks() + dry +
         fmt::format(
             "ground_motion{{ wave = sine{{ amplitude = 8, frequency = 2 }}, direction = \"y\" }}\n"
             "recorder{{ name = \"top\", quantity = \"displacement\", block = \"b3\" }}\nanalysis{{ duration = {} }}\n",
             duration);
}

bool page_is_built() {
  if (!report_page().script.empty()) return true;
  WARN("the packages of the page were absent when this was built; sh .ci/setup installs them");
  return false;
}

// CHROMIUM names another one than that of the distribution.
bool browser_is_there() {
  const char* own = std::getenv("CHROMIUM");
  if (fs::exists(own ? own : "/usr/bin/chromium") && can_start("node") &&
      fs::exists(test::in_source("/lua/page/node_modules/playwright-core")))
    return true;
  WARN("no browser test: it needs chromium, node and the packages of sh .ci/setup");
  return false;
}

}  // namespace

TEST_CASE("a page holds a run and loads nothing from elsewhere", "[report][program]") {
  if (!page_is_built()) return;
  Bench bench;
  REQUIRE(bench.run(titled_pier(0.5)) == 0);
  REQUIRE(bench.erbs({"report", bench.out()}) == 0);
  CHECK(contains(bench.said, "report.html"));
  const std::string html = text_of(bench.out() + "/report.html");
  CHECK(contains(html, "A pier&#39;s &quot;fall&quot; &lt;b&gt;über&lt;/b&gt;"));
  CHECK_FALSE(contains(html, "<link"));
  CHECK_FALSE(std::regex_search(html.substr(0, html.find("</head>")), std::regex("src=|url\\(|@import")));
  CHECK_FALSE(contains(html, "<script src"));
  std::size_t addresses = 0, names = 0;  // of the XHTML name space, which is no place to load from
  for (std::size_t at = 0; (at = html.find("://", at)) != std::string::npos; ++at) ++addresses;
  for (std::size_t at = 0; (at = html.find("http://www.w3.org/", at)) != std::string::npos; ++at) ++names;
  CHECK(addresses == names);
  CHECK(bench.erbs({"report", bench.out()}) == 2);
  CHECK(contains(bench.said, "--force"));
  CHECK(bench.erbs({"report", bench.out(), "--force", "-q"}) == 0);
  CHECK(bench.said.empty());
  const std::string other = (bench.folder / "eine Seite.html").string();
  CHECK(bench.erbs({"report", bench.out(), "-o", other}) == 0);
  CHECK(contains(text_of(other), "\"folder\":\"out\""));
  CHECK_FALSE(fs::exists(other + ".part"));
}

TEST_CASE("each folder without a run has its cause and its remedy", "[report][program]") {
  if (!page_is_built()) return;
  Bench bench;
  REQUIRE(bench.run(titled_pier(0.2)) == 0);
  const auto refused = [&](const std::vector<std::string>& words, const char* why) {
    INFO(fmt::format("{}", fmt::join(words, " ")));
    CHECK(bench.erbs(words) == 2);
    INFO(bench.said);
    CHECK(contains(bench.said, why));
  };
  refused({"report", (bench.folder / "nowhere").string()}, "no such folder");
  fs::create_directories(bench.folder / "empty");
  refused({"report", (bench.folder / "empty").string()}, "no manifest.json");
  refused({"report", bench.out(), "-o", (bench.folder / "page.pdf").string()}, ".html");
  refused({"report", bench.out(), "-o", (bench.folder / "no" / "page.html").string()}, "does not exist");
  fs::resize_file(bench.out() + "/motion.h5", fs::file_size(bench.out() + "/motion.h5") / 3);
  refused({"report", bench.out()}, "motion.h5");
  CHECK_FALSE(fs::exists(bench.out() + "/report.html"));
  fs::remove(bench.out() + "/motion.h5");
  refused({"report", bench.out()}, "motion.h5");
  for (const auto& entry : fs::directory_iterator(bench.out())) CHECK(entry.path().extension() != ".part");
}

TEST_CASE("a run that did not end has a page too", "[report][program]") {
  if (!page_is_built()) return;
  Bench bench;
  REQUIRE(bench.run(titled_pier(0.3)) == 0);
  for (const char* file : {"metrics.json", "histories.csv", "energy.csv", "events.csv"}) fs::remove(fs::path(bench.out()) / file);
  CHECK(bench.erbs({"report", bench.out()}) == 0);
}

TEST_CASE("a browser replays, picks and zooms the page", "[report][browser]") {
  if (!page_is_built()) return;
  if (!browser_is_there()) return;
  Bench bench;
  REQUIRE(bench.run(titled_pier(1)) == 0);
  REQUIRE(bench.erbs({"report", bench.out()}) == 0);
  const std::string log = (bench.folder / "browser.log").string(), shots = (bench.folder / "shots").string();
  fs::create_directories(shots);
  const int code = wait_for(start(
      {"node", test::in_source("/tests/page/browser.mjs"), bench.out() + "/report.html", shots, test::in_source("/tests/page")}, log));
  INFO(text_of(log));
  CHECK(code == 0);
  for (const char* name : {"desktop.png", "phone.png", "dark.png", "large.png", "print.pdf"}) CHECK(fs::exists(fs::path(shots) / name));
}

TEST_CASE("a browser opens the page of a collapse that has no time", "[report][browser]") {
  if (!page_is_built() || !browser_is_there()) return;
  Bench bench;
  REQUIRE(bench.run(titled_pier(1)) == 0);
  Json metrics = read_json(bench.out() + "/metrics.json");
  metrics["collapse"]["collapsed"] = true, metrics["collapse"]["under_gravity"] = true, metrics["collapse"]["time_s"] = nullptr;
  write_json(bench.out() + "/metrics.json", metrics);
  REQUIRE(bench.erbs({"report", bench.out()}) == 0);
  const std::string log = (bench.folder / "browser.log").string();
  const int code = wait_for(start({"node", test::in_source("/tests/page/browser.mjs"), bench.out() + "/report.html"}, log));
  INFO(text_of(log));
  CHECK(code == 0);
}

TEST_CASE("the page of a run that broke off does not say that it stands", "[report][browser]") {
  if (!page_is_built() || !browser_is_there()) return;
  Bench bench;
  REQUIRE(bench.run(titled_pier(1)) == 0);
  Json metrics = read_json(bench.out() + "/metrics.json");
  metrics["collapse"]["collapsed"] = false, metrics["status"] = GENERATE("interrupted", "diverged");
  write_json(bench.out() + "/metrics.json", metrics);
  REQUIRE(bench.erbs({"report", bench.out()}) == 0);
  const std::string log = (bench.folder / "browser.log").string();
  const int code = wait_for(start({"node", test::in_source("/tests/page/browser.mjs"), bench.out() + "/report.html"}, log));
  INFO(text_of(log));
  CHECK(code == 0);
}

TEST_CASE("the page of a push tells its multiplier and its states, which a browser replays", "[report][browser]") {
  if (!page_is_built()) return;
  Bench bench;
  const char* const kind = GENERATE("'pushover', direction = 'y', step = .1", "'tilt', direction = 'y', step = 2*deg");
  CAPTURE(kind);
  REQUIRE(bench.run("-- A pier that is pushed\n" + four_bricks() + dry +
                    fmt::format("analysis{{ kind = {}, monitor = {{ block = 'b3' }} }}\n", kind)) == 0);
  REQUIRE(bench.erbs({"report", bench.out()}) == 0);
  const std::string html = text_of(bench.out() + "/report.html");
  CHECK(contains(html, kind[1] == 't' ? "<span class=\"quiet\">largest tilt</span>" : " g</strong>"));
  CHECK(contains(html, kind[1] == 't' ? "\"unit\":\"tan\"" : "\"unit\":\"g\""));
  if (!browser_is_there()) return;
  const std::string log = (bench.folder / "browser.log").string();
  const int code = wait_for(start({"node", test::in_source("/tests/page/browser.mjs"), bench.out() + "/report.html"}, log));
  INFO(text_of(log));
  CHECK(code == 0);
}

TEST_CASE("studies of a scene have a page beside the page of their run, which a browser uses", "[report][browser][study_page]") {
  if (!page_is_built()) return;
  Bench bench;
  REQUIRE(bench.run("local seed, push = param('seed', 0, ''), param('push', 1, '')\n" + four_bricks() +
                    "joint{ law = dry{ kn = 1*GPa, mu = .6 } } analysis{ duration = .01 }\n"
                    "ensemble{ n = 3, seed = 1, name = 'twins', value = function(run) return seed % 7 end }\n") == 0);
  REQUIRE(bench.erbs({"report", bench.out()}) == 0);
  const fs::path page = fs::path(bench.out()) / "studies/report.html";
  REQUIRE(fs::exists(page));
  CHECK(contains(text_of(fs::path(bench.out()) / "report.html"), "studies/report.html"));
  for (const char* run : {"twins/runs/000000", "twins/runs/000002"}) CHECK(contains(text_of(page), run));  // links to the runs
  CHECK(bench.erbs({"report", bench.out() + "/studies"}) == 2);
  if (!browser_is_there()) return;
  const std::string log = (bench.folder / "study.log").string();
  const int code = wait_for(start({"node", test::in_source("/tests/page/study.mjs"), page.string()}, log));
  INFO(text_of(log));
  CHECK(code == 0);
}
