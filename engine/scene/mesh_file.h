// Block shapes from mesh files, read by assimp. No other file uses that library.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "engine/geometry/polyhedron.h"

namespace erbs {

// The meshes of a file (OBJ, STL, PLY, glTF), in the units of the file. Each mesh is one convex part, its coplanar triangles merged. Files
// that it refers to are read if `may_read` allows it. Throws Error with the name of a mesh that is not closed or not convex.
std::vector<Polyhedron> read_mesh(const std::string& path, const std::function<bool(const std::string&)>& may_read);

}  // namespace erbs
