// erbs compare as a user calls it.
#include <catch2/catch.hpp>
#include <sstream>

#include "engine/record/format/json.h"
#include "lua/program/options.h"
#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;

namespace {

// Four bricks that shake without falling, in a folder of their own.
std::string shaken(Bench& bench, const std::string& name, const std::string& amplitude, const std::string& brick = "b") {
  std::string text = four_bricks();
  text.replace(text.find("\"b\""), 3, "\"" + brick + "\"");
  bench.write(name + ".lua", text + R"(joint{ law = dry{ kn = 1*GPa, mu = 0.6 } }
local shake = param("shake", 0.1*g, "of the table [m/s2]")
ground_motion{ wave = sine{ amplitude = shake, frequency = 3*Hz, duration = .3 }, direction = "y" }
analysis{ duration = .5 }
recorder{ name = "top", quantity = "displacement", block = ")" +
                                 brick + R"(3" })");
  const std::string out = (bench.folder / name).string();
  REQUIRE(bench.erbs({"run", (bench.folder / (name + ".lua")).string(), "-o", out, "-q", "--no-figures", "-D", "shake=" + amplitude}) ==
          exit_ok);
  return out;
}

}  // namespace

TEST_CASE("erbs compare judges a run against another run", "[compare][program]") {
  Bench bench;
  const std::string a = shaken(bench, "a", "0.1*g"), b = shaken(bench, "b", "0.12*g"), other = shaken(bench, "c", "0.1*g", "stone");
  const std::string limits = "peak<5%,rms<5%,difference<1%,lag<1ms";
  CHECK(bench.erbs({"compare", a, a, "--expect", "peak<5%,rms<5%,difference<1%,lag<.001,collapse_time<.01"}) == exit_ok);
  const Json same = read_json(a + "/compare/compare.json");
  CHECK(same["passed"] == true);
  CHECK(same["columns"]["top_uy_rel_m"]["peak_error"] == 0.0);
  CHECK(same["same_script"] == true);
  CHECK(same["params"].empty());
  CHECK(contains(bench.said, "params      the same"));
  CHECK(bench.erbs({"compare", a, b}) == exit_usage);  // there already
  CHECK(bench.erbs({"compare", a, b, "--force", "--expect", "peak<5%"}) == exit_expectation);
  CHECK(bench.said.find("FAILED") != std::string::npos);
  CHECK(contains(bench.said, "params      shake: run 0.981 m/s2, reference 1.1772 m/s2"));
  CHECK(read_json(a + "/compare/compare.json")["params"]["shake"]["reference"] == Approx(0.12 * 9.81));
  CHECK(read_json(a + "/compare/compare.json")["columns"]["ground_ay_m_s2"]["peak_error"] == Approx(-1. / 6).margin(1e-3));

  const std::string place = (bench.folder / "none").string();
  CHECK(bench.erbs({"compare", a, b, "-o", place, "--expect", limits}) == exit_usage);
  CHECK(bench.erbs({"compare", a, b, "-o", place, "--expect", "peek<5%"}) == exit_usage);
  CHECK(bench.erbs({"compare", a, other, "-o", place}) == exit_usage);
  CHECK(bench.said.find("another scene") != std::string::npos);
  CHECK(bench.erbs({"compare", a, "nowhere", "-o", place}) == exit_usage);
  std::filesystem::resize_file(b + "/motion.h5", 1000);
  CHECK(bench.erbs({"compare", a, b, "-o", place}) == exit_usage);
  CHECK(bench.said.find("motion.h5") != std::string::npos);
  bench.write("m.csv", "depth_m,top_uy_rel_m\n0,1\n1,2\n");
  CHECK(bench.erbs({"compare", a, (bench.folder / "m.csv").string(), "-o", place}) == exit_usage);
  CHECK(bench.said.find("m.csv:1") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(place));
}

