#include "engine/study/fragility/observations.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "engine/base/units.h"
#include "engine/record/format/csv.h"

namespace erbs::study {
namespace {

double number_of(const std::string& cell) {
  double value = std::nan("");
  std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return value;
}

// Places of the columns of runs.csv.
struct Columns {
  std::size_t im = 0, collapse = 0, status = 0;
  std::vector<std::size_t> damage, by, of_case, fall;
  std::optional<std::size_t> moving;  // none where the study does not ask for it
};

Columns columns_of(const Sweep& sweep) {
  const Plan& plan = sweep.plan;
  const FragilityPlan& wanted = *plan.fragility;
  const std::vector<std::string> params = varied_params(plan);
  const std::size_t bisected = 1 + params.size(), first_key = bisected + (sweep.bisected.empty() ? 0 : 2);
  const auto place_of = [&](const std::string& name) {
    if (const auto at = std::find(params.begin(), params.end(), name); at != params.end()) return 1 + std::size_t(at - params.begin());
    if (plan.bisect && plan.bisect->param == name) return bisected;
    if (name == "verdict") return bisected + 1;
    return first_key + std::size_t(std::find(plan.collect.begin(), plan.collect.end(), name) - plan.collect.begin());
  };
  Columns out;
  out.im = place_of(wanted.im), out.collapse = place_of(wanted.collapse), out.status = first_key + plan.collect.size();
  for (const std::string& key : wanted.damage) out.damage.push_back(place_of(key));
  for (const std::string& name : wanted.by) out.by.push_back(place_of(name));
  if (std::find(plan.collect.begin(), plan.collect.end(), moving_key) != plan.collect.end()) out.moving = place_of(moving_key);
  if (wanted.falls)
    for (const char* key : fall_keys) out.fall.push_back(place_of(key));
  for (const std::string& name : params)
    if (name != wanted.along && std::find(wanted.by.begin(), wanted.by.end(), name) == wanted.by.end())
      out.of_case.push_back(place_of(name));
  return out;
}

std::string joined(const std::vector<std::string>& cells, const std::vector<std::size_t>& which) {
  std::string out;
  for (const std::size_t i : which) out += (out.empty() ? "" : ", ") + cells[i];
  return out;
}

// Damage of a case at an intensity: linear from zero through its runs, of several at one intensity the worst. None beyond the last run of
// a standing case.
double damage_at(const Case& one, std::size_t k, double im) {
  double x0 = 0, y0 = 0;
  for (std::size_t i = 0; i < one.runs.size(); ++i) {
    const Run& run = one.runs[i];
    const auto damage = [&](std::size_t at) { return one.runs[at].collapsed ? infinite : one.runs[at].damage[k]; };
    double y = damage(i);
    for (; i + 1 < one.runs.size() && one.runs[i + 1].im == run.im; ++i) y = std::fmax(y, damage(i + 1));
    if (im <= run.im) {
      if (im == run.im || std::isnan(y)) return y;
      return std::isinf(y) ? infinite : y0 + (y - y0) * (im - x0) / (run.im - x0);
    }
    if (std::isinf(y)) return infinite;
    x0 = run.im, y0 = y;
  }
  return std::nan("");
}

// Which count of the group a run belongs to that has no part in a fit; none if it has one.
int* reason_to_leave(Group& group, bool completed, double im, double collapse, bool above) {
  if (im == 0) return &group.unshaken;
  if (!completed) return &group.left_out;
  if (std::isnan(collapse)) return &group.untold;
  if (std::isnan(im)) return &group.wordy;
  if (im < 0) return &group.negative;
  if (!above && collapse != 0 && collapse != 1) return &group.unclear;
  return nullptr;
}

}  // namespace

Interval Case::capacity() const {
  Interval out;
  if (const auto first = std::find_if(runs.begin(), runs.end(), [](const Run& run) { return run.collapsed; }); first != runs.end())
    out.hi = first->im;
  for (const Run& run : runs)
    if (!run.collapsed && run.im < out.hi) out.lo = std::max(out.lo, run.im);
  return out;
}

std::vector<Interval> Group::single_runs() const {
  std::vector<Interval> out;
  for (const Case& one : cases)
    for (const Run& run : one.runs) out.push_back(run.collapsed ? Interval{0, run.im} : Interval{run.im, infinite});
  return out;
}

std::vector<Interval> Group::capacities() const {
  std::vector<Interval> out;
  for (const Case& one : cases) out.push_back(one.capacity());
  return out;
}

bool Group::incremental() const {
  return std::any_of(cases.begin(), cases.end(), [](const Case& one) { return one.runs.size() > 1; });
}

std::vector<Group> read_groups(const Sweep& sweep) {
  const FragilityPlan& wanted = *sweep.plan.fragility;
  const Columns at = columns_of(sweep);
  // By group, case, and what orders the runs of a case: intensity, verdict and number. An intensity out of metrics.json may come twice.
  std::map<std::string, std::map<std::string, std::map<std::tuple<double, bool, double>, Run>>> sorted;
  std::map<std::string, Group> counts;
  std::ifstream file(sweep.directory + "/" + runs_file);
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    const std::vector<std::string> cells = csv_cells(line);
    if (cells.size() <= at.status) continue;
    std::string group;
    for (std::size_t k = 0; k < at.by.size(); ++k) group += (k == 0 ? "" : ", ") + wanted.by[k] + " " + cells[at.by[k]];
    std::string name = joined(cells, at.of_case);
    if (wanted.along.empty() && !sweep.plan.bisect) name += (name.empty() ? "run " : ", run ") + cells.front();
    const double im = number_of(cells[at.im]), collapse = number_of(cells[at.collapse]);
    auto& cases = sorted[group];
    if (int* const reason = reason_to_leave(counts[group], cells[at.status] == "completed", im, collapse, wanted.above.has_value())) {
      ++*reason;
      continue;
    }
    Run run{im, wanted.above ? collapse > *wanted.above : collapse != 0, {}};
    for (const std::size_t i : at.damage) run.damage.push_back(number_of(cells[i]));
    if (at.moving && !run.collapsed && number_of(cells[*at.moving]) > 0) ++counts[group].restless;
    if (wanted.falls && run.collapsed)
      run.time = number_of(cells[at.fall[0]]), run.direction = {number_of(cells[at.fall[1]]), number_of(cells[at.fall[2]])};
    const std::tuple<double, bool, double> place{im, run.collapsed, number_of(cells.front())};
    cases[name].emplace(place, std::move(run));
  }
  std::vector<Group> out;
  for (auto& [name, cases] : sorted) {
    Group group = counts[name];
    group.name = name;
    for (auto& [of_case, runs] : cases) {
      group.cases.push_back({of_case, {}});
      for (auto& [place, run] : runs) group.cases.back().runs.push_back(std::move(run));
    }
    out.push_back(std::move(group));
  }
  return out;
}

