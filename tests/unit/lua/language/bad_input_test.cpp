// Bad input from the user's side: exit code 2, one message per mistake with place and remedy, and no file left behind.
#include <sys/wait.h>

#include <algorithm>
#include <catch2/catch.hpp>

#include "engine/record/format/json.h"
#include "tests/support/places.h"
#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;
namespace fs = std::filesystem;

namespace {

// Six lines, so that a test's own line is line 7.
const std::string pier = four_bricks() + R"(joint{ law = dry{ kn = 1*GPa, mu = .6 } }
analysis{ duration = param("duration", 0.01, "[s]") }
local el_centro = "elcentro_1940_ns.csv"
)";

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

struct BadPiece {
  std::string piece;               // in line 7 of the scene
  std::vector<std::string> parts;  // parts of the one message: place, name and remedy
};

void refuses(Bench& bench, const BadPiece& bad) {
  INFO(bad.piece);
  CHECK(bench.run(pier + bad.piece, {"--allow", test::in_source("/scenes/records")}) == 2);
  INFO(bench.said);
  CHECK(lines_of(bench.said).size() == 1);
  for (const auto& part : bad.parts) {
    INFO(part);
    CHECK(contains(bench.said, part));
  }
  CHECK_FALSE(fs::exists(bench.out()));
}

}  // namespace

TEST_CASE("the pier is sound", "[bad_input]") {
  Bench bench;
  CHECK(bench.run(pier) == 0);
  INFO(bench.said);
}

TEST_CASE("a recorder of joints takes the group on their other side", "[bad_input]") {
  Bench bench;
  CHECK(bench.run(pier + "recorder{ name = 'r', quantity = 'opening', group = 'ground', other_group = 'pier' }", {"--no-figures"}) == 0);
  INFO(bench.said);
}

