// Which planes meet in each corner of the overlap of two small bodies, and which corners make its triangles: what stays the same from
// step to step while the corners move. A cache only (contact/corners.inc).
#pragma once
#include <cstdint>

namespace erbs {

struct alignas(64) Corners {
  static constexpr int most = 24, most_triangles = 40;
  // Planes by number: 0 to 7 faces of the reference body a, 8 to 15 those of the other, b. Where the bit of a corner is set in
  // `second_less`, its second plane is the one on which faces `second` and `less_second` are equally near; likewise the third.
  std::uint8_t first[most], second[most], less_second[most], third[most], less_third[most];  // first: corner of b where `is_vertex`
  std::uint8_t nearest[most];                                                                // face of a
  std::uint32_t second_less = 0, third_less = 0, is_vertex = 0;
  // Corners on each plane, as bits: as near to a face of a as to the nearest, on a face of b (8 to 15), on the surface of a (phi = 0).
  static constexpr int surface = 16;
  std::uint32_t on[surface + 1] = {};
  std::uint8_t corner[3][most_triangles], faces[most_triangles];  // as in Triangles
  std::uint8_t count = 0, triangles = 0;                          // no corners: nothing known
  std::uint8_t inside = 0;                                        // corners of a that lie in b
};

}  // namespace erbs
