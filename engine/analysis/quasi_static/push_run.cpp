#include "engine/analysis/quasi_static/push_run.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/analysis/quasi_static/limit_beside.h"
#include "engine/analysis/quasi_static/push_events.h"
#include "engine/analysis/quasi_static/push_results.h"
#include "engine/analysis/quasi_static/push_state.h"
#include "engine/analysis/quasi_static/relaxation.h"
#include "engine/analysis/resume.h"
#include "engine/analysis/snapshot.h"
#include "engine/analysis/start/at_rest.h"
#include "engine/base/count.h"
#include "engine/model/lost_blocks.h"
#include "engine/record/folder/checkpoint.h"
#include "engine/record/folder/run_writer.h"
#include "engine/record/results/collapse.h"
#include "engine/record/results/mechanism_name.h"
#include "engine/scene/effects.h"

namespace erbs::analysis {
namespace {

constexpr double beyond = 1.02;          // the fall: the load over the least one without equilibrium
constexpr int frames_of_last_step = 10;  // on the way to collapse

class PushRun {
 public:
  PushRun(Scene scene, const std::string& script, const RunOptions& options)
      : scene_(std::move(scene)), push_(scene_.push), effects_(effects_of(scene_)), script_(script), options_(options) {}
  RunOutcome go();

 private:
  void begin();
  bool stand();
  void push_on();
  void control_on();
  void fall(bool drawn);
  Relaxed attempt(const LoadCourse& course);
  bool record(const Solver& solver, const Relaxed& now);
  Snapshot snapshot(const Solver& solver) const;
  bool interrupted();
  void save(const WriterProgress& written);
  void save_when_due();
  bool controlled() const { return by_displacement(push_); }
  void assess();
  Metrics metrics();

