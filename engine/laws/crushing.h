// Compression of a bed that yields at fc, over a whole face in closed form; perfectly plastic, unloading elastic, place by place.
//
// Gaps are linear over a face. The bed presses with p = kn max(0, z - g); z <= 0 is how far it has been crushed at that place, the
// lowest that g + fc / kn has ever been there, so that p <= fc. z is therefore the lower envelope of planes, and every integral of p
// a sum over convex polygons, exact for any rule of contact points. Of its planes a face keeps `most`; a load that leaves more (one
// that goes round the face) loses the one that matters least to the crushed volume, and the work of that is booked like all other.
// Only plain data here: files compiled for several instruction sets read it.
#pragma once

namespace erbs {

struct CrushedFace {
  static constexpr int most = 12;
  long planes = 0;
  double plane[most][3] = {};  // m, at the joint's centre, and its slopes along s and t
};

// A face in its joint's frame: `corner` holds s, t of each corner, counter-clockwise (m).
struct Bed {
  static constexpr int most_corners = 128;
  double kn, limit;  // Pa/m; m, fc / kn
  int corners;
  const double* corner;  // [2 corners]
};

struct Pressed {
  double force = 0, s = 0, t = 0, energy = 0;  // N; N m, Int p s, Int p t; J
};

// `gap`: a plane as above. What presses at this gap; its energy is what would come back.
Pressed pressed(const Bed& bed, const CrushedFace& crushed, const double gap[3]);

// Carries the crushed face on from one gap to the next. Returns the work this took (J): over a step a place's work is the mean of its
// two pressures times the change of its gap, and what of it is not stored is their mean times the change of z.
double crush(const Bed& bed, CrushedFace& crushed, const double before[3], const double now[3]);

// Depth (m) by which the place s, t presses at this gap, at most bed.limit.
double pressed_depth(const Bed& bed, const CrushedFace& crushed, const double gap[3], double s, double t);

}  // namespace erbs
