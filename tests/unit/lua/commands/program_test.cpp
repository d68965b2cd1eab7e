// The program from the user's side: exit codes, destination of messages, and no incomplete file left behind.
#include <catch2/catch.hpp>
#include <csignal>
#include <thread>

#include "engine/base/system/process.h"
#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;
namespace fs = std::filesystem;

namespace {

const std::string falling_brick = R"(
material{ name = "brick", density = 1800 }
box{ name = "b", size = { .3, .2, .1 }, center = { 0, 0, 10 }, free = true }
analysis{ duration = param("duration", 0.1, "[s]"), dt = 1e-3, start = "rest", output_dt = 0.01 }
recorder{ name = "b", quantity = "displacement", block = "b", axis = "z" }
metric("fall", "m", function(run) return -run.last("b_uz_rel_m") end)
)";

}  // namespace

TEST_CASE("a run ends with 0, writes its metric and judges it", "[program]") {
  Bench bench;
  REQUIRE(bench.run(falling_brick + "expect('metrics.fall', 0.5 * g * 0.1^2, { rel = 1e-9 })") == 0);
  INFO(bench.said);
  CHECK(contains(bench.said, "expectations: 1 passed, 0 failed"));
  const Json metrics = read_json(bench.out() + "/metrics.json");
  CHECK(metrics["metrics"]["fall"].get<double>() == Approx(0.5 * 9.81 * 0.01).epsilon(1e-9));
  CHECK(metrics["expectations"]["passed"] == 1);
  CHECK(read_json(bench.out() + "/expectations.json").size() == 1);
}

TEST_CASE("a failed expectation ends with 4", "[program]") {
  Bench bench;
  CHECK(bench.run(falling_brick + "expect('metrics.fall', 1, { rel = 0.1 })") == 4);
  CHECK(contains(bench.said, "FAILED metrics.fall: expected 1 rel 0.1, got 0.04905"));
}

TEST_CASE("a folder that exists is refused with the remedy, and --force replaces it", "[program]") {
  Bench bench;
  REQUIRE(bench.run(falling_brick, {"-q"}) == 0);
  CHECK(bench.said.empty());
  CHECK(bench.run(falling_brick) == 2);
  CHECK(contains(bench.said, "--force"));
  CHECK(bench.run(falling_brick, {"--force"}) == 0);
}

TEST_CASE("the command line is checked", "[program]") {
  Bench bench;
  CHECK(bench.erbs({}) == 2);
  CHECK(bench.erbs({"runn"}) == 2);
  CHECK(bench.erbs({"run", "nope.lua"}) == 2);
  CHECK(contains(bench.said, "there is no scene nope.lua"));
  CHECK(bench.run(falling_brick, {"-D", "durration=1"}) == 2);
  CHECK(contains(bench.said, "-D durration=1: the scene has no param \"durration\"; did you mean \"duration\"?"));
  CHECK(bench.run(falling_brick, {"--max-wall", "soon"}) == 2);
  CHECK(bench.erbs({"version"}) == 0);
  CHECK(contains(bench.said, "erbs "));
  CHECK(bench.erbs({"help", "mortar"}) == 0);
  CHECK(contains(bench.said, "tensile strength (Pa; 0 to 1e+09; required)"));
  CHECK(bench.erbs({"help", "run"}) == 0);
  CHECK(contains(bench.said, "--max-wall"));
  CHECK(bench.erbs({"help", "render"}) == 0);
  CHECK(contains(bench.said, "--stills"));
  CHECK(bench.erbs({"help", "record"}) == 0);  // a verb and a function of scenes
  CHECK(contains(bench.said, "smoothing"));
  CHECK(contains(bench.said, "In a scene:"));
}

