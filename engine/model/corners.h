// Which planes meet in each corner of the overlap of two small bodies, and which corners make its triangles: what stays the same from
// step to step while the corners move. A cache only (contact/corners.inc).
#pragma once
#include <cstdint>

namespace erbs {

struct alignas(64) Corners {
  static constexpr int most = 24, most_triangles = 40;
  std::uint8_t count = 0, triangles = 0;  // no corners: nothing known
  std::uint8_t inside = 0;                // corners of a that lie in b
  // Corners as bits: those that are corners of b; those whose second, or third, plane is half-way between two faces of a.
  std::uint32_t is_vertex = 0, second_half = 0, third_half = 0;
  // Corners on each plane, as bits: as near to a face of a as to the nearest, on a face of b (8 to 15), on the surface of a (phi = 0).
  static constexpr int surface = 16;
  std::uint32_t on[surface + 1] = {};
  // Of each corner, four bits each from the lowest: first plane, or the corner of b; second and the face on its other side; third and the
  // same; nearest face of a. Planes by number: 0 to 7 faces of the reference body a, 8 to 15 those of the other, b.
  std::uint32_t planes[most];
  // Eight triangles side by side: corners, and faces as in Triangles.
  struct Eight {
    std::uint8_t corner[3][8], faces[8];
  };
  Eight eight[most_triangles / 8];
};

}  // namespace erbs
