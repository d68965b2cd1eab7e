// Each function of the language fills the `Scene` with its arguments.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "engine/geometry/mass.h"
#include "tests/support/folder.h"
#include "tests/unit/lua/load.h"

using namespace erbs;
using namespace erbs::lua;

namespace {

bool near(const Vec3& a, const Vec3& b, double tolerance = 1e-12) { return (a - b).norm() < tolerance; }

Vec3 centroid(const Block& block) { return mass_properties(block.parts).centroid; }

}  // namespace

TEST_CASE("units are factors to SI", "[lua]") {
  const Scene scene =
      scene_of("gravity{ 3e-3*km, 20*cm + 5*mm, -1*t/kg }\nanalysis{ duration = 500*ms, dt = 1e-4, lazy_rotation = 0.1*deg }");
  CHECK(near(scene.gravity, {3, 0.205, -1000}));
  CHECK(scene.analysis.duration == 0.5);
  CHECK(scene.analysis.lazy_rotation == Approx(pi / 1800));
}

TEST_CASE("material, box and the place they were said", "[lua]") {
  const Scene scene = scene_of(
      "material{ name = 'stone', density = 2500, kn = 4*GPa/m, friction = 0.7, color = {.1,.2,.3} }\n"
      "box{ name = 'a', group = 'wall', size = {2,1,.5}, center = {0,0,3}, material = 'stone', fixed = true }");
  const Material& stone = scene.materials.at(1);
  CHECK(stone.density == 2500);
  CHECK(stone.kn == 4e9);
  CHECK(stone.friction == 0.7);
  CHECK(near(stone.color, {.1, .2, .3}));
  CHECK(stone.place.text() == "scene.lua:6");
  const Block& block = scene.blocks.at(1);
  CHECK(block.name == "a");
  CHECK(block.group == "wall");
  CHECK(block.fixed);
  CHECK(block.material == 1);
  CHECK(block.place.line == 7);
  CHECK(near(centroid(block), {0, 0, 3}));
  CHECK(mass_properties(block.parts).volume == Approx(1.0));
}

TEST_CASE("a box turns about its centre, a transform turns all inside it", "[lua]") {
  const Scene scene = scene_of(
      "box{ size = {2,1,1}, center = {5,0,0}, rotation = {0,0,90*deg}, material = 'brick' }\n"
      "transform{ at = {0,0,10}, rotation = {0,0,90*deg}, about = {1,0,0}, function()\n"
      "  box{ size = {2,1,1}, center = {3,0,0}, material = 'brick', initial = { velocity = {1,0,0}, about = {3,0,0} } }\n"
      "  transform{ at = {1,0,0}, function() box{ size = {1,1,1}, center = {1,0,0}, material = 'brick' } end }\n"
      "  force{ block = 'b', wave = 3*N, direction = 'x', point = {2,0,0} }\n"
      "end }");
  Vec3 extent = Vec3::Zero();
  for (const Vec3& v : scene.blocks.at(1).parts[0].vertices) extent = extent.cwiseMax((v - Vec3(5, 0, 0)).cwiseAbs());
  CHECK(near(extent, {0.5, 1, 0.5}));
  CHECK(near(centroid(scene.blocks.at(2)), {1, 2, 10}));
  CHECK(near(scene.blocks.at(2).initial().velocity, {0, 1, 0}));
  CHECK(near(scene.blocks.at(2).initial().about, {1, 2, 10}));
  CHECK(near(centroid(scene.blocks.at(3)), {1, 1, 10}));
  CHECK(near(scene.loads.at(0).direction, {0, 1, 0}));
  CHECK(near(scene.loads.at(0).point, {1, 1, 10}));
}

TEST_CASE("block takes faces, a hull, or several parts", "[lua]") {
  const Scene scene = scene_of(
      "block{ vertices = {{0,0,0},{1,0,0},{0,1,0},{0,0,1}}, faces = {{1,3,2},{1,2,4},{1,4,3},{2,3,4}}, material = 'brick' }\n"
      "block{ vertices = {{0,0,0},{1,0,0},{0,1,0},{0,0,1},{.1,.1,.1}}, at = {4,0,0}, material = 'brick' }\n"
      "local cube = {{0,0,0},{1,0,0},{1,1,0},{0,1,0},{0,0,1},{1,0,1},{1,1,1},{0,1,1}}\n"
      "local beside = {} for i, v in ipairs(cube) do beside[i] = { v[1] + 1, v[2], v[3] } end\n"
      "block{ parts = { { vertices = cube }, { vertices = beside } }, at = {0,0,7}, material = 'brick' }");
  CHECK(mass_properties(scene.blocks.at(1).parts).volume == Approx(1.0 / 6));
  CHECK(scene.blocks.at(2).parts[0].vertices.size() == 4);
  CHECK(mass_properties(scene.blocks.at(3).parts).volume == Approx(2.0));
  CHECK(near(centroid(scene.blocks.at(3)), {1, .5, 7.5}));
}