std::vector<double> levels_of(const Group& group) {
  std::set<double> all;
  for (const Case& one : group.cases)
    for (const Run& run : one.runs) all.insert(run.im);
  return {all.begin(), all.end()};
}

double fractile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const double place = share * double(values.size() - 1);
  const auto below = std::size_t(place), above = std::min(below + 1, values.size() - 1);
  if (values[below] == values[above] || place == double(below)) return values[below];
  return values[below] + (place - double(below)) * (values[above] - values[below]);
}

std::vector<Fractiles> fractiles_of(const Group& group, std::size_t damage) {
  std::vector<double> at = levels_of(group);
  constexpr std::size_t most = 40;  // beyond it the cases have intensities of their own
  if (at.size() > most) {
    const double low = at.front(), high = at.back();
    at.clear();
    for (std::size_t i = 0; i < most; ++i) at.push_back(low + (high - low) * double(i) / double(most - 1));
  }
  std::vector<Fractiles> out;
  for (const double im : at) {
    std::vector<double> values;
    for (const Case& one : group.cases)
      if (const double value = damage_at(one, damage, im); !std::isnan(value)) values.push_back(value);
    if (!values.empty()) out.push_back({im, int(values.size()), fractile(values, 0.16), fractile(values, 0.5), fractile(values, 0.84)});
  }
  return out;
}

}  // namespace erbs::study