TEST_CASE("what a scene says wrong is one message with its place and remedy", "[bad_input]") {
  Bench bench;
  const std::string at = "scene.lua:7: ";
  const BadPiece list[] = {
      {"box{ size = {1, 1, 1}", {"scene.lua:", "'}' expected"}},
      {"boxx{ size = {1, 1, 1} }", {at, "unknown name \"boxx\"; did you mean \"box\"?"}},
      {"box{ sise = {1, 1, 1}, at = {5, 5, 5}, free = true }", {at, "box: unknown key \"sise\"; did you mean \"size\"?"}},
      {"box{ at = {5, 5, 5}, free = true }", {at, "\"size\" is missing"}},
      {"masonry_stiffness{ E = 5*GPa }", {at, "masonry_stiffness: \"spacing\" is missing"}},
      {"masonry_stiffness{ spacing = .5 }", {at, "masonry_stiffness: \"E\" is missing"}},
      {"masonry_stiffness{ E = 5*GPa, spacing = 0 }", {at, "spacing = 0 m is out of range"}},
      {"masonry_stiffness{ E = -1, spacing = .5 }", {at, "E = -1 Pa is out of range"}},
      {"masonry_stiffness{ E = 1e9, spacing = .5, nu = .6 }", {at, "nu = 0.6 is out of range; allowed is -0.99 to 0.5"}},
      {"masonry_stiffness{ E = 1e9, spacing = .5, h = .5 }", {at, "unknown key \"h\""}},
      {"analysis{ kind = 'pushover', pattern = {} }", {at, "pattern must be a list of one table or more"}},
      {"gravity{ 0, 0 }", {at, "value 3 is missing", "add it behind the others"}},
      {"camera{ name = 'c', eye = {5, 5, 5}, target = {0, 0, 0}, up = {0, 0, 0} }", {at, "up is zero"}},
      {"building{ plan = {2, 2}, courses = '5', brick = { length = .3, width = .1, height = .1 }, joint = 0, material = 'brick' }",
       {at, "building: courses must be a whole number"}},
      {"recorder{ name = 'r', quantity = 'reaction', blocks = {} }", {at, "blocks names no block"}},
      {"recorder{ name = 'r', quantity = 'reaction', group = '' }", {at, "group names no block"}},
      {"expect('dt_s', 1, { below = false })", {at, "below = false says nothing"}},
      {"rocking{ width = .2, height = 1, theta = .05, p = -1, duration = 1 }", {at, "p = -1 rad/s is out of range"}},
      {"for i = 1, 3 do rocking{ width = .2, height = 1, theta = .05, p = -1, duration = 1 } end", {at, "p = -1 rad/s is out of range"}},
      {"rocking_overturning{ width = .2, height = -1, wave = full_sine{ amplitude = 1, frequency = 1 } }", {at, "height = -1 m is out"}},
      {"spectral_acceleration{ wave = half_sine{ amplitude = 1, frequency = 1 }, period = -1 }", {at, "period = -1 s is out of range"}},
      {"spectral_acceleration{ wave = math.sin, period = 1 }", {at, "wave must be a wave", "table_wave"}},
      {"masonry_stiffness(5)", {at, "masonry_stiffness takes a table of keys"}},
      {"joint{ law = mortar{ kn = 1e10, ft = 0, c = 0, mu = .6, fc = 10*MPa, Gc = 4000 } }",
       {at, "Gc = 4000 J/m2 is not above the elastic energy at the peak", "= 5000 J/m2", "give Gc more than that"}},
      {"joint{ law = mortar{ kn = 1e10, ft = 0, c = 0, mu = .6, Gc = 4000 } }", {at, "no strength to lose", "give fc"}},
      {"joint{ law = mortar{ kn = 1e10, ft = 0, c = 0, mu = .6, fc = 10*MPa, Gc = -1 } }", {at, "Gc = -1 J/m2 is out of range"}},
      {"joint{ law = dry{ kn = 1e10, mu = .6, Gc = 4000 } }", {at, "unknown key \"Gc\""}},
      {"joint{ law = mortar{ kn = 1e10, ft = 0, c = 0, mu = .6, fc = 10*MPa }, pressure = 'points', points = 64 }",
       {at, "64 contact points bear the joint between", "with fc, up to 36 do: take fewer points, or pressure"}},
      {"joint{ law = dry{ kn = 1e10, mu = .6 }, pressure = 'corners' }", {at, "\"corners\"", "is not one of face, points"}},
      {"recorder{ name = 'r', quantity = 'normal_stres', block = 'b1' }", {at, "did you mean \"normal_stress\"?"}},
      {"analysis{ sleep = 'deep' }", {at, "sleep must be true or false"}},
      {"analysis{ levels = 3, solver = 'sequential' }", {at, "the sequential solver has one level only", "levels = 1"}},
      {"analysis{ levels = 3, kernel = 'reference' }", {at, "kernel = \"reference\" has one level only", "levels = 1"}},
      {"analysis{ levels = 0 }", {at, "levels", "1 to 8"}},
      {"analysis{ sleep = true, solver = 'sequential' }", {at, "lets no debris sleep", "leave sleep out", "leapfrog"}},
      {"material{ name = 'm', density = -5 }", {at, "density = -5 kg/m3 is out of range; allowed is 0.01 to 100000 kg/m3"}},
      {"material{ name = 'm', density = '5' }", {at, "density must be a number in kg/m3"}},
      {"box{ size = {0, 1, 1}, at = {5, 5, 5}, free = true }", {at, "size[1] = 0 m is out of range; allowed is"}},
      {"box{ size = {0/0, 1, 1}, at = {5, 5, 5}, free = true }", {at, "size[1] is not a number (0/0?); allowed is"}},
      {"box{ size = {1, 1, 1}, at = {1/0, 5, 5}, free = true }", {at, "at[1] is infinite (1/0?); allowed is"}},
      {"box{ size = {1, 1, 1}, at = {5, 5, 5}, material = 'brik', free = true }", {at, "\"brik\" is unknown; did you mean \"brick\"?"}},
      {"box{ name = 'b1', size = {1, 1, 1}, at = {5, 5, 5}, free = true }", {at, "block \"b1\" is there twice; give one of them"}},
      {"box{ size = {.3, .125, .1}, at = {0, 0, .399} }", {at, "overlap by 1 mm", "at most 0.001", "part them", "stress_free"}},
      {"box{ name = 'l', size = {.3, .125, .1}, at = {3, 0, 3} }", {at, "block 'l' has no joint", "free = true"}},
      {"analysis{ duration = 0 }", {at, "duration = 0 s is out of range; allowed is 1e-09 to 1e+06 s"}},
      {"analysis{ duration = math.huge }", {at, "duration is infinite (1/0?); allowed is 1e-09 to 1e+06 s"}},
      {"analysis{ duration = 1, dt = 0.1 }",
       {at, "analysis: dt = 0.1 s", "times the limit", "set by the joints of block", "take at most", "unstable = true"}},
      {"recorder{ name = 'r', quantity = 'displacement', block = 'b1', group = 'peir' }",
       {at, "group \"peir\" has no blocks; did you mean \"pier\"?"}},
      {"recorder{ name = 'r', quantity = 'opening', block = 'b1', others = 'b2', other_group = 'peir' }",
       {at, "group \"peir\" has no blocks; did you mean \"pier\"?"}},
      {"recorder{ name = 'r', quantity = 'displacement', block = 'b1', others = 'b2' }",
       {at, "displacement is no quantity of joints", "leave out others"}},
      {"recorder{ name = 'r', quantity = 'ground_velocity', block = 'b1' }", {at, "ground_velocity is of the ground", "leave out block"}},
      {"recorder{ name = 'r', quantity = 'gravity', group = 'pier' }", {at, "gravity is of the ground", "leave out block"}},
      {"recorder{ name = 'r', quantity = 'contact_points', blocks = { 'b1' } }", {at, "is of the whole model", "leave out block"}},
      {"recorder{ name = 'r', quantity = 'opening', block = 'b1', point = { 0, 0, 1 } }",
       {at, "point goes with quantities of blocks", "leave it out"}},
      {"recorder{ name = 'r', quantity = 'momentum', frame = 'abs' }", {at, "frame goes with the motion of blocks", "leave it out"}},
      {"damping{ mass = 1 } damping{ joint_ratio = .02 }", {at, "damping: it was given before, at ", "scene.lua:7; put all keys into one"}},
      {"gravity(9.81) gravity{ 0, 0, -1.6 }", {at, "gravity: it was given before, at ", "scene.lua:7; keep one"}},
      {"building{ plan = { 2, 2 }, courses = 2, brick = { length = .25, width = .12, height = .06 }, joint = .01, walls = { 'a', 'b' } }",
       {at, "walls has 2 names for 4 runs of the plan", "give one for each"}},
      {"joint{ law = mortar{ E = 1e9, kn = 1e11, thickness = .01, ft = 1e5, c = 2e5, mu = .6 } }",
       {at, "mortar: E and kn both give the normal stiffness", "leave one out"}},
      {"joint{ law = mortar{ kn = 1e11, G = 1e9, ks = 1e10, thickness = .01, ft = 1e5, c = 2e5, mu = .6 } }", {at, "G and ks both give"}},
      {"joint{ law = mortar{ kn = 1e11, ft = 1e5, c = 2e5, mu = .6, Gf1 = 10, un_ultimate = 1e-3 } }", {at, "Gf1 and un_ultimate both"}},
      {"joint{ law = mortar{ kn = 1e11, ft = 1e5, c = 2e5, mu = .6, Gf2 = 10, us_ultimate = 1e-3 } }", {at, "Gf2 and us_ultimate both"}},
      {"recorder{ name = 'r', quantity = 'displacement', block = 'b11' }", {at, "there is no block \"b11\"; did you mean \"b1\"?"}},
      {"recorder{ name = 'r', quantity = 'load', blocks = { 'b1', 'b2', 'b1' } }", {at, "block \"b1\" is listed twice"}},
      {"recorder{ name = 'r', quantity = 'displacment', block = 'b1' }", {at, "did you mean \"displacement\"?; allowed: displacement, "}},
      {"tilt{ wave = 30, axis = 'y' }", {at, "tilt: its wave reaches 30 rad, 4.77 turns", "30 * deg"}},
      {"tilt{ wave = function(t) return 900 * t end, axis = 'y' }", {at, "turns; angles are in radians"}},
      {"motion{ block = 'b1', wave = 0 } force{ block = 'b1', wave = 1 }", {at, "force: block \"b1\" is driven by motion{}"}},
      {"force{ block = 'b11', wave = 1 }", {at, "force: there is no block \"b11\"; did you mean \"b1\"?"}},
      {"force{ block = 'b1', wave = 0/0 }", {at, "wave is not a number (0/0?); allowed is any finite number in N"}},
      {"expect('metrics.top', 3, { rel = .1 })", {at, "there is no metric \"top\""}},
      {"expect('energy.kinetic', 3, { rel = .1 })", {at, "no key \"energy.kinetic\"; did you mean \"energy.kinetic_J\"?"}},
      {"joint{ between = {'piers', ''}, law = dry{ kn = 1e9, mu = .6 } }", {at, "no block is of group \"piers\"; did you mean \"pier\"?"}},
      {"joint{ between = {'pier', 'pier'}, law = mortar{ kn = 1e9, ft = 1e5, c = 1e5, mu = .6, kn_cracked = 2e9 } }",
       {at, "kn_cracked = 2e+09 Pa/m lies above kn = 1e+09 Pa/m", "lower it, or leave it out"}},
      {"ground_motion{ wave = 1, direction = {0, 0, 0} }", {at, "direction has no length; give a vector such as { 1, 0, 0 }"}},
      {"ground_motion{ wave = record{ file = el_centro, peak = -1 } }", {at, "peak = -1 m/s2 is out of range"}},
      {"mesh{ file = 'no.obj', free = true }", {at, "\"no.obj\" is not there; looked for", "correct the name"}},
      {"wall{ lenth = 3, joint = .01, courses = 2, brick = { length = .3, width = .1, height = .1 }, length = 2 }",
       {at, "unknown key \"lenth\"; did you mean \"length\"?"}},
  };
  for (const BadPiece& bad : list) refuses(bench, bad);
}

