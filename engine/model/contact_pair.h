// Contact pair: two parts that may touch, with their contact law and their history.
#pragma once
#include <cstdint>
#include <type_traits>
#include <vector>

#include "engine/base/vec.h"
#include "engine/laws/interlock.h"
#include "engine/model/block_arrays.h"
#include "engine/model/overlap_cache.h"

namespace erbs {

struct PairLaw {
  double kn = 0;  // Pa/m
  double ks = 0;  // Pa/m
  double mu = 0;
  double restitution = 0;  // of an impact through the centre
  Hop hop = {};            // laws/interlock.h
};

// Numerical settings of contact, the same for all pairs.
struct ContactSettings {
  double reference_speed = 0.01;      // m/s; above it the restitution is as specified, below it impacts are softer
  double memory = 0.05;               // s, over which the peak approach speed decays
  double settling = 0.2;              // share of critical damping of a settled contact, normal; it fades with the impact speed
  double settling_tangential = 0.05;  // the same of a sticking contact, tangential
  double horizon = 0;                 // s, time before a predicted event can change a step (model/levels.h)
  double first_fall = 0;              // m, in the first steps of a run, in which bodies have no speed yet; 0 in all others
  double event_budget = 0;            // J, energy error allowed per impact (event_bound.h); 0: no limit
  double blow_share = 1e300;          // of the kinetic energy of a blow: the same (event_bound.h)
  double falling_mass = 0;            // kg, of all moving blocks: no blow presses deeper than that of a body with this mass
  double gravity = 0;                 // m/s2, of interlock (laws/interlock.h); 0: none
};

// Force and moments on the two bodies of a pair, world axes, each moment about the body's own centroid.
struct PairWrench {
  Vec3 force = Vec3::Zero();                              // N, on b; on a the opposite
  Vec3 moment_a = Vec3::Zero(), moment_b = Vec3::Zero();  // N m
};

// A contact pair. The data that a step reads of a touching pair come first and without gaps, as rows of eight numbers (pair_lanes.h).
struct alignas(64) ContactPair {
  PairLaw law;
  double impact = 0;  // impact_factor(law.restitution)
  // relative pose at the last step, pair axes
  Mat3 rotation = Mat3::Identity();
  Vec3 shift = Vec3::Zero();  // m
  // friction, pair axes: slip field u + psi n x (x - c) of the tangential springs
  Vec3 n = Vec3::Zero();          // unit
  Vec3 c = Vec3::Zero();          // m, point to which u belongs, relative to the centroid of the reference body
  Vec3 u = Vec3::Zero();          // m
  double psi = 0;                 // rad
  double area = 0;                // m2, largest in this contact so far: gives the stiffness of the springs
  double gyration = 0;            // m, largest so far
  double peak_closing_speed = 0;  // m/s, largest recent approach speed
  // present state of the friction springs and of interlock
  double tangential = 0;         // J, energy of the springs
  double mean_normal_force = 0;  // N, mean normal force (interlock.h)
  double lent = 0;               // N s, of friction beyond the current force, over its coefficient (interlock.h)
  // wrenches of the last step; half a step of their work is not yet booked
  PairWrench friction, damping;
  // Offset at which contact sees the other body, pair axes. With it the contact stores as much energy as the joint did before its release
  // (`release_to_contact`).
  Vec3 lift = Vec3::Zero();                     // m
  double lag = 0;                               // N, part of the dashpot that follows a blow with a lag (pair_law.h)
  double blow_age = 0;                          // s, since the approach was as fast as peak_closing_speed
  double bound_share_a = 0, bound_share_b = 0;  // 1/s2, share of the pair in the bound of each block, at the last update
  int a = 0, b = 0;                             // blocks, a < b
  int part_a = 0, part_b = 0;                   // parts of them
  int separating_axis = -1;                     // cache only
  // The inner distance of the reference body is the contact potential. This body is the larger part, or the part of the lower block; it
  // never changes.
  std::uint8_t b_is_reference = 0;  // 1: b is the reference body, else a
  std::uint8_t touching = 0;
  static constexpr std::uint8_t softening = 2;
  // 1: the pair has the faces and the stiffness of a former joint; once separated it is debris. 2: its stiffness is changing to that of
  // debris.
  std::uint8_t former_joint = 0;
  std::uint8_t slow = 0;  // 1: the pair acts once in a macro step (model/levels.h)
  Corners corners;        // cache only
};

struct PairList {
  std::vector<ContactPair> pair, spare;  // sorted by (a, b, part_a, part_b); room for the next list: new memory would be slow
  double margin = 0.01;                  // m, parts closer than this are listed
  bool valid = false;                    // false after blocks came loose or joints were released: the next search then runs
  std::vector<Vec3> u;                   // m, pose of each block at the last search [nblock]
  std::vector<Mat3> rotation;            //                                          [nblock]
  std::vector<double> travel;            // m, that each block may travel after it before parts farther than the margin may meet  [nblock]
  long searches = 0;
  std::vector<int> contact_count;  // number on each moving block in the last step; a jointed block counts as saturated [nblock]
  // bound of the time step (time_step_bound.h)
  double bound_at_last_update = 0;               // 1/s2, part of 1 / dt^2 common to all blocks, at the last update
  std::vector<double> block_bounds;              // 1/s2, part that each block adds                       [nblock]
  long bound_updates = 0, bound_updated_at = 0;  // number of updates, step of the last one
  bool by_blocks = false;                        // the last update bounded joints block by block too
  std::vector<std::uint8_t> fast;                // blocks whose pairs act in every step [nblock]; empty: those of all (levels.h)
};

// A separated pair. It needs no update until its two bodies may have closed the distance.
struct PairSeparation {
  double distance = 0;             // m, lower bound at the last update of the pair; 0: unknown
  double rotation_travel = 0;      // m, sum of the rotation travel of both blocks at that time
  Vec3 relative_u = Vec3::Zero();  // m, displacement of b minus that of a at that time
};
// All separated pairs. An earlier update may find another separating plane, which later steps then use. Hence this is part of the State.
struct SeparationState {
  std::vector<PairSeparation> pair;  // as PairList::pair
  BlockQuat q;                       // rotation of each block when it was last tracked    [nblock]
  // m, rotation travel since the last search: path of the farthest point of each block by rotation alone, upper bound   [whole groups]
  std::vector<double> rotation_travel;
};

// All members that a checkpoint or a hash must contain.
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
  f("hop_time", p.hop.time);
  f("hop_loan", p.hop.loan);
}
template <class P, class F>
requires std::is_same_v<std::remove_const_t<P>, ContactPair>
void each(P& p, F&& f) {
  f("a", p.a), f("b", p.b), f("part_a", p.part_a), f("part_b", p.part_b), f("law", p.law);
  f("b_is_reference", p.b_is_reference), f("touching", p.touching), f("former_joint", p.former_joint), f("slow", p.slow),
      f("separating_axis", p.separating_axis);
  f("rotation", p.rotation), f("shift", p.shift), f("n", p.n), f("c", p.c), f("u", p.u), f("psi", p.psi);
  f("area", p.area), f("gyration", p.gyration), f("mean_normal_force", p.mean_normal_force), f("lent", p.lent),
      f("peak_closing_speed", p.peak_closing_speed), f("impact", p.impact);
  f("bound_share_a", p.bound_share_a), f("bound_share_b", p.bound_share_b);
  f("friction", p.friction), f("damping", p.damping), f("lift", p.lift), f("lag", p.lag), f("blow_age", p.blow_age),
      f("tangential", p.tangential);
}
template <class P, class F>
requires std::is_same_v<std::remove_const_t<P>, PairList>
void each(P& p, F&& f) {
  f("pair", p.pair), f("margin", p.margin), f("valid", p.valid), f("u", p.u), f("rotation", p.rotation), f("travel", p.travel),
      f("searches", p.searches);
  f("contact_count", p.contact_count), f("bound_at_last_update", p.bound_at_last_update), f("block_bounds", p.block_bounds),
      f("bound_updates", p.bound_updates), f("bound_updated_at", p.bound_updated_at), f("by_blocks", p.by_blocks), f("fast", p.fast);
}

template <class P, class F>
requires std::is_same_v<std::remove_const_t<P>, PairSeparation>
void each(P& p, F&& f) { f("distance", p.distance), f("rotation_travel", p.rotation_travel), f("relative_u", p.relative_u); }
template <class P, class F>
requires std::is_same_v<std::remove_const_t<P>, SeparationState>
void each(P& p, F&& f) { f("pair", p.pair), f("q", p.q), f("rotation_travel", p.rotation_travel); }

}  // namespace erbs