TEST_CASE("erbs compare does not pass a run that has not ended, nor a small part of two", "[compare][program]") {
  Bench bench;
  const std::string whole = shaken(bench, "a", "0.1*g"), broken = shaken(bench, "b", "0.1*g");
  std::filesystem::remove(broken + "/metrics.json");  // as kill -9 leaves it
  std::istringstream rows(text_of(broken + "/histories.csv"));
  std::string head, line;
  for (int i = 0; i < 20 && std::getline(rows, line); ++i) head += line + "\n";
  std::ofstream(broken + "/histories.csv") << head;
  const std::string place = (bench.folder / "c").string();
  CHECK(bench.erbs({"compare", broken, whole, "-o", place}) == exit_ok);
  CHECK(contains(bench.said, "status      run unfinished, reference completed"));
  CHECK(contains(bench.said, "warning: the run is unfinished"));
  CHECK(contains(bench.said, "of the longer run ("));
  CHECK(bench.erbs({"compare", broken, whole, "-o", place, "--force", "--expect", "peak<5%"}) == exit_expectation);
  CHECK(read_json(place + "/compare.json")["passed"] == false);
  CHECK(read_json(place + "/compare.json")["span"]["whole"] == false);
  CHECK(bench.erbs({"compare", broken, whole, "-o", place, "--force", "--expect", "peak<5%", "--time", "0:.05"}) == exit_ok);
  CHECK(bench.erbs({"compare", broken, whole, "-o", place, "--force", "--expect", "peak<5%", "--time", "0:.4"}) == exit_expectation);
  CHECK(contains(bench.said, "of the span that --time asks for"));
}

TEST_CASE("erbs compare of runs without a response in their histories compares energies and collapse", "[compare][program]") {
  Bench bench;
  const auto settled = [&](const std::string& name, const char* height) {
    const std::string out = (bench.folder / name).string();
    bench.write(name + ".lua", four_bricks() + "box{ name = 'top', size = { .1, .1, .1 }, at = { 0, 0, " + height + " }, free = true }\n" +
                                   "joint{ law = dry{ kn = 1*GPa, mu = 0.6 } }\nanalysis{ duration = .3 }");
    REQUIRE(bench.erbs({"run", (bench.folder / (name + ".lua")).string(), "-o", out, "-q", "--no-figures"}) == exit_ok);
    return out;
  };
  const std::string low = settled("low", ".5"), high = settled("high", ".6"), place = (bench.folder / "c").string();
  CHECK(bench.erbs({"compare", low, low, "-o", place, "--expect", "peak<1%,collapse_time<.01"}) == exit_ok);
  CHECK(contains(bench.said, "energies are compared"));
  CHECK(contains(bench.said, "collapse    run "));
  const Json same = read_json(place + "/compare.json");
  CHECK(same["columns"].contains("kinetic_J"));
  CHECK_FALSE(same["columns"].contains("residual_J"));
  CHECK(bench.erbs({"compare", low, high, "-o", place, "--force", "--expect", "peak<1%"}) == exit_expectation);
}

TEST_CASE("erbs compare does not take the states of a push for seconds", "[compare][program]") {
  Bench bench;
  const std::string history = shaken(bench, "a", "0.1*g"), push = (bench.folder / "push").string();
  bench.write("push.lua", four_bricks() +
                              "joint{ law = dry{ kn = 1*GPa, mu = 0.6 } }\n"
                              "analysis{ kind = 'pushover', up_to = .02, limit = 'never' }\n");
  REQUIRE(bench.erbs({"run", (bench.folder / "push.lua").string(), "-o", push, "-q", "--no-figures"}) == exit_ok);
  for (const auto& [run, reference] : {std::pair{history, push}, {push, history}}) {
    CHECK(bench.erbs({"compare", run, reference}) == exit_usage);
    CHECK(contains(bench.said, push + " is a push through states of equilibrium, " + history + " a time history"));
  }
}