TEST_CASE("prism extrudes along each axis, whichever way its corners run", "[lua]") {
  for (const std::string axis : {"x", "y", "z"})
    for (const std::string corners : {"{{0,0},{2,0},{0,1}}", "{{0,0},{0,1},{2,0}}"}) {
      const Scene scene = scene_of("prism{ polygon = " + corners + ", height = 3, axis = '" + axis + "', material = 'brick' }");
      const Block& block = scene.blocks.at(1);
      CHECK(problem_of(block.parts.at(0)) == "");
      CHECK(mass_properties(block.parts).volume == Approx(3.0));
      const int k = axis[0] - 'x';
      Vec3 expected;
      expected[k] = 1.5;
      expected[(k + 1) % 3] = 2.0 / 3;
      expected[(k + 2) % 3] = 1.0 / 3;
      CHECK(near(centroid(block), expected));
    }
}

TEST_CASE("ground is a fixed plate with a friction of its own", "[lua]") {
  const Scene scene = scene_of("ground{ z = -0.5, size = 4, friction = 0.9 }");
  const Block& ground = scene.blocks.at(1);
  CHECK(ground.fixed);
  CHECK(ground.group == "ground");
  CHECK(scene.materials.at(static_cast<size_t>(ground.material)).friction == 0.9);
  CHECK(bounding_box(ground.parts[0]).high.z() == -0.5);
  CHECK(bounding_box(ground.parts[0]).low.x() == -2);
}

TEST_CASE("joint rules and laws", "[lua]") {
  const Scene scene = scene_of(
      "box{ name = 'c', group = 'slab', size = {1,1,1}, at = {3,0,0}, material = 'brick' }\n"
      "joint{ law = mortar{ E = 5*GPa, nu = 0.25, thickness = 5*mm, ft = 0.2*MPa, c = 0.3*MPa, mu = 0.7, Gf1 = 10, coupling = 'linear' } "
      "}\n"
      "joint{ law = dry{ kn = 1e9, mu = 0.6 }, between = {'slab', ''}, points = {5, 3}, rule = 'gauss', tolerance = 1*mm }\n"
      "joint{ between = {'slab', 'slab'}, none = true, points = 9 }");
  const auto& mortar = std::get<Mortar>(scene.joint_rules.at(0).law);
  CHECK(mortar.E == 5e9);
  CHECK(mortar.coupling == "linear");
  CHECK(scene.joint_rules[0].thickness == Approx(0.005));
  const auto& dry = std::get<DryFriction>(scene.joint_rules.at(1).law);
  CHECK(dry.ks == Approx(0.4e9));
  CHECK(scene.joint_rules[1].group_a == "slab");
  CHECK(scene.joint_rules[1].points_long == 5);
  CHECK(scene.joint_rules[1].points_short == 3);
  CHECK(scene.joint_rules[1].rule == "gauss");
  CHECK(scene.joint_rules[2].none);
  CHECK(scene.joint_rules[2].points_long == 3);
  CHECK(mentions(mistakes_in("joint{ law = mortar{ E = 1e9, ft = 0, c = 0, mu = 0.5 } }"), "the mortar has E but no thickness"));
}

TEST_CASE("the stiffness of joints comes from that of masonry, and says how", "[lua]") {
  const Scene scene = scene_of(
      "local k = masonry_stiffness{ E = 5*GPa, nu = 0.25, spacing = 50*cm }\n"
      "joint{ law = mortar{ kn = k.kn, ks = k.ks, ft = 0, c = 0, mu = 0.6 } }\n"
      "for i = 1, 3 do joint{ law = dry{ kn = masonry_stiffness{ E = 2*GPa, spacing = 0.25 }.kn, mu = 0.6 } } end");
  const PointLaw law = compile(scene.joint_rules.at(0).law);
  CHECK(law.kn == Approx(10e9));
  CHECK(law.ks == Approx(4e9));
  CHECK(compile(scene.joint_rules.at(3).law).kn == Approx(8e9));
  REQUIRE(scene.notes.size() == 2);  // a line in a loop says it once
  CHECK(scene.notes[0] == "scene.lua:6: kn = E/h = 10 GPa/m from E = 5 GPa, h = 0.5 m; ks = kn/(2(1+nu)) = 4 GPa/m from nu = 0.25");
  CHECK_THAT(scene.notes[1], Catch::Contains("from nu = 0.2 (default)"));
}

