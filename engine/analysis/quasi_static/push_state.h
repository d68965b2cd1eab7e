// What a push has found so far, for its checkpoint.
#pragma once
#include <cstdint>
#include <type_traits>

#include "engine/analysis/quasi_static/push_curve.h"
#include "engine/analysis/quasi_static/push_path.h"
#include "engine/record/results/capacity.h"

namespace erbs::analysis {

struct PushState {
  LoadPath path;
  MachinePath machine;
  double multiplier = 0;  // of the last state in equilibrium, in the units of its path
  double t = 0;           // s, of the next state in the run folder
  CurvePoint peak;
  long states = 0, attempts = 0, curve_rows = 0;
  double steps = 0, worst_unbalanced = 0;
  std::uint64_t curve_sum = 0;
  DisplacedShapes shapes;
  std::vector<std::uint8_t> happened;  // to each joint: what events.csv has told of it (push_events.h)  [njoint]
  bool gravity_alone = false;          // there is no equilibrium without the push
  std::vector<std::uint8_t> fell;      // the block had fallen off before the push  [nblock]
};

template <class P, class F>
requires std::is_same_v<std::remove_const_t<P>, PushState>
void each(P& p, F&& f) {
  each(p.path, f);
  each(p.machine, f);
  f("push_multiplier", p.multiplier);
  f("push_t", p.t);
  f("push_peak", p.peak);
  f("push_states", p.states);
  f("push_attempts", p.attempts);
  f("push_steps", p.steps);
  f("push_worst_unbalanced", p.worst_unbalanced);
  f("push_curve_rows", p.curve_rows);
  f("push_curve_sum", p.curve_sum);
  each(p.shapes, f);
  f("push_happened", p.happened);
  f("push_gravity_alone", p.gravity_alone);
  f("push_fell", p.fell);
}

}  // namespace erbs::analysis
