#include "engine/study/children.h"

#include <filesystem>

#include "engine/base/hash.h"
#include "engine/base/system/process.h"
#include "engine/record/folder/manifest.h"
#include "engine/record/folder/run_folder.h"
#include "engine/record/format/csv.h"
#include "engine/record/format/json.h"
#include "engine/study/machine.h"
#include "engine/study/pool.h"

namespace erbs::study {
namespace {

namespace fs = std::filesystem;

struct Interrupted {};

class Runner {
 public:
  Runner(const Study& study, const Children& c) : study_(study), c_(c), folder_(run_file(c.directory, "studies/" + study.name)) {
    fs::create_directories(folder_);
  }

  std::vector<Answer> run(const std::vector<double>& xs) {
    std::vector<Answer> answers(xs.size());
    std::vector<std::size_t> waiting;
    for (std::size_t i = 0; i < xs.size(); ++i) {
      answers[i].x = xs[i];
      if (!finished(answers[i])) waiting.push_back(i);
    }
    Pool pool(c_.at_once);
    memory_ = machine_memory() / double(pool.size());
    std::size_t next = 0;
    while (!pool.empty() || (next < waiting.size() && !interrupted())) {
      for (; next < waiting.size() && !pool.full() && !interrupted(); ++next) pool.add(waiting[next], job(xs[waiting[next]]));
      if (interrupted()) pool.interrupt_all();
      const auto ended = pool.wait(1.0);
      if (!ended) continue;
      read(answers[ended->id], ended->code, ended->overdue);
      failed_ += !answers[ended->id].value;
      if (c_.progress) c_.progress({study_.name, ++done_, asked_ + int(waiting.size()), failed_, seconds_since_begin()});
    }
    if (interrupted()) throw Interrupted{};
    asked_ += int(waiting.size());
    rows_.insert(rows_.end(), answers.begin(), answers.end());
    write_table();
    return answers;
  }

  double updates() const {
    double sum = 0;
    for (const Answer& a : rows_) sum += a.updates;
    return sum;
  }

 private:
  double seconds_since_begin() const { return wall_seconds() - begin_; }
  bool interrupted() const { return c_.interrupted != nullptr && c_.interrupted->load(); }
  std::string folder_of(double x) const { return run_file(folder_, fmt::format("{}={}", study_.param, x)); }
  std::string file_of(double x) const { return folder_of(x) + ".json"; }
  std::string log_of(double x) const { return folder_of(x) + ".log"; }

  Job job(double x) {
    std::vector<std::string> command{own_path(), "run",       c_.scene, "-o",      folder_of(x), "--force",
                                     "--quiet",  "--threads", "1",      "--study", study_.name,  "--no-figures"};
    for (const auto& [name, value] : c_.overrides)
      if (name != study_.param) command.insert(command.end(), {"-D", name + "=" + value});
    command.insert(command.end(), {"-D", fmt::format("{}={}", study_.param, x)});
    for (const auto* more : {&c_.words, &c_.permissions}) command.insert(command.end(), more->begin(), more->end());
    if (c_.max_wall > 0) command.insert(command.end(), {"--max-wall", fmt::format("{}s", c_.max_wall)});
    std::error_code ignored;
    fs::remove_all(folder_of(x), ignored);  // left by an interrupted run
    // A run stops itself at its time limit, with its results so far. A run that does not stop is killed.
    const Launch how{.output = log_of(x), .errors = log_of(x), .own_group = true, .bound_hard = true, .memory = memory_};
    return {command, how, 0, c_.max_wall > 0 ? c_.max_wall + 15 : 0};
  }

  // Reads the answer of the child, or the reason for its absence, and writes a note of it. A child that is interrupted, or killed from
  // outside, leaves no note.
  void read(Answer& a, int code, bool overdue) const {
    if (code == 130) {
      a.reason = "interrupted";
      return;
    }
    if (overdue) code = 128 + 9;
    try {
      const std::string file = run_file(folder_of(a.x), "metrics.json");
      const Json metrics = fs::exists(file) ? read_json(file) : Json::object();
      if (const Json* wall = find_key(metrics, "wall_s.total"); wall != nullptr && wall->is_number()) a.wall_s = wall->get<double>();
      if (const Json* updates = find_key(metrics, "point_updates"); updates != nullptr && updates->is_number())
        a.updates = updates->get<double>();
      const std::string status = metrics.value("status", "");
      const Json* value = find_key(metrics, study_.collapse ? "collapse.collapsed" : "metrics.study");
      if (overdue) a.reason = fmt::format("took longer than {:g} s and was ended", c_.max_wall);
      // A bisection for a limit of stability looks for divergence: the scene's own function may answer yes to such a run, never no.
      else if (status == "diverged" && study_.kind == Study::Kind::bisect && !study_.collapse && value != nullptr &&
               (*value == true || *value == 1))
        a.value = 1;
      else if (status == "diverged" || status == "inaccurate" || status == "stopped")
        a.reason = status + "; " + last_words(log_of(a.x), code, c_.scene);
      else if (code != 0 || value == nullptr) a.reason = last_words(log_of(a.x), code, c_.scene);
      else if (value->is_boolean()) a.value = value->get<bool>() ? 1 : 0;
      else if (value->is_number() && std::isfinite(value->get<double>())) a.value = value->get<double>();
      else a.reason = "its answer is no finite number";
    } catch (const std::exception& trouble) { a.reason = trouble.what(); }
    Json note{{"key", key()}, {"x", a.x}, {"reason", a.reason}, {"wall_s", a.wall_s}, {"updates", a.updates}};
    note["value"] = a.value ? Json(*a.value) : Json(nullptr);
    if (overdue || !was_killed(code)) write_json(file_of(a.x), note);
  }

  bool finished(Answer& a) const {
    try {
      if (!fs::exists(file_of(a.x))) return false;
      const Json note = read_json(file_of(a.x));
      if (note.value("key", "") != key()) return false;
      if (note["value"].is_number()) a.value = note["value"].get<double>();
      a.reason = note.value("reason", "");
      a.wall_s = note.value("wall_s", 0.0);
      a.updates = note.value("updates", 0.0);
      return true;
    } catch (const std::exception&) { return false; }
  }

  std::string key() const {
    std::string text = c_.key + program_version();
    for (const auto& [name, value] : c_.overrides)
      if (name != study_.param) text += "\n" + name + "=" + value;
    for (const auto& word : c_.words) text += "\n" + word;
    return hash_text(text);
  }

  void write_table() const {
    CsvWriter table(folder_ + ".csv", {study_.param, "answer", "reason", "wall_s"});
    for (const Answer& a : rows_)
      table.text_row({fmt::format("{}", a.x), a.value ? fmt::format("{}", *a.value) : "nan", a.reason, fmt::format("{:.3f}", a.wall_s)});
    table.flush();
  }

  const Study& study_;
  const Children& c_;
  std::string folder_;
  std::vector<Answer> rows_;
  int done_ = 0, asked_ = 0, failed_ = 0;
  double memory_ = 0;  // bytes, most of a run
  double begin_ = wall_seconds();
};

}  // namespace

Carried carry_out(const Study& study, const Children& children) {
  Runner runner(study, children);
  try {
    Carried carried{carry_out(study, [&](const std::vector<double>& xs) { return runner.run(xs); }), false};
    carried.result.updates = runner.updates();
    return carried;
  } catch (const Interrupted&) { return {{}, true}; }
}

}  // namespace erbs::study