TEST_CASE("a run stopped by --until ends with 3, and --resume ends as one run would", "[program]") {
  Bench bench;
  REQUIRE(bench.run(falling_brick) == 0);
  const Json whole = read_json(bench.out() + "/metrics.json");
  CHECK(bench.run(falling_brick, {"--force", "--until", "0.05"}) == 3);
  CHECK(bench.run(falling_brick, {"--resume"}) == 0);
  INFO(bench.said);
  CHECK(read_json(bench.out() + "/metrics.json")["state_hash"] == whole["state_hash"]);
}

TEST_CASE("a param with its unit written onto it is met with the way to write it", "[program][bad_input]") {
  Bench bench;
  CHECK(bench.run(falling_brick, {"-D", "duration=0.5s"}) == 2);
  CHECK(contains(bench.said, "-D duration=0.5s: malformed number near '0.5s'; a unit is a factor: 0.8*g"));
}

TEST_CASE("the log of a run that was stopped twice has each warning once", "[program][resume]") {
  Bench bench;
  const std::string scene = falling_brick + "joint{ between = { 'brick', 'brick' }, law = dry{ kn = 1e9, mu = .6 } }\n";
  CHECK(bench.run(scene, {"--until", "0.03"}) == 3);
  CHECK(bench.run(scene, {"--resume", "--until", "0.06"}) == 3);
  CHECK(bench.run(scene, {"--resume"}) == 0);
  const std::string log = text_of(bench.out() + "/log.txt");
  const auto at = log.find("joins nothing");
  REQUIRE(at != std::string::npos);
  CHECK(log.find("joins nothing", at + 1) == std::string::npos);
}

TEST_CASE("a stopped run says how to go on, and needs nothing but its folder, from wherever it is called", "[program][resume]") {
  Bench bench;
  const std::vector<std::string> options{"-D", "duration=0.2", "--set", "output_dt=4*ms", "--no-figures"};
  REQUIRE(bench.run(falling_brick, options) == 0);
  const Json whole = read_json(bench.out() + "/metrics.json");
  // The scene and its folder are named from where the run is started.
  const auto in_shell = [&](const std::string& folder, const std::string& line) {
    fs::create_directories(bench.folder / folder);
    const std::string program = test::in_build("/erbs");
    const std::string text = "cd '" + (bench.folder / folder).string() + "' && erbs() { '" + program + "' \"$@\"; } && " + line;
    const int code = wait_for(start({"/bin/sh", "-c", text}, (bench.folder / "log").string()));
    bench.said = text_of(bench.folder / "log");
    return code;
  };
  CHECK(in_shell(".", "erbs run scene.lua -o 'its part' -D duration=0.2 --set 'output_dt=4*ms' --no-figures --until 0.05") == 3);
  INFO(bench.said);
  CHECK(contains(bench.said, "go on: erbs run 'its part' --resume\n"));
  CHECK(in_shell("elsewhere", "erbs run '../its part' --resume --until 0.1 --no-figures --threads 1") == 3);
  CHECK(contains(bench.said, "go on: erbs run '../its part' --resume\n"));
  CHECK(in_shell("elsewhere", "erbs run '../its part' --resume --no-figures -q") == 0);
  const std::string part = (bench.folder / "its part").string();
  const Json metrics = read_json(part + "/metrics.json"), manifest = read_json(part + "/manifest.json");
  CHECK(metrics["status"] == "completed");
  CHECK(metrics["state_hash"] == whole["state_hash"]);
  CHECK(text_of(part + "/histories.csv") == text_of(bench.out() + "/histories.csv"));
  CHECK(manifest["departures"] == Json::array({"--set", "output_dt=4*ms"}));
  CHECK(manifest["arguments"] == Json::array({"-D", "duration=0.2", "--threads", "1"}));
}

