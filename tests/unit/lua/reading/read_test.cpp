// Every mistake in a script is reported with its place, cause and remedy, and all of them at once.
#include <catch2/catch.hpp>

#include "tests/unit/lua/load.h"

using namespace erbs;
using namespace erbs::lua;

TEST_CASE("a sound scene has no mistakes", "[lua]") { CHECK(mistakes_in("").empty()); }

TEST_CASE("a syntax error names its line", "[lua]") {
  const auto mistakes = mistakes_in("box{ size = {1,1,1}");
  REQUIRE(mistakes.size() == 1);
  CHECK(contains(mistakes[0], "scene.lua:6:"));
  CHECK(contains(mistakes[0], "'}' expected"));
}

TEST_CASE("an unknown key names the nearest known one", "[lua]") {
  const auto mistakes = mistakes_in("box{ size = {1,1,1}, at = {3,0,0}, matrial = 'brick' }");
  REQUIRE(mistakes.size() == 1);
  CHECK(mistakes[0] == "scene.lua:6: box: unknown key \"matrial\"; did you mean \"material\"?");
}

TEST_CASE("a number out of range names the range and its unit", "[lua]") {
  const auto mistakes = mistakes_in("material{ name = 'stone', density = -2500 }");
  REQUIRE(mistakes.size() == 1);
  CHECK(mistakes[0] == "scene.lua:6: material: density = -2500 kg/m3 is out of range; allowed is 0.01 to 100000 kg/m3");
}

TEST_CASE("a wrong type says what was wanted and what came", "[lua]") {
  CHECK(mistakes_in("material{ name = 'stone', density = '2500' }")[0] ==
        "scene.lua:6: material: density must be a number in kg/m3, not the string \"2500\"");
  CHECK(mentions(mistakes_in("box{ size = 3, material = 'brick' }"), "size must be a vector { x, y, z } in m, not the number 3"));
  CHECK(mentions(mistakes_in("box{ size = {1, 2}, material = 'brick' }"), "size must be { x, y, z }, not a table of 2"));
  CHECK(mentions(mistakes_in("box{ size = {1, true, 3}, material = 'brick' }"), "size[2] must be a number in m, not true"));
  CHECK(mentions(mistakes_in("box{ size = {1, 2, 3, x = 4}, material = 'brick' }"), "size is a list and has a key \"x\""));
  CHECK(mentions(mistakes_in("ground_motion{ wave = table_wave{ times = {0, 1, n = 2}, values = {0, 1} } }"), "has a key \"n\""));
  CHECK(mentions(mistakes_in("prism{ polygon = {{0, 0}, {1, 0, z = 1}, {0, 1}}, length = 1, material = 'brick' }"), "has a key \"z\""));
  CHECK(mentions(mistakes_in("box 'b'"), "box takes a table of keys, not the string \"b\"; write box{ ... }"));
  CHECK(mentions(mistakes_in("joint{ law = 5 }"), "law must be a joint law"));
  CHECK(mentions(mistakes_in("analysis{ duration = 0/0 }"), "duration is not a number"));
  CHECK(mentions(mistakes_in("ground_motion{ wave = 1/0 }"), "wave is infinite (1/0?); allowed is any finite number in m/s2"));
  CHECK(mentions(mistakes_in("joint{ law = dry{ kn = 1e9, mu = 0.6 }, points = 5 }"), "points = 5 is no square number"));
}

TEST_CASE("a missing key is named with its meaning", "[lua]") {
  const auto mistakes = mistakes_in("material{ name = 'stone' }");
  REQUIRE(mistakes.size() == 1);
  CHECK(mistakes[0] == "scene.lua:6: material: \"density\" is missing (mass per volume of the block); add density = ...");
  CHECK(mentions(mistakes_in("joint{ between = {'a', 'b'} }"), "\"law\" is missing"));
}

TEST_CASE("a word outside its list names the list", "[lua]") {
  CHECK(mentions(mistakes_in("analysis{ duration = 1, kernel = 'fats' }"),
                 "kernel = \"fats\" is not one of fast, reference; did you mean \"fast\"?"));
}

