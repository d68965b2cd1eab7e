// A pair of parts that may touch: its law, and all it remembers from step to step.
#pragma once
#include <cstdint>
#include <type_traits>
#include <vector>

#include "engine/base/vec.h"
#include "engine/laws/interlock.h"
#include "engine/model/block_field.h"
#include "engine/model/corners.h"

namespace erbs {

struct PairLaw {
  double kn = 0;  // Pa/m
  double ks = 0;  // Pa/m
  double mu = 0;
  double restitution = 0;  // of an impact through the centre
};

// Dashpots and scales that are choices of the numerics, the same for all pairs.
struct ContactSettings {
  double reference_speed = 0.01;      // m/s, restitution is as asked for above it, impacts are softer below
  double memory = 0.05;               // s, over which the greatest approach speed is forgotten
  double settling = 0.2;              // share of critical damping of the settled contact, normal; fades with the speed of impact
  double settling_tangential = 0.05;  // the same of a contact that sticks, tangential
  double event_budget = 0;            // J, by which a blow may err (event_bound.h); 0: any
  Interlock interlock;                // of contacts, in m, m2/s2 and shares of a step (interlock.h)
};

// Force and moments on the two bodies of a pair, world axes, each moment about the body's own centroid.
struct PairWrench {
  Vec3 force = Vec3::Zero();                              // N, on b; on a the opposite
  Vec3 moment_a = Vec3::Zero(), moment_b = Vec3::Zero();  // N m
};

// What a step reads of a touching pair comes first, without gaps: rows of eight numbers (pair_lanes.h).
struct alignas(64) Pair {
  PairLaw law;
  double impact = 0;  // impact_factor(law.restitution)
  // relative pose at the last step, pair axes
  Mat3 turn = Mat3::Identity();
  Vec3 shift = Vec3::Zero();  // m
  // friction, pair axes: slip field u + psi n x (x - c) of the tangential springs
  Vec3 n = Vec3::Zero();  // unit
  Vec3 c = Vec3::Zero();  // m, where u is taken, relative to the centroid of the reference
  Vec3 u = Vec3::Zero();  // m
  double psi = 0;         // rad
  double area = 0;        // m2, largest seen in this contact: stiffness of the springs
  double gyration = 0;    // m, largest seen
  double approach = 0;    // m/s, greatest recent speed of approach
  // what the pair stores now
  double tangential = 0;  // J
  double bearing = 0;     // N, mean of what presses it (interlock.h)
  // wrenches of the last step, whose half step of work is still to be booked
  PairWrench friction, damping;
  // Way by which the other body is seen off its place, pair axes: so a contact stores what was stored before it (hand_over()).
  Vec3 lift = Vec3::Zero();             // m
  double counted_a = 0, counted_b = 0;  // 1/s2, its share in PairList::counted
  int a = 0, b = 0;                         // blocks, a < b
  int part_a = 0, part_b = 0;               // parts of them
  int separating = -1;                      // cache only
  std::uint8_t b_is_reference = 0;          // whose inner distance is the potential: the larger part, then the lower block; never changes
  std::uint8_t touching = 0;
  static constexpr std::uint8_t softening = 2;
  std::uint8_t bed = 0;  // still the faces of a former joint, and its stiffness; once parted they meet as debris. 2: on the way to its stiffness
  Corners corners;       // cache only
};

struct PairList {
  std::vector<Pair> pair;   // sorted by (a, b, part_a, part_b)
  double margin = 0.01;     // m, parts closer than this are listed
  bool valid = false;       // set to false when blocks come loose or pairs are freed: the next search then runs
  std::vector<Vec3> start;  // m, displacement of each block at the start of the run [nblock]
  std::vector<Vec3> u;      // m, pose of each block at the last search [nblock]
  std::vector<Mat3> turn;   //                                          [nblock]
  long searches = 0;
  std::vector<int> contacts;  // of each block that moves, in the last step, and as many for its joints as make a crowd [nblock]
  // the step that is allowed (contact_limit.h)
  double counted = 0;               // 1/s2, of 1 / dt^2 what all blocks share, as counted last, ...
  std::vector<double> counted_of;   // ... and what each adds to it                         [nblock]
  long counts = 0, counted_at = 0;  // how often, in which step
  bool by_blocks = false;           // joints were counted block by block too
};

// A pair that is apart needs no look until its bodies may have come closer by their distance.
struct Apart {
  double distance = 0;          // m, at least, when they were looked at last; 0: not known
  double spun = 0;              // m, of both blocks by then
  Vec3 between = Vec3::Zero();  // m, displacement of b less that of a then
};
// All of them. Looking sooner may find another plane between two bodies, by which they are judged from then on: so it is part of the State.
struct Parting {
  std::vector<Apart> pair;   // as PairList::pair
  BlockQuat q;               // of each block, where it was followed last           [nblock]
  std::vector<double> spun;  // m, way of its farthest point as it turned from step to step, since the list was made, at most [whole groups]
};

// Every member that a checkpoint or a hash must hold.
template <class W, class F>
requires std::is_same_v<std::remove_const_t<W>, PairWrench>
void each(W& w, F&& f) {
  f("force", w.force);
  f("moment_a", w.moment_a);
  f("moment_b", w.moment_b);
}
template <class P, class F>
requires std::is_same_v<std::remove_const_t<P>, PairLaw>
void each(P& p, F&& f) {
  f("kn", p.kn);
  f("ks", p.ks);
  f("mu", p.mu);
  f("restitution", p.restitution);
}
template <class P, class F>
requires std::is_same_v<std::remove_const_t<P>, Pair>
void each(P& p, F&& f) {
  f("a", p.a), f("b", p.b), f("part_a", p.part_a), f("part_b", p.part_b), f("law", p.law);
  f("b_is_reference", p.b_is_reference), f("touching", p.touching), f("bed", p.bed), f("separating", p.separating);
  f("turn", p.turn), f("shift", p.shift), f("n", p.n), f("c", p.c), f("u", p.u), f("psi", p.psi);
  f("area", p.area), f("gyration", p.gyration), f("bearing", p.bearing), f("approach", p.approach), f("impact", p.impact);
  f("counted_a", p.counted_a), f("counted_b", p.counted_b);
  f("friction", p.friction), f("damping", p.damping), f("lift", p.lift), f("tangential", p.tangential);
}
template <class P, class F>
requires std::is_same_v<std::remove_const_t<P>, PairList>
void each(P& p, F&& f) {
  f("pair", p.pair), f("margin", p.margin), f("valid", p.valid), f("start", p.start), f("u", p.u), f("turn", p.turn),
      f("searches", p.searches);
  f("contacts", p.contacts), f("counted", p.counted), f("counted_of", p.counted_of), f("counts", p.counts), f("counted_at", p.counted_at),
      f("by_blocks", p.by_blocks);
}

template <class P, class F>
requires std::is_same_v<std::remove_const_t<P>, Apart>
void each(P& p, F&& f) { f("distance", p.distance), f("spun", p.spun), f("between", p.between); }
template <class P, class F>
requires std::is_same_v<std::remove_const_t<P>, Parting>
void each(P& p, F&& f) { f("pair", p.pair), f("q", p.q), f("spun", p.spun); }

}  // namespace erbs