TEST_CASE("waves are values, can be called, and drive loads", "[lua]") {
  const Scene scene = scene_of(
      "local w = sine{ amplitude = 2, frequency = 1, phase = 90*deg }\n"
      "ground_motion{ wave = w, direction = 'y' }\n"
      "ground_motion{ wave = half_sine{ amplitude = 1, frequency = 2 }, direction = {3,0,4} }\n"
      "tilt{ wave = table_wave{ times = {0, 10}, values = {0, 20*deg}, hold = true }, axis = 'y' }\n"
      "moment{ block = 'b', wave = pulse{ amplitude = 5, start = 1, duration = 2 }, direction = 'z' }\n"
      "box{ name = 'table', size = {1,1,1}, at = {5,0,0}, material = 'brick', free = true }\n"
      "motion{ block = 'table', wave = full_sine{ amplitude = 1e-3, frequency = 3 } }\n"
      "force{ block = 'b', wave = function(x) return 2 * w(x) + x end, direction = 'z', sample = 10*ms }");
  CHECK(value(scene.loads.at(0).wave, 0) == Approx(2));
  CHECK(near(scene.loads.at(0).direction, {0, 1, 0}));
  CHECK(near(scene.loads.at(1).direction, {.6, 0, .8}));
  CHECK(value(scene.loads.at(2).wave, 5) == Approx(10 * pi / 180));
  CHECK(value(scene.loads.at(2).wave, 50) == Approx(20 * pi / 180));
  CHECK(scene.loads.at(3).kind == Load::Kind::moment);
  CHECK(value(scene.loads.at(3).wave, 2) == 5);
  CHECK(scene.loads.at(4).kind == Load::Kind::motion);
  const auto& sampled = std::get<Table>(scene.loads.at(5).wave);
  CHECK(value(sampled, 0.25) == Approx(4 * std::cos(pi / 2) + 0.25).margin(1e-9));
}

TEST_CASE("a place or an angle given by points keeps its last value, a force does not, unless `hold` says so", "[lua]") {
  for (const std::string wave : {"table_wave", "curve_wave"})
    for (const std::string hold : {"", ", hold = true", ", hold = false"}) {
      CAPTURE(wave, hold);
      const std::string of = " wave = " + wave + "{ times = {0, 1}, values = {0, .1}" + hold + " } }\n";
      const Scene scene = scene_of(
          "box{ name = 'table', size = {1,1,1}, at = {5,0,0}, material = 'brick', free = true }\n"
          "motion{ block = 'table', direction = 'x'," +
          of + "turning{ block = 'table', axis = 'z'," + of + "tilt{ axis = 'y'," + of + "force{ block = 'b', direction = 'x'," + of +
          "ground_motion{ direction = 'x'," + of);
      const bool says = hold.ends_with("true"), is_silent = hold.empty();
      for (std::size_t i = 0; i < 5; ++i) CHECK(value(scene.loads.at(i).wave, 9) == Approx(says || (is_silent && i < 3) ? 0.1 : 0));
    }
}

TEST_CASE("a wrong number among the points of a wave is one mistake, not two", "[lua][bad_input]") {
  for (const char* wave : {"table_wave", "curve_wave"})
    for (const char* points : {"times = {0, 0/0, 2}, values = {0, 1, 2}", "times = {0, 1, 2}, values = {0, {}, 2}"}) {
      INFO(wave << ": " << points);
      CHECK(mistakes_in(std::string("tilt{ axis = 'y', wave = ") + wave + "{ " + points + " } }").size() == 1);
    }
  CHECK(mentions(mistakes_in("tilt{ axis = 'y', wave = curve_wave{ times = {0, 1, 2}, values = {0, 1} } }"), "3 times but 2 values"));
}