TEST_CASE("what a run folder says of its run cannot be said again, and a scene that is gone is named", "[program][resume]") {
  Bench bench;
  REQUIRE(bench.run(falling_brick, {"--until", "0.05", "-D", "duration=0.2", "--no-figures"}) == 3);
  CHECK(bench.erbs({"run", bench.out()}) == 2);
  CHECK(contains(bench.said, "is the folder of a run, not a scene; to go on with that run: erbs run " + bench.out() + " --resume"));
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"-D", "duration=0.2"}, {"-o", bench.out()}, {"--set", "levels=1"}, {"--allow-unstable"}}) {
    std::vector<std::string> words{"run", bench.out(), "--resume"};
    words.insert(words.end(), more.begin(), more.end());
    CHECK(bench.erbs(words) == 2);
    INFO(bench.said);
    CHECK(contains(bench.said, more.front()));
    CHECK(contains(bench.said, "a run that is resumed by its folder keeps its scene, options and folder"));
  }
  const std::string manifest = text_of(bench.out() + "/manifest.json");
  for (const std::string& damaged : {manifest.substr(0, manifest.size() / 2), std::string("[1]"), std::string("{}")}) {
    bench.write("out/manifest.json", damaged);
    CHECK(bench.erbs({"run", bench.out(), "--resume"}) == 2);
    INFO(bench.said);
    CHECK(contains(bench.said, "name the scene, with the options of the run: erbs run SCENE.lua -o " + bench.out() + " --resume"));
  }
  bench.write("out/manifest.json", manifest);
  fs::rename(bench.folder / "scene.lua", bench.folder / "moved.lua");
  CHECK(bench.erbs({"run", bench.out(), "--resume"}) == 2);
  CHECK(contains(bench.said, "the scene " + (bench.folder / "scene.lua").string() + " of the run in "));
  CHECK(contains(bench.said, "name its new place: erbs run SCENE.lua -o " + bench.out() + " --resume -D duration=0.2"));
  CHECK(bench.erbs({"run", (bench.folder / "moved.lua").string(), "-o", bench.out(), "--resume", "-D", "duration=0.2", "--no-figures"}) ==
        0);
}

TEST_CASE("an interrupt ends with 130 and a checkpoint", "[program]") {
  Bench bench;
  const Child child = start(bench.command({"run", bench.scene(falling_brick), "-o", bench.out(), "-D", "duration=100000"}),
                            (bench.folder / "log").string());
  for (int i = 0; i < 3000 && !fs::exists(bench.out() + "/histories.csv"); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  kill(child.pid, SIGINT);
  CHECK(wait_for(child) == 130);
  CHECK(fs::exists(bench.out() + "/checkpoint.bin"));
}

TEST_CASE("erbs test prints one row per expectation, and one for a scene that fails to run", "[program]") {
  Bench bench;
  fs::create_directories(bench.folder / "cases");
  std::ofstream(bench.folder / "cases/good.lua") << falling_brick << "expect('metrics.fall', 0.04905, { rel = 1e-6 })";
  std::ofstream(bench.folder / "cases/wrong.lua")
      << falling_brick << "expect('metrics.fall', 1, { abs = 0.1 })\nexpect('status', 'completed')";
  std::ofstream(bench.folder / "cases/broken.lua") << "box{ sise = 3 }\nexpect('steps', 1, { rel = 1 })";
  std::ofstream(bench.folder / "cases/part.lua") << "-- no expect(...) here";
  // A run folder among the scenes holds a copy of its scene, which is no case.
  const std::string good = (bench.folder / "cases/good.lua").string(), run = (bench.folder / "cases/runs/good").string();
  CHECK(bench.erbs({"run", good, "-o", run, "-q", "--no-figures"}) == 0);
  CHECK(bench.erbs({"test", (bench.folder / "cases").string(), "-o", bench.out(), "-j", "2"}) == 4);
  INFO(bench.said);
  CHECK(contains(bench.said, "broken.lua:1: box: unknown key \"sise\"; did you mean \"size\"?"));
  CHECK(contains(bench.said, "4 expectations of 3 cases: 2 passed, 2 failed (2 cases)"));
  CHECK(bench.erbs({"test", good, "-o", bench.out()}) == 0);
}

namespace {

const std::string overhanging = R"(
  material { name = "brick", density = 1800 }
  joint { law = dry { kn = 1e9, mu = 0.6 } }
  box { name = "foot", size = { .3, .1, .1 }, at = { 0, 0, -.1 }, material = "brick", fixed = true }
  box { name = "over", size = { .7, .1, .1 }, at = { 0, 0, 0 }, material = "brick" }
)";

}  // namespace

