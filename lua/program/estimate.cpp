#include "lua/program/estimate.h"

#include <algorithm>

#include "engine/base/error.h"
#include "lua/program/progress.h"

namespace erbs::lua {
namespace {

// s on one core. Intact joints: walls of 43 and 262 joints and the house of the bench with 2812 take 0.47, 2.35 and 22 to 25 us a step
// (erbs run --threads 1).
constexpr double step_cost = 0.1e-6, joint_cost = 0.0086e-6;
// A contact point of a cracked joint: 5 to 8 times its share of an intact joint with nine points.
constexpr double cracked_point_cost = 8 * joint_cost / 9;
// A pair of touching blocks, with its search and its separated neighbours: 0.32 us in a heap of 300 bricks, 0.41 in one of 2,000,
// 0.40 in the poured pile, 0.34 in a dry wall of 10 x 10 bricks. The second number: fixed cost of a step once blocks are loose.
constexpr double contact_cost = 0.4e-6, loose_step_cost = 1e-6;
// Touching pairs per block: 0.7 to 1.0 while a heap falls, 1.6 when it lies. A rocking dry wall has 0.3 to 0.8 per joint.
constexpr double pairs_falling = 0.7, pairs_lying = 1.6, pairs_of_joints = 0.5;
// Impacts and sliding shorten the step: 1.2 to 1.7 times as many steps in heaps, 1.0 to 3.0 times in dry structures.
constexpr double more_steps = 2;

}  // namespace

Cost estimated_cost(const Model& m, double steps, bool debris) {
  const auto moving = double(std::count(m.kind.begin(), m.kind.end(), Kind::moving));
  const double intact = steps * (step_cost + joint_cost * m.njoint);
  const auto loose = [&](double pairs) { return steps * (loose_step_cost + contact_cost * pairs); };
  if (m.njoint == 0)
    return {loose(pairs_falling * moving), more_steps * loose(pairs_lying * moving), "while all blocks fall", "when all lie in a heap"};
  const double cracked = steps * (step_cost + cracked_point_cost * m.npoint);
  const bool dry =
      std::all_of(m.joint.begin(), m.joint.end(), [&](const Joint& joint) { return !m.laws[std::size_t(joint.type->law)].has_bond(); });
  const std::string all_sound = dry ? "if no joint opens or slides" : "if all joints stay intact";
  if (!debris) return {intact, std::max(intact, cracked), all_sound, "if all joints are cracked or slide"};
  const double worst = more_steps * loose(std::max(pairs_of_joints * m.njoint, pairs_lying * moving));
  if (dry) return {intact, worst, all_sound, "if it rocks, slides or falls"};
  return {intact, std::max(cracked, worst), all_sound, "if all blocks come loose", cracked};
}

std::string cost_text(const Cost& cost) {
  const std::string cracked = cost.cracked > 0 ? fmt::format(" ({} if all joints are cracked)", duration_text(cost.cracked)) : "";
  return fmt::format("on one core {} {}{} to {} {}", duration_text(cost.least), cost.least_text, cracked, duration_text(cost.most),
                     cost.most_text);
}

}  // namespace erbs::lua