TEST_CASE("all mistakes come at once, each with its line", "[lua]") {
  const auto mistakes =
      mistakes_in("box{ size = {1,1,1}, material = 'brik' }\nmaterial{ name = 'x', density = 0 }\nforce{ block = 'c', wave = 1 }\nbxo{}");
  REQUIRE(mistakes.size() == 3);
  CHECK(contains(mistakes[0], "scene.lua:6: box: material \"brik\" is unknown; did you mean \"brick\"?"));
  CHECK(contains(mistakes[1], "scene.lua:7: material: density = 0"));
  CHECK(contains(mistakes[2], "scene.lua:9: unknown name \"bxo\"; did you mean \"box\"?"));
  CHECK(mentions(mistakes_in("force{ block = 'c', wave = 1 }\nbox{ size = {1,1,1}, sise = 2 }"),
                 "scene.lua:6: force: there is no block \"c\""));
}

TEST_CASE("a mistake in a loop is reported once, and very many end the script", "[lua]") {
  CHECK(mistakes_in("for i = 1, 1000 do box{ size = {1,1,1}, at = {2*i,0,0}, sise = 3 } end").size() == 1);
  CHECK(mistakes_in("for i = 1, 1000 do box{ size = {1,1,1}, ['k' .. i] = 3 } end").size() <= 51);
}

TEST_CASE("names of the language stay what they are", "[lua]") {
  CHECK(mentions(mistakes_in("t = 5*mm"), "scene.lua:6: \"t\" is a name of the language; write local t"));
  CHECK(mistakes_in("thickness_of_wall = 5*mm").empty());
  CHECK(mentions(mistakes_in("local x = undefined_thing"), "unknown name \"undefined_thing\""));
}

TEST_CASE("the option -D gives params their values and names those it does not find", "[lua]") {
  const std::string piece = "local pga = param('pga', 0.4*g, 'peak of the record, assumed [m/s2]')\nground_motion{ wave = pga }";
  const Scene plain = scene_of(piece), changed = scene_of(piece, {{"pga", "0.8*g"}});
  CHECK(plain.params.at(0).value == Approx(0.4 * 9.81));
  CHECK(plain.params.at(0).unit == "m/s2");
  CHECK(plain.params.at(0).text == "peak of the record, assumed");
  CHECK(changed.params.at(0).value == Approx(0.8 * 9.81));
  CHECK(changed.params.at(0).fallback == Approx(0.4 * 9.81));
  CHECK(std::get<Pulse>(changed.loads.at(0).wave).amplitude == Approx(0.8 * 9.81));
  CHECK(mistakes_in(piece, {{"pgb", "1"}})[0] == "-D pgb=1: the scene has no param \"pgb\"; did you mean \"pga\"?");
  CHECK(mentions(mistakes_in(piece, {{"pga", "0.8*"}}), "-D pga=0.8*: unexpected symbol"));
  CHECK(mentions(mistakes_in(piece, {{"pga", "'big'"}}), "the value must be a finite number"));
}

TEST_CASE("expectations need a tolerance and a metric that exists", "[lua]") {
  CHECK(mentions(mistakes_in("expect('steps', 3)"), "add how near it must be, such as { rel = 0.01 }"));
  CHECK(mentions(mistakes_in("metric('drift', 'm', 1)\nexpect('metrics.drif', 3, { rel = 0.1 })"),
                 "there is no metric \"drif\"; did you mean \"metrics.drift\"?"));
  CHECK(mentions(mistakes_in("expect('steps', 3, { rel = 0.1, abs = 1 })"), "give one of rel, abs, below, above, between"));
}

TEST_CASE("an error inside a function of time carries its line", "[lua]") {
  CHECK(mentions(mistakes_in("ground_motion{ wave = function(x)\n return x.y\nend }"), "scene.lua:7: attempt to index a number value"));
  CHECK(mentions(mistakes_in("ground_motion{ wave = function(x) return 'a' end }"), "it must return a finite number"));
}

TEST_CASE("a missing record and mesh file say where they were looked for", "[lua]") {
  CHECK(mentions(mistakes_in("ground_motion{ wave = record{ file = 'nope.csv' } }"),
                 "scene.lua:6: file \"nope.csv\" is not there; looked for"));
  CHECK(mentions(mistakes_in("mesh{ file = 'nope.obj' }"), "scene.lua:6: mesh: file \"nope.obj\" is not there; looked for"));
}