TEST_CASE("a function that is sampled too coarsely is told", "[lua]") {
  const auto warned = [](const std::string& wave) {
    return warnings(scene_of("force{ block = 'b', direction = 'z', wave = " + wave + " }"));
  };
  const std::string sine = "function(t) return math.sin(2 * pi * 20 * t) end";
  const auto told = warned(sine + ", sample = .05");  // one sample a period: nothing is left of it
  REQUIRE(told.size() == 1);
  CHECK(mentions(told, "scene.lua:6: between its samples, 0.05 s apart"));
  CHECK(mentions(told, "sample = 0.005"));
  CHECK(warned(sine + ", sample = .01").size() == 1);
  CHECK(warned(sine).empty());
  CHECK(warned("function(t) return t < .5 and 1 or 0 end").empty());
  CHECK(warned("function(t) return 3 end, sample = .5").empty());
}

TEST_CASE("a smooth curve that swings beyond its values is told", "[lua]") {
  const auto notes = [](const char* points) {
    return scene_of(std::string("tilt{ axis = 'y', wave = curve_wave{ ") + points + " } }").notes;
  };
  CHECK(mentions(notes("times = {0, 1, 2, 2.2}, values = {0, .1, .1, 0}"),
                 "this curve reaches from 0 to 0.1695, its values lie from 0 to 0.1"));
  CHECK(notes("times = {0, .5, 1, 1.5, 2}, values = {0, .1, .2, .1, 0}, hold = true").empty());
}

TEST_CASE("analysis, damping, recorder and camera", "[lua]") {
  const Scene scene = scene_of(
      "analysis{ duration = 3, dt = { 1e-3, unstable = true }, kernel = 'reference', start = 'rest', gyroscopic = false }\n"
      "damping{ mass = 2, scope = 'all', form = 'explicit' }\n"
      "recorder{ name = 'top', quantity = 'displacement', block = 'b', axis = 'xz', frame = 'abs', point = {.1,.1,.1} }\n"
      "box{ name = 'c', group = 'roof', size = {1,1,1}, at = {3,0,0}, material = 'brick' }\n"
      "box{ name = 'd', group = 'roof', size = {1,1,1}, at = {5,0,0}, material = 'brick' }\n"
      "recorder{ name = 'roof', quantity = 'velocity', group = 'roof' }\n"
      "camera{ name = 'front', eye = {0,-9,1}, target = {0,0,2}, fov = 40*deg }");
  CHECK(scene.analysis.duration == 3);
  CHECK(scene.analysis.dt == 1e-3);
  CHECK(scene.analysis.unstable);
  CHECK(scene.analysis.kernel == "reference");
  CHECK_FALSE(scene.analysis.gyroscopic);
  CHECK(scene.damping.mass == 2);
  CHECK(scene.damping.scope == "all");
  CHECK(scene.recorders.at(0).blocks == std::vector<std::string>{"b"});
  CHECK(scene.recorders.at(0).axis == "xz");
  CHECK(scene.recorders.at(0).has_point);
  CHECK(scene.recorders.at(1).blocks == std::vector<std::string>{"c", "d"});
  CHECK(scene.cameras.at(0).fov == Approx(40 * pi / 180));
  CHECK(near(scene.cameras.at(0).eye, {0, -9, 1}));
}

TEST_CASE("expectations of every kind", "[lua]") {
  using Kind = Expectation::Kind;
  const Scene scene = scene_of(
      "expect('time_s', 1, { rel = 0.1, source = 'a book' })\nexpect('time_s', 1, { abs = 0.2 })\nexpect('steps', 1, { above = true })\n"
      "expect('steps', 9, { below = true })\nexpect('steps', nil, { between = {1, 9} })\nexpect('status', "
      "'completed')\nexpect('collapse.collapsed', false)");
  REQUIRE(scene.expectations.size() == 7);
  CHECK(scene.expectations[0].kind == Kind::rel);
  CHECK(scene.expectations[0].tolerance == 0.1);
  CHECK(scene.expectations[0].source == "a book");
  CHECK(scene.expectations[1].kind == Kind::abs);
  CHECK(scene.expectations[2].kind == Kind::above);
  CHECK(scene.expectations[3].kind == Kind::below);
  CHECK(scene.expectations[4].kind == Kind::between);
  CHECK(scene.expectations[4].high == 9);
  CHECK(scene.expectations[5].text_value == "completed");
  CHECK(scene.expectations[6].text_value == "false");
}

