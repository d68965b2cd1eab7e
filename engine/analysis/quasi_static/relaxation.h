// Dynamic relaxation: from a state at rest to equilibrium under a load, or off to collapse. The time integration of a run finds the
// equilibrium, with damping and masses chosen for speed, so that cracks, slip and contacts are those of a run.
#pragma once
#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "engine/analysis/crew.h"
#include "engine/analysis/quasi_static/push_loads.h"
#include "engine/analysis/quasi_static/push_path.h"
#include "engine/analysis/quasi_static/scaled_inertia.h"
#include "engine/analysis/start/prepare.h"
#include "engine/solve/step.h"

namespace erbs::analysis {

enum class Ending : std::uint8_t {
  equilibrium,  // the mean unbalanced force is below its limit
  collapse,     // a block has moved by a tenth of its smallest edge and gains speed, or by half of it; under a loading machine, by half of
                // it and far beyond what the machine moves
  creep,        // still moving after the longest time: no equilibrium, and no block has gone far
  broken,       // a number is not finite
  inexact,      // an equilibrium, on the way to which the ledger missed too much; never returned
  stopped       // by the caller
};

struct Relaxed {
  Ending ending = Ending::stopped;
  long steps = 0;
  double unbalanced = 0;  // mean unbalanced force over mean applied force
  int furthest = -1;      // the block that moved furthest, ...
  double moved = 0;       // m, ... by this
  bool found() const { return ending == Ending::equilibrium; }
};

// Error if no joint leads from a block to a fixed one: it has no equilibrium, and would hide that of the others.
void refuse_floating(const Prepared& run, const Place& place);
double height_of(const Model& model);  // m, of the moving blocks, against gravity

// The multiplier of the loads as a function of the share of the ramp done, 0 to 1, and of the displacement of the monitored point.
using LoadCourse = std::function<double(double ramp, double displacement)>;

class Relaxation {
 public:
  static constexpr double ledger_tolerance = 1e-2;  // relative, of the energy ledger of all relaxations
  static constexpr double gone = 0.1;               // of a block's smallest edge: it falls if it has moved so far and still gains speed
  // `run` as prepared, unloaded; it outlives this object, whose model is a copy with masses of its own. `groups`: of each block. `fell`:
  // blocks that had fallen off before the push; they lie about and do not count [nblock].
  Relaxation(const PushSettings& push, const std::vector<std::string>& groups, const Prepared& run, std::vector<std::uint8_t> fell,
             int threads);

  // Ramps the loads over one period of the structure, then holds them. `seen` is called some times a period, with the solver at a sample;
  // it returns false to stop. `with_machine`: the load follows the monitored point. `falling`: a block must move far before this is a
  // collapse. On return velocities are zero and time starts anew; in equilibrium the state may be relaxed further, without it, but for
  // `falling`, it is as before. What a brittle bond sets free within one step may be missing in the ledger: beyond its tolerance all is
  // repeated with shorter steps.
  using Seen = std::function<bool(const Solver&, const Relaxed&)>;
  enum class Way : std::uint8_t { to_rest, with_machine, falling };
  Relaxed relax(State& state, const LoadCourse& course, const Seen& seen, Way way = Way::to_rest);
  // Lets the structure go under the present loads, with its true masses and without damping, for at most `duration` (s). `seen` is called
  // every `interval` (s).
  void release(State& state, double duration, double interval, const Seen& seen);

  const PushLoads& loads() const { return loads_; }
  MachinePath loading_machine() const { return MachinePath(push_, height_of(run_.model), elastic_slope_); }  // at its start
  void hold_by_machine(double stiffness);  // 1/m, from the next relaxation on
  const MonitorPoint& monitor() const { return monitor_; }
  const Model& model() const { return model_; }
  double period() const { return period_; }            // s, of the relaxation's structure along the push
  const Profile& profile() const { return profile_; }  // of all relaxations
  double searched() const { return searched_; }        // s, for contacts in them
  long steps() const { return steps_; }                // of all that have ended
  void hold(const std::vector<int>& blocks) {          // what falls for ever
    for (const int b : blocks) model_.kind[std::size_t(b)] = Kind::fixed;
  }
  void set_load(double multiplier) { loads_.set(multiplier); }
  // N, on fixed and driven blocks, without the weight of the others: a push that rises or falls would take a part of it for base shear.
  Vec3 reaction(const Solver& solver) const;

 private:
  // Once, with steps that are `finer` times shorter. `exact`: whatever the ledger misses.
  Relaxed relax(State& state, const LoadCourse& course, const Seen& seen, Way way, double finer, bool exact);
  // N, mean unbalanced and mean applied force on moving blocks; the solver is at a sample.
  std::array<double, 2> mean_forces(const Solver& solver);
  void engage(std::optional<Solver>& solver, const Model& model, State& state, const StepRange& range);
  void take_times(const Solver& solver);
  void soften_inertia();
  void take_machine(const Freedom& freedom);
  double quick_rate() const;  // 1/s2, that of the coarse inertia at the present step
  bool counts(int b) const { return model_.kind[std::size_t(b)] == Kind::moving && fell_[std::size_t(b)] == 0; }
  double kinetic(const State& state) const;  // J, of what counts
  void start(State& state, double dt) const;
  void end(State& state) const;
  // Whether a block has moved by this share of its smallest edge, and by `least` (m).
  bool far(const State& state, const BlockVec3& from, double share, double least, Relaxed& out) const;

  const PushSettings push_;
  const Prepared& run_;
  const std::vector<std::uint8_t> fell_;
  Crew crew_;
  long steps_ = 0;
  Model model_;
  PushLoads loads_;
  MonitorPoint monitor_;
  StepRange range_;
  std::optional<CoarseInertia> inertia_;
  double quick_ = 0, share_ = 0;  // 1/s2, its rate; its share of the elastic energy
  double elastic_rate_ = 0;       // 1/s2, square of the circular frequency of the intact structure along the push; 0: a mechanism
  // For a loading machine: 1/m, multiplier over displacement of the monitored point; 1/s2, as `elastic_rate_`, under the pattern; m/s2, of
  // the monitored block alone under a multiplier of 1.
  double elastic_slope_ = std::numeric_limits<double>::infinity(), loaded_rate_ = 0, on_block_ = 0;
  double machine_ = 1;                         // stiffness of the structure with the loading machine over that without it
  double dt_ = 0, free_dt_ = 0, true_dt_ = 0;  // s; free_dt_: without machine and coarse inertia
  double period_ = 0, longest_ = 0;            // s; longest_: of one relaxation
  std::vector<Vec3> unbalanced_;               // N, at the last check, with the share of the coarse inertia
  Profile profile_;
  double searched_ = 0;  // s
};

}  // namespace erbs::analysis
