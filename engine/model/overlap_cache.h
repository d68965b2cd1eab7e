// Cache of the overlap of two small bodies: which planes meet in each of its corners, and which corners form its triangles. Between steps
// the corners move, but this topology mostly stays (contact/overlap/known_corners.h).
#pragma once
#include <cstdint>

namespace erbs {

struct alignas(64) Corners {
  static constexpr int most = 24, most_triangles = 40;
  std::uint8_t count = 0, triangles = 0;  // count 0: the cache is empty
  std::uint8_t inside = 0;                // corners of a inside b, as bits
  // Corners as bits: corners of b; corners whose second (third) plane is the bisector of two faces of a.
  std::uint32_t is_vertex = 0, second_half = 0, third_half = 0;
  // Corners on each plane, as bits. Planes 0 to 7: a face of a that is as near as the nearest one. 8 to 15: a face of b. 16: the surface of
  // a (phi = 0).
  static constexpr int surface = 16;
  std::uint32_t on[surface + 1] = {};
  // Planes of each corner, four bits each, from the lowest:
  //   first plane, or the corner of b
  //   second plane, then the second face of its bisector
  //   third plane, then the second face of its bisector
  //   nearest face of a
  // Planes 0 to 7 are faces of the reference body a, 8 to 15 faces of the other body b.
  std::uint32_t planes[most];
  // Eight triangles side by side: their corners, and their faces as in Triangles.
  struct TrianglePack {
    std::uint8_t corner[3][8], faces[8];
  };
  TrianglePack triangle_pack[most_triangles / 8];
};

}  // namespace erbs
