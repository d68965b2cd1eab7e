#include "lua/reports/accuracy/tables.h"

#include <algorithm>
#include <cmath>

#include "lua/program/say.h"
#include "lua/reading/quality.h"
#include "lua/reports/book.h"

namespace erbs::lua {
namespace {

std::vector<std::size_t> front_of(const AccuracyStudy& s, bool own = false) { return pareto(s.quantity(), s.main, s.all, false, own); }

bool has_order(const study::Curve& c) { return c.slope && c.knob != "lazy rotation" && !c.knob.starts_with("sequential"); }

std::string orders_text(const AccuracyStudy& s) {
  std::string text;
  for (const study::Curve& c : curves_of(s.quantity(), s.main, s.all))
    if (has_order(c)) text += fmt::format("{}{} {:.2f}", text.empty() ? "" : ", ", c.knob, *c.slope);
  return text.empty() ? "-" : text;
}

// "5.6 % to 0.0061 %: 3.0 decades"
std::string fall_text(const AccuracyStudy& s, const std::vector<std::size_t>& front) {
  if (front.empty()) return "-";
  const double first = s.error(s.all[front.front()]).value(), last = s.error(s.all[front.back()]).value();
  const std::string decades = last > 0 ? fmt::format(": {:.1f} decades", std::log10(first / last)) : "";
  return fmt::format("{} to {}{}", error_text(s.quantity(), first), error_text(s.quantity(), last), decades);
}

std::string ending_text(const AccuracyStudy& s) {
  const auto ending = ending_of(s.quantity(), s.main, s.all);
  if (!ending) return "-";
  return fmt::format("{}: {}", ending->knob.empty() ? "the model" : ending->knob, error_text(s.quantity(), ending->error));
}

// By what errors are measured.
std::string measure_text(const AccuracyStudy& s) {
  const study::Goal& q = s.quantity();
  if (q.expected) return "theory";
  const double uncertain = q.reference != 0 ? q.uncertainty / std::fabs(q.reference) : q.uncertainty;
  return fmt::format("own limit, within {}", error_text(q, uncertain));
}

std::string cheapest_text(const AccuracyStudy& s, double target) {
  const auto i = cheapest(s.quantity(), s.main, s.all, target);
  return i ? fmt::format("{}: {}", s.all[*i].setting.name, cost_text(s.all[*i])) : "not reached";
}

std::string accuracy_row(const AccuracyStudy& s) {
  const study::Goal& q = s.quantity();
  const std::vector<std::size_t> front = front_of(s), own = front_of(s, true);
  return fmt::format("| `{}` | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", s.name, code_cell(q.name), measure_text(s),
                     fall_text(s, front), front.empty() ? "-" : cost_text(s.all[front.back()]), cheapest_text(s, 0.01),
                     cheapest_text(s, 0.001), ending_text(s), own.empty() ? "-" : error_text(q, s.own_error(s.all[own.back()])),
                     orders_text(s));
}

// The row of a problem in the table of qualities: the error of each against the scene's own limit, which is all that steps and points can
// reach, and its number of evaluations over that of standard.
std::string quality_row(const AccuracyStudy& s) {
  const auto find = [&](const Quality& q) {
    return std::find_if(s.all.begin(), s.all.end(), [&](const study::Measured& m) {
      return m.setting.knob == study::quality_knob && m.setting.name.ends_with(q.name);
    });
  };
  std::string errors, costs;
  const auto standard = find(qualities[1]);
  for (const Quality& q : qualities) {
    const auto m = find(q);
    if (m == s.all.end() || standard == s.all.end()) return "";
    errors += " " + error_text(s.quantity(), s.own_error(*m)) + " |";
    costs += m->updates > 0 && standard->updates > 0 ? fmt::format(" {:.2g} |", m->updates / standard->updates)
                                                     : fmt::format(" {:.2g} (s) |", m->cpu / standard->cpu);
  }
  const study::Goal& q = s.quantity();
  const double uncertain = q.reference != 0 ? q.own_uncertainty / std::fabs(q.reference) : q.own_uncertainty;
  return fmt::format("| `{}` | {} |{} {} |{}\n", s.name, code_cell(q.name), errors, error_text(q, uncertain), costs);
}

}  // namespace

std::string error_text(const study::Goal& q, const std::optional<double>& error) {
  if (!error) return "-";
  return q.reference != 0 ? fmt::format("{:.3g} %", 100 * *error) : fmt::format("{:.3g} {}", *error, q.unit);
}

std::string cost_text(const study::Measured& run) { return fmt::format("{:.2g} s, {:.2g} pt", run.cpu, run.updates); }

void print_settings(const AccuracyStudy& s) {
  const study::Goal& q = s.quantity();
  say("{}: {}\n{} = {:.8g} {} by {}{}\n", s.name, s.title, q.name, q.reference, q.unit, q.from,
      q.uncertainty > 0 ? fmt::format(", uncertainty {:.2g}", q.uncertainty) : "");
  if (q.expected)
    say("its own limit, which finer steps and points lead to, is {:.8g} {}, uncertainty {:.2g}; errors against both are in {}\n",
        q.own_limit, q.unit, q.own_uncertainty, q.reference != 0 ? fmt::format("% of {:.8g} {}", q.reference, q.unit) : q.unit);
  say("\n{:<22}  {:<32}  {:>14}  {:>12}  {:>12}  {:>9}  {:>12}\n", "knob", "setting", "value", "error", "to own limit", "cpu s",
      "evaluations");
  std::vector<std::size_t> order(s.all.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const study::Setting &x = s.all[a].setting, &y = s.all[b].setting;
    return x.knob != y.knob ? x.knob < y.knob : x.size > y.size;
  });
  for (const std::size_t i : order) {
    const study::Measured& m = s.all[i];
    const auto& value = m.values[s.main];
    say("{:<22}  {:<32}  {:>14}  {:>12}  {:>12}  {:>9.3f}  {:>12.3g}{}\n", m.setting.knob, m.setting.name,
        value ? fmt::format("{:.8g}", *value) : "-", error_text(q, s.error(m)), error_text(q, s.own_error(m)), m.cpu, m.updates,
        m.reason.empty() ? "" : "  " + m.reason);
  }
  for (const auto& text : s.not_applicable) say("{:<22}  not applicable\n", text);
  for (const study::Curve& c : curves_of(q, s.main, s.all))
    if (c.slope)
      say("{}: the error falls with the power {:.2f} of {}\n", c.knob, *c.slope,
          c.knob == "time step"          ? "dt"
          : c.knob.starts_with("points") ? "the spacing of points"
                                         : "its size");
}

