// What friction goes by while faces part by next to nothing.
//
// A stack on a slope that has been shaken keeps on hopping, by less than its own weight presses its beds together: where and while it is
// light its springs of friction let go, it slides a little at little friction, and what it slides feeds the hopping, since friction turns
// its blocks. So it creeps down for ever, at any step. Dashpots in proportion to stiffness end that only where they damp the lowest mode of
// the stack by some 6 %: eight plates need .5 of critical at each joint, forty more than an explicit step bears.
// Asperities of real beds stay in each other over such hops. So the friction of a point goes by the mean of its pressure over some hops
// where that is more than the pressure of the moment, while its gap is no wider than some times the settlement d of the structure under its
// own weight, and its joint slides slower than some sqrt(g d), which is as high and as fast as such hops are: what slides faster feels the
// pressure of the moment, so that its mean friction is Coulomb's. Slip then takes at least mu times the mean pressure from what the slope
// gives, which is less below the angle of friction: so it ends. All is measured by d and g: no length, time or speed of its own comes in.
#pragma once

namespace erbs {

inline constexpr double interlock_gap = 100;    // of d
inline constexpr double interlock_time = 100;  // of sqrt(d / g); the structure hops with a period of some 5
inline constexpr double interlock_speed = 120;  // of sqrt(g d)
inline constexpr int interlock_every = 8;      // steps, from one look at the means to the next

// The same in the terms of a step.
struct Interlock {
  double gap = 0;   // m; 0: nothing interlocks
  double slow = 0;  // m2, square of the way of a step
  double rate = 0;  // by which share of the difference the means go on now; 0: they do not
};

}  // namespace erbs
