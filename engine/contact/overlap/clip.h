// Fast overlap of two small bodies (at most 8 vertices and 8 faces each: bricks, voussoirs, wedges), as triangles side by side; `general.h`
// computes the same for any body. Plain data, compiled once per instruction set. A larger body, or an overlap of more triangles, takes the
// general path.
#pragma once
#include "engine/model/overlap_cache.h"

namespace erbs {

inline constexpr int few = 8;               // vertices or faces of a small body
inline constexpr int most_triangles = 128;  // a multiple of 8

struct alignas(64) SmallShape {
  double vertex[3][few];               // m, as in `ContactShape`; the last one fills the array
  double normal[3][few], offset[few];  // unit, m; 0 and 1e30 beyond the last face: every point is inside
  double edge;                         // m, smallest
  int vertices = 0, faces = 0;         // none for a larger body
  // Corners of each face, counter-clockwise seen from outside; the first fills the array. The same as bits.
  unsigned char count[few], loop[few][few], mask[few];
};

// Pose of b in the axes of a (row-major `rotation`; `shift` in m), as `PairPose`.
struct SmallPose {
  double rotation[9], shift[3];
};

struct alignas(64) Triangles {
  double plane[4][few];                         // faces of a from the centroid of b: normal . x <= `plane[3]`
  double normal[3][few];                        // of the faces of b
  double corner[3][3][most_triangles + 8];      // m, [corner][axis], pair axes: origin at the centroid of b
  double depth[3][most_triangles + 8];          // m, phi at the corners, filled by `sum()`
  double closing_speed[3][most_triangles + 8];  // m/s, filled by `closing_speeds()`
  double size[most_triangles + 8];              // m2, filled by `sum()`
  unsigned char faces[most_triangles + 8];      // face of b, plus `few` times the face of a below which phi is measured
  double max_depth;                             // m, filled by `sum()`
  int count;                                    // a multiple of 8, with empty ones at the end
  int separating_axis;                          // a face of a with all of b on its outer side; -1: none
  bool overflow;                                // more triangles than there is room for
};

struct ClipTask {
  const SmallShape *a, *b;
  SmallPose pose;
  Triangles* out;
  Corners* known = nullptr;  // corners of an earlier overlap of the same bodies, updated by the call; null: not used
};

// Sums over the triangles, kn = 1 (names as in `general.h`).
struct alignas(64) OverlapSums {
  double total, pressure[3], area, centroid[3], second[6], force[3], moment[3], unused[4];
};

struct ClipKernels {
  const char* name;
  void (*clip)(const SmallShape& a, const SmallShape& b, const SmallPose& pose, Triangles& out);
  void (*clip_all)(const ClipTask* task, int count);  // up to eight, independent of each other
  void (*sum)(Triangles& triangles, OverlapSums& out);
  // Closing speed along + turning . x at the corners (m/s); returns the greatest.
  double (*closing_speeds)(Triangles& triangles, double along, const double angular_part[3]);
  // Int phi (s - 1) dS and its first moment over the faces that press along `normal`; s - 1 = chi closing clamped to [-1, limit - 1].
  void (*damp)(const Triangles& triangles, const double normal[3], double chi, double limit, double& total, double first[3]);
};

const ClipKernels& clip_kernels();

namespace sse2 {
extern const ClipKernels clip_kernels;
}
namespace avx2 {
extern const ClipKernels clip_kernels;
}
namespace avx512 {
extern const ClipKernels clip_kernels;
}

}  // namespace erbs
