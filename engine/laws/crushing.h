// Compression: a bed of mortar that yields at fc, integrated over a whole face in closed form. The bed is plastic with elastic unloading,
// position by position; its strength stays (a plateau) or softens.
//
// Gaps g are linear over a face. The bed resists with the pressure p = kn max(0, z - g). The crushed depth z <= 0 at a
// position is the lowest value that g + fc / kn has ever had there, so that p <= fc. Hence z is the lower envelope of planes, and every
// integral of p is a sum over convex polygons, exact for any rule of contact points. A face stores at most `most` of these planes. A load
// path that needs more (a load that circles the face) drops the plane that matters least to the crushed volume. The work of that change is
// booked like all other work.
//
// Softening. The strength at a position falls linearly with its crushed depth w = -z, from fc to zero at `ultimate` = 2 Gc / fc, so that
// crushing takes Gc per area (Lourenco 1996 has a compressive fracture energy; the linear branch is ours). Monotonic closing by u gives
//   kn (u - w) = fc (1 - w / ultimate)   =>   w = (u - fc / kn) / (1 - limit / ultimate),   limit = fc / kn,
// as long as limit < ultimate; the joint would snap back otherwise. So z is the envelope of the planes (g + limit) / (1 - limit /
// ultimate), still linear, and the closed form stays exact. Where z reaches -ultimate the bed is spent: it bears nothing, and z is of no
// interest.
//
// Where the contact points bear a face, each with its share of the area, z is a number for each point instead: the same law, but no plane.
//
// Plain data only: files compiled for several instruction sets include this header.
#pragma once

namespace erbs {

struct CrushedFace {
  static constexpr int most = 12, most_points = 3 * most;
  long planes = 0;             // 1 where points bear and any is crushed
  double plane[most][3] = {};  // m at the joint's centre, then the slopes along s and t; z of each point, where points bear
};

// A face in the frame of its joint. `corner`: s, t of each corner, counter-clockwise (m).
struct CompressionFace {
  static constexpr int most_corners = 128;
  double kn, limit;  // Pa/m; m, fc / kn
  int corners;
  const double* corner;           // [2 corners]
  double ultimate = 0;            // m, crushed depth at which the strength is zero; 0: never
  int points = 0;                 // points that bear; 0: the face does
  const double* point = nullptr;  // [3 points]: s, t (m) and area (m2)
};

struct Pressed {
  double force = 0, s = 0, t = 0, energy = 0;  // N; N m, Int p s, Int p t; J
};

// Resultants and elastic energy at a gap. `gap`: a plane as above. Unloading would return the energy.
Pressed pressed(const CompressionFace& face, const CrushedFace& crushed, const double gap[3]);

// Updates the crushed face from gap `before` to gap `now`; returns the plastic work (J). Over a step the work at a position is the mean of
// its two pressures times the change of gap. Its plastic part is the same mean times the change of z.
double crush(const CompressionFace& face, CrushedFace& crushed, const double before[3], const double now[3]);

// Elastic compression (m) at the position s, t, at most face.limit.
double pressed_depth(const CompressionFace& face, const CrushedFace& crushed, const double gap[3], double s, double t);

// m, -z at the position s, t; where points bear, of the nearest.
double crushed_depth(const CompressionFace& face, const CrushedFace& crushed, double s, double t);
double lost_strength(const CompressionFace& face, const CrushedFace& crushed);  // 0..1, mean over the face; 0 on a plateau

}  // namespace erbs
