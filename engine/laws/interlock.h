// Interlock of asperities: friction follows a mean pressure while faces separate by tiny hops.
//
// The problem: a stack on a slope that has been shaken keeps hopping, by less than its own weight compresses its joints. While a joint is
// nearly unloaded its friction springs let go, and it slips a little at low friction. The slip feeds the hopping, since friction rotates
// the blocks. So the stack creeps downhill for ever, at any time step. Dashpots proportional to stiffness end the creep only if they damp
// the lowest mode of the stack by about 6 %. Eight plates need 0.5 of critical at each joint; forty plates need more than an explicit step
// can bear.
//
// The remedy: asperities of real joints stay interlocked over such hops. Friction of a point therefore follows the mean of its pressure
// over some hops, if that exceeds the current pressure. Two conditions limit this. The gap is at most a multiple of d, the settlement of
// the column of blocks through the joint under its own weight. The slip rate is at most a multiple of sqrt(g d). Such hops are so high and
// so fast. A joint that slips faster feels the current pressure.
// Slip then dissipates at least mu times the mean pressure. Below the friction angle the slope supplies less, so the creep ends.
//
// What friction takes beyond the current pressure is lent: the impulse is kept, and while the pressure is above its mean, friction stays
// at the mean until it is paid back. So over some hops friction is Coulomb's. The greater of mean and current pressure alone, without
// paying back, would be more than either in the mean: a wall of undamped mortar on a cracked bed, whose pressure trembles by its own size,
// stood under 1 g at mu = .6. No more is lent than what the pressure now lacks of its mean gives in a few hops: a bed that is unloaded for
// good lets go, and shaking that is slower than the hops moves it as Coulomb's law does (V63). Low columns come to rest by their dashpots
// and are lent less; some hops must be lent all the same, or a wall of undamped mortar creeps as it trembles (V62), and a stack that plates
// have fallen onto (h35). The mean of a dry bed starts with the pressure at which it first opens or slides, since its asperities have been
// interlocked so far: from zero on, a stack near its limit slid by centimetres in the time until the mean was known (h27). Elsewhere it
// starts from zero: with the blow of a landing face, or the pressure at which a bond breaks, it would lend a multiple of the weight. All
// scales derive from d and g: the model has no length, time or speed of its own. sqrt(d / g) of a column, its time of a hop, says all.
#pragma once

namespace erbs {

inline constexpr double interlock_gap = 100;    // times d: largest gap
inline constexpr double interlock_time = 100;   // times sqrt(d / g): averaging time; the structure hops with a period of about 5
inline constexpr double interlock_speed = 120;  // times sqrt(g d): largest slip rate
inline constexpr double interlock_loan = 8;     // times sqrt(d / g): what lacks of the mean pressure is lent at most so long
inline constexpr int interlock_every = 8;       // steps between updates of the mean pressure

// Of the column of blocks through a joint or contact; 0: no interlock.
struct Hop {
  double time = 0, loan = 0;  // s, sqrt(d / g); over which what lacks of the mean pressure may be lent
};

// What is common to all joints in a step; without gravity there is no interlock.
struct InterlockStep {
  double gravity = 0;    // m/s2
  double slip_time = 0;  // s, over which slip is measured; 1 where it is a speed
  double dt = 0;         // s, since the last evaluation
  double since = 0;      // s, since the last update of the mean pressure; 0: no update in this step
};

}  // namespace erbs
