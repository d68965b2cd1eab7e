// Kinetic energy of blocks, from the recorded poses.
#include <algorithm>

#include "engine/base/error.h"
#include "engine/geometry/mass.h"
#include "render/movie/movie.h"

namespace erbs::render {
namespace {

MassProperties properties_of(const MotionScene& scene, const MotionBlock& block) {
  std::vector<Polyhedron> parts;
  for (int part : block.parts) {
    const MotionShape& shape = scene.shapes[static_cast<std::size_t>(part)];
    parts.push_back({{}, shape.faces});
    for (std::size_t i = 0; i + 2 < shape.vertices.size(); i += 3)
      parts.back().vertices.emplace_back(shape.vertices[i], shape.vertices[i + 1], shape.vertices[i + 2]);
  }
  return mass_properties(parts);
}

Eigen::Quaterniond turn_of(const float* pose) { return Eigen::Quaterniond(pose[3], pose[4], pose[5], pose[6]).normalized(); }

}  // namespace

std::vector<Body> bodies_of(const MotionScene& scene, const Run& run) {
  std::vector<Body> bodies(scene.blocks.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const MotionBlock& block = scene.blocks[b];
    if (block.fixed || block.parts.empty()) continue;
    const auto material = static_cast<std::size_t>(block.material);
    if (material >= run.materials.size() || !(run.materials[material].density > 0))
      throw Error("--color energy needs the density of block " + block.name + ", which manifest.json does not give; run the scene anew");
    const MassProperties shape = properties_of(scene, block);
    bodies[b] = {run.materials[material].density * shape.volume, run.materials[material].density * shape.inertia};
  }
  return bodies;
}

void derive_energies(const MotionReader& reader, const std::vector<Body>& bodies, MotionFrame& frame) {
  frame.derived.assign(bodies.size(), 0);
  const Rates rates = rates_at(reader, nullptr, frame.t);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Vec3 spin =
        turn_of(&frame.poses[7 * b]).conjugate() * rates.spin[b];  // in the axes of the block, in which its inertia is constant
    frame.derived[b] =
        static_cast<float>(0.5 * bodies[b].mass * rates.velocity[b].squaredNorm() + 0.5 * spin.dot(bodies[b].inertia * spin));
  }
}

}  // namespace erbs::render