  Scene scene_;
  const PushSettings push_;
  std::vector<Effect> effects_;
  std::vector<std::string> group_;
  const std::string& script_;
  const RunOptions& options_;
  const double born_ = seconds();
  double residual_ = 0;  // relative, of the energy ledger: the worst up to the collapse, and at the end
  double setup_ = 0, solve_start_ = 0, last_save_ = 0, record_ = 0;
  Prepared run_;
  CheckpointKey key_;
  PushState so_far_;
  Collapse collapse_;
  std::optional<Relaxation> relaxation_;
  std::optional<RunWriter> writer_;
  std::optional<CsvWriter> curve_;
  bool too_far_ = false;  // control by displacement: this step is to be repeated in parts
  std::string fall_;      // how far the fall after the last step has come, for the progress line; empty before it
  NamedMechanism mechanism_;
  std::vector<WallMechanism> walls_;
  std::optional<LimitBeside> limit_;
  std::optional<Performance> performance_;
  RunOutcome out_;
};

void PushRun::begin() {
  out_.lock = reserve_folder(options_.directory, options_.existing, options_.override_arguments);
  const bool resume = options_.existing == Existing::resume;
  run_ = prepare(scene_, options_.allow_unstable);
  refuse_floating(run_, push_.place);
  const double dt = run_.state.time.dt;
  key_ = checkpoint_key(scene_, script_, dt, options_.override_arguments);
  so_far_.path = LoadPath(push_);
  const State intact = run_.state;
  WriterProgress written;
  for (const Block& block : scene_.blocks) group_.push_back(block.group);
  if (resume) {
    const std::vector<std::size_t> sizes = sizes_of(run_.state);
    read_checkpoint(options_.directory, key_, run_.state, written, collapse_, so_far_, run_.equilibrium);
    check_sizes(options_.directory, sizes, run_.state);
    collapse_.supports.ride = rides_of(run_.model);
  } else {
    start_at_rest(scene_, run_, options_.threads, told_at_start(options_, born_));
    add_noise(run_, options_.noise, options_.noise_seed);
    add_noise(run_, options_.twin_noise, 2);
    collapse_ = watch_collapse(run_.model, run_.state.pose);
    so_far_.gravity_alone = falling_share(run_) >= scene_.analysis.collapse_fraction;
    so_far_.fell.assign(z(run_.model.nblock), 0);
    for (const int b : run_.fallers)
      collapse_.start[z(b)] = height_above_rest(run_.model, intact.pose, z(b)), so_far_.fell[z(b)] = !so_far_.gravity_alone;
  }
  State loaded = std::exchange(run_.state, intact);
  relaxation_.emplace(push_, group_, run_, so_far_.fell, options_.threads);  // of the intact structure: a resumed push has the same
  run_.state = std::move(loaded);
  relaxation_->hold(blocks_past_ground(run_.model, run_.state));
  if (!resume) so_far_.machine = relaxation_->loading_machine();
  Manifest manifest = manifest_of_run(scene_, script_, run_, options_);
  manifest.dt = dt;
  const Recorders wanted(scene_, run_.model);  // reports columns of equal names before anything is written
  create_run_folder(options_.directory, options_.existing, script_, manifest);
  if (!out_.lock) out_.lock = std::make_shared<FolderLock>(options_.directory);
  writer_.emplace(options_.directory, scene_, run_.model, resume ? &written : nullptr);
  const std::string curve = run_file(options_.directory, "curve.csv");
  if (resume) curve_.emplace(curve, curve_columns(push_), so_far_.curve_rows, so_far_.curve_sum);
  else curve_.emplace(curve, curve_columns(push_));
  so_far_.curve_rows = curve_->rows(), so_far_.curve_sum = curve_->sum();
  for (const std::string& note : resume ? std::vector<std::string>{} : options_.notes) writer_->log(note);
  for (const std::string& w : run_.warnings) writer_->log_once("warning: " + w);
  for (const std::string& note : run_.notes) writer_->log_once(note);
  out_.warnings = run_.warnings;
  setup_ = seconds() - born_;
  solve_start_ = last_save_ = seconds();
}

Snapshot PushRun::snapshot(const Solver& solver) const {
  Snapshot now = snapshot_of(relaxation_->model(), run_.state, solver, writer_->needs().joint_force);
  now.t = so_far_.t;
  now.ground_v = now.ground_u = Vec3::Zero();
  return now;
}

// Writes a state in equilibrium.
bool PushRun::record(const Solver& solver, const Relaxed& now) {
  if (now.ending != Ending::equilibrium) return !interrupted();
  const double began = seconds();
  CurvePoint p = curve_point(run_.model, run_.state, *relaxation_, solver, push_);
  p.unbalanced = now.unbalanced, p.steps = double(now.steps);
  too_far_ = controlled() && so_far_.machine.goes_too_far(p.displacement);
  if (too_far_) return true;
  const Snapshot state = snapshot(solver);
  curve_->row(curve_row(p));
  curve_->flush();
  writer_->row(state);
  writer_->frame(state);
  write_push_events(so_far_.happened, run_.model, run_.state.joints, state.pose, so_far_.t, *writer_);
  run_.state.observed.joints_broken = state.joints_broken;
  so_far_.t += scene_.analysis.frame_dt;
  so_far_.curve_rows = curve_->rows(), so_far_.curve_sum = curve_->sum();
  // Steps of the load end at its bracket, or at the last load of the path.
  const bool peak = !controlled() || so_far_.states == 0 || p.multiplier > so_far_.peak.multiplier;
  if (peak) so_far_.peak = p;
  so_far_.shapes.take(along_push(*relaxation_, solver, push_.direction), so_far_.states, peak);
  ++so_far_.states;
  so_far_.worst_unbalanced = std::max(so_far_.worst_unbalanced, now.unbalanced);
  record_ += seconds() - began;
  return true;
}

bool PushRun::interrupted() {
  const double now = seconds();
  if (options_.progress) {
    Progress p;
    p.wall = now - solve_start_;
    p.steps = relaxation_->steps() + run_.state.time.step;
    p.joints_broken = run_.state.observed.joints_broken;
    p.residual = run_.state.energy.residual_relative;
    p.dt = run_.state.time.dt;
    p.line = progress_line(push_, so_far_, relaxation_->loads().multiplier(), fall_);
    options_.progress(p);
  }
  if (options_.interrupted != nullptr && options_.interrupted->load()) out_.metrics.status = "interrupted";
  else if (options_.max_wall > 0 && now - born_ > options_.max_wall) out_.metrics.status = "stopped";
  return out_.metrics.status != "completed";
}

// From the last state in equilibrium; back to it if there is none under this load.
Relaxed PushRun::attempt(const LoadCourse& course) {
  const PushState known = so_far_;
  const Relaxed r = relaxation_->relax(
      run_.state, course, [&](const Solver& solver, const Relaxed& now) { return record(solver, now); },
      so_far_.states > 0 && controlled() ? Relaxation::Way::with_machine : Relaxation::Way::to_rest);
  if (r.ending == Ending::stopped) {
    so_far_ = known;
  } else {
    so_far_.steps += double(r.steps);
    ++so_far_.attempts;
    if (r.ending == Ending::broken) out_.metrics.status = "diverged";
  }
  return r;
}

// Once the path has taken note of a state, so that a run killed later does not visit it again.
void PushRun::save_when_due() {
  if (seconds() - last_save_ > options_.checkpoint_every) save(writer_->progress());
}

void PushRun::save(const WriterProgress& written) {
  write_checkpoint(options_.directory, key_, run_.state, written, collapse_, so_far_, run_.equilibrium);
  last_save_ = seconds();
}

// Equilibrium without the push.
bool PushRun::stand() {
  if (so_far_.states > 0) return true;  // resumed
  const Relaxed r = attempt([](double, double) { return 0.0; });
  if (r.ending == Ending::collapse || r.ending == Ending::creep) so_far_.gravity_alone = true;
  return r.found();
}

void PushRun::push_on() {
  while (!so_far_.path.done() && out_.metrics.status == "completed") {
    const double from = so_far_.multiplier, to = so_far_.path.next();
    const Relaxed r = attempt([=](double ramp, double) { return from + ramp * (to - from); });
    if (r.ending == Ending::stopped || r.ending == Ending::broken) return;
    if (r.found()) so_far_.path.found(), so_far_.multiplier = to;
    else so_far_.path.failed();
    writer_->log(fmt::format("multiplier {:.6g}: {} after {} steps, unbalanced {:.2e}", shown_multiplier(push_, to),
                             r.found()                      ? "equilibrium"
                             : r.ending == Ending::collapse ? "collapse"
                                                            : "creeps",
                             r.steps, r.unbalanced));
    save_when_due();
  }
}

void PushRun::control_on() {
  MachinePath& machine = so_far_.machine;
  while (!machine.done() && out_.metrics.status == "completed") {
    const State before = run_.state;
    const double from = machine.extension, to = machine.next();
    relaxation_->hold_by_machine(machine.stiffness);
    const Relaxed r = attempt([&, from, to](double ramp, double u) { return machine.load(from + ramp * (to - from), u); });
    if (r.ending == Ending::stopped || r.ending == Ending::broken) return;
    if (!r.found()) {
      machine.failed();
      writer_->log(fmt::format("extension {:.6g} m: {} after {} steps", to,
                               r.ending == Ending::collapse ? "a part that the machine does not hold comes apart" : "creeps", r.steps));
    } else if (too_far_) {
      machine.repeat(relaxation_->monitor().along(run_.state.pose));
      run_.state = before;
      continue;
    } else {
      const double displaced = relaxation_->monitor().along(run_.state.pose);
      if (machine.leaps(displaced)) out_.warnings.push_back(machine.leap_text(displaced)), writer_->log("warning: " + out_.warnings.back());
      so_far_.multiplier = relaxation_->loads().multiplier();
      machine.found(displaced);
    }
    save_when_due();
  }
  if (machine.bracketed()) so_far_.path.above = machine.load(*machine.above, machine.displacement);
}

// The collapse as it goes on from the least load without equilibrium, or from a state past the peak, for the mechanism, and for pictures
// where it is `drawn`.
void PushRun::fall(bool drawn) {
  const double from = so_far_.multiplier, to = so_far_.path.above ? beyond * *so_far_.path.above : from;
  const double far = 0.5 / frames_of_last_step;
  double shown = far;
  const auto frame = [&](const Solver& solver) {
    const Snapshot now = snapshot(solver);
    writer_->frame(now);
    writer_->row(now);
    so_far_.t += scene_.analysis.frame_dt;
    if (update(collapse_, run_.model, now.pose, now.t))
      writer_->event(now.t, "collapse", scene_.name, collapse_.fallen_fraction, "share of mass");
  };
  Mechanism joints;
  bool named = false;
  const auto name = [&] {
    joints = mechanism_of(run_.model, run_.state.pose, so_far_.t, so_far_.fell);
    BlockMotions motions = motions_of(run_.state.pose, run_.model.nblock);
    for (int b = 0; b < run_.model.nblock; ++b)
      if (so_far_.fell[z(b)] != 0) motions.u[z(b)] = motions.theta[z(b)] = Vec3::Zero();
    mechanism_ = name_mechanism(run_.model, motions, joints, push_.direction);
    walls_ = wall_mechanisms(run_.model, motions, joints, push_.direction, group_);
    named = true;
  };
  relaxation_->relax(
      run_.state, [=](double ramp, double) { return from + ramp * (to - from); },
      [&](const Solver& solver, const Relaxed& r) {
        const double edges = r.furthest >= 0 ? r.moved / run_.model.smallest_edge[z(r.furthest)] : 0;
        if (drawn && edges > shown) frame(solver), shown += far;
        fall_ = fmt::format("it falls: a block has moved by {:.3g} of its edge", edges);
        if (!named && edges > Relaxation::gone) name();
        return !interrupted() && (!named || (drawn && push_.fall > 0));
      },
      Relaxation::Way::falling);
  if (out_.metrics.status != "completed") return;
  if (!named) name();
  if (!drawn) return;
  relaxation_->release(run_.state, push_.fall, scene_.analysis.frame_dt, [&](const Solver& solver, const Relaxed&) {
    frame(solver);
    fall_ = fmt::format("it falls: {:.2f} of {:.4g} s", run_.state.time.t, push_.fall);
    return !collapse_.collapsed && !interrupted();
  });
  collapse_.mechanism = joints;
}

void PushRun::assess() {
  if (push_.kind != "pushover" || so_far_.states < 2) return;
  performance_ = assess_pushover(options_.directory, scene_.performance, push_shape(run_.model, group_, so_far_.shapes));
  if (!performance_ || performance_->trouble.empty()) return;
  out_.warnings.push_back("no performance point: " + performance_->trouble);
  writer_->log("warning: " + out_.warnings.back());
}

Metrics PushRun::metrics() {
  Metrics m = out_.metrics;
  const State& s = run_.state;
  m.time_s = so_far_.t;
  m.steps = long(so_far_.steps);
  m.dt_s = run_.state.time.dt;
  m.dt_critical_s = run_.bounds.critical;
  m.dt_block_bound_s = run_.bounds.block;
  m.threads = options_.threads;
  m.blocks = run_.model.nblock, m.joints = run_.model.njoint, m.contact_points = run_.model.npoint;
  m.joints_broken = s.observed.joints_broken;
  m.wall_s.total = seconds() - born_;
  m.wall_s.setup = setup_, m.wall_s.record = record_;
  m.wall_s.solve = seconds() - solve_start_ - record_;
  m.wall_s.search = relaxation_ ? relaxation_->searched() : 0;
  divide_solving(m.wall_s, out_.profile);
  m.point_updates = std::uint64_t(so_far_.steps) * std::uint64_t(run_.model.npoint);
  m.peak_memory_bytes = peak_memory_bytes();
  for (const Effect& e : effects_) (e.on ? m.effects_on : m.effects_off).push_back(e.name);
  m.energy = energy_terms(s.energy);
  m.residual_relative = residual_;
  m.momentum_residual = s.observed.momentum_residual;
  m.max_penetration_relative = s.observed.max_penetration_relative;
  m.collapse.collapsed = so_far_.gravity_alone || collapse_.collapsed || so_far_.path.above.has_value();
  m.collapse.under_gravity = so_far_.gravity_alone;
  if (so_far_.gravity_alone) m.collapse.under = weight_at_start(run_.model);
  m.collapse.fallen_fraction = collapse_.fallen_fraction;
  m.collapse.moving_fraction = moving_fraction(collapse_, run_.model, s);
  if (collapse_.fallen_fraction > 0) m.collapse.direction = collapse_direction(collapse_, run_.model, s.pose);
  m.collapse.mechanism = mechanism_metrics(collapse_.mechanism, run_.model);
  m.equilibrium = equilibrium_metrics(run_);
  m.diagnostics = push_diagnostics(residual_, run_.model, s);
  Capacity& c = m.capacity.emplace(capacity_of(push_, so_far_));
  c.gravity_alone = so_far_.gravity_alone;
  c.limit = limit_;
  c.mechanism = mechanism_.name, c.course = mechanism_.text, c.walls = walls_;
  c.performance = performance_;
  m.state_hash = state_hash(s);
  return m;
}

RunOutcome PushRun::go() {
  begin();
  if (!so_far_.gravity_alone && stand()) {
    if (controlled()) control_on();
    else push_on();
  }
  std::string& status = out_.metrics.status;
  residual_ = run_.state.energy.residual_worst;
  if (status == "interrupted" || status == "stopped") {
    save(writer_->progress());
  } else if (status == "completed" && (so_far_.gravity_alone || so_far_.path.above || past_peak(push_, so_far_))) {
    const bool drawn = so_far_.gravity_alone || so_far_.path.above;
    const State before = run_.state;
    const PushState known = so_far_;
    const WriterProgress written = writer_->progress();
    const Collapse watched = collapse_;
    fall(drawn);
    if (status != "completed" || !drawn) run_.state = before, so_far_ = known, collapse_ = watched;
    if (status != "completed") save(written);  // resumed, it falls anew
  }
  residual_ = std::max(residual_, run_.state.energy.residual_relative);
  if (status == "completed" && residual_ > Relaxation::ledger_tolerance) {
    status = "inaccurate";
    out_.trouble = fmt::format("analysis: the energy ledger misses {:.2g} of all energy; say dt_fraction = {:.2g}", residual_,
                               scene_.analysis.dt_fraction / 2);
  }
  if (status == "completed") {
    std::string why;
    const bool found = so_far_.path.above || past_peak(push_, so_far_);
    limit_ = limit_beside(scene_, run_.model, found ? std::optional(so_far_.peak.multiplier) : std::nullopt, so_far_.fell, why);
    if (!why.empty()) writer_->log("no limit analysis beside the capacity: " + why);
  }
  writer_->log(fmt::format("status {}", status));
  curve_->flush(), writer_->flush();
  if (status == "completed" || status == "inaccurate") assess();
  if (relaxation_) out_.profile = relaxation_->profile(), out_.limits = limit_lines(out_.profile, run_.model);
  out_.metrics = metrics();
  writer_->close();
  write_metrics(options_.directory, out_.metrics);
  return std::move(out_);
}

}  // namespace

RunOutcome run_push(Scene scene, const std::string& script, const RunOptions& options) {
  return PushRun(std::move(scene), script, options).go();
}

}  // namespace erbs::analysis
