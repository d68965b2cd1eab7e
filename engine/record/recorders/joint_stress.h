// Stresses of a joint, from the law of its points: for recorders, pictures and histograms.
#pragma once
#include <array>

#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

// Pa, tension positive. Dashpots do not count. Zero once contact has replaced the joint.
struct JointStress {
  double normal = 0;               // mean over the face: normal force over area
  double least = 0, greatest = 0;  // at the corners of the face and of the cells of its points
  double shear = 0;                // mean: shear force over area
  double greatest_shear = 0;       // at the contact points
};
JointStress joint_stress(const Model& model, const JointState& joints, const BlockPoses& pose, int j);

// Resultant on block a in the joint's rotated frame: s, t, n in N, then N m about the joint's centre. Springs alone; zero as above.
std::array<double, 6> joint_resultant(const Model& model, const JointState& joints, const BlockPoses& pose, int j);

// Resultant on block a, world axes, and where its normal part acts in the plane of the joint; its centre without a normal force.
struct JointThrust {
  Vec3 force = Vec3::Zero();  // N
  Vec3 at = Vec3::Zero();     // m
};
JointThrust joint_thrust(const Model& model, const JointState& joints, const BlockPoses& pose, int j);

// Share of the compressive strength that crushing has taken, mean over the face (0..1); kept in contact, 0 without softening.
double joint_crushing(const Model& model, const JointState& joints, int j);

}  // namespace erbs
