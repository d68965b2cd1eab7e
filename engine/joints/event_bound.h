// Bound on the time step by contacts that are about to open or close.
//
// Leapfrog conserves T_n+1/2 + k p_n p_n+1 / 2 of a spring in permanent compression. A one-sided spring violates this twice per impact. The
// kick that enters (p_n < 0 < p_n+1) loses k p_n+1 |p_n| / 2; the kick that leaves gains k p_n |p_n+1| / 2. The instant of touch within the
// step decides the amount. At a rate of r (m/s) both are at most k (r dt)^2 / 8. At omega dt = 1.8 an impact returns a fifth to five times
// its energy, on average twice; at .3 it errs by 4 %, at .1 by .2 %. Openings and closings are therefore predicted. Each face gives
//   dt_event = sqrt(budget / (k r^2 / 8)), the step at which its event errs by at most `budget`,
//   in_time  = the time until the event, over `event_steps`,
// and the step is at most the greater of the two. Its reciprocal is the event rate (1/s). The step thus shortens while blocks still fly, at
// no cost: a change of dt errs by F^2 (dt_0^2 - dt_1^2) / (8 m), F the net force. The step grows again once this error is below the budget
// too (`Solver::next_dt()`).
#pragma once
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

inline constexpr int foresee_every = 4;  // steps between two predictions
// Share of `Energy::reference` by which one event may err. A hundred events of either sign then leave a third of the tolerance of 1e-3.
inline constexpr double event_tolerance = 3e-5;
// The same for the sum of all events: as it comes near, each event may err by less.
inline constexpr double event_sum = 5e-4;
inline constexpr double least_allowance = 1e-2;  // share of `event_tolerance` that is left in any case

// A blow of a structure of many joints is a thousand events within some hundred steps. Each errs by far less than it may, but faces that
// meet lose more than faces that part gain, since friction and dashpots act in between: of a storey that falls on its walls 1.3 of 700 J
// that it dissipates. So there the residual of the last steps counts, which fades: the step is shorter until the blow has passed, and then
// no longer. In a rain of loose bricks all blows come at once, and half as much is allowed.
//
// The sum of the whole run does not count there. Cracked mortar that trembles at the limit of the step makes a little energy in each event,
// always of the same sign, but little: of 273 walls that a block strikes at most 5.6e-4 in half a second
// (`scenes/hard/h34_struck_wall.lua`).
inline constexpr double blow_sum = 1e-4, rain_sum = 5e-5;  // shares of `Energy::reference`
inline constexpr double recent_share = 7.0 / 8;            // of `Energy::event_residual` that each step of the ledger leaves
inline constexpr int few_joints = 16;                      // in a structure of more joints the first opening of one is no significant event
inline constexpr int few_loose = 16;                       // blocks; the blows of more are a rain

// With many loose blocks each impact is a smaller part of the whole, and the tolerance is that of a collapse, 1e-2. From `few_loose` blocks
// on both shares grow with the square root of their number, up to this factor. A pile of 300 took 4 % more steps than without any bound,
// instead of 21 %; with the sum of a rain it takes 7 % more than that, and its ledger closes to 3.4e-4, instead of 4e-3.
inline constexpr double most_for_many = 4;

// A blow of little energy beside that of all blocks still rebounds as asked: it may err by this share of its own energy, so that
// omega dt < .06 for the face that lands, and the restitution by .01. Of many blocks the mean of their blows counts: the share grows with
// their number, and of more than `few_loose` it does not count. A pile of 2,000 would need five times as many steps, pours of 16 to 48
// bricks 1.6 times as many.
inline constexpr double own_share = 1e-3;
inline constexpr int few_blows = 4;  // moving blocks
double blow_share(const Model& model);

// True where the residual of the last steps counts, not that of the whole run.
inline bool has_many_events(const Model& model, const State& state) {
  return model.njoint > few_joints || state.topology.unjoined > few_loose;
}
// J, error allowed to one event now; 0: unlimited.
double event_allowance(const Model& model, const State& state);
// The same; also 0 in a step without prediction.
double event_budget(const Model& model, const State& state);
// `last_dt` over the step that joint j allows. `gap_before` is its relative displacement one step ago, `gap` the present one; 0: no event
// is near.
double foresee(const Model& model, const Joint& joint, const double gap_before[6], const double gap[6], double budget);

}  // namespace erbs