TEST_CASE("a record that cannot be read names the scene's line and the file's", "[bad_input]") {
  Bench bench;
  bench.write("empty.csv", "");
  bench.write("names.csv", "time_s,acc_g\n");
  bench.write("letter.csv", "0, 0.1\n0.02, 0.2x\n0.04, 0.1\n");
  bench.write("nan.txt", "0.1\nnan\n");
  bench.write("short.at2", "PEER\nX\nACCELERATION IN UNITS OF G\nNPTS= 10, DT= .01 SEC\n.1 .2 .3\n");
  const auto wave = [](const std::string& keys) { return "ground_motion{ wave = record{ file = " + keys + " }, direction = 'x' }"; };
  const BadPiece list[] = {
      {wave("'nope.csv'"), {"scene.lua:7: ", "\"nope.csv\" is not there; looked for", "put the file beside the scene"}},
      {wave("'empty.csv', unit = 'g'"), {"scene.lua:7: record: ", "empty.csv: the record file is empty; give a file with numbers"}},
      {wave("'names.csv'"), {"scene.lua:7: record: ", "names.csv: ", "holds no numbers"}},
      {wave("'letter.csv', unit = 'g'"), {"scene.lua:7: record: ", "letter.csv:2: column 7: \"0.2x\" is not a number; correct it"}},
      {wave("'nan.txt', unit = 'g', dt = .01"), {"scene.lua:7: record: ", "nan.txt:2: ", "\"nan\" is not a number"}},
      {wave("'short.at2'"), {"scene.lua:7: record: ", "short.at2:4: NPTS promises 10 values, the file holds 3"}},
      {wave("'letter.csv'"), {"scene.lua:7: record: ", "letter.csv:"}},
  };
  for (const BadPiece& bad : list) refuses(bench, bad);
}

