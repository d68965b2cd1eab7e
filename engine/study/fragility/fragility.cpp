#include "engine/study/fragility/fragility.h"

#include <algorithm>
#include <cmath>

#include "engine/base/text.h"
#include "engine/base/units.h"
#include "engine/record/format/csv.h"
#include "engine/record/format/json.h"
#include "engine/record/plot/unit.h"
#include "engine/study/fragility/falls.h"

namespace erbs::study {
namespace {

std::string cell(double x) { return fmt::format("{}", x); }

std::string to_text(FitEnd end) {
  constexpr const char* names[] = {"fitted", "empty", "no collapse", "all collapse", "separated", "one level", "falling"};
  return names[std::size_t(end)];
}

Fragility fragility_of(const Group& group, const std::string& method, const FragilityPlan& plan, const ShownIntensity& im) {
  Fragility out{group.name, method, fit_fragility(method == "runs" ? group.single_runs() : group.capacities()), {}};
  out.words = words(out.fit, im.unit, im.factor);
  const auto say = [&](const std::string& what) { out.words += (out.words.empty() ? "" : "; ") + what; };
  const auto leave_out = [&](int n, const std::string& why) {
    if (n > 0) say(fmt::format("{} left out: {}", counted(n, "run"), why));
  };
  leave_out(group.left_out, "no answer, see the reasons in runs.csv");
  leave_out(group.untold,
            fmt::format("{} has no number there; name a key that is 1 or 0, or a number to lay above against", plan.collapse));
  leave_out(group.unshaken, "at intensity 0, where any fit is 0");
  leave_out(group.negative, fmt::format("{} is below 0, and an intensity lies above", plan.im));
  leave_out(group.wordy, fmt::format("{} is no number; take an im that is one", plan.im));
  leave_out(group.unclear, fmt::format("{} is neither 1 nor 0; give above, the number from which on it is a collapse", plan.collapse));
  if (group.restless > 0)
    say(fmt::format("{} counted as standing still moved at the end, and may fall later: try a longer duration",
                    counted(group.restless, "run")));
  if (method == "runs" && group.incremental()) say("runs of one case are not independent, so that the bands are too narrow");
  if (method == "capacities" && out.fit.end == FitEnd::fitted && out.fit.observations < 20)
    say(fmt::format("{} cases are few: bands of 95 % hold some 91 %", out.fit.observations));
  return out;
}

// A number that is not known is an empty cell, and the words say why.
std::vector<std::string> row_of(const Fragility& one) {
  const Fit& f = one.fit;
  std::vector<std::string> row{one.group, one.method, std::to_string(f.observations), std::to_string(f.collapsed), to_text(f.end)};
  const bool fitted = f.end == FitEnd::fitted;
  const auto add = [&](bool known, double x) { row.push_back(known && std::isfinite(x) ? cell(x) : ""); };
  const bool bounds = fitted || f.end == FitEnd::none || f.end == FitEnd::all || f.end == FitEnd::separated;
  add(fitted, f.theta);
  add(bounds && f.theta_lo > 0, f.theta_lo);
  add(bounds, f.theta_hi);
  for (const double x : {f.beta, f.beta_lo, f.beta_hi, f.theta * std::exp(-f.beta), f.theta * std::exp(f.beta), f.log_likelihood})
    add(fitted, x);
  row.push_back(one.words);
  return row;
}

void write_table(const std::string& path, const std::vector<std::string>& names, const std::vector<std::vector<std::string>>& rows) {
  std::string text = csv_line(names);
  for (const auto& row : rows) text += csv_line(row);
  write_text_atomically(path, text);
}

void write_stripes(const Sweep& sweep, const std::vector<Group>& groups) {
  std::vector<std::vector<std::string>> rows;
  for (const Group& group : groups)
    for (const double im : levels_of(group)) {
      int runs = 0, collapsed = 0;
      for (const Case& one : group.cases)
        for (const Run& run : one.runs)
          if (run.im == im) ++runs, collapsed += run.collapsed ? 1 : 0;
      rows.push_back({group.name, cell(im), std::to_string(runs), std::to_string(collapsed), cell(double(collapsed) / runs)});
    }
  write_table(sweep.directory + "/stripes.csv", {"group", unit_of_im(sweep), "runs", "collapsed", "fraction"}, rows);
}

void write_fractiles(const Sweep& sweep, const std::vector<Group>& groups) {
  const std::vector<std::string>& damage = sweep.plan.fragility->damage;
  std::vector<std::vector<std::string>> rows;
  for (const Group& group : groups)
    for (std::size_t k = 0; k < damage.size(); ++k)
      for (const Fractiles& f : fractiles_of(group, k)) {
        std::vector<std::string> row{group.name, damage[k], cell(f.im), std::to_string(f.cases)};
        for (const double p : {f.p16, f.p50, f.p84}) row.push_back(std::isfinite(p) ? cell(p) : "collapse");
        rows.push_back(std::move(row));
      }
  if (!damage.empty())
    write_table(sweep.directory + "/fractiles.csv", {"group", "damage", unit_of_im(sweep), "cases", "p16", "p50", "p84"}, rows);
}

}  // namespace

std::string ShownIntensity::label() const { return unit.empty() ? words : fmt::format("{} [{}]", words, unit); }

std::string ShownIntensity::number(double im) const { return fmt::format("{:.3g}{}{}", factor * im, unit.empty() ? "" : " ", unit); }

ShownIntensity shown_intensity(const Sweep& sweep) {
  const std::string column = unit_of_im(sweep);
  if (plot::unit_of(column) == "m_s2") return {1 / standard_g, plot::words_of(column), "g"};
  return {1, plot::words_of(column), plot::unit_name(column)};
}

std::string unit_of_im(const Sweep& sweep) {
  const std::string& im = sweep.plan.fragility->im;
  if (sweep.plan.bisect && sweep.plan.bisect->param == im) return sweep.bisected;
  const std::vector<std::string> params = varied_params(sweep.plan);
  if (const auto at = std::find(params.begin(), params.end(), im); at != params.end())
    return sweep.params[std::size_t(at - params.begin())];
  const auto& keys = sweep.plan.collect;
  if (const auto at = std::find(keys.begin(), keys.end(), im); at != keys.end()) return sweep.collected[std::size_t(at - keys.begin())];
  return im;
}

// Twins of one record or draw fall at nearly the same intensity: they tell of chaos, not of other records.
std::string twins_of(const Sweep& sweep, const Group& group) {
  std::size_t twins = 1;
  for (const Axis& axis : sweep.plan.axes)
    if (is_perturbation(axis)) twins *= axis.rows.size();
  if (twins < 2 || group.cases.size() <= twins) return "";
  return fmt::format("; {} perturbations of each case are not independent of each other, so that the bands are too narrow", twins);
}

std::vector<Fragility> write_fragility(const Sweep& sweep, const std::vector<Group>& groups) {
  const std::string im = unit_of_im(sweep);
  const ShownIntensity shown = shown_intensity(sweep);
  std::vector<Fragility> out;
  std::vector<std::vector<std::string>> rows;
  for (const Group& group : groups) {
    const FragilityPlan& plan = *sweep.plan.fragility;
    const bool bisected = sweep.plan.bisect.has_value();  // it chooses its runs by their answers
    if (group.incremental() || bisected) {
      out.push_back(fragility_of(group, "capacities", plan, shown));
      out.back().words += twins_of(sweep, group);
    }
    if (!bisected) out.push_back(fragility_of(group, "runs", plan, shown));
  }
  for (const Fragility& one : out) rows.push_back(row_of(one));
  write_table(sweep.directory + "/fragility.csv",
              {"group", "method", "observations", "collapsed", "end", "theta_" + im, "theta_lo95", "theta_hi95", "beta", "beta_lo95",
               "beta_hi95", "theta16", "theta84", "log_likelihood", "words"},
              rows);
  write_stripes(sweep, groups);
  write_fractiles(sweep, groups);
  if (sweep.plan.fragility->falls) write_falls(sweep, groups);
  return out;
}

}  // namespace erbs::study
