#include "engine/analysis/dynamic.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/analysis/crew.h"
#include "engine/analysis/diagnostics.h"
#include "engine/analysis/joint_events.h"
#include "engine/analysis/resume.h"
#include "engine/analysis/snapshot.h"
#include "engine/analysis/start/at_rest.h"
#include "engine/analysis/verdict.h"
#include "engine/base/count.h"
#include "engine/base/units.h"
#include "engine/model/lost_blocks.h"
#include "engine/record/folder/checkpoint.h"
#include "engine/record/results/course.h"
#include "engine/scene/effects.h"
#include "engine/solve/energy.h"
#include "engine/solve/step.h"

namespace erbs::analysis {
namespace {

// Output written so far, so that a resumed run continues at the same rows. Rows and frames are due at whole multiples of their interval.
struct OutputSchedule {
  long rows = 0, frames = 0;
  long right = 0;  // last step at which the energy ledger was valid (verdict.h)
  JointEvents joints;

  SamplePlan next(const Analysis& how, const Needs& needs) const {
    return {std::min(double(rows) * how.output_dt, double(frames) * how.frame_dt), how.duration, needs.block_wrench || needs.load_wrench,
            std::min(how.output_dt, how.frame_dt)};
  }
};

template <class C, class F>
requires std::is_same_v<std::remove_const_t<C>, OutputSchedule>
void each(C& c, F&& f) {
  f("rows", c.rows);
  f("frames", c.frames);
  f("right", c.right);
  f("joints", c.joints);
}

class Run {
 public:
  Run(Scene scene, const std::string& script, const RunOptions& options);
  RunOutcome go();

 private:
  void begin();
  void step_on();
  void watch(const BlockVec3& built);
  void record(const Snapshot& now);
  Snapshot snapshot() const { return snapshot_of(run_.model, run_.state, *solver_, writer_->needs().joint_force); }
  void show_end();
  bool stop();
  void take_counts();
  void change_threads();
  void save();
  RunSoFar so_far() const;
  void judge();
  Metrics metrics() const;

