// Arcades, barrel vaults and buttresses built in Lua: pieces are convex and meet exactly, volumes are those on paper, mistakes are named.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "engine/base/units.h"
#include "engine/geometry/mass.h"
#include "engine/model/build/interface.h"
#include "tests/unit/lua/load.h"

using namespace erbs;
using namespace erbs::lua;

namespace {

const std::string dry_joint = "joint{ law = dry{ kn = 1e10, mu = .6 } }\n";

struct Masonry {
  Scene scene;  // without the common block
  Interfaces joints;
  std::string said;  // what the script printed, in one line

  explicit Masonry(const std::string& piece) {
    Script script(quiet());
    scene = script.load_text(sound + "\n" + dry_joint + piece, "scene.lua");
    scene.blocks.erase(scene.blocks.begin());
    for (const auto& line : script.output()) said += (said.empty() ? "" : " ") + line;
    std::vector<InterfaceBlock> blocks;
    for (const Block& block : scene.blocks) blocks.push_back({block.parts, block.group, block.fixed});
    joints = find_interfaces(blocks, scene.joint_rules);
  }

  double volume() const {
    double sum = 0;
    for (const Block& block : scene.blocks) sum += mass_properties(block.parts).volume;
    return sum;
  }
  // Area of all joints between two groups (m2).
  double area(const std::string& one, const std::string& other) const {
    double sum = 0;
    for (const Interface& joint : joints.all) {
      const std::string &a = scene.blocks[size_t(joint.a)].group, &b = scene.blocks[size_t(joint.b)].group;
      if ((a == one && b == other) || (a == other && b == one)) sum += joint.area;
    }
    return sum;
  }
  Vec3 extent(const Block& block) const {
    Vec3 low = block.parts[0].vertices[0], high = low;
    for (const Vec3& v : block.parts[0].vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
    return high - low;
  }
};

// Angles of the joints of a ring above the horizontal (rad): those at beds, and `crown` voussoirs over the last of them.
std::vector<double> angles(int courses, double height, int crown) {
  const double outer = (courses - 0.5) * height;
  std::vector<double> all;
  for (int j = 0; j < courses; ++j) all.push_back(std::asin(j * height / outer));
  const double last = all.back();
  for (int i = 1; i < crown; ++i) all.push_back(last + (pi - 2 * last) * i / crown);
  for (int j = courses - 1; j >= 0; --j) all.push_back(pi - std::asin(j * height / outer));
  return all;
}

const char* const two_tiers =
    "local a = arcade{ spans = {4, 3}, piers = {3.4, 3, 5}, width = 2, rows = 2, block = { length = 1, height = .5 }, at = {20, 3, 1},\n"
    "  tiers = { { springing = 3, top = 6.5, thickness = .6, crown = 3 }, { springing = 8, top = 11, thickness = .5, crown = 3 } },\n"
    "  fixed_courses = 1, quiet = true }\n";

}  // namespace

TEST_CASE("pieces of an arcade are convex and meet without gaps or overlaps", "[lua][masonry]") {
  for (const char* axis : {"x", "y"}) {
    std::string piece = two_tiers;
    piece.insert(piece.find("quiet"), fmt::format("axis = '{}', ", axis));
    const Masonry m(piece);
    CHECK(check(m.scene).empty());  // closed convex parts, names used once
    CHECK(m.joints.overlaps.empty());
    CHECK(m.joints.unjoined.empty());
    for (const Interface& joint : m.joints.all) CHECK(std::abs(joint.gap) < 1e-12);
    // Solid: length x height x width, less the openings between the piers and within the rings' inner polygons.
    double open = 0, backs = 0;
    for (const auto& [span, courses, from] :
         {std::tuple{4., 6, 3.}, std::tuple{3., 5, 3.}, std::tuple{4., 6, 1.5}, std::tuple{3., 5, 1.5}}) {
      const auto joints = angles(courses, 0.5, 3);
      open += span * from;
      for (size_t i = 1; i < joints.size(); ++i) {
        open += span * span / 8 * std::sin(joints[i] - joints[i - 1]);
        backs += 2 * (courses - 0.5) * 0.5 * std::sin((joints[i] - joints[i - 1]) / 2);
      }
    }
    CHECK(m.volume() == Approx((18.4 * 11 - open) * 2).epsilon(1e-12));
    // All of the rings' backs bears spandrels, their feet stand on the piers.
    CHECK(m.area("arcade_ring", "arcade_spandrel") == Approx(backs * 2).epsilon(1e-9));
    CHECK(m.area("arcade_ring", "arcade_pier") == Approx(2 * 2 * (2 * 0.75 + 2 * 0.75)).epsilon(1e-9));  // thickness 2.75 - 2, 2.25 - 1.5
  }
}

TEST_CASE("perpends of an arcade are staggered, and leave no narrow piece", "[lua][masonry]") {
  const Masonry m(two_tiers);
  std::map<double, std::set<double>> perpends;  // height of a course -> positions
  for (const Block& block : m.scene.blocks) {
    if (block.group == "arcade_ring") continue;
    CHECK(m.extent(block).x() > 0.4 - 1e-9);
    if (block.group != "arcade_pier") continue;
    CHECK(m.extent(block).x() < 1 + 2 * 0.4);  // a block and a sliver at either end
    double low = 1e9, z = 1e9;
    for (const Vec3& v : block.parts[0].vertices) low = std::min(low, v.x()), z = std::min(z, v.z());
    if (std::abs(low - 20) > 1e-9 && std::abs(low - 27.4) > 1e-9 && std::abs(low - 33.4) > 1e-9)
      perpends[std::round(z * 1e6) / 1e6].insert(std::round(low * 1e6) / 1e6);
  }
  int compared = 0;
  for (const auto& [z, row] : perpends)
    if (const auto above = perpends.find(z + 0.5); above != perpends.end())
      for (const double u : row)
        for (const double v : above->second) {
          CHECK(std::abs(u - v) > 0.4);
          ++compared;
        }
  CHECK(compared > 100);
}

TEST_CASE("an arcade says what stands where", "[lua][masonry]") {
  const std::string piece = std::string(two_tiers) + R"(
local o = a.openings["t2.a01"]
print(#a.blocks, #a.base, #a.top, #a.piers, #a.piers[2].courses, a.height, a.length, a.tops[1], a.tops[2])
print(o.span, o.thickness, o.springing, o.crown, o.center[1], o.center[2], #o.ring, #o.left, o.left[1], o.right[1])
print(table.concat(a.piers[2].courses[22], " "))
param("volume", a.volume)
)";
  const Masonry m(piece);
  const auto named = [&](const std::string& group, bool fixed) {
    return std::count_if(m.scene.blocks.begin(), m.scene.blocks.end(),
                         [&](const Block& b) { return (group.empty() || b.group == group) && b.fixed == fixed; });
  };
  std::istringstream said(m.said);
  size_t blocks = 0, base = 0, top = 0, piers = 0, courses = 0;
  double height = 0, length = 0, first = 0, second = 0;
  said >> blocks >> base >> top >> piers >> courses >> height >> length >> first >> second;
  CHECK(blocks == size_t(named("", false)));
  CHECK(base == size_t(named("", true)));
  CHECK(base == size_t(named("arcade_pier", true)));
  CHECK(piers == 3);
  CHECK(courses == 22);
  CHECK(top > 2 * 17);
  CHECK(height == Approx(11));
  CHECK(length == Approx(18.4));
  CHECK(first == Approx(6.5));
  CHECK(second == Approx(11));
  double span = 0, thick = 0, springing = 0, crown = 0, x = 0, y = 0;
  size_t ring = 0, left = 0;
  std::string one, other, above;
  said >> span >> thick >> springing >> crown >> x >> y >> ring >> left >> one >> other >> above;
  CHECK(span == Approx(4));
  CHECK(thick == Approx(0.75));  // .5 at least: to the middle of the next course
  CHECK(springing == Approx(9));
  CHECK(crown == Approx(11));
  CHECK(x == Approx(25.4));
  CHECK(y == Approx(3));
  CHECK(ring == 6 * 2 + 7 * 3);  // 13 voussoirs of two and three blocks
  CHECK(left == 3 + 2 + 3);      // rows of its three courses
  for (const auto& jamb : {std::pair{one, 23.4}, std::pair{other, 27.4}}) {
    INFO(jamb.first);
    const auto block = std::find_if(m.scene.blocks.begin(), m.scene.blocks.end(), [&](const Block& b) { return b.name == jamb.first; });
    REQUIRE(block != m.scene.blocks.end());
    const auto& corners = block->parts[0].vertices;
    CHECK(std::any_of(corners.begin(), corners.end(), [&](const Vec3& v) { return std::abs(v.x() - jamb.second) < 1e-9; }));
  }
  CHECK(above.starts_with("arcade.c022."));
  double free = 0;
  for (const Block& block : m.scene.blocks) free += block.fixed ? 0 : mass_properties(block.parts).volume;
  CHECK(m.scene.params.back().value == Approx(free).epsilon(1e-12));
}

TEST_CASE("the piers of an arcade stand on ground of any height", "[lua][masonry]") {
  const std::string level(two_tiers);
  const auto on_ground = [&](const std::string& feet) {
    std::string piece = level;
    return piece.insert(piece.find("quiet"), "feet = " + feet + ", ") +
           "for i, p in ipairs(a.piers) do print(p.foot, #p.courses, #p.courses[2], #p.courses[4]) end param('volume', a.volume)";
  };
  const Masonry m(on_ground("{ 1.1, 0, 2 }"));  // rounded to two courses, none, four
  CHECK(check(m.scene).empty());
  CHECK(m.joints.unjoined.empty());
  CHECK(m.said.starts_with("1.0\t22\t0\t3 0.0\t22\t3\t3 2.0\t22\t0\t0"));
  CHECK(Masonry(level).volume() - m.volume() == Approx((3.4 * 1 + 5 * 2) * 2).epsilon(1e-12));
  // The lowest course of each pier is fixed, and no other.
  std::map<double, double> base;  // height of its underside -> volume
  double free = 0;
  for (const Block& block : m.scene.blocks) {
    const double volume = mass_properties(block.parts).volume;
    double low = 1e9;
    for (const Vec3& v : block.parts[0].vertices) low = std::min(low, v.z());
    if (block.fixed) base[std::round(low * 1e6) / 1e6] += volume;
    else free += volume;
  }
  REQUIRE(base.size() == 3);
  CHECK(base[2] == Approx(3.4 * 0.5 * 2));
  CHECK(base[1] == Approx(3 * 0.5 * 2));
  CHECK(base[3] == Approx(5 * 0.5 * 2));
  CHECK(m.scene.params.back().value == Approx(free).epsilon(1e-12));
  CHECK(Masonry(level).volume() - Masonry(on_ground("1.5")).volume() == Approx(11.4 * 1.5 * 2).epsilon(1e-12));
}

TEST_CASE("half arches end at their crown", "[lua][masonry]") {
  const Masonry m(
      "arcade{ spans = 4, bays = 2, piers = 3, ends = 'half', width = 1, block = { length = 1, height = .5 }, at = {10, 0, 0},\n"
      "  tiers = { { springing = 4, top = 8, thickness = .6 } }, quiet = true }");
  CHECK(m.joints.overlaps.empty());
  CHECK(m.joints.unjoined.empty());
  double low = 1e9, high = -1e9;
  for (const Block& block : m.scene.blocks)
    for (const Vec3& v : block.parts[0].vertices) low = std::min(low, v.x()), high = std::max(high, v.x());
  CHECK(low == Approx(10).epsilon(1e-12));
  CHECK(high == Approx(17).epsilon(1e-12));
}

TEST_CASE("a barrel vault has the volume of its arch, in rows that are staggered", "[lua][masonry]") {
  const std::string keys = " radius = 2, thickness = 0.3, width = 3, voussoirs = 9, at = {0, 20, 5} }";
  const Masonry vault("local v = barrel{ rows = 3," + keys + " print(#v.blocks, #v.abutments, #v.crown, v.span, v.height)");
  const Masonry arch("arch{" + keys);
  CHECK(vault.volume() == Approx(arch.volume()).epsilon(1e-12));
  CHECK(vault.scene.blocks.size() == 5 * 3 + 4 * 4 + 2);
  CHECK(vault.joints.overlaps.empty());
  std::istringstream said(vault.said);
  size_t blocks = 0, abutments = 0, crown = 0;
  double span = 0, height = 0;
  said >> blocks >> abutments >> crown >> span >> height;
  CHECK(blocks == 31);
  CHECK(abutments == 2);
  CHECK(crown == 3);  // the keystone, an odd voussoir
  CHECK(span == Approx(2 * 1.85));
  CHECK(height == Approx(2.15 * std::cos(pi / 18)));
  // Across a radial joint three blocks meet four: six overlaps, each half a block or less.
  const double joint = 0.3 * 3;
  double between = 0;
  int pairs = 0;
  for (const Interface& face : vault.joints.all) {
    const Block &a = vault.scene.blocks[size_t(face.a)], &b = vault.scene.blocks[size_t(face.b)];
    if (a.fixed || b.fixed || a.name.substr(0, 10) == b.name.substr(0, 10)) continue;
    between += face.area, ++pairs;
  }
  CHECK(between == Approx(8 * joint).epsilon(1e-9));
  CHECK(pairs == 8 * 6);
}

TEST_CASE("buttresses lean or step back, and stand against their wall", "[lua][masonry]") {
  for (const std::string towards : {"x", "-x", "y", "-y"}) {
    INFO(towards);
    const std::string keys =
        "towards = '" + towards + "', width = 1, depth = 1.5, block = { length = .6, height = .25 }, courses = 8, at = {20, 20, 1}, ";
    const Masonry lean("local b = buttress{ " + keys + "top_depth = .5, rows = 2 } print(#b.foot, #b.top, #b.back, b.height, b.volume)");
    CHECK(lean.volume() == Approx((1.5 + 0.5) / 2 * 2).epsilon(1e-12));
    CHECK(check(lean.scene).empty());
    CHECK(lean.joints.overlaps.empty());
    CHECK(lean.joints.unjoined.empty());
    std::istringstream said(lean.said);
    size_t foot = 0, top = 0, back = 0;
    double height = 0, volume = 0;
    said >> foot >> top >> back >> height >> volume;
    CHECK(foot == 2 * 2);  // 1.44 m on average: two lengths of .6 and .84
    CHECK(top == 3);       // one piece, in three rows
    CHECK(back == 4 * 2 + 4 * 3);
    CHECK(height == Approx(2));
    CHECK(volume == Approx(lean.volume()).epsilon(1e-12));
    const Masonry steps("buttress{ " + keys + "top_depth = .5, steps = 1 }");
    CHECK(steps.volume() == Approx(4 * 0.25 * 1.5 + 4 * 0.25 * 0.5).epsilon(1e-12));
    CHECK(steps.joints.overlaps.empty());
  }
}

TEST_CASE("the joint of a buttress lies between it and the wall, and in its beds", "[lua][masonry]") {
  const Masonry m(
      "joint{ law = mortar{ kn = 1e10, ft = 1e5, c = 1e5, mu = .6 }, thickness = 10*mm, tolerance = 1*mm }\n"
      "box{ name = 'wall', group = 'wall', size = {1, 4, 3}, at = {19, 18, 0} }\n"
      "buttress{ at = {20, 20, 0}, width = 1, depth = 1.2, courses = 4, joint = 10*mm, rows = 2, block = { length = .6, height = .25 } }");
  CHECK(m.joints.overlaps.empty());
  CHECK(m.joints.unjoined.empty());
  for (const Interface& joint : m.joints.all) CHECK(joint.gap == Approx(0.01).epsilon(1e-9));
  CHECK(m.area("wall", "buttress") == Approx(4 * 0.25 * (1 - 0.01) - 2 * 0.25 * 0.01).epsilon(1e-9));  // less the joints between rows
}

TEST_CASE("mistakes of arcades, vaults and buttresses are told with their line and a remedy", "[lua][masonry]") {
  const std::string rest = ", width = 5, block = { length = 1, height = .5 }, ";
  const std::string tier = "tiers = { { springing = 9, top = 14, thickness = .6 } } }";
  const auto wrong = [&](const std::string& piece) {
    const auto all = mistakes_in(piece);
    REQUIRE_FALSE(all.empty());
    CHECK(all[0].starts_with("scene.lua:6: "));
    return all;
  };
  CHECK(mentions(wrong("arcade{ spans = 4, piers = 3" + rest + tier), "give bays"));
  CHECK(mentions(wrong("arcade{ spans = {4, 4}, bays = 3, piers = 3" + rest + tier), "leave bays out"));
  CHECK(mentions(wrong("arcade{ spans = {4, -4}, piers = 3" + rest + tier), "spans[2] must be a length above 0 m"));
  CHECK(mentions(wrong("arcade{ spans = 'wide', piers = 3" + rest + tier), "spans must be a length in m or a list"));
  CHECK(mentions(wrong("arcade{ spans = {4, 4}, piers = {3, 3}" + rest + tier), "piers has 2 lengths for 3"));
  CHECK(mentions(wrong("arcade{ spans = {4, 4}, piers = 1" + rest + tier), "pier 2 is 1 m wide; the rings of tier 1 take 1.5 m of it"));
  CHECK(mentions(wrong("arcade{ spans = {4}, piers = 3, ends = 'half'" + rest + tier), "at least two arches"));
  CHECK(mentions(wrong("arcade{ spans = {4}, piers = 3, ends = 'open'" + rest + tier), "allowed: pier, half"));
  CHECK(mentions(wrong("arcade{ spans = {4}, piers = 3" + rest + "tiers = {} }"), "tiers is empty"));
  CHECK(mentions(wrong("arcade{ spans = {4}, piers = 3" + rest + "tiers = { { springing = 9, top = 11, thickness = .6 } } }"),
                 "reaches up to 11.75 m, the tier ends at 11 m; raise its top to 12 m at least"));
  CHECK(mentions(wrong("arcade{ spans = {4}, piers = 3" + rest + "tiers = { { springing = .1, top = 11, thickness = .6 } } }"),
                 "springs at"));
  CHECK(mentions(wrong("arcade{ spans = {4}, piers = 3, fixed_courses = 30" + rest + tier), "fixed_courses = 30"));
  CHECK(mentions(wrong("arcade{ spans = {4}, piers = 3, feet = {0, 8.5}, fixed_courses = 1" + rest + tier),
                 "feet[2] = 8.5 m leaves no pier below the springing line at 9 m above its fixed courses; at most 8 m is allowed"));
  CHECK(mentions(wrong("arcade{ spans = {4}, piers = 3, feet = {0, -1}" + rest + tier), "feet[2] must be a height of 0 m or more"));
  CHECK(mentions(wrong("arcade{ spans = {4}, piers = 3, feet = {0, 1, 2}" + rest + tier), "feet has 3 lengths for 2"));
  CHECK(mentions(wrong("arcade{ spans = {4}, piers = 3, least = .8" + rest + tier), "at most 0.5 m"));
  CHECK(mentions(wrong("arcade{ spans = {.1}, piers = 3" + rest + "tiers = { { springing = 9, top = 14, thickness = .1 } } }"),
                 "lower than two courses"));
  CHECK(mentions(wrong("arcade{ spans = {4, 4}, piers = 3, ends = 'half'" + rest +
                       "tiers = { { springing = 9, top = 14, thickness = .6, crown = 3 } } }"),
                 "give an even number"));
  CHECK(mentions(wrong("arcade{ spans = {4}, piers = 3, tier = 2" + rest + tier), "unknown key \"tier\"; did you mean \"tiers\"?"));
  CHECK(mentions(wrong("barrel{ radius = 2, thickness = .3, width = 3, voussoirs = 9 }"), "rows is missing"));
  CHECK(mentions(wrong("barrel{ radius = 2, thickness = 5, width = 3, voussoirs = 9, rows = 2 }"),
                 "barrel: thickness = 5 m leaves no opening"));
  const std::string plain = "buttress{ width = 1, depth = 1, courses = 4, block = { length = .5, height = .25 }";
  CHECK(mentions(wrong(plain + ", top_depth = 2 }"), "does not overhang"));
  CHECK(mentions(wrong(plain + ", steps = 2 }"), "make top_depth smaller"));
  CHECK(mentions(wrong(plain + ", steps = 4, top_depth = .5 }"), "need more than 4 courses"));
  CHECK(mentions(wrong(plain + ", towards = 'z' }"), "allowed: x, -x, y, -y"));
  // The script goes on without the blocks.
  const auto later =
      mistakes_in("local a = arcade{ spans = 4, piers = 3" + rest + tier + "\nprint(#a.top + a.height)\nanalysis{ durration = 1 }");
  CHECK(mentions(later, "durration"));
}
