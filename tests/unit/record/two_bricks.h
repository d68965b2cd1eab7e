// A minimal model: brick 1 (1 kg) stands on brick 0 (fixed), joined over 0.2 m x 0.1 m; brick 2 (3 kg) is free. Joint axes are the world
// axes.
#pragma once
#include <filesystem>
#include <string>

#include "engine/model/model.h"
#include "engine/model/state.h"
#include "tests/support/folder.h"

namespace erbs::test {

struct TwoBricks {
  Scene scene;
  Model model;
  State state;
};

inline Polyhedron brick() {
  Polyhedron p;
  for (int i = 0; i < 8; ++i) p.vertices.push_back({i & 1 ? 0.1 : -0.1, i & 2 ? 0.05 : -0.05, i & 4 ? 0.05 : -0.05});
  p.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return p;
}

inline TwoBricks two_bricks() {
  TwoBricks t;
  t.scene.name = "two_bricks";
  t.scene.materials.resize(1);
  t.scene.materials[0].name = "brick";
  t.scene.materials[0].density = 1800;
  t.scene.joint_rules.resize(1);
  t.scene.joint_rules[0].thickness = 0.005;
  Model& m = t.model;
  m.nblock = 3, m.njoint = 1, m.npoint = 4;
  m.block_name = {"base", "top", "stray"};
  m.kind = {Kind::fixed, Kind::moving, Kind::moving};
  m.mass = {1, 1, 3};
  m.rest = {Vec3(0, 0, 0), Vec3(0, 0, 0.1), Vec3(1, 0, 0)};
  m.smallest_edge = m.thickness = {0.1, 0.1, 0.1};
  m.material = {0, 0, 0};
  for (const auto& name : m.block_name) {
    Block block;
    block.name = name;
    block.group = "wall";
    block.parts = {translated(brick(), m.rest[t.scene.blocks.size()])};
    m.parts.push_back(block.parts);
    block.material = 0;
    t.scene.blocks.push_back(block);
  }
  JointType type;
  type.points = type.corners = 4;
  type.frame = Mat3::Identity();
  type.area = 0.02;
  type.radius = 0.112;
  m.joint_types = {std::make_shared<const JointType>(type)};
  Joint joint;
  joint.type = m.joint_types.front().get();
  joint.a = 0, joint.b = 1;
  joint.arm_a = Vec3(0, 0, 0.05);
  joint.arm_b = Vec3(0, 0, -0.05);
  m.joint = {joint};
  m.point = {{-0.1, -0.05, 0.005}, {0.1, -0.05, 0.005}, {0.1, 0.05, 0.005}, {-0.1, 0.05, 0.005}};
  m.overlap_corner = {{-0.1, -0.05}, {0.1, -0.05}, {0.1, 0.05}, {-0.1, 0.05}};
  m.laws.resize(1);
  State& s = t.state;
  s.pose.u.assign(4, Vec3::Zero());
  s.pose.q.assign(4, Quat::Identity());
  s.motion.v.assign(4, Vec3::Zero());
  s.motion.spin_momentum.assign(4, Vec3::Zero());
  s.motion.w.assign(4, Vec3::Zero());
  s.joints.stage.assign(1, JointStage::intact);
  s.joints.memory.resize(1);
  s.joints.history.resize(4);
  s.joints.pack.resize(1);
  s.joints.slot.assign(1, 0);
  return t;
}

// An unused name in a folder of its own.
struct Scratch {
  Folder own;
  std::string path;
  explicit Scratch(const std::string& name) : path(own.file(name)) {}
};

}  // namespace erbs::test
