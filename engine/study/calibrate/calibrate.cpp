#include "engine/study/calibrate/calibrate.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>

#include "engine/study/bracket.h"
#include "engine/study/calibrate/least_squares.h"
#include "engine/study/calibrate/run_table.h"
#include "engine/study/pool.h"
#include "engine/study/sweep/one_run.h"

namespace erbs::study {
namespace {

namespace fs = std::filesystem;

struct Interrupted {};

using Values = std::map<std::string, double>;  // of the params that have been fitted so far, and of the stage under way

class Calibrator {
 public:
  Calibrator(const Sweep& sweep, bool resume)
      : s_(sweep),
        c_(*sweep.plan.calibration),
        keys_(sweep.plan.collect),
        table_(s_.directory + "/" + calibration_table, columns(), resume) {
    take_earlier();
  }

  Calibrated run() {
    try {
      for (const CalibrationStage& stage : c_.stages) {
        ++stage_;
        if (stage.key.empty()) fit(stage);
        else raise(stage);
      }
      finish();
    } catch (const Interrupted&) { out_.interrupted = true; }
    return std::move(out_);
  }

 private:
  struct Row {
    std::vector<double> got;  // of keys_
    bool sound = false;
    std::string reason;
  };

  std::vector<std::string> columns() const {
    std::vector<std::string> names{"run", "stage"};
    names.insert(names.end(), s_.params.begin(), s_.params.end());
    names.insert(names.end(), s_.collected.begin(), s_.collected.end());
    names.insert(names.end(), {"sum_of_squares", "status", "reason"});
    return names;
  }

  static double number_in(const std::string& cell) {
    char* end = nullptr;
    const double value = std::strtod(cell.c_str(), &end);
    return end != cell.c_str() && *end == 0 && std::isfinite(value) ? value : NAN;
  }

  // Reads the runs of an earlier table. The fit goes the same way again, and so it finds them where it asks for them.
  void take_earlier() {
    const std::vector<std::string> params = varied_params(s_.plan);
    for (const auto& [run, cells] : table_.rows()) {
      Values values;
      for (std::size_t k = 0; k < params.size(); ++k)
        if (const double value = number_in(table_.cell(cells, s_.params[k])); std::isfinite(value)) values[params[k]] = value;
      Row row;
      for (const std::string& name : s_.collected) row.got.push_back(number_in(table_.cell(cells, name)));
      row.reason = table_.cell(cells, "reason");
      row.sound = table_.cell(cells, "status") == "completed" && row.reason.empty();
      earlier_[values] = std::move(row);
    }
  }

  // Of `all` those that have no answer yet, each once.
  std::vector<Values> unknown(const std::vector<Values>& all, bool anew) const {
    std::vector<Values> out;
    for (const Values& values : all)
      if ((anew || !known_.contains(values)) && std::find(out.begin(), out.end(), values) == out.end()) out.push_back(values);
    return out;
  }

  // Runs the scene with each of the values, side by side. A run that was made before is not repeated. With a `name` it is made in any
  // case, and its folder stays.
  std::vector<Row> evaluate(const std::vector<Values>& all, const std::string& name = "") {
    const std::vector<Values> asked = unknown(all, !name.empty());
    const int before = out_.runs;  // numbers tell the order in which runs were asked for, whichever ends first
    std::vector<std::optional<Row>> rows(asked.size());
    std::vector<std::size_t> waiting;
    for (std::size_t i = 0; i < asked.size(); ++i)
      if (const auto found = earlier_.find(asked[i]); name.empty() && found != earlier_.end()) rows[i] = found->second;
      else waiting.push_back(i);
    const auto place = [&](std::size_t i) { return name.empty() ? fmt::format("r{:04}", before + int(i) + 1) : name; };
    Pool pool(s_.at_once);
    std::size_t next = 0;
    while (!pool.empty() || (next < waiting.size() && !interrupted())) {
      for (; next < waiting.size() && !pool.full() && !interrupted(); ++next) {
        Point point;
        for (const auto& [param, value] : asked[waiting[next]]) point.emplace_back(param, value);
        fs::create_directories(s_.directory + "/runs");
        pool.add(waiting[next], job_of(s_, point, 0, place(waiting[next])));
      }
      if (interrupted()) pool.interrupt_all();
      const auto ended = pool.wait(0.5);
      if (!ended || interrupted()) continue;
      const std::size_t i = ended->id;
      const RunRow run = read_run(s_, {}, 0, place(i), *ended);
      rows[i] = note(asked[i], run, before + int(i) + 1);
      if (name.empty()) tidy(s_, run, place(i));
    }
    return collect(all, asked, std::move(rows));
  }