TEST_CASE("what does not stand under its own weight has that as its verdict, with the mechanism and no time", "[program]") {
  Bench bench;
  CHECK(bench.run(overhanging + "analysis { duration = 0.3 }") == 0);
  INFO(bench.said);
  CHECK(contains(bench.said, "does not stand under its own weight"));
  CHECK(contains(bench.said, "1 joint opened as a hinge: between foot and over"));
  CHECK(contains(text_of(bench.out() + "/log.txt"),
                 "does not stand under its own weight: 100 % of the mass; 1 joint opened as a hinge: between foot and over"));
  const Json collapse = read_json(bench.out() + "/metrics.json")["collapse"];
  CHECK(collapse["under_gravity"] == true);
  CHECK(collapse["under"] == "its own weight");
  CHECK(collapse["collapsed"] == true);
  CHECK(collapse["time_s"].is_null());
  CHECK(bench.run(overhanging + "analysis { duration = 0.3, start = 'rest' }", {"--force"}) == 0);
  CHECK(read_json(bench.out() + "/metrics.json")["collapse"]["under_gravity"] == false);
  CHECK(bench.run(overhanging + "analysis { duration = 5, stop_after_collapse = 0.1 }", {"--force"}) == 0);  // after it has fallen
  CHECK(read_json(bench.out() + "/metrics.json")["time_s"] > 0.2);
  CHECK(read_json(bench.out() + "/metrics.json")["time_s"] < 1.);
  CHECK(read_json(bench.out() + "/metrics.json")["collapse"]["time_s"].is_null());
  CHECK(bench.run(overhanging + "analysis { duration = 0.3 }", {"--force", "--max-wall", "0.0001"}) == 2);
  CHECK(contains(bench.said, "0.0001 s were not enough for the structure to come to rest before the first step; nothing is written"));
}

TEST_CASE("loads that act from the start are named beside the weight that a structure does not bear", "[program]") {
  Bench bench;
  const std::string beam = "box { name = 'on', size = { .3, .1, .1 }, at = { 0, 0, 0 }, material = 'brick' }\n";
  const std::string foot = overhanging.substr(0, overhanging.find("  box { name = \"over\""));
  for (const bool loaded : {false, true}) {  // the foot bears its weight, .6 of it along x not
    const std::string push = loaded ? "force { block = 'on', wave = 40, direction = 'x' }\n" : "";
    CHECK(bench.run(foot + beam + push + "analysis { duration = 0.2 }", {"--force"}) == 0);
    INFO(bench.said);
    CHECK(contains(bench.said, "does not stand under its own weight and the loads that act from the start;") == loaded);
    CHECK(read_json(bench.out() + "/metrics.json")["collapse"]["under_gravity"] == loaded);
  }
}

TEST_CASE("a run past its gate is inaccurate in status, exit code and last line, and names the knob", "[program]") {
  Bench bench;
  const std::string strict = overhanging + "analysis { duration = 0.5, start = 'rest', energy_gate = 1e-12 }";
  CHECK(bench.run(strict) == 1);
  INFO(bench.said);
  CHECK(read_json(bench.out() + "/metrics.json")["status"] == "inaccurate");
  CHECK(contains(bench.said, "exceeds its tolerance 1e-12"));
  CHECK(contains(bench.said, "take --dt-fraction 0."));
  CHECK(contains(bench.said, "energy_gate = "));
  CHECK(contains(bench.said, "inaccurate: not to be relied on; results in"));
  CHECK(bench.run(strict + "expect('status', 'inaccurate')", {"--force"}) == 0);
  CHECK(bench.run(strict + "param('x', 1) bisect { param = 'x', lo = 1, hi = 2 }", {"--force"}) == 1);
  CHECK(contains(bench.said, "inaccurate; exit code 1"));
  CHECK(contains(bench.said, "no answer at an end"));
}

