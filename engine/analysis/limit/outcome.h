// What a limit analysis found, joint by joint and in words: the thrust in every joint, and the mechanism.
#pragma once
#include <string>
#include <vector>

#include "engine/analysis/limit/limit.h"
#include "engine/record/results/mechanism.h"
#include "engine/scene/scene.h"

namespace erbs::analysis {

// The load that analysis{ kind = "pushover" | "tilt" } of the scene multiplies; without one, an acceleration to x. That of a tilt lies in
// the plane normal to gravity.
LimitLoad limit_load(const Scene& scene, const Model& model);

// Unit vector of the load that a push adds to gravity (m/s2): of a tilt, the part of its direction normal to gravity; zero if there is
// none.
Vec3 load_direction(const PushSettings& push, const Vec3& gravity);

// Resultant of a joint's contact forces.
struct Thrust {
  Vec3 at = Vec3::Zero();     // m, centre of pressure; the centre of the joint where nothing presses
  Vec3 force = Vec3::Zero();  // N, on block b of the joint
  double normal = 0;          // N, compression positive
  double shear = 0;           // N
};
std::vector<Thrust> thrusts(const LimitResult& result, const Model& model);  // [njoint]

struct LimitMechanism {
  Mechanism joints;           // joints that open or slide; amounts as if the fastest joint had moved by a fiftieth of its size
  int moving = 0;             // blocks that move at more than a thousandth of the fastest
  Vec3 drift = Vec3::Zero();  // unit mean horizontal velocity of the moving mass; zero where they move against each other
  std::string kind;           // "out-of-plane overturning", "in-plane sliding", "4 hinges" ...
  std::string words;          // the same with the joints that move
};
LimitMechanism limit_mechanism(const LimitResult& result, const Model& model);

// The poses of all blocks when the mechanism has moved its fastest block by `way` (m). To first order in the spins.
BlockPoses poses_of(const LimitResult& result, const Model& model, double way);

}  // namespace erbs::analysis