  // Counts the runs of a batch in their order, and answers for all of it.
  std::vector<Row> collect(const std::vector<Values>& all, const std::vector<Values>& asked, std::vector<std::optional<Row>> rows) {
    for (std::size_t i = 0; i < asked.size(); ++i)
      if (rows[i]) count(*rows[i]), known_[asked[i]] = std::move(*rows[i]);
    if (interrupted()) throw Interrupted{};
    table_.sort();
    if (s_.progress) s_.progress({.points = 0, .done = out_.runs, .failed = out_.discarded, .runs = out_.runs});
    std::vector<Row> answers;
    for (const Values& values : all) answers.push_back(known_.at(values));
    return answers;
  }

  bool interrupted() const { return s_.interrupted != nullptr && s_.interrupted->load(); }

  Row note(const Values& values, const RunRow& run, int number) {
    Row row;
    row.sound = run.answered();
    row.reason = run.reason.empty() ? run.status : run.status + ": " + run.reason;
    for (const std::string& cell : run.values) {
      row.got.push_back(number_in(cell));
      if (std::isnan(row.got.back()) && row.sound)
        row.sound = false, row.reason = fmt::format("{} has no number in this run", keys_[row.got.size() - 1]);
    }
    std::vector<std::string> cells{fmt::format("{}", stage_)};
    for (const std::string& param : varied_params(s_.plan))
      cells.push_back(values.contains(param) ? fmt::format("{}", values.at(param)) : "nan");
    for (const double x : row.got) cells.push_back(fmt::format("{}", x));
    cells.push_back(row.sound ? fmt::format("{:.6g}", sum_of_squares(residuals(row))) : "nan");
    cells.insert(cells.end(), {run.status, row.sound ? "" : row.reason});
    table_.add(number, std::move(cells));
    return row;
  }

  void count(const Row& row) {
    ++out_.runs;
    if (row.sound) return;
    ++out_.discarded;
    if (out_.first_discarded.empty()) out_.first_discarded = fmt::format("run {}: {}", out_.runs, row.reason);
  }

  double got(const Row& row, const std::string& key) const {
    return row.got[std::size_t(std::find(keys_.begin(), keys_.end(), key) - keys_.begin())];
  }

  std::vector<double> residuals(const Row& row) const {
    std::vector<double> out;
    for (const CalibrationTarget& target : c_.targets)
      for (std::size_t i = 0; i < target.keys.size(); ++i) out.push_back((got(row, target.keys[i]) - target.values[i]) / target.scale);
    return out;
  }

  Values with(const CalibrationStage& stage, const Shares& shares) const {
    Values values = fitted_;
    for (std::size_t k = 0; k < stage.params.size(); ++k) values[stage.params[k].param] = in_range(stage.params[k], shares[k]);
    return values;
  }

  void fit(const CalibrationStage& stage) {
    std::string first_reason;
    const EvaluateAll all = [&](const std::vector<Shares>& points) {
      std::vector<Values> values;
      for (const Shares& shares : points) values.push_back(with(stage, shares));
      std::vector<Residuals> out;
      for (const Row& row : evaluate(values)) {
        out.push_back(row.sound ? Residuals(residuals(row)) : std::nullopt);
        if (!row.sound && first_reason.empty()) first_reason = row.reason;
      }
      return out;
    };
    const Minimum minimum = least_squares(stage.params.size(), all, {c_.rel, c_.rounds});
    if (!minimum.found)
      throw Error(fmt::format("stage {}: no run gives all targets; the first says: {}", stage_, first_reason), s_.plan.place);
    FittedStage done;
    fitted_ = with(stage, minimum.best);
    for (std::size_t k = 0; k < stage.params.size(); ++k) {
      const Range& range = stage.params[k];
      const double value = fitted_.at(range.param), width = range.log ? value * std::log(range.hi / range.lo) : range.hi - range.lo;
      done.params.push_back({range.param, value, width * minimum.deviation[k], minimum.best[k] <= 0 || minimum.best[k] >= 1});
    }
    done.rms = std::sqrt(minimum.sum / double(minimum.residuals.size()));
    done.converged = minimum.converged;
    out_.stages.push_back(done);
  }