TEST_CASE("a mesh file becomes a block, an open or concave one is refused", "[lua]") {
  namespace fs = std::filesystem;
  const test::Folder own;
  const fs::path& folder = own.path;
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
  const std::string sides = "f 1 4 3 2\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n", top = "f 5 6 7 8\n";
  std::ofstream(folder / "cube.obj") << corners << sides << top;
  std::ofstream(folder / "open.obj") << corners << sides;
  std::ofstream(folder / "dent.obj") << corners << "v 0.5 0.5 0.5\n" << sides << "f 5 6 9\nf 6 7 9\nf 7 8 9\nf 8 5 9\n";
  Script::Options allowed = quiet();
  allowed.allow = {folder.string()};
  Script script(allowed);
  const auto load = [&](const std::string& file) {
    return mistakes_of(sound + "mesh{ file = '" + (folder / file).string() + "', scale = 10*cm, material = 'brick' }", {}, allowed);
  };
  const Scene scene =
      script.load_text(sound + "mesh{ file = '" + (folder / "cube.obj").string() + "', scale = 10*cm, at = {1,0,0} }", "scene.lua");
  CHECK(mass_properties(scene.blocks.at(1).parts).volume == Approx(1e-3));
  CHECK(scene.blocks[1].parts[0].faces.size() == 6);
  CHECK(near(centroid(scene.blocks[1]), {1.05, .05, .05}, 1e-7));
  CHECK(scene.inputs.size() == 1);
  CHECK(mentions(load("open.obj"), "is not a closed surface at its edge from "));
  CHECK(mentions(load("dent.obj"), "is not convex"));
  std::ofstream(folder / "turned.obj") << corners << sides << "f 8 7 6 5\n";
  std::ofstream(folder / "twice.obj") << corners << sides << top << top;
  std::ofstream(folder / "flat.obj") << corners << sides << top << "f 5 6 6\n";
  std::ofstream(folder / "sheet.obj") << corners << "f 1 2 3\nf 1 3 2\n";
  CHECK(mentions(load("turned.obj"), "has a face that is inside out at its edge from ("));
  CHECK(mentions(load("twice.obj"), "3 faces meet at its edge from ("));
  CHECK(mentions(load("flat.obj"), "is flat, without area: remove it first"));
  CHECK(mentions(load("sheet.obj"), "sheet.obj: "));
}

TEST_CASE("a damaged PLY header is told with the file, before anything is read by it", "[lua]") {
  namespace fs = std::filesystem;
  const test::Folder own;
  Script::Options allowed = quiet();
  allowed.allow = {own.path.string()};
  const std::string begin = "ply\nformat ascii 1.0\nelement vertex ", xyz = "property float x\nproperty float y\nproperty float z\n";
  const auto load = [&](const std::string& text) {
    const fs::path file = own.path / "a.ply";
    std::ofstream(file) << text;
    return mistakes_of(sound + "mesh{ file = '" + file.string() + "', material = 'brick' }", {}, allowed);
  };
  CHECK(mentions(load(begin + "4\nproperty float x\nprop"), "a.ply: its header has no end (end_header)"));
  CHECK(
      mentions(load(begin + "2000000000\n" + xyz + "end_header\n0 0 0\n"), "a.ply:3: the header promises 2000000000 elements \"vertex\""));
  CHECK(load(begin + "4\n" + xyz +
             "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
             "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n")
            .empty());
}

TEST_CASE("include runs a file of the folder and gives what it returns", "[lua]") {
  namespace fs = std::filesystem;
  const test::Folder own;
  const fs::path& folder = own.path;
  std::ofstream(folder / "part.lua") << "material{ name = 'm', density = 1000 }\nreturn 7";
  std::ofstream(folder / "main.lua") << "local n = include 'part.lua'\nbox{ size = {n,1,1} }\nanalysis{ duration = 1 }";
  std::ofstream(folder / "self.lua") << "include 'self.lua'";
  std::ofstream(folder / "bad.lua") << "\nbox{ size = 3 }";
  std::ofstream(folder / "calls_bad.lua") << "include 'bad.lua'";
  {
    Script script(quiet());
    const Scene& scene = script.load((folder / "main.lua").string());
    CHECK(scene.name == "main");
    CHECK(scene.inputs.size() == 2);
    CHECK(bounding_box(scene.blocks.at(0).parts[0]).high.x() == 7);
  }
  const auto mistakes = [&](const char* file) {
    Script script(quiet());
    try {
      script.load((folder / file).string());
    } catch (const Errors& errors) { return errors.messages; }
    return std::vector<std::string>{};
  };
  CHECK(mentions(mistakes("self.lua"), "does a file include itself?"));
  CHECK(mentions(mistakes("calls_bad.lua"), "bad.lua:2: box: size must be a vector"));
}

