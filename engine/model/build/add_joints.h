// Interfaces -> joints: contact points, principal frame, diagonal stiffness. Equal joints share their type.
#pragma once
#include <functional>
#include <vector>

#include "engine/model/build/interface.h"
#include "engine/model/model.h"

namespace erbs {

void add_joints(const Scene& scene, const std::vector<Interface>& faces, Model& model);

// Calls `use` for each part of each block, in order, with its contact shape relative to the block's centroid. Jointed faces are moved
// outward by half the gap of their joint, so that a stress-free joint is a closed contact. Throws Error if no body is left of a part.
void each_contact_part(const Model& model, const std::function<void(int block, const Polyhedron& part)>& use);

}  // namespace erbs