TEST_CASE("a mesh that is no solid is refused", "[bad_input]") {
  Bench bench;
  const std::string corners = "o cube\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 2\nv 1 0 2\nv 0 1 2\n";
  const std::string sides = "f 4 3 2 1\nf 5 6 8 7\nf 2 3 8 6\nf 3 4 7 8\nf 4 1 5 7\n", front = "f 1 2 6 5\n";
  bench.write("whole.obj", corners + "v 1 1 2\n" + sides + front);
  bench.write("open.obj", corners + "v 1 1 2\n" + sides);
  bench.write("dented.obj", corners + "v 0.4 0.4 1\n" + sides + front);
  bench.write("junk.obj", "");
  const auto mesh = [](const std::string& file) { return "mesh{ file = '" + file + "', at = {5, 5, 5}, free = true }"; };
  CHECK(bench.run(pier + mesh("whole.obj"), {"--force"}) == 0);
  INFO(bench.said);
  fs::remove_all(bench.out());
  refuses(bench, {mesh("open.obj"), {"scene.lua:7: mesh: ", "\"cube\"", "is not a closed surface at its edge", "close its holes"}});
  refuses(bench, {mesh("dented.obj"), {"scene.lua:7: mesh: ", "\"cube\"", "is not convex", "split it"}});
  refuses(bench, {mesh("junk.obj"), {"scene.lua:7: mesh: ", "cannot read the mesh"}});
}