TEST_CASE("without figures nothing of figure{} is left, but for the book", "[program]") {
  Bench bench;
  const std::string figure = "figure{ name = 'f', title = 't', x = 'x', y = 'y', curves = { { label = 'l', x = {1, 2}, y = {1, 2} } } }\n";
  const std::string scene = four_bricks() + "joint{ law = dry{ kn = 1e9, mu = .6 } }\nanalysis{ duration = .01 }\n" + figure;
  REQUIRE(bench.run(scene, {"-q", "--no-figures"}) == 0);
  CHECK_FALSE(std::filesystem::exists(bench.out() + "/figures"));
  REQUIRE(bench.run(scene, {"-q", "--no-figures", "--figure-scripts", "--force"}) == 0);
  CHECK(std::filesystem::exists(bench.out() + "/figures/f.gnuplot"));
}

TEST_CASE("what masonry_stiffness did stands in check, in the log and in the manifest", "[program]") {
  Bench bench;
  const std::string text = four_bricks() +
                           "local k = masonry_stiffness{ E = 5*GPa, nu = .25, spacing = .5 }\n"
                           "joint{ law = mortar{ kn = k.kn, ks = k.ks, ft = 1e5, c = 1e5, mu = .6 } }\nanalysis{ duration = .001 }\n";
  const std::string sentence = "kn = E/h = 10 GPa/m from E = 5 GPa, h = 0.5 m; ks = kn/(2(1+nu)) = 4 GPa/m from nu = 0.25";
  REQUIRE(bench.erbs({"check", bench.scene(text)}) == 0);
  CHECK(contains(bench.said, sentence));
  REQUIRE(bench.run(text) == 0);
  CHECK(contains(text_of(bench.out() + "/log.txt"), sentence));
  const Json notes = read_json(bench.out() + "/manifest.json")["notes"];
  REQUIRE(notes.size() == 1);
  CHECK(contains(notes[0].get<std::string>(), "scene.lua:4: " + sentence));
}

TEST_CASE("check says how strong a record is, as scaled", "[program]") {
  Bench bench;
  bench.write("shake.csv", "time_s,acceleration_m_s2\n0,0\n.1,-2\n.2,1\n.3,0\n");
  const std::string text = four_bricks() +
                           "joint{ law = dry{ kn = 1e8, mu = .3 } }\nanalysis{ duration = .1 }\n"
                           "ground_motion{ wave = record{ file = 'shake.csv', peak = .3*g }, direction = 'y' }\n";
  CHECK(bench.erbs({"check", bench.scene(text)}) == 0);
  CHECK(contains(bench.said, "record along (0, 1, 0): PGA 0.3 g, PGV 0.221 m/s"));  // 2.943 m/s2 (.1 + .1 / 2) s / 2
}

TEST_CASE("a param that is a word stands in check, in the log and in the manifest", "[program]") {
  Bench bench;
  const std::string way = "param way = \"drop\"  -- what the brick does",
                    scene = falling_brick + "param('way', 'rest', 'what the brick does')\n";
  CHECK(bench.run(scene, {"-D", "way=drop", "-q", "--no-figures"}) == 0);
  CHECK(contains(text_of(bench.out() + "/log.txt"), way));
  CHECK(read_json(bench.out() + "/manifest.json")["notes"] == Json::array({way}));
  CHECK(bench.erbs({"check", bench.scene(scene), "-D", "way=drop"}) == 0);
  CHECK(contains(bench.said, way));
}
