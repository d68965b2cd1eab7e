// erbs check SCENE.lua: reports all mistakes of a scene, and the size and cost of a run, without running it.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "engine/analysis/flat_bed.h"
#include "engine/analysis/quasi_static/relaxation.h"
#include "engine/analysis/start/prepare.h"
#include "engine/base/text.h"
#include "engine/base/units.h"
#include "engine/loads/record/record_report.h"
#include "engine/record/recorders/recorder.h"
#include "engine/scene/effects.h"
#include "lua/program/estimate.h"
#include "lua/program/options.h"
#include "lua/program/say.h"

namespace erbs::lua {
namespace {

// bytes of the program and its libraries without a model: the peak of the pier (scenes/first.lua)
constexpr double own_memory = 20 * 1048576.0;

size_t bytes_of(const Model& model) {
  // While all joints are intact. A joint: its record, the data the step reads of it, two wrench rows. A block: model and state with its
  // shapes. Points need nothing: they share their positions and have no history. Fitted to the peak of a wall of 29,911 blocks, 101 MiB.
  const auto joints = static_cast<size_t>(model.njoint), blocks = static_cast<size_t>(model.nblock);
  return joints * (sizeof(Joint) + 400) + blocks * 1500;
}

void print_scene(const Scene& scene) {
  std::set<std::string> groups;
  size_t fixed = 0;
  for (const Block& block : scene.blocks) groups.insert(block.group), fixed += block.fixed;
  say("{}: {} ({} fixed) in {}, {}, {}, {}, {}, {}\n", scene.file, counted(scene.blocks.size(), "block"), fixed,
      counted(groups.size(), "group"), counted(scene.materials.size(), "material"), counted(scene.joint_rules.size(), "joint rule"),
      counted(scene.loads.size(), "load"), counted(scene.recorders.size(), "recorder"), counted(scene.cameras.size(), "camera"));
  for (const Param& param : scene.params)
    say("  param {} = {:g} {}{}{}\n", param.name, param.value, param.unit, param.text.empty() ? "" : "  -- ", param.text);
  for (const std::string& note : scene.notes) say("  {}\n", note);
}

// How strong each ground motion is that the script does not give by a formula, and where those that end leave the ground.
void print_motions(const Scene& scene) {
  for (const Load& load : scene.loads) {
    if (load.kind != Load::Kind::ground) continue;
    const double end = end_time(load.wave);
    const std::string kind = std::visit([](const auto& w) { return std::string(std::decay_t<decltype(w)>::wave_name); }, load.wave);
    if (const auto* record = std::get_if<Record>(&load.wave)) {
      const RecordReport all = report(*record);
      say("  record along ({:g}, {:g}, {:g}): PGA {:.3g} g, PGV {:.3g} m/s, PGD {:.3g} m, as scaled\n", load.direction.x(),
          load.direction.y(), load.direction.z(), std::abs(all.pga.value) / standard_g, std::abs(all.pgv.value), std::abs(all.pgd.value));
    }
    if (!std::isfinite(end)) continue;
    say("  ground motion {} along ({:g}, {:g}, {:g}): ends at {:.4g} s with the velocity {:.3g} m/s and the displacement {:.3g} m\n", kind,
        load.direction.x(), load.direction.y(), load.direction.z(), end, integral(load.wave, end), second_integral(load.wave, end));
  }
}

void print_effects(const Scene& scene) {
  std::string off;
  say("effects on:\n");
  for (const Effect& effect : effects_of(scene)) {
    if (effect.on) say("  {:<28} {}\n", effect.name, effect.because);
    else off += (off.empty() ? "" : ", ") + effect.name;
  }
  say("effects off: {}\n", off.empty() ? "none" : off);
}

// The files of a run: a row at most every step.
void print_results(const Scene& scene, const Model& model, double steps, std::size_t columns) {
  constexpr double energy_row = 210, column = 14, block = 40;  // bytes, as measured; a pose is compressed
  constexpr double much = 2e9;
  const Analysis& a = scene.analysis;
  const double rows = std::min(steps, std::floor(a.duration / a.output_dt) + 1),
               frames = std::min(steps, std::floor(a.duration / a.frame_dt) + 1);
  const double bytes = rows * (energy_row + column * double(columns)) + frames * block * model.nblock;
  say("results: {:g} rows and {:g} frames, about {:.2g} MB\n", rows, frames, 1e-6 * bytes);
  if (bytes > much)
    tell(stderr,
         fmt::format("warning: {}: analysis: results of about {:.2g} GB ({:.3g} rows, output_dt = {:g} s; {:.3g} frames, frame_dt = "
                     "{:g} s); say a longer {}",
                     a.place.text(), 1e-9 * bytes, rows, a.output_dt, frames, a.frame_dt,
                     rows * (energy_row + column * double(columns)) > 0.5 * bytes ? "output_dt" : "frame_dt"));
}

void print_run(const Scene& scene, const analysis::Prepared& run, std::size_t columns) {
  const Model& model = run.model;
  const double dt = run.state.time.dt, steps = std::ceil(scene.analysis.duration / dt);
  say("model: {} blocks, {} joints, {} contact points\n", model.nblock, model.njoint, model.npoint);
  say("dt = {:.4g} s: {}\n  dt_critical {:.4g} s, dt_block_bound {:.4g} s{}\n", dt, run.dt_rule, run.bounds.critical, run.bounds.block,
      run.bounds.stiffest_block >= 0 ? ", set by block " + model.block_name[static_cast<size_t>(run.bounds.stiffest_block)] : "");
  if (scene.push.quasi_static()) {
    constexpr double some = 1e5;
    say("estimate: some thousand steps for each state of the {}; {:g} steps: {:.0f} MiB; {}\n", scene.push.kind, some,
        (static_cast<double>(bytes_of(model)) + own_memory) / 1048576.0, cost_text(estimated_cost(model, some, scene.analysis.debris)));
    return;
  }
  say("estimate: {:g} steps for {:g} s, {:.0f} MiB; {}\n", steps, scene.analysis.duration,
      (static_cast<double>(bytes_of(model)) + own_memory) / 1048576.0, cost_text(estimated_cost(model, steps, scene.analysis.debris)));
  print_results(scene, model, steps, columns);
}

void print_rocking(const Model& model) {
  constexpr size_t shown = 3;
  const std::vector<analysis::FlatBed> beds = analysis::flat_beds(model);
  for (size_t i = 0; i < std::min(shown, beds.size()); ++i) say("rocking: {}\n", told(model, beds[i]));
  if (beds.size() > shown) say("rocking: and {} more blocks on flat beds of their own\n", beds.size() - shown);
}

void check_scene(const std::string& path, const CheckCommand& command) {
  Script script(script_options(command.scene, command.quiet));
  const Scene scene = script.load(path, command.scene.overrides);
  const analysis::Prepared run = analysis::prepare(scene, command.scene.allow_unstable);
  if (scene.push.quasi_static()) analysis::refuse_floating(run, scene.push.place);
  const Recorders recorders(scene, run.model);  // throws Error if two columns have one name
  for (const auto& warning : warnings(scene)) tell(stderr, "warning: " + warning);
  for (const auto& warning : run.warnings) tell(stderr, "warning: " + warning);
  if (command.quiet) return;
  print_scene(scene);
  print_motions(scene);
  print_run(scene, run, recorders.columns().size());
  print_rocking(run.model);
  print_effects(scene);
}

}  // namespace

int verb_check(const CheckCommand& command) {
  if (command.words.empty()) throw Error("check takes a scene; write erbs check SCENE.lua");
  int code = exit_ok;
  for (const auto& path : command.words) {
    try {
      check_scene(path, command);
    } catch (const Errors& mistakes) {
      tell(stderr, mistakes.what());
      code = exit_usage;
    } catch (const Error& mistake) {
      tell(stderr, mistake.what());
      code = exit_usage;
    }
    std::fflush(stdout);
  }
  return code;
}

}  // namespace erbs::lua