  // The least value of the param at which the key is below its number: multisection of the range.
  void raise(const CalibrationStage& stage) {
    std::vector<double> seen;
    const auto answers = [&](const std::vector<double>& shares) {
      std::vector<Values> values;
      for (const double share : shares) values.push_back(with(stage, {share - 1}));
      std::vector<Answer> out;
      for (const Row& row : evaluate(values)) {
        Answer answer{shares[out.size()], {}, row.reason};
        if (const double value = got(row, stage.key); row.sound && std::isfinite(value)) answer.value = value < stage.below ? 1 : 0;
        out.push_back(answer);
      }
      return out;
    };
    // Shares, shifted by one, since the width of a bracket is relative to its larger end, which is 2 at most.
    Bracket bracket(1, 2, 0.5 * (c_.rel_given ? c_.rel : 0.02), 2);
    double share = 1;
    const std::vector<Answer> ends = answers({1, 2});
    if (!(ends[0].value && *ends[0].value == 1)) {
      bracket.take(ends);
      for (std::vector<double> next = bracket.next(); !next.empty(); next = bracket.next()) bracket.take(answers(next));
      if (!bracket.found()) {
        const bool stays = ends[0].value && ends[1].value && *ends[1].value == 0;
        throw Error(
            fmt::format("stage {}: {} {}; {}", stage_, stage.key,
                        stays ? fmt::format("stays above {:g} up to {} = {:g}", stage.below, stage.params[0].param, stage.params[0].hi)
                              : bracket.trouble(),
                        stays ? "raise the upper end of its range, or the number" : "see " + std::string(calibration_table)),
            s_.plan.place);
      }
      share = bracket.hi();
    }
    fitted_ = with(stage, {share - 1});
    const Row& row = known_.at(fitted_);
    FittedStage done;
    done.raised = done.converged = true;
    done.params.push_back({stage.params[0].param, fitted_.at(stage.params[0].param), 0, share <= 1});
    if (share > 1) done.bracket = {in_range(stage.params[0], bracket.lo() - 1), done.params[0].value};
    done.key_value = got(row, stage.key);
    done.rms = std::sqrt(sum_of_squares(residuals(row)) / double(std::max<std::size_t>(1, residuals(row).size())));
    out_.stages.push_back(done);
  }

  // The run with the fitted params and the one of the scene as it is written stay, with their histories.
  void finish() {
    stage_ = 0;
    const auto of = [&](const Values& values, const char* name, std::vector<double>& targets, double& rms) {
      const Row row = evaluate({values}, name).front();
      for (const CalibrationTarget& target : c_.targets)
        for (const std::string& key : target.keys) targets.push_back(got(row, key));
      rms = std::sqrt(sum_of_squares(residuals(row)) / double(targets.size()));
    };
    of({}, first_run, out_.got_before, out_.rms_before);
    of(fitted_, best_run, out_.got, out_.rms);
    out_.values.assign(fitted_.begin(), fitted_.end());
  }

  const Sweep& s_;
  const Calibration& c_;
  const std::vector<std::string>& keys_;
  RunTable table_;
  std::map<Values, Row> known_, earlier_;  // asked for by now; in the table of a calibration that was cut off
  Values fitted_;
  Calibrated out_;
  int stage_ = 0;
};

}  // namespace

Calibrated calibrate(const Sweep& sweep, bool resume) { return Calibrator(sweep, resume).run(); }

std::vector<std::string> calibrated_keys(const Calibration& calibration) {
  std::vector<std::string> keys;
  const auto add = [&](const std::string& key) {
    if (!key.empty() && std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
  };
  for (const CalibrationTarget& target : calibration.targets)
    for (const std::string& key : target.keys) add(key);
  for (const CalibrationStage& stage : calibration.stages) add(stage.key);
  return keys;
}

}  // namespace erbs::study