TEST_CASE("a script without end is stopped", "[bad_input]") {
  Bench bench;
  refuses(bench, {"while true do end", {"scene.lua:7: the script ran longer than 10 s; a loop may never end"}});
}

TEST_CASE("all mistakes come at once, in the order of the lines, overlaps among them", "[bad_input]") {
  Bench bench;
  CHECK(bench.run(pier + R"(box{ sise = {1, 1, 1} }
material{ name = "a", density = "heavy" }
force{ block = "b77", wave = 1 }
for i = 1, 3 do box{ group = "pier", material = "brick", size = {.3, .125, .1}, at = {0, 0, .399 + i * .098} } end
recorder{ name = "q", quantity = "displacement", block = "b9" }
analysis{ durration = 1 }
expect("state_hsh", "x"))") == 2);
  INFO(bench.said);
  const std::string begins[] = {"box: unknown key",         "material: density must",       "force: there is no block", "blocks '",
                                "recorder \"q\": there is", "analysis: unknown key \"durr", "expect: metrics.json has"};
  const auto lines = lines_of(bench.said);
  REQUIRE(lines.size() == 7);
  for (size_t i = 0; i < 7; ++i) CHECK(contains(lines[i], fmt::format("scene.lua:{}: {}", i + 7, begins[i])));
  CHECK(contains(lines[3], "more pair(s) of these lines"));
}

TEST_CASE("an overlap below a thousandth is warned of and carries no force", "[bad_input]") {
  Bench bench;
  const std::string rest = "gravity(0)\n";
  CHECK(bench.run(pier + rest + "box{ group = 'pier', size = {.3, .125, .1}, at = {0, 0, .39995} }") == 0);
  CHECK(contains(bench.said, "overlap by 0.05 mm"));
  CHECK(contains(bench.said, "free of force at rest"));
  CHECK(read_json(bench.out() + "/metrics.json")["energy"]["elastic_J"].get<double>() < 1e-12);
  CHECK(bench.run(pier + rest +
                      "box{ group = 'pier', size = {.3, .125, .1}, at = {0, 0, .398} }\nanalysis{ duration = .01, overlap = "
                      "'stress_free' }",
                  {"--force"}) == 0);
  CHECK(read_json(bench.out() + "/metrics.json")["energy"]["elastic_J"].get<double>() < 1e-12);
}

TEST_CASE("a block without joint is legal where it is free or starts in motion", "[bad_input]") {
  Bench bench;
  const std::string box = "box{ size = {.3, .2, .1}, at = {3, 0, 3}, ";
  CHECK(bench.run(pier + box + "free = true }") == 0);
  CHECK(bench.run(pier + box + "initial = { velocity = {1, 0, 0} } }", {"--force"}) == 0);
  INFO(bench.said);
}

TEST_CASE("a joint rule may name a group that this case of the scene has none of", "[bad_input]") {
  Bench bench;
  const auto between = [](const std::string& group) { return "joint{ between = {'" + group + "', ''}, law = dry{ kn = 1e9, mu = .6 } }"; };
  for (const std::string group : {"lintel", "pier2"}) {
    CHECK(bench.run(pier + between(group), {"--force"}) == 0);
    CHECK(contains(bench.said, "warning: "));
    CHECK(contains(bench.said, "scene.lua:7: joint: no block is of group \"" + group + "\", so that this rule joins nothing"));
    CHECK_FALSE(contains(bench.said, "no faces lie at most"));
  }
  CHECK(bench.erbs({"check", bench.scene(pier + between("lintel"))}) == 0);
  CHECK(contains(bench.said, "scene.lua:7: joint: no block is of group"));
}

TEST_CASE("a joint rule that joins nothing is warned of", "[bad_input]") {
  Bench bench;
  CHECK(bench.run(pier + "joint{ between = {'ground', 'ground'}, law = dry{ kn = 1e9, mu = .6 } }") == 0);
  CHECK(contains(bench.said, "warning: "));
  CHECK(contains(bench.said, "scene.lua:7: this joint rule joins nothing"));
  CHECK(contains(text_of(bench.out() + "/log.txt"), "joins nothing"));
}

TEST_CASE("an option -D must name a param of the scene and give a number, once", "[bad_input]") {
  Bench bench;
  const std::pair<std::string, std::string> list[] = {
      {"durtion=1", "-D durtion=1: the scene has no param \"durtion\"; did you mean \"duration\"?"},
      {"duration=1*furlong", "-D duration=1*furlong: unknown name \"furlong\""},
      {"duration=1+", "-D duration=1+: unexpected symbol"},
      {"duration=", "must be a finite number, such as 0.8*g, not nil"},
      {"duration=0/0", "must be a finite number"},
      {"duration=0,4", "-D duration=0,4: a comma parts two values; write one, with a decimal point"},
      {"duration='1'", "must be a finite number, such as 0.8*g, not the string"},
      {"duration", "write -D name=value"},
      {"duration=-1", "scene.lua:5: analysis: duration = -1 s is out of range"},
  };
  for (const auto& [define, message] : list) {
    INFO(define);
    CHECK(bench.run(pier, {"-D", define}) == 2);
    INFO(bench.said);
    CHECK(contains(bench.said, message));
    CHECK(lines_of(bench.said).size() == 1);
    CHECK_FALSE(fs::exists(bench.out()));
  }
  CHECK(bench.run(pier, {"-D", "duration=1", "-D", "duration=2"}) == 2);
  CHECK(contains(bench.said, "-D duration=2: duration was given before, as 1; keep one"));
}

TEST_CASE("options out of range are refused before anything is written", "[bad_input]") {
  Bench bench;
  const std::pair<std::vector<std::string>, std::string> list[] = {
      {{"--threads", "0"}, "not in range 1 to 1024"},
      {{"--until", "-1"}, "--until -1: not a length of time"},
      {{"--until", "inf"}, "not a length of time"},
      {{"--max-wall", "0"}, "leaves no time to run"},
      {{"--max-wall", "x"}, "not a length of time"},
      {{"--resume"}, "nothing to resume: there is no folder"},
      {{"--resume", "--force"}, "exclude each other"},
      {{"--threds", "2"}, "erbs run has no option --threds; did you mean \"--threads\"?"},
      {{"--frobnicate=3"}, "erbs run has no option --frobnicate"},
      {{"-z", "2"}, "erbs run has no option -z"},
      {{"--force=1"}, "--force takes no value"}};
  for (const auto& [words, message] : list) {
    CHECK(bench.run(pier, words) == 2);
    INFO(bench.said);
    CHECK(contains(bench.said, message));
    CHECK_FALSE(fs::exists(bench.out()));
  }
  CHECK(bench.erbs({"-v"}) == 2);
  CHECK(contains(bench.said, "see erbs help"));
  CHECK_FALSE(contains(bench.said, "help -v"));
  const std::string push = pier.substr(0, pier.find("analysis")) + "analysis{ kind = 'pushover', up_to = .02, limit = 'never' }\n";
  const std::pair<std::vector<std::string>, std::string> of_push[] = {
      {{"--from", "1"}, "--from is a time, and a push has none"},
      {{"--until", "1"}, "--until is a time, and a push has none"},
      {{"--twin"}, "--twin finds the time at which two runs part, and a push has none"},
      {{"--set", "bracket=2"}, "must be a number from 1e-06 to 0.5"},
      {{"--set", "step=5"}, "step = 5 is beyond up_to = 0.02"},
      {{"--set", "patern=3"}, "did you mean \"pattern\"?"},
      {{"--set", "bracket=0.1*"}, "must be a number from 1e-06 to 0.5"},
      {{"--set", "bracket={}"}, "must be a number from 1e-06 to 0.5"},
      {{"--set", "gyroscopic=2"}, "must be true or false"},
      {{"--set", "path=3"}, "path may be a table, and --set takes numbers and words alone"},
      {{"--set", "brackt=0.1"}, "did you mean \"bracket\"?"}};
  for (const auto& [words, message] : of_push) {
    CHECK(bench.run(push, words) == 2);
    INFO(bench.said);
    CHECK(contains(bench.said, message));
  }
  CHECK(bench.run(pier, {"--set", "bracket=0.1"}) == 2);
  CHECK(contains(bench.said, "belongs to a push"));
  CHECK(bench.run(push, {"--set", "bracket=0.2*0.5", "--set", "relaxation=local", "--set", "gyroscopic=false", "-q", "--no-figures"}) == 0);
  CHECK(bench.run(pier, {"--set", "duration=20*ms", "-q", "--no-figures", "--force"}) == 0);
  CHECK(read_json(bench.out() + "/metrics.json")["time_s"].get<double>() == Approx(0.02).margin(1e-3));
  CHECK(bench.erbs({"frobnicate"}) == 2);
  CHECK(contains(bench.said, "there is no verb frobnicate; known: run, check"));
  CHECK(bench.erbs({"chek"}) == 2);
  CHECK(contains(bench.said, "there is no verb chek; did you mean \"check\"?"));
}

TEST_CASE("a folder that cannot be written, or is none of ours, is left as it is", "[bad_input]") {
  Bench bench;
  bench.write("file", "mine");
  fs::create_directories(bench.folder / "own");
  bench.write("own/notes.txt", "mine");
  const std::string scene = bench.scene(pier);
  for (const std::string name : {"file", "own"}) {
    CHECK(bench.erbs({"run", scene, "-o", (bench.folder / name).string()}) == 2);
    CHECK(contains(bench.said, "exists; choose another with -o DIR"));
    CHECK(bench.erbs({"run", scene, "-o", (bench.folder / name).string(), "--force"}) == 2);
    CHECK(contains(bench.said, "choose another with -o DIR"));
  }
  CHECK(text_of(bench.folder / "file") == "mine");
  CHECK(text_of(bench.folder / "own/notes.txt") == "mine");
  CHECK(bench.erbs({"run", scene, "-o", (bench.folder / "file/below").string()}) == 2);
  CHECK(contains(bench.said, "cannot be made"));
  CHECK(bench.erbs({"run", scene, "-o", "/proc/erbs/run"}) == 2);
  CHECK(contains(bench.said, "cannot be made"));
}

TEST_CASE("a bad scene does not touch the run of before, --force or not", "[bad_input]") {
  Bench bench;
  REQUIRE(bench.run(pier) == 0);
  const std::string before = text_of(bench.out() + "/metrics.json");
  CHECK(bench.run(pier + "box{ sise = 1 }", {"--force"}) == 2);
  CHECK(bench.run(pier + "analysis{ duration = 1, dt = 1 }", {"--force"}) == 2);
  CHECK(text_of(bench.out() + "/metrics.json") == before);
}

TEST_CASE("check tells the mistakes of every scene, and writes nothing", "[bad_input]") {
  Bench bench;
  const std::string scene = bench.scene(pier);
  bench.write("bad.lua", "box{ sise = 3 }\n");
  bench.write("worse.lua", "boxx{}\n");
  CHECK(bench.erbs({"check", (bench.folder / "bad.lua").string(), (bench.folder / "worse.lua").string(), scene}) == 2);
  INFO(bench.said);
  for (const char* part :
       {"bad.lua:1: box: unknown key", "worse.lua:1: unknown name \"boxx\"", "model: 5 blocks, 4 joints, 36 contact points", "dt_critical",
        "estimate: ", "steps for 0.01 s", "debris contact", "scene.lua:4", "energy ledger"}) {
    INFO(part);
    CHECK(contains(bench.said, part));
  }
  CHECK(std::distance(fs::directory_iterator(bench.folder), {}) == 4);  // three scenes and the log
}

TEST_CASE("what a script prints stands at the head of the run's log", "[program]") {
  Bench bench;
  REQUIRE(bench.run(pier + "print('five bricks whole')", {"-q"}) == 0);
  CHECK(bench.said.empty());
  CHECK(text_of(bench.out() + "/log.txt").starts_with("five bricks whole\n"));
}

TEST_CASE("a file that is no script is named as such", "[lua]") {
  Bench bench;
  for (const std::string& text : {std::string("{ \"status\": \"completed\" }"), std::string("\n<html>"), std::string("HDF\0\0", 5)}) {
    CHECK(bench.run(text) == 2);
    CHECK(contains(bench.said, ":1: this is no Lua script, as a scene is one"));
  }
}