std::string accuracy_table(const std::vector<AccuracyStudy>& studies) {
  std::string table =
      "| problem | quantity | errors are against | the error falls | its last value costs | 1 % costs | 0.1 % costs | what ends it | best "
      "against the own limit | order of the error in |\n|---|---|---|---|---|---|---|---|---|---|\n";
  for (const AccuracyStudy& s : studies) table += accuracy_row(s);
  return table;
}

std::string quality_table(const std::vector<AccuracyStudy>& studies) {
  std::string table =
      "| problem | quantity | error of draft | standard | reference | own limit, uncertain | cost of draft | standard | "
      "reference |\n"
      "|---|---|---|---|---|---|---|---|---|\n";
  for (const AccuracyStudy& s : studies) table += quality_row(s);
  return table;
}

std::string seconds_sentence(const std::vector<AccuracyStudy>& studies) {
  const auto seconds = [](const AccuracyStudy& s, double target) {
    const auto i = cheapest(s.quantity(), s.main, s.all, target);
    return i ? fmt::format("{:.2g}", s.all[*i].cpu) : std::string("-");
  };
  std::string text =
      "[What accuracy costs](scenes/accuracy/README.md) by `erbs accuracy --study`, in seconds of one processor for an error of 1 % and of "
      "0.1 %:";
  for (const AccuracyStudy& s : studies)
    text += fmt::format("{} `{}` {} and {}", &s == studies.data() ? "" : ",", s.name, seconds(s, 0.01), seconds(s, 0.001));
  return text + " (-: not reached).";
}

}  // namespace erbs::lua
