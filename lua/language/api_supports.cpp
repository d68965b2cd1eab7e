// Functions of a script: supports that move: spread{} and settle{}, prescribed motions of groups of fixed blocks.
#include <algorithm>
#include <cmath>
#include <set>

#include "engine/base/spelling.h"
#include "lua/language/api.h"

namespace erbs::lua {
namespace {

constexpr double shortest = 1e-3;  // s, of a ramp: its points lie apart even after 1e6 s
constexpr int ramp_points = 200;   // intervals of the ramp; the speed at a kink changes by 0.9 % of the greatest speed at most

// From 0 to 1 with speed and acceleration zero at both ends: 10 x^3 - 15 x^4 + 6 x^5.
double smooth(double x) { return x * x * x * (10 + x * (6 * x - 15)); }

Curve ramp(double by, double start, double duration) {
  std::vector<double> times, values;
  for (int i = 0; i <= ramp_points; ++i) {
    const double x = static_cast<double>(i) / ramp_points;
    times.push_back(start + duration * x);
    values.push_back(by * smooth(x));
  }
  return make_curve(std::move(times), std::move(values), true);
}

// One entry of `supports`: a fixed block, or all blocks of a group, which move as one.
struct Support {
  std::vector<const Block*> blocks;
  double middle = 0;  // m, of their extent along the direction
};

Support support_of(const Scene& scene, const std::string& name, const Vec3& direction, Arguments& arguments) {
  Support support;
  for (const Block& block : scene.blocks)
    if (block.name == name) support.blocks = {&block};
  for (const Block& block : scene.blocks)
    if (support.blocks.empty() || support.blocks.front()->name != name)
      if (block.group == name) support.blocks.push_back(&block);
  if (support.blocks.empty()) {
    std::vector<std::string> known;
    for (const Block& block : scene.blocks)
      for (const std::string& word : {block.name, block.group})
        if (block.fixed && !word.empty() && std::ranges::find(known, word) == known.end()) known.push_back(word);
    arguments.mistake(fmt::format("supports: no block or group built so far is called \"{}\"{}", name, did_you_mean(name, known)));
    return support;
  }
  double low = unbounded, high = -unbounded;
  const auto free = [](const Block* block) { return !block->fixed; };
  if (const auto first = std::ranges::find_if(support.blocks, free); first != support.blocks.end()) {
    const auto others = std::ranges::count_if(support.blocks, free) - 1;
    arguments.mistake(
        fmt::format("supports: block \"{}\" is free{}; supports are fixed blocks: add fixed = true to {}, or move {} with motion{{}}",
                    (*first)->name, others > 0 ? fmt::format(", and so are {} more of \"{}\"", others, name) : "",
                    others > 0 ? "them" : "it", others > 0 ? "them" : "it"));
  }
  for (const Block* block : support.blocks) {
    for (const Polyhedron& part : block->parts)
      for (const Vec3& vertex : part.vertices) low = std::min(low, vertex.dot(direction)), high = std::max(high, vertex.dot(direction));
  }
  support.middle = (low + high) / 2;
  return support;
}

struct Movement {
  std::string name;
  Vec3 direction = Vec3::UnitX();
  double by = 0, start = 0, duration = 1;
  std::vector<Support> supports;
};

Movement read_movement(Call& call, Arguments& arguments, const Vec3& usual) {
  Movement movement;
  std::vector<std::string> names;
  arguments.read("name", movement.name);
  arguments.read("by", movement.by);
  arguments.read("start", movement.start);
  arguments.read("duration", movement.duration);
  arguments.read("supports", names);
  movement.direction = usual;
  arguments.direction("direction", movement.direction);
  movement.direction = call.context.frame().vector(movement.direction);
  if (arguments.is_table("supports") && names.empty())
    arguments.mistake("supports names none; give blocks or groups, such as { \"arch.left\" }");
  std::set<const Block*> moved;
  for (const std::string& name : names) {
    Support support = support_of(call.context.scene, name, movement.direction, arguments);
    const auto again = std::ranges::find_if(support.blocks, [&](const Block* block) { return moved.contains(block); });
    if (again != support.blocks.end()) {
      arguments.mistake(fmt::format("supports: block \"{}\" is named twice, the second time by \"{}\"; keep one", (*again)->name, name));
      support.blocks.clear();  // what follows from it is no mistake of its own
    }
    moved.insert(support.blocks.begin(), support.blocks.end());
    movement.supports.push_back(std::move(support));
  }
  return movement;
}

// A prescribed motion of each block of the support, as motion{} makes it.
void add_motions(Call& call, const Movement& movement, const Support& support, double by) {
  if (by == 0 || !(movement.duration >= shortest && movement.start >= 0 && std::isfinite(by))) return;  // the last three were told
  for (const Block* block : support.blocks) {
    Load load;
    load.kind = Load::Kind::motion;
    load.place = call.place;
    load.name = movement.name;
    load.direction = movement.direction;
    load.block = block->name;
    load.wave = ramp(by, movement.start, movement.duration);
    call.context.scene.loads.push_back(std::move(load));
  }
}

int settle(Call& call) {
  Arguments arguments = call.arguments();
  const Movement movement = read_movement(call, arguments, -Vec3::UnitZ());
  for (const Support& support : movement.supports) add_motions(call, movement, support, movement.by);
  return 0;
}

int spread(Call& call) {
  Arguments arguments = call.arguments();
  const Movement movement = read_movement(call, arguments, Vec3::UnitX());
  std::string ends = "both";
  arguments.read("ends", ends);
  double low = unbounded, high = -unbounded, size = 0;
  for (const Support& support : movement.supports) {
    if (support.blocks.empty()) return 0;
    low = std::min(low, support.middle), high = std::max(high, support.middle), size = std::max(size, std::fabs(support.middle));
  }
  if (movement.supports.size() < 2) {
    if (arguments.has("supports")) arguments.mistake("supports needs at least two, which move apart; use settle{} or motion{} for one");
    return 0;
  }
  if (high - low <= 1e-9 * (1 + size)) {
    arguments.mistake(
        "the supports lie side by side across the direction, so that nothing spreads; give the direction from one to the other");
    return 0;
  }
  const double still = ends == "both" ? 0.5 : ends == "first" ? 1 : 0;  // place of the support that stays, between the first and the last
  for (const Support& support : movement.supports)
    add_motions(call, movement, support, movement.by * ((support.middle - low) / (high - low) - still));
  return 0;
}

Keys support_keys(const std::string& by, const std::string& direction, const std::string& usual) {
  return {{"supports", "strings", "", "names of fixed blocks, or of groups of them; each entry moves as one; they are built before",
           -unbounded, unbounded, true},
          {"by", "number", "m", by, -1e6, 1e6, true},
          {"direction", "direction", "", direction, -1e9, 1e9, false, "", usual},
          {"start", "number", "s", "time at which they begin to move", 0, 1e6, false, "", "0"},
          {"duration", "number", "s", "time they take; speed and acceleration begin and end at zero", shortest, 1e6, false, "", "1"},
          {"name", "string", "", "name, for reports"}};
}

}  // namespace

std::vector<Function> support_functions() {
  return {
      {"settle", settle, "{ ... }", "", "Moves supports together, downwards unless a direction is given, along a smooth ramp.",
       support_keys("distance", "\"x\", \"y\", \"z\" or a vector", "{ 0, 0, -1 }")},
      {"spread", spread, "{ ... }", "",
       "Moves supports apart along a smooth ramp, each in proportion to its place between the first and the last along the direction.",
       joined({support_keys("how much farther apart the first and the last are in the end; negative: closer",
                            "\"x\", \"y\", \"z\" or a vector", "\"x\""),
               {{{"ends", "string", "", "which of them move: both by half of it, or only the first or the last along the direction",
                  -unbounded, unbounded, false, "both|first|last", "both"}}}})},
  };
}

}  // namespace erbs::lua
