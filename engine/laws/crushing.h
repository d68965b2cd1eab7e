// Compression plateau: a bed of mortar that yields at fc, integrated over a whole face in closed form. The bed is perfectly plastic with
// elastic unloading, position by position.
//
// Gaps g are linear over a face. The bed resists with the pressure p = kn max(0, z - g). The crushed depth z <= 0 at a
// position is the lowest value that g + fc / kn has ever had there, so that p <= fc. Hence z is the lower envelope of planes, and every
// integral of p is a sum over convex polygons, exact for any rule of contact points. A face stores at most `most` of these planes. A load
// path that needs more (a load that circles the face) drops the plane that matters least to the crushed volume. The work of that change is
// booked like all other work. Plain data only: files compiled for several instruction sets include this header.
#pragma once

namespace erbs {

struct CrushedFace {
  static constexpr int most = 12;
  long planes = 0;
  double plane[most][3] = {};  // m at the joint's centre, then the slopes along s and t
};

// A face in the frame of its joint. `corner`: s, t of each corner, counter-clockwise (m).
struct CompressionFace {
  static constexpr int most_corners = 128;
  double kn, limit;  // Pa/m; m, fc / kn
  int corners;
  const double* corner;  // [2 corners]
};

struct Pressed {
  double force = 0, s = 0, t = 0, energy = 0;  // N; N m, Int p s, Int p t; J
};

// Resultants and elastic energy at a gap. `gap`: a plane as above. Unloading would return the energy.
Pressed pressed(const CompressionFace& face, const CrushedFace& crushed, const double gap[3]);

// Updates the crushed face from gap `before` to gap `now`; returns the plastic work (J). Over a step the work at a position is the mean of
// its two pressures times the change of gap. Its plastic part is the same mean times the change of z.
double crush(const CompressionFace& face, CrushedFace& crushed, const double before[3], const double now[3]);

// Elastic compression (m) at the position s, t, at most bed.limit.
double pressed_depth(const CompressionFace& face, const CrushedFace& crushed, const double gap[3], double s, double t);

}  // namespace erbs