TEST_CASE("labels are kept once each, and a limit of use with its reason", "[lua]") {
  const Scene scene =
      scene_of("label('quick', 'fixed_dt')\nlabel('quick')\nuse_limit{ dt_fraction = 0.5, points = 9, reason = 'it walks' }");
  CHECK(scene.labels == std::vector<std::string>{"quick", "fixed_dt"});
  CHECK(scene.use_limit.dt_fraction == 0.5);
  CHECK(scene.use_limit.points == 9);
  CHECK(scene.use_limit.place.line == 8);
  CHECK(mentions(mistakes_in("label()"), "at least one label"));
  CHECK(mentions(mistakes_in("label('Quick one')"), "small letters"));
  CHECK(mentions(mistakes_in("label(3)"), "must be a string"));
  CHECK(mentions(mistakes_in("use_limit{ points = 4 }"), "reason"));
}

TEST_CASE("a quality sets what the scene does not say: the step, and the points of plain joint rules", "[lua]") {
  const std::string rules = "joint{ law = dry{ kn = 1e9, mu = 0.6 } }\njoint{ law = dry{ kn = 1e9, mu = 0.6 }, points = 16 }\n";
  const Scene plain = scene_of(rules), reference = scene_of(rules + "analysis{ duration = 1, quality = 'reference' }"),
              draft = scene_of("analysis{ duration = 1, quality = 'draft', dt_fraction = 0.7 }\n" + rules);
  CHECK(plain.joint_rules[0].points_long == 3);
  CHECK(reference.joint_rules[0].points_long == 5);
  CHECK(reference.joint_rules[1].points_long == 4);
  CHECK(reference.analysis.dt_fraction == 0.25);
  CHECK(draft.joint_rules[0].points_short == 2);
  CHECK(draft.analysis.dt_fraction == 0.7);
  CHECK_FALSE(mistakes_in("analysis{ duration = 1, quality = 'best' }").empty());
}

TEST_CASE("a rocking block takes a Lua function for its ground, as a load does", "[lua]") {
  const std::string block = "{ width = .6, height = 3, from = .1, to = 2, points = 40, duration = 5, wave = ";
  const Scene scene = scene_of(
      "local pulse = half_sine{ amplitude = g, frequency = 1 }\n"
      "local told = rocking_overturning" +
      block +
      "pulse }\n"
      "local asked = rocking_overturning" +
      block +
      "function(t) return pulse(t) end }\n"
      "param('told', told.lowest) param('asked', asked.lowest)\n"
      "param('steps', #rocking{ width = .6, height = 3, duration = 1, wave = function(t) return 3 end, sample = .01 }.t)");
  CHECK(scene.params.at(0).fallback == Approx(scene.params.at(1).fallback).epsilon(1e-5));  // 1 ms between its values
  CHECK(scene.params.at(2).fallback > 10);
  CHECK(mentions(mistakes_in("rocking_overturning{ width = 1, height = 4, wave = function(t) return 1 end }"), "say how long to watch"));
  CHECK(mentions(mistakes_in("rocking{ width = 1, height = 4, duration = 1, wave = function(t) return 'a' end }"),
                 "must return a finite number"));
}

TEST_CASE("mortar given by kn alone takes .4 of it along the joint, as a dry joint does", "[lua]") {
  const Scene scene = scene_of("joint{ law = mortar{ kn = 1e10, ft = 1e5, c = 1e5, mu = .6 } }\njoint{ law = dry{ kn = 1e10, mu = .6 } }");
  CHECK(std::get<Mortar>(scene.joint_rules.at(0).law).ks == 4e9);
  CHECK(std::get<DryFriction>(scene.joint_rules.at(1).law).ks == 4e9);
}

TEST_CASE("the quality of the command line comes before that of the scene, and after its own step and points", "[lua]") {
  const std::string text = sound + "joint{ law = dry{ kn = 1e10, mu = .6 } }\nanalysis{ quality = 'draft' }\n";
  const auto loaded = [&](const std::string& more, const char* quality) {
    Script::Options options = quiet();
    options.quality = quality;
    Script script(options);
    return script.load_text(text + more, "scene.lua");
  };
  CHECK(loaded("", "").joint_rules[0].points_long == 2);
  CHECK(loaded("", "reference").joint_rules[0].points_long == 5);
  CHECK(loaded("", "reference").analysis.dt_fraction == 0.25);
  CHECK(loaded("analysis{ dt_fraction = .5 }", "reference").analysis.dt_fraction == 0.5);
}
