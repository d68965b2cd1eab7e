// Interfaces -> joints: contact points, principal frame, diagonal stiffness; equal ones share their type.
#pragma once
#include <functional>
#include <vector>

#include "engine/model/interface.h"
#include "engine/model/model.h"

namespace erbs {

void add_joints(const Scene& scene, const std::vector<Interface>& faces, Model& model);

// Calls `use` for each part of each block in order, as contact sees it: relative to the block's centroid, its jointed faces moved out by
// half their bed, so that a stress-free joint is a closed contact. Throws Error where nothing is left of a part.
void each_contact_part(const Model& model, const std::function<void(int block, const Polyhedron& part)>& use);

}  // namespace erbs
