// Walls and buildings built in Lua: bricks fit, bond and are supported, and wrong arguments are named.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "engine/geometry/mass.h"
#include "engine/model/build/build.h"
#include "lua/language/script.h"
#include "tests/support/places.h"

using namespace erbs;
using namespace erbs::lua;

namespace {

struct Brick {
  std::string name, group;
  Vec3 low, high;  // m
};

// Blocks of a scene as boxes, without the ground.
std::vector<Brick> bricks_of(const Scene& scene) {
  std::vector<Brick> all;
  for (const Block& block : scene.blocks) {
    if (block.fixed) continue;
    Vec3 low = block.parts[0].vertices[0], high = low;
    for (const Vec3& v : block.parts[0].vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
    all.push_back({block.name, block.group, low, high});
  }
  return all;
}

std::vector<Brick> built(const std::string& text) {
  Script script({.seconds = 100, .quiet = true});
  return bricks_of(
      script.load_text("material{ name = 'brick', density = 1800 }\nground{}\nanalysis{ duration = 1 }\n"
                       "joint{ law = dry{ kn = 1e10, mu = 0.6 }, thickness = 5*mm, tolerance = 2.5*mm }\n" +
                           text,
                       "t.lua"));
}

std::vector<std::string> mistakes_in_masonry(const std::string& text) {
  try {
    built(text);
  } catch (const Errors& errors) { return errors.messages; }
  return {};
}

struct Fit {
  int overlaps = 0, too_near = 0, too_far = 0, unsupported = 0;  // faces nearer than t; facing faces 1.6 t to 30 mm apart
};

Fit fit_of(const std::vector<Brick>& bricks, double t) {
  Fit fit;
  std::vector<bool> stands(bricks.size(), false);
  for (size_t i = 0; i < bricks.size(); ++i) {
    if (bricks[i].low.z() < 1.01 * t + 1e-9) stands[i] = true;  // on the ground
    for (size_t j = 0; j < bricks.size(); ++j) {
      const Vec3 gap = (bricks[j].low - bricks[i].high).cwiseMax(bricks[i].low - bricks[j].high);
      Eigen::Index axis = 0;
      const double apart = gap.maxCoeff(&axis);
      if (i == j || (gap.array() > -1e-9).count() > 1) continue;  // touching at an edge, or far away
      if (apart < -1e-9) ++fit.overlaps;
      else if (apart < t - 1e-9) ++fit.too_near;
      else if (apart < 1.6 * t + 1e-9) stands[i] = stands[i] || (axis == 2 && bricks[j].low.z() < bricks[i].low.z());
      else if (apart < 0.03) ++fit.too_far;
    }
  }
  fit.unsupported = static_cast<int>(std::count(stands.begin(), stands.end(), false));
  return fit;
}

void check_fit(const std::vector<Brick>& bricks, double t) {
  const Fit fit = fit_of(bricks, t);
  CHECK(fit.overlaps == 0);
  CHECK(fit.too_near == 0);
  CHECK(fit.too_far == 0);
  CHECK(fit.unsupported == 0);
}

// Head joints of each course of a wall along x: height of the course (m) -> positions (m). Blocks are sorted along the wall.
std::map<double, std::vector<double>> head_joints(const std::vector<Brick>& bricks, const std::string& group) {
  std::map<double, std::vector<Brick>> courses;
  for (const Brick& b : bricks)
    if (b.group == group) courses[std::round(b.low.z() * 1e6) / 1e6].push_back(b);
  std::map<double, std::vector<double>> joints;
  for (auto& [z, row] : courses) {
    std::sort(row.begin(), row.end(), [](const Brick& p, const Brick& q) { return p.low.x() < q.low.x(); });
    for (size_t i = 1; i < row.size(); ++i)
      if (row[i].low.x() - row[i - 1].high.x() < 0.01) joints[z].push_back(0.5 * (row[i].low.x() + row[i - 1].high.x()));
  }
  return joints;
}

// Shortest lap between courses that lie on each other; a slab between them ends the bond.
double shortest_lap(const std::map<double, std::vector<double>>& joints) {
  double least = 1e9;
  for (const auto& [z, row] : joints)
    for (const auto& [z_above, above] : joints) {
      if (z_above <= z || z_above > z + 0.11) continue;
      for (const double u : above)
        for (const double v : row) least = std::min(least, std::abs(u - v));
    }
  return least;
}

const char* const house =
    "local h = building{ plan = {1.525, 1.83}, at = {-0.7, -0.9, 0}, storeys = 2, courses = 13, joint = 5*mm, quiet = true,\n"
    "  brick = {length = 0.3, width = 0.125, height = 0.1}, slab = {thickness = 50*mm}, lintel = {bearing = 0.1},\n"
    "  openings = {{wall = 'south', kind = 'door', storey = 1, centre = 0.7625, width = 0.45, height = 1.05},\n"
    "              {wall = 'east', name = 'window', centre = 0.915, width = 0.4, sill = 0.42, height = 0.63}} }\n";

}  // namespace

TEST_CASE("a plain wall is laid in running bond with halves", "[lua][masonry]") {
  const auto bricks =
      built("wall{ length = 1.525, courses = 6, brick = {length = 0.3, width = 0.125, height = 0.1}, joint = 5*mm, quiet = true }");
  check_fit(bricks, 5e-3);
  CHECK(bricks.size() == 3 * 5 + 3 * 6);  // 5 whole with joints of 6.25 mm; 2 halves and 4 whole with 5 mm
  CHECK(shortest_lap(head_joints(bricks, "wall")) > 0.14);
  for (const Brick& b : bricks) CHECK(b.high.x() < 1.525 + 1e-9);
}

TEST_CASE("dry masonry of whole and half bricks has no gaps", "[lua][masonry]") {
  const auto bricks = built(
      "wall{ length = 4*0.3, courses = 16, brick = {length = 0.3, width = 0.125, height = 0.1}, joint = 0, quiet = true, axis = 'y' }");
  CHECK(bricks.size() == 8 * 4 + 8 * 5);
  double volume = 0;
  for (const Brick& b : bricks) volume += (b.high - b.low).prod();
  CHECK(volume == Approx(1.2 * 0.125 * 1.6).epsilon(1e-12));
}

TEST_CASE("a building fits: joints between all neighbours, nothing hangs in the air", "[lua][masonry]") {
  const auto bricks = built(house);
  check_fit(bricks, 5e-3);
  CHECK(shortest_lap(head_joints(bricks, "wall_north")) > 0.075);
  double top = 0, least = 1;
  for (const Brick& b : bricks) {
    top = std::max(top, b.high.z());
    if (b.group.starts_with("wall")) least = std::min({least, b.high.x() - b.low.x(), b.high.y() - b.low.y()});
  }
  CHECK(top == Approx(2 * 1.42).epsilon(1e-12));  // 2 x (13 x 105 + 5 + 50) mm
  CHECK(least > 0.04 - 1e-9);
}

TEST_CASE("corners interlock: the walls take turns to run through", "[lua][masonry]") {
  const auto bricks = built(house);
  const Vec3 corner(-0.7, -0.9, 0);
  std::map<int, std::string> through;  // course -> wall whose brick covers the outer edge of the corner
  for (const Brick& b : bricks)
    if ((b.low - corner).head<2>().norm() < 1e-9 && b.group.starts_with("wall")) through[int(std::lround(b.low.z() / 0.105))] = b.group;
  REQUIRE(through.size() == 26);
  for (const auto& [course, wall] : through)
    if (course % 13 != 12 && through.count(course + 1)) CHECK(wall != through.at(course + 1));
}

TEST_CASE("head joints that a builder widened are joined by the rule that joins its others", "[lua][masonry]") {
  const std::string rest = ", joint = 10*mm, joint_max = 20*mm, quiet = true, brick = {length = 0.3, width = 0.125, height = 0.1} }";
  const std::string opening = ", openings = {{wall = 'south', kind = 'window', at = 0.45, width = 0.3, sill = 0.3, height = 0.2}}";
  std::vector<std::string> texts;
  for (const double extra : {0.013, 0.02, 0.027, 0.036})
    for (const double bricks : {5, 6, 7}) {
      texts.push_back(fmt::format("wall{{ length = {}, courses = 6{}", bricks * 0.31 + extra, rest));
      texts.push_back(fmt::format("building{{ plan = {{ {}, {} }}, courses = 8, storeys = 2, slab = {{ thickness = 0.1 }}{}{}",
                                  bricks * 0.31 + extra, 1.86 + extra, opening, rest));
    }
  int widened = 0;
  for (const std::string& text : texts) {
    INFO(text);
    Script script({.seconds = 100, .quiet = true});
    const Scene& scene = script.load_text(
        "material{ name = 'brick', density = 1800 }\nground{}\ngravity(g)\nanalysis{ duration = 1 }\n"
        "joint{ law = mortar{ E = 1e10, thickness = 10*mm, ft = 1e5, c = 1e5, mu = 0.6 } }\n" +
            text,
        "t.lua");
    const Built built = build(scene);
    const Model& model = built.model;
    for (const std::string& warning : built.warnings) CHECK(warning.find("not joined") == std::string::npos);
    const auto wide = std::count_if(model.joint.begin(), model.joint.end(), [](const Joint& j) { return j.gap > 10.2e-3; });
    widened += wide > 0;
    const auto says = [](const std::string& warning) { return warning.find("its masonry made wider") != std::string::npos; };
    CHECK(std::ranges::any_of(built.warnings, says) == (wide > 0));
  }
  CHECK(widened > 4);
}

TEST_CASE("lintels bear on both jambs and bear their names", "[lua][masonry]") {
  const auto bricks = built(house);
  const auto find = [&](const std::string& name) {
    const auto found = std::find_if(bricks.begin(), bricks.end(), [&](const Brick& b) { return b.name == name; });
    INFO(name);
    REQUIRE(found != bricks.end());
    return *found;
  };
  const Brick lintel = find("lintel.south.door1");
  CHECK(lintel.low.x() < -0.7 + 0.5375 - 0.1 + 1e-9);
  CHECK(lintel.high.x() > -0.7 + 0.9875 + 0.1 - 1e-9);
  CHECK(lintel.low.z() == Approx(5e-3 + 10 * 0.105));
  CHECK(find("lintel.east.window2").low.z() > 1.42);
  CHECK(find("slab2").group == "slab");
  CHECK(find("north.c26.b01").group == "wall_north");
}

TEST_CASE("open and re-entrant plans fit as well", "[lua][masonry]") {
  const std::string rest = ", courses = 6, joint = 5*mm, quiet = true, brick = {length = 0.3, width = 0.125, height = 0.1} }";
  check_fit(built("building{ closed = false, plan = {{0,2},{0,0},{2,0},{2,2}}" + rest), 5e-3);
  check_fit(built("building{ shift = 1, plan = {{0,0},{3,0},{3,1.5},{1.5,1.5},{1.5,3},{0,3}}" + rest), 5e-3);
}

TEST_CASE("the base of an open plan reaches beyond the walls on every side", "[lua][masonry]") {
  const std::string brick = "brick = {length=.3, width=.125, height=.1}, joint = 0, base = {thickness=.1, margin=.05}, quiet = true";
  for (const std::string& text :
       {"wall{ length = 1.2, courses = 2, at = {1, 2, 0}, " + brick + " }", "wall{ length = 1.2, axis = 'y', courses = 2, " + brick + " }",
        "building{ plan = {{0,0}, {1.5,0}, {1.5,1.2}}, closed = false, courses = 2, " + brick + " }"}) {
    CAPTURE(text);
    Script script({.seconds = 100, .quiet = true});
    const Scene scene = script.load_text("material{ name = 'brick', density = 1800 }\nanalysis{ duration = 1 }\n" + text, "t.lua");
    Vec3 low = Vec3::Constant(1e9), high = -low;
    for (const Brick& one : bricks_of(scene)) low = low.cwiseMin(one.low), high = high.cwiseMax(one.high);
    for (const Block& block : scene.blocks) {
      if (!block.fixed) continue;
      Vec3 from = Vec3::Constant(1e9), to = -from;
      for (const Vec3& v : block.parts[0].vertices) from = from.cwiseMin(v), to = to.cwiseMax(v);
      CHECK((low - from).head<2>().isApprox(Eigen::Vector2d(0.05, 0.05), 1e-9));
      CHECK((to - high).head<2>().isApprox(Eigen::Vector2d(0.05, 0.05), 1e-9));
    }
  }
}

TEST_CASE("the summary says what was cut and widened", "[lua][masonry]") {
  Script script({.seconds = 100, .quiet = true});
  script.load_text(
      "material{ name = 'brick', density = 1800 }\nground{}\nanalysis{ duration = 1 }\njoint{ law = dry{ kn = 1e10, mu = 0.6 }, thickness "
      "= 5*mm, tolerance = 2*mm }\n"
      "building{ plan = {1.525, 1.83}, courses = 4, joint = 5*mm, brick = {length = 0.3, width = 0.125, height = 0.1} }",
      "t.lua");
  std::string said;
  for (const auto& line : script.output()) said += line + "\n";
  CHECK(said.find("5 whole, head joints 6.25 mm") != std::string::npos);
  CHECK(said.find("4 whole + closer of 45 mm") != std::string::npos);
}

TEST_CASE("masonry says what stands where: openings, tops and volume", "[lua][masonry]") {
  Script script({.seconds = 100, .quiet = true});
  const Scene& scene = script.load_text(
      "material{ name = 'brick', density = 1800 }\nground{}\nanalysis{ duration = 1 }\n"
      "joint{ law = dry{ kn = 1e10, mu = 0.6 }, thickness = 5*mm, tolerance = 2.5*mm }\n" +
          std::string(house) + R"(
local door, window = h.openings["south.door1"], h.openings["east.window2"]
param("volume", h.volume) param("width", door.width) param("height", door.height) param("x", door.center[1]) param("z", door.at[3])
param("sill", window.at[3]) param("courses_left", #door.left) param("courses_right", #door.right)
print(door.lintel, door.above[1], window.above[1], #door.below, window.wall, window.storey, h.top[1], h.storey_top[1][1])
print(table.concat(door.left, " "), table.concat(window.below, " "))
local w = wall{ length = 1.525, courses = 6, brick = {length = 0.3, width = 0.125, height = 0.1}, joint = 5*mm, quiet = true, at = {5, 0, 0} }
print(#w.top, w.top[1], #w.storey_top[1]) param("wall_volume", w.volume)
)",
      "t.lua");
  const auto bricks = bricks_of(scene);
  const auto value = [&](const std::string& name) {
    return std::find_if(scene.params.begin(), scene.params.end(), [&](const Param& p) { return p.name == name; })->value;
  };
  double volume = 0, wall = 0;
  for (const Brick& b : bricks) (b.group == "wall" ? wall : volume) += (b.high - b.low).prod();
  CHECK(value("volume") == Approx(volume).epsilon(1e-12));
  CHECK(value("wall_volume") == Approx(wall).epsilon(1e-12));
  CHECK(value("width") == Approx(0.45));
  CHECK(value("height") == Approx(10 * 0.105 + 0.005));
  CHECK(value("x") == Approx(-0.7 + 0.7625));
  CHECK(value("z") == Approx(0).margin(1e-12));
  CHECK(value("sill") == Approx(1.42 + 4 * 0.105));  // of the upper storey: .42 m above its floor
  CHECK(value("courses_left") == 10);
  CHECK(value("courses_right") == 10);
  CHECK(script.output()[0].find("lintel.south.door1\tlintel.south.door1\tlintel.east.window2\t0\teast\t2\tslab2\tslab1") == 0);
  CHECK(script.output()[2].find("5\twall.c06.b01\t5") == 0);
  // The blocks at the jamb end there; those below the window lie under it.
  std::istringstream names(script.output()[1]);
  std::string name;
  for (int i = 0; names >> name; ++i) {
    const auto brick = std::find_if(bricks.begin(), bricks.end(), [&](const Brick& b) { return b.name == name; });
    REQUIRE(brick != bricks.end());
    if (i < 10) CHECK(brick->high.x() == Approx(-0.7 + 0.5375));
    else CHECK(brick->high.z() == Approx(1.42 + 4 * 0.105));
  }
}

TEST_CASE("mistakes in masonry are named with line and remedy, all at once", "[lua][masonry]") {
  const auto some =
      mistakes_in_masonry("wall{ lenght = 2, courses = 3,\n  brick = {length = 0.3, width = 0.125, height = -0.1}, joint = 5*mm }");
  REQUIRE(some.size() == 2);
  const auto said = [&](const std::string& words) {
    return std::any_of(some.begin(), some.end(),
                       [&](const std::string& m) { return m.starts_with("t.lua:5") && m.find(words) != std::string::npos; });
  };
  CHECK(said("unknown key \"lenght\"; did you mean \"length\"?"));
  CHECK(said("height = -0.1 must be above 0"));

  const std::string walls =
      "building{ plan = {1.525, 1.83}, courses = 13, joint = 5*mm, brick = {length = 0.3, width = 0.125, height = 0.1}, openings = {";
  const auto near_corner = mistakes_in_masonry(walls + "{wall = 'south', at = 0.1, width = 0.4, height = 0.5}} }");
  REQUIRE(near_corner.size() == 1);
  CHECK(near_corner[0].find("allowed: 170 mm to 1355 mm") != std::string::npos);
  const auto no_wall = mistakes_in_masonry(walls + "{wall = 'suoth', at = 0.5, width = 0.4, height = 0.5}} }");
  REQUIRE(no_wall.size() == 1);
  CHECK(no_wall[0].find("did you mean \"south\"?") != std::string::npos);
  CHECK(mistakes_in_masonry(walls + "{wall = 'south', at = 0.5, width = 0.4, height = 5}} }").size() == 1);
}

TEST_CASE("mistakes after bad masonry are told as well, and nothing that only follows from it", "[lua][masonry]") {
  const auto mistakes = mistakes_in_masonry(
      "local house = building{ plan = {1.5, 1.8}, courses = 3, joint = 5*mm, brick = {lenth = 0.3, width = 0.125, heigth = 0.1} }\n"
      "recorder{ name = 'top', quantity = 'displacement', block = house.slabs[3] }\n"
      "analysis{ durration = 1 }\n"
      "local sill = house.tops[1] + 1\n"
      "analysis{ duration = 'x' }");
  REQUIRE(mistakes.size() == 3);
  CHECK(mistakes[0].find("building.brick: unknown key \"heigth\"; did you mean \"height\"?") != std::string::npos);
  CHECK(mistakes[1].find("building.brick: unknown key \"lenth\"; did you mean \"length\"?") != std::string::npos);
  CHECK(mistakes[2].find("durration") != std::string::npos);
}

TEST_CASE("the house of the shaking table has the blocks it should", "[lua][masonry]") {
  Script script({.seconds = 100, .quiet = true});
  const Scene& scene = script.load(test::in_source("/scenes/shake_table_house.lua"));
  const auto bricks = bricks_of(scene);
  CHECK(bricks.size() >= 750);
  CHECK(bricks.size() <= 900);
  check_fit(bricks, 5e-3);
  Vec3 low = bricks[0].low, high = bricks[0].high;
  for (const Brick& b : bricks) low = low.cwiseMin(b.low), high = high.cwiseMax(b.high);
  CHECK((high - low - Vec3(1.525, 1.83, 4.255)).norm() < 1e-9);  // 4260 with the bed joint beneath
  for (const char* wall : {"wall_south", "wall_north"}) CHECK(shortest_lap(head_joints(bricks, wall)) >= 0.075);  // a quarter brick
}

TEST_CASE("the aqueduct of Valens has the size and the number of blocks of its source", "[lua][masonry]") {
  for (const auto& [model, length, blocks] : {std::tuple{"1", 102., 16920.}, std::tuple{"2", 195., 29695.}}) {
    Script script({.seconds = 100, .quiet = true});
    const Scene& scene = script.load(test::in_source("/scenes/valens_aqueduct.lua"), {{"model", model}});
    Vec3 low = Vec3::Constant(1e9), high = -low;
    double count = 0;
    for (const Block& block : scene.blocks) {
      if (block.name == "ground" || block.group == "rock") continue;
      ++count;
      for (const Vec3& v : block.parts[0].vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
      CHECK((!block.fixed || block.group == "valens_pier"));
    }
    CHECK((high - low - Vec3(length, 5.25, 28.5)).norm() < 1e-9);
    CHECK(count == Approx(blocks).epsilon(0.035));
  }
}

TEST_CASE("a pier of the aqueduct stands between its planes of symmetry without gaps", "[lua][masonry]") {
  Script script({.seconds = 100, .quiet = true});
  const Built one = build(script.load(test::in_source("/scenes/valens_aqueduct.lua"), {{"bays", "1"}}));
  CHECK(one.warnings.empty());
  for (const Joint& joint : one.model.joint) CHECK(std::abs(joint.gap) < 1e-9);
}

TEST_CASE("the METU house has the size and the roof of its source", "[lua][masonry]") {
  Script script({.seconds = 100, .quiet = true});
  const Scene& scene = script.load(test::in_source("/scenes/metu_house.lua"));
  Vec3 low = Vec3::Constant(1e9), high = -low;
  double roof = 0;
  for (const Block& block : scene.blocks) {
    if (block.group == "log") roof += scene.materials[size_t(block.material)].density * 9.81 * mass_properties(block.parts).volume;
    if (block.group.starts_with("wall"))
      for (const Vec3& v : block.parts[0].vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
  }
  CHECK(roof == Approx(55e3).epsilon(1e-12));
  CHECK((high - low - Vec3(3, 4, 2.4 - 0.015)).norm() < 1e-9);  // 2.4 m with the bed joint beneath
  CHECK(build(scene).warnings.empty());
}