  Scene scene_;
  std::vector<Effect> effects_;
  std::vector<std::string> group_;  // of each block
  const std::string& script_;
  const RunOptions& options_;
  double born_ = seconds(), setup_ = 0, solve_start_ = 0, record_ = 0, last_save_ = 0, last_progress_ = 0, started_at_ = 0;
  Prepared run_;
  CheckpointKey key_;
  OutputSchedule output_;
  Collapse collapse_;
  RunDiagnostics diagnostics_;
  std::optional<Solver> solver_;
  std::optional<Crew> crew_;
  long touched_ = 0, slept_ = 0;
  double searched_ = 0, solved_ = 0;  // s
  double framed_ = -1;                // s, time of the last frame of this process
  std::optional<RunWriter> writer_;
  RunOutcome out_;
  double dt_at_start_ = 0;
  double height_energy_ = 0;  // J, potential energy released if all blocks fell to the lowest centroid
  long steps_at_start_ = 0;
};

Run::Run(Scene scene, const std::string& script, const RunOptions& options)
    : scene_(std::move(scene)), effects_(effects_of(scene_)), script_(script), options_(options) {}

void Run::begin() {
  out_.lock = reserve_folder(options_.directory, options_.existing, options_.override_arguments);
  run_ = prepare(scene_, options_.allow_unstable);
  dt_at_start_ = run_.state.time.dt;
  key_ = checkpoint_key(scene_, script_, dt_at_start_, options_.override_arguments);
  const bool resume = options_.existing == Existing::resume;
  WriterProgress written;
  if (resume) {
    const std::vector<std::size_t> sizes = sizes_of(run_.state);
    read_checkpoint(options_.directory, key_, run_.state, written, collapse_, output_, diagnostics_, run_.equilibrium);
    check_sizes(options_.directory, sizes, run_.state);
    collapse_.supports.ride = rides_of(run_.model);
  } else {
    const BlockVec3 built = run_.state.pose.u;
    start_at_rest(scene_, run_, options_.threads, told_at_start(options_, born_));
    add_noise(run_, options_.noise, options_.noise_seed);
    add_noise(run_, options_.twin_noise, 2);
    watch(built);
  }
  Manifest manifest = manifest_of_run(scene_, script_, run_, options_);
  manifest.dt = dt_at_start_;
  const Recorders wanted(scene_, run_.model);  // reports columns of equal names before anything is written
  create_run_folder(options_.directory, options_.existing, script_, manifest);
  if (!out_.lock) out_.lock = std::make_shared<FolderLock>(options_.directory);
  writer_.emplace(options_.directory, scene_, run_.model, resume ? &written : nullptr);
  for (const Block& block : scene_.blocks) group_.push_back(block.group);
  scene_.blocks = std::vector<Block>();
  return_free_memory();
  if (!resume)
    for (const std::string& note : options_.notes) writer_->log(note);
  for (const std::string& w : run_.warnings) writer_->log_once("warning: " + w);
  if (!resume && collapse_.under_gravity)
    writer_->log(fmt::format("the structure does not stand under {}: {:.3g} % of the mass; {}", weight_at_start(run_.model),
                             100 * falling_share(run_), summary(collapse_.mechanism, run_.model, 1000)));
  for (const std::string& note : run_.notes) writer_->log_once(note);
  out_.warnings = run_.warnings;
  double low = std::numeric_limits<double>::infinity(), weights = 0, moments = 0;
  for (int b = 0; b < run_.model.nblock; ++b) {
    const double height = -run_.model.rest[z(b)].dot(run_.model.gravity);  // times |g|
    low = std::min(low, height);
    if (run_.model.kind[z(b)] == Kind::moving) weights += run_.model.mass[z(b)], moments += run_.model.mass[z(b)] * height;
  }
  height_energy_ = weights > 0 ? moments - weights * low : 0;
  solver_.emplace(run_.model, run_.state, run_.range, options_.threads);
  solver_->follow_closely();
  crew_.emplace(options_.threads);
  return_free_memory();
  steps_at_start_ = run_.state.time.step;
  started_at_ = run_.state.time.t;
  setup_ = seconds() - born_;
  solve_start_ = last_save_ = last_progress_ = seconds();
}

// A structure that cannot stand under its own weight has collapsed before the run begins, if the falling share of mass is large enough.
void Run::watch(const BlockVec3& built) {
  collapse_ = watch_collapse(run_.model, run_.state.pose);
  collapse_.thrown = thrown_blocks(scene_, run_.model, run_.state);
  for (const int b : run_.fallers) collapse_.start[z(b)] = upwards(run_.model).dot(built[z(b)]);
  if (run_.fallers.empty() || falling_share(run_) < scene_.analysis.collapse_fraction) return;
  collapse_.collapsed = collapse_.under_gravity = true;
  collapse_.time = infinite;  // it has not fallen yet
  collapse_.mechanism = mechanism_of(run_.model, run_.fallen ? *run_.fallen : run_.state.pose, 0);
}

void Run::record(const Snapshot& now) {
  const double began = seconds();
  take_events(output_.joints, *solver_);
  write_events(output_.joints, now, *writer_);
  std::vector<int> fallen;
  const bool collapse = update(collapse_, run_.model, now.pose, now.t, &fallen);
  for (const int b : fallen) writer_->event(now.t, "fall", run_.model.block_name[z(b)], -now.pose.u[z(b)].z(), "m");
  if (collapse) {
    writer_->event(now.t, "collapse", scene_.name, collapse_.fallen_fraction, "share of mass");
    for (const MovedJoint& moved : collapse_.mechanism.moved)
      writer_->event(now.t, word(moved.kind), run_.model.joint_name(moved.joint), std::max({moved.opening, moved.slip, moved.gap}), "m");
    writer_->log(fmt::format("collapse {}; {}", span_of_event(scene_.analysis, now.t), summary(collapse_.mechanism, run_.model, 1000)));
  }
  run_.state.observed.joints_broken = now.joints_broken;
  const Analysis& how = scene_.analysis;
  const double dt = solver_->sample().dt, reached = now.t + 1e-9 * dt;
  const bool end = now.t >= how.duration - 0.5 * dt;
  if (end || reached >= double(output_.rows) * how.output_dt) writer_->row(now);
  if (end || reached >= double(output_.frames) * how.frame_dt) writer_->frame(now), framed_ = now.t;
  while (double(output_.rows) * how.output_dt <= reached) ++output_.rows;
  while (double(output_.frames) * how.frame_dt <= reached) ++output_.frames;
  record_ += seconds() - began;
}

// A run that a collapse ends stops between two frames. Its pictures end with what it came to.
void Run::show_end() {
  if (out_.metrics.status == "completed" && solver_->sample().t > framed_) writer_->frame(snapshot());
}

void Run::save() {
  const double began = seconds();
  take_events(output_.joints, *solver_);
  write_checkpoint(options_.directory, key_, run_.state, writer_->progress(), collapse_, output_, diagnostics_, run_.equilibrium);
  last_save_ = seconds();
  record_ += last_save_ - began;
}

bool Run::stop() {
  const double now = seconds();
  const Energy& e = run_.state.energy;
  update_diagnostics(diagnostics_, run_.state, solver_->stable_dt(run_.bounds.critical), energy_tolerance(so_far()),
                     solver_->take_long_steps());
  if (options_.progress && now - last_progress_ > 0.1) {
    last_progress_ = now;
    options_.progress({run_.state.time.t, scene_.analysis.duration, now - solve_start_, run_.state.time.step - steps_at_start_,
                       run_.state.observed.joints_broken, e.residual_relative, run_.state.time.dt, text(solver_->limit(), run_.model)});
  }
  const double sampled_t = run_.state.time.t - run_.state.time.last_dt;
  if (sampled_t >= scene_.analysis.duration - 0.5 * run_.state.time.dt) return true;
  if (scene_.analysis.stop_after_collapse >= 0 && collapse_.collapsed && sampled_t >= collapse_.time + scene_.analysis.stop_after_collapse)
    return true;
  if (collapse_.moved) return true;
  if (diverges(so_far(), output_.right)) out_.metrics.status = "diverged";
  if (out_.metrics.status != "completed") return true;
  if (options_.interrupted != nullptr && options_.interrupted->load()) out_.metrics.status = "interrupted";
  if (options_.until && sampled_t >= *options_.until) out_.metrics.status = "stopped";
  if (options_.max_wall > 0 && now - born_ > options_.max_wall) out_.metrics.status = "stopped";
  if (out_.metrics.status != "completed") return true;
  if (now - last_save_ > options_.checkpoint_every) save();
  return false;
}

Metrics Run::metrics() const {
  const State& s = run_.state;
  Metrics m = out_.metrics;
  m.time_s = s.time.t - s.time.last_dt;
  m.steps = s.time.step;
  m.dt_s = dt_at_start_;
  m.dt_critical_s = run_.bounds.critical;
  m.dt_block_bound_s = run_.bounds.block;
  m.threads = options_.threads;
  m.blocks = run_.model.nblock;
  m.joints = run_.model.njoint;
  m.contact_points = run_.model.npoint;
  m.joints_broken = s.observed.joints_broken;
  m.blocks_asleep = s.sleep.count;
  m.wall_s.total = seconds() - born_;
  m.wall_s.setup = setup_;
  m.wall_s.record = record_;
  m.wall_s.solve = solved_;
  m.wall_s.search = searched_;
  divide_solving(m.wall_s, out_.profile);
  m.simulated_s = m.time_s - started_at_;
  m.point_updates = std::uint64_t(s.time.step - steps_at_start_) * std::uint64_t(run_.model.npoint);
  m.peak_memory_bytes = peak_memory_bytes();
  for (const Effect& e : effects_) (e.on ? m.effects_on : m.effects_off).push_back(e.name);
  m.energy = energy_terms(s.energy);
  m.residual_relative = s.energy.residual_worst;
  m.momentum_residual = s.observed.momentum_residual;
  m.max_penetration_relative = s.observed.max_penetration_relative;
  m.collapse.collapsed = collapse_.collapsed;
  m.collapse.fallen_fraction = collapse_.fallen_fraction;
  m.collapse.moving_fraction = moving_fraction(collapse_, run_.model, s);
  m.collapse.moved = collapse_.moved;
  m.collapse.under_gravity = collapse_.under_gravity;
  if (collapse_.under_gravity) m.collapse.under = weight_at_start(run_.model);
  if (collapse_.collapsed && !collapse_.under_gravity) m.collapse.time_s = collapse_.time;
  if (collapse_.fallen_fraction > 0) m.collapse.direction = collapse_direction(collapse_, run_.model, s.pose);
  const Course course = course_of(collapse_, run_.model, group_, m.collapse.direction);
  m.collapse.course = course.text;
  for (const GroupFall& one : course.groups)
    m.collapse.sequence.push_back({{"group", one.group}, {"time_s", one.time}, {"share", one.share}});
  m.diagnostics = diagnostics_of(diagnostics_, run_.model, s);
  m.collapse.mechanism =
      mechanism_metrics(collapse_.collapsed ? collapse_.mechanism : mechanism_of(run_.model, s.pose, m.time_s), run_.model);
  m.equilibrium = equilibrium_metrics(run_);
  m.state_hash = state_hash(s);
  return m;
}

RunSoFar Run::so_far() const {
  return {scene_, run_, collapse_, diagnostics_, output_.joints.released, dt_at_start_, height_energy_, options_.allow_unstable};
}

// Status, exit code and last line follow from errors in the numbers.
void Run::judge() {
  std::string& status = out_.metrics.status;
  if (status == "completed" && diverged_at_end(so_far())) status = "diverged";
  out_.trouble = trouble_of(so_far(), status);
  if (status == "completed" && !out_.trouble.empty()) status = "inaccurate";
  writer_->log(fmt::format("status {}; {}", status, ledger_line(so_far())));
}

// Of the present Solver, before it ends.
void Run::take_counts() {
  touched_ += solver_->contacts().sums().touched(), slept_ += solver_->contacts().slept();
  searched_ += solver_->contacts().searched();
  out_.profile += solver_->profile();
}

// The run continues from its state, as a resumed run does.
void Run::change_threads() {
  const double began = seconds();
  take_events(output_.joints, *solver_);
  take_counts();
  solver_.emplace(run_.model, run_.state, run_.range, crew_->threads());
  solver_->follow_closely();
  crew_->took(seconds() - began);
}

// THE LOOP, from one closing of the energy ledger to the next; some are samples. The number of threads is the one that is fastest at the
// moment.
void Run::step_on() {
  // A run that was killed after its last step, or is resumed twice, is where it should stop.
  if (run_.state.time.step > 0 && options_.until && run_.state.time.t - run_.state.time.last_dt >= *options_.until) {
    out_.metrics.status = "stopped";
    if (const double t = run_.state.time.t; t > *options_.until + 2 * run_.state.time.dt)
      out_.warnings.push_back(fmt::format("--until {:g}: the run was at {:g} s already, nothing was simulated", *options_.until, t));
    return;
  }
  while (true) {
    const Solver::Stop at = solver_->advance(output_.next(scene_.analysis, writer_->needs()));
    if (at == Solver::Stop::sample) record(snapshot());
    if (solver_->broken()) return;
    if (stop()) return show_end();
    if (crew_->should_change(run_.state.time.step)) change_threads();
  }
}

RunOutcome Run::go() {
  begin();
  step_on();
  solved_ = seconds() - solve_start_ - record_;
  if (solver_->broken()) out_.metrics.status = "diverged";
  take_counts();
  judge();
  const std::string& status = out_.metrics.status;
  if (!out_.trouble.empty()) writer_->log(out_.trouble);
  if (touched_ > 0)
    writer_->log(fmt::format("contact: {} pair forces evaluated in {} steps", touched_, run_.state.time.step - steps_at_start_));
  if (slept_ > 0)
    writer_->log(fmt::format("sleep: {:.1f} of {} blocks asleep on average, {} at the end",
                             double(slept_) / double(std::max(1L, run_.state.time.step - steps_at_start_)), run_.model.nblock,
                             run_.state.sleep.count));
  if (const std::string lost = lost_blocks(run_.model, run_.state); !lost.empty()) {
    out_.warnings.push_back(lost);
    writer_->log("warning: " + lost);
  }
  if (status == "stopped" || status == "interrupted") save();
  else write_last_events(output_.joints, run_.state.time.t - run_.state.time.last_dt, run_.model, run_.state.energy, *writer_);
  solver_.reset();
  out_.limits = limit_lines(out_.profile, run_.model);
  out_.metrics = metrics();
  writer_->log(diagnostics_line(out_.metrics.diagnostics));
  if (const double t = output_.joints.first_crack; t >= 0) writer_->log("first crack " + span_of_event(scene_.analysis, t));
  writer_->close();
  write_metrics(options_.directory, out_.metrics);
  return std::move(out_);
}

}  // namespace

Manifest manifest_of_run(const Scene& scene, const std::string& script, const Prepared& run, const RunOptions& options) {
  Manifest manifest = manifest_of(scene, script);
  manifest.threads = options.threads;
  manifest.dt = run.state.time.dt;
  manifest.dt_critical = run.bounds.critical;
  manifest.dt_block_bound = run.bounds.block;
  manifest.dt_rule = run.dt_rule;
  manifest.override_arguments = options.override_arguments;
  manifest.scene_path = options.scene_path, manifest.arguments = options.arguments;
  for (const Effect& e : effects_of(scene))
    (e.on ? manifest.effects_on : manifest.effects_off).push_back(e.on ? e.name + " (" + e.because + ")" : e.name);
  return manifest;
}

StartTold told_at_start(const RunOptions& options, double born) {
  return [&options, born](const std::string& line) {
    if (options.max_wall > 0 && seconds() - born > options.max_wall)
      throw Error(
          fmt::format("{:g} s were not enough for the structure to come to rest before the first step; nothing is written: raise "
                      "--max-wall, or let the run begin as built, with analysis{{ start = \"rest\" }}",
                      options.max_wall));
    if (options.progress) options.progress({.wall = seconds() - born, .line = line, .starting = true});
  };
}

void divide_solving(Metrics::Wall& wall, const Profile& profile) {
  const auto phase = profile.seconds(wall.solve - wall.search);
  wall.contact = phase[std::size_t(Phase::contact)], wall.joints = phase[std::size_t(Phase::joints)];
  wall.integrate = phase[std::size_t(Phase::integrate)], wall.ledger = phase[std::size_t(Phase::ledger)];
}

RunOutcome run_dynamic(Scene scene, const std::string& script, const RunOptions& options) {
  return Run(std::move(scene), script, options).go();
}

}  // namespace erbs::analysis
