#include "engine/study/sweep/one_run.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "engine/record/format/json.h"

namespace erbs::study {
namespace {

namespace fs = std::filesystem;

std::string folder_of(const Sweep& sweep, const std::string& place) { return sweep.directory + "/runs/" + place; }
std::string log_of(const Sweep& sweep, const std::string& place) { return folder_of(sweep, place) + ".log"; }

std::string cell_of(const Json* value) {
  if (value == nullptr || value->is_null()) return "nan";
  if (value->is_boolean()) return value->get<bool>() ? "1" : "0";
  if (value->is_number_integer()) return fmt::format("{}", value->get<std::int64_t>());
  if (value->is_number()) return fmt::format("{}", value->get<double>());
  if (value->is_string()) return value->get<std::string>();
  return value->dump();
}

bool says(const std::string& log, const char* what) {
  std::ifstream stream(log);
  for (std::string line; std::getline(stream, line);)
    if (line.find(what) != std::string::npos) return true;
  return false;
}

// What programs say that find no room under a limit of memory: ours, the system at an allocation or a new thread, the loader of libraries
// (those of the program that waits here: they are there).
bool found_no_memory(const std::string& log) {
  constexpr const char* sayings[] = {"not enough memory", "MiB of memory", "Cannot allocate memory", "Resource temporarily unavailable",
                                     "while loading shared libraries"};
  return std::ranges::any_of(sayings, [&](const char* saying) { return says(log, saying); });
}

std::string bytes_text(double bytes) { return fmt::format("{:.3g} MB", 1e-6 * bytes); }

// Why a key has no value: what the run said of its metric, else what may be.
std::string why_absent(const Sweep& sweep, const std::string& key, const std::string& log) {
  if (!key.starts_with("metrics.")) return fmt::format("{} has no value in this run", key);
  const std::string name = key.substr(std::string("metrics.").size());
  const std::string words = sweep.plan.question.empty() || name != "study" ? fmt::format("metric \"{}\"", name) : sweep.plan.question;
  std::ifstream stream(log);
  for (std::string line; std::getline(stream, line);)
    if (line.find(words) != std::string::npos && line.find("has no value") != std::string::npos) return line;
  return fmt::format("{} has no value: its function gave nil, or no finite number", key);
}

// The verdict at the key; none if the run gives none, with a reason if that is a word.
std::string verdict_of(const Bisection& bisect, const Json& metrics, std::string& reason) {
  const Json* value = find_key(metrics, bisect.key);
  if (value != nullptr && value->is_boolean()) return value->get<bool>() ? "1" : "0";
  if (value != nullptr && value->is_number() && std::isfinite(value->get<double>())) {
    const double number = value->get<double>();
    return (bisect.above ? number > *bisect.above : number != 0) ? "1" : "0";
  }
  if (value != nullptr && value->is_string())
    reason = fmt::format("{} is the word \"{}\", and a verdict is a number, true or false", bisect.key, value->get<std::string>());
  return "nan";
}

// Why the run has no result by its end alone; "" if it has one.
void judge_end(const Sweep& sweep, const std::string& scene, const Finished& finished, const std::string& log, RunRow& row) {
  const std::string words = last_words(log, finished.code, scene);
  const double cap = sweep.plan.memory;
  if (finished.overdue) {
    row.status = "timeout";
    row.reason = fmt::format("took longer than max_wall = {:g} s and was ended", sweep.plan.max_wall);
  } else if (cap > 0 && finished.code != 0 && found_no_memory(log)) {
    row.status = "memory";
    row.reason = fmt::format("needs more than memory = {} and was ended at {}", bytes_text(cap), bytes_text(finished.memory));
  } else if (finished.code > 128) {
    row.status = "crash";
    row.reason = fmt::format("{}{}", words, finished.code == 128 + 9 ? ", by another program or for lack of memory" : "");
  } else if (finished.code == 2 || finished.code == 127) {
    row.status = "error";
    row.reason = words;
  }
}

const Variant* variant_of(const Sweep& sweep, const std::string& param, const Value& value) {
  return param == variant && !sweep.variants.empty() ? &sweep.variants.at(text_of(value)) : nullptr;
}

}  // namespace

std::string place_of(const Sweep& sweep, std::int64_t point, std::size_t run) {
  return sweep.plan.bisect ? fmt::format("{:06}_{:02}", point, run) : fmt::format("{:06}", point);
}

std::string scene_of(const Sweep& sweep, const Point& point) {
  for (const auto& [param, value] : point)
    if (const Variant* how = variant_of(sweep, param, value); how != nullptr && !how->scene.empty()) return how->scene;
  return sweep.scene;
}

Job job_of(const Sweep& sweep, const Point& point, double x, const std::string& place) {
  const std::string folder = folder_of(sweep, place);
  std::vector<std::string> command{own_path(),  "run", scene_of(sweep, point), "-o", folder, "--force", "--quiet",
                                   "--threads", "1",   "--no-figures"};
  for (const auto& [param, value] : point)
    if (const Variant* how = variant_of(sweep, param, value)) command.insert(command.end(), how->arguments.begin(), how->arguments.end());
    else if (param == perturbation)
      command.insert(command.end(), {"--noise", fmt::format("{}", sweep.plan.noise), "--noise-seed", expression_of(value)});
    else command.insert(command.end(), {"-D", param + "=" + expression_of(value)});
  if (sweep.plan.bisect) command.insert(command.end(), {"-D", fmt::format("{}={}", sweep.plan.bisect->param, x)});
  command.insert(command.end(), sweep.arguments.begin(), sweep.arguments.end());
  std::error_code ignored;
  fs::remove_all(folder, ignored);  // left by a run that was killed
  const std::string log = log_of(sweep, place);
  return {
      command, {.output = log, .errors = log, .own_group = true, .bound_hard = true, .memory = sweep.plan.memory}, 0, sweep.plan.max_wall};
}

RunRow read_run(const Sweep& sweep, const Point& point, double x, const std::string& place, const Finished& finished) {
  const std::string scene = scene_of(sweep, point);
  const std::string file = folder_of(sweep, place) + "/metrics.json", log = log_of(sweep, place);
  RunRow row;
  row.x = x, row.wall = finished.wall, row.cpu = finished.cpu, row.memory = finished.memory;
  row.verdict = "nan";
  row.values.assign(sweep.plan.collect.size(), "nan");
  judge_end(sweep, scene, finished, log, row);
  if (!row.status.empty()) return row;
  try {
    if (!fs::exists(file)) {
      row.status = "error";
      row.reason = finished.code == 0 ? fmt::format("it ended well, but {} is not there: another program has removed it", file)
                                      : last_words(log, finished.code, scene);
      return row;
    }
    const Json metrics = read_json(file);
    row.status = metrics.value("status", "");
    if (row.status == "diverged" && sweep.plan.bisect && sweep.plan.bisect->stability) {
      std::string none;
      if (verdict_of(*sweep.plan.bisect, metrics, none) == "1") row.verdict = "1";
    }
    if (row.status != "completed") row.reason = last_words(log, finished.code, scene);
    const bool shown = row.status == "inaccurate" && !sweep.variants.empty();  // settings are compared by what they gave
    if (row.status != "completed" && row.verdict != "1" && !shown) return row;
    std::string absent;
    for (std::size_t k = 0; k < row.values.size(); ++k) {
      const std::string& key = sweep.plan.collect[k];
      row.values[k] = cell_of(find_key(metrics, key));
      // A time of collapse may well be absent; a metric of the scene has lost its number.
      // Variants may run scenes that have it not.
      if (row.values[k] == "nan" && key.starts_with("metrics.") && absent.empty() && sweep.variants.empty())
        absent = why_absent(sweep, key, log);
    }
    if (row.status != "completed") return row;
    if (sweep.plan.bisect) {
      row.verdict = verdict_of(*sweep.plan.bisect, metrics, row.reason);
      if (row.verdict == "nan" && row.reason.empty()) row.reason = why_absent(sweep, sweep.plan.bisect->key, log);
    }
    if (!row.reason.empty()) row.status = "error";
    else row.reason = absent;
  } catch (const std::exception& trouble) { row.status = "error", row.reason = trouble.what(); }
  return row;
}

void tidy(const Sweep& sweep, const RunRow& row, const std::string& place) {
  if (sweep.plan.keep == "all") return;
  const std::string folder = folder_of(sweep, place);
  std::error_code ignored;
  if (sweep.plan.keep == "metrics") fs::rename(folder + "/metrics.json", folder + ".json", ignored);
  fs::remove_all(folder, ignored);
  if (row.answered() || sweep.plan.keep == "none") fs::remove(log_of(sweep, place), ignored);
}

}  // namespace erbs::study
