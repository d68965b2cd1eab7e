// erbs bench: the step kernel against the reference implementation and the limits of the machine, in one run. Without arguments it
// times the scenes of scenes/bench, each in its own process, so that its memory can be measured. With arguments it times those scenes.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "engine/analysis/start/at_rest.h"
#include "engine/base/count.h"
#include "engine/base/system/process.h"
#include "engine/record/format/json.h"
#include "engine/record/results/metrics.h"
#include "engine/study/machine.h"
#include "engine/study/timing.h"
#include "lua/program/options.h"
#include "lua/program/say.h"
#include "lua/reports/bench_report.h"

namespace erbs::lua {
namespace {

namespace fs = std::filesystem;

Json to_json(const study::Timing& t, double per) {
  return {{"user_us_per_step", 1e6 * t.user},
          {"wall_us_per_step", 1e6 * t.wall},
          {"steps", t.steps},
          {"steps_per_s", 1 / t.wall},
          {"ns_per_point", per > 0 ? Json(1e9 * t.user / per) : Json(nullptr)},
          {"cpu_s_per_s", t.user / t.dt},
          {"touching", t.touching},
          {"pairs_per_s", t.touching / t.user}};
}

// Makes all blocks search for neighbours: contact detection at every step, as in other codes.
void loosen(const Model& m, State& s) {
  for (int b = 0; b < m.nblock; ++b) s.topology.loose[z(b)] = m.kind[z(b)] == Kind::moving;
}

// s to simulate of a structure that falls apart: its whole duration, or less if blocks times steps exceed the limit.
double span(const Model& m, const State& s) {
  constexpr double most = 1e7;
  return std::min(m.analysis.duration, most / m.nblock * s.time.dt);
}

// Measures the cost of one scene. Each way of running it takes about `seconds`.
Json measure(const std::string& path, const SceneOptions& options, double seconds) {
  Script script(script_options(options, true));
  script.load(path, options.overrides);
  Scene scene = script.take_scene();
  analysis::Prepared run = analysis::prepare(scene, true);
  const Model& m = run.model;
  start_at_rest(scene, run, 1);
  scene.blocks = std::vector<Block>();  // as a run does
  const bool mortared = m.njoint > 0 && m.laws[z(m.joint.front().type->law)].has_bond();
  if (!mortared && m.njoint > 0) loosen(m, run.state);
  const double points = m.npoint;
  // Memory of a run after its first step; measured before timing makes copies of the state.
  study::run_in(run.model, run.state, run.range, 1);
  const double memory = double(peak_memory_bytes());
  Json out{{"scene", fs::path(path).stem().string()},
           {"blocks", m.nblock},
           {"joints", m.njoint},
           {"points", m.npoint},
           {"dt_s", run.state.time.dt}};
  const auto timed = [&](int threads) {
    return mortared ? study::time_steps(m, run.state, run.range, "fast", threads, threads * seconds)
                    : study::time_course(m, run.state, run.range, threads, span(m, run.state));
  };
  const study::Timing one = timed(1);
  out["one_thread"] = to_json(one, points);
  const study::Timing two = timed(2);
  out["two_threads"] = to_json(two, points);
  out["same_bits_with_two_threads"] = one.hash == two.hash;
  out["two_threads_over_one"] = one.wall / two.wall;
  if (m.njoint > 0) {
    const study::Demand d = study::demand(m);
    const double bandwidth = study::triad(static_cast<size_t>(d.bytes)), peak = study::flop_peak();
    const double least = std::max(d.bytes / bandwidth, d.flop / peak);
    out["roofline"] = {{"bytes_per_point", d.bytes / points},         {"flop_per_point", d.flop / points},
                       {"triad_of_that_size_bytes_per_s", bandwidth}, {"flop_peak_per_s", peak},
                       {"least_ns_per_point", 1e9 * least / points},  {"share", least / one.user}};
    out["bytes_per_point"] = memory / points;
  }
  if (mortared && m.nblock < 5000) {
    const study::Timing reference = study::time_steps(m, run.state, run.range, "reference", 1, seconds);
    const State broken = study::all_broken(m, run.state);
    const study::Timing broken_fast = study::time_steps(m, broken, run.range, "fast", 1, seconds),
                        broken_reference = study::time_steps(m, broken, run.range, "reference", 1, seconds);
    out["reference"] = to_json(reference, points);
    out["broken"] = to_json(broken_fast, points);
    out["broken_reference"] = to_json(broken_reference, points);
    const double over = study::instructions_over_bare(m, run.state, run.range);
    if (over > 0) out["effects_off_instructions"] = over;
    out["intact_vs_reference"] = reference.user / one.user;
    out["broken_vs_reference"] = broken_reference.user / broken_fast.user;
  }
  return out;
}

struct BenchCase {
  const char* name;
  const char* scene;
  std::vector<std::string> defines;
};

const std::vector<BenchCase>& cases() {
  static const std::vector<BenchCase> all{{"house_951", "house_951.lua", {}},
                                          {"dry_wall_100", "dry_wall.lua", {"bricks=10", "courses=10"}},
                                          {"dry_wall_1012", "dry_wall.lua", {"bricks=40", "courses=25"}},
                                          {"dry_wall_10012", "dry_wall.lua", {"bricks=400", "courses=25"}},
                                          {"house_10000", "house_951.lua", {"x=12.39", "y=12.39", "courses=20"}},
                                          {"aqueduct", "aqueduct.lua", {}},
                                          {"pile", "pile.lua", {}}};
  return all;
}

std::string folder_of_scenes() {
  for (const char* place : {"scenes/bench", "../scenes/bench", "../../scenes/bench"})
    if (fs::is_directory(place)) return place;
  throw Error("the folder scenes/bench is not here; start erbs bench where the project lies, or name scenes: erbs bench SCENE.lua");
}

Json child(const BenchCase& item, const std::string& scenes, const std::string& directory) {
  const std::string file = directory + "/" + item.name + ".json", log = directory + "/" + item.name + ".log";
  std::vector<std::string> command{own_path(), "bench", scenes + "/" + item.scene, "-o", file, "--force", "-q"};
  for (const auto& define : item.defines) command.insert(command.end(), {"-D", define});
  const int code = wait_for(start(command, log));
  if (code == 0) return read_json(file).at(0);
  return {{"scene", item.name}, {"failed", last_words(log, code, item.scene)}};
}

int bench_scenes(const BenchCommand& command) {
  Json rows = Json::array();
  for (const auto& path : command.words) {
    if (!command.output.quiet)
      tell(
          stderr,
          path + ": timing kernel and reference with intact and with broken joints, on one and two threads; some minutes with many blocks");
    rows.push_back(measure(path, command.scene, 1.5));
    if (!command.output.quiet) print_bench_row(rows.back());
    std::fflush(stdout);
  }
  if (!command.output.directory.empty()) write_json(command.output.directory, rows);
  return exit_ok;
}

}  // namespace

int verb_bench(const BenchCommand& command) {
  if (!command.words.empty()) return bench_scenes(command);
  const std::string directory = command.output.directory.empty() ? "runs/bench" : command.output.directory, scenes = folder_of_scenes();
  if (fs::exists(directory + "/bench.json") && !command.output.force)
    throw Error(fmt::format("\"{}\" holds an earlier bench; overwrite it with --force, or choose another folder with -o DIR", directory));
  fs::create_directories(directory);
  Json rows = Json::object();
  for (const BenchCase& item : cases()) {
    rows[item.name] = child(item, scenes, directory);
    if (!command.output.quiet) print_bench_row(rows[item.name]);
  }
  const Json all = bench_summary(rows);
  write_json(directory + "/bench.json", all);
  print_bench_summary(all);
  write_bench_figure(rows, directory + "/bench.svg");
  if (!command.output.quiet) say("{}\n{}\n", directory + "/bench.json", directory + "/bench.svg");
  return exit_ok;
}

}  // namespace erbs::lua
