// The box along the axes of the scene around a block where it is at rest.
#pragma once
#include "engine/base/vec.h"
#include "engine/model/model.h"

namespace erbs {

inline Eigen::AlignedBox3d box_at_rest(const Model& model, std::size_t b) {
  Eigen::AlignedBox3d box;
  for (const Polyhedron& part : model.parts[b])
    for (const Vec3& corner : part.vertices) box.extend(corner);
  return box;
}

}  // namespace erbs
