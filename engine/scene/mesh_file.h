// Meshes from files. The one door to assimp.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "engine/geometry/polyhedron.h"

namespace erbs {

// The meshes of a file (OBJ, STL, PLY, glTF), each one convex part with its coplanar triangles merged, in the file's units. What the file
// refers to is read where `may_read` says so. Throws Error with the name of the mesh where one is not closed or not convex.
std::vector<Polyhedron> read_mesh(const std::string& path, const std::function<bool(const std::string&)>& may_read);

}  // namespace erbs
