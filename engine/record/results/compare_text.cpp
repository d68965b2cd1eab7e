// The comparison as a table and as JSON.
#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/record/results/compare_runs.h"

namespace erbs {
namespace {

std::string percent(double share) { return std::isfinite(share) ? fmt::format("{:+.2f} %", 100 * share) : "-"; }

// "0.780 s", or that it stands; "falls" under its weight or in a push, which have no time.
std::string fall_of(bool collapsed, double time) {
  return !collapsed ? "stands" : std::isfinite(time) ? fmt::format("{:.3f} s", time) : "falls";
}

std::string list_of(const std::vector<std::string>& names) { return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")); }

std::string collapse_text(const CollapseErrors& c) {
  std::string text = fmt::format("collapse    run {}, reference {}", fall_of(c.run, c.time_run), fall_of(c.reference, c.time_reference));
  if (c.run && c.reference && std::isfinite(c.time)) text += fmt::format("; error {:+.4f} s after the alignment", c.time);
  if (c.run && c.reference && std::isfinite(c.direction)) text += fmt::format(", direction {:.1f} deg apart", c.direction);
  return text + fmt::format("\nsequence    run {}; reference {}; {}\n", list_of(c.order_run), list_of(c.order_reference),
                            c.same_sequence ? "the same" : "another");
}

// Each param on a line of its own: which input tells the two runs apart.
std::string scenes_text(const SceneDifferences& scenes) {
  const auto value = [](const std::optional<double>& v, const std::string& unit) {
    return v ? fmt::format("{:.6g}{}{}", *v, unit.empty() ? "" : " ", unit) : std::string("none");
  };
  std::string text = scenes.script ? "scene       the two scripts differ\n" : "";
  if (scenes.params.empty() && scenes.run_notes.empty() && scenes.reference_notes.empty()) return text + "params      the same\n";
  for (std::size_t i = 0; i < scenes.params.size(); ++i) {
    const ParamDifference& p = scenes.params[i];
    text +=
        fmt::format("{:<12}{}: run {}, reference {}\n", i == 0 ? "params" : "", p.name, value(p.run, p.unit), value(p.reference, p.unit));
  }
  for (const std::string& note : scenes.run_notes) text += fmt::format("run         {}\n", note);
  for (const std::string& note : scenes.reference_notes) text += fmt::format("reference   {}\n", note);
  return text;
}

}  // namespace

bool only_ground(const RunComparison& c) {
  return !c.columns.empty() && std::ranges::all_of(c.columns, [](const ColumnErrors& e) { return e.name.starts_with("ground_a"); });
}

std::string words_of(Alignment how) {
  return how == Alignment::none ? "none" : how == Alignment::first_motion ? "first-motion" : "correlation";
}

std::string table_of(const RunComparison& c) {
  std::string text = fmt::format("time        aligned by {}", words_of(c.shift.how));
  if (c.shift.how != Alignment::none)
    text += fmt::format(" of {}: the run is {:.4f} s {}", c.shift.column, std::fabs(c.shift.lag), c.shift.lag < 0 ? "earlier" : "later");
  text += "\n";
  if (c.scenes) text = scenes_text(*c.scenes) + text;
  if (c.shift.at_edge) text += "warning: the best lag is the largest one searched; the true one may lie beyond, see --reach\n";
  if (!c.columns.empty())
    text += fmt::format("{:<28} {:>11} {:>11} {:>10} {:>10} {:>10} {:>9} {:>8} {:>18}\n", "column (SI)", "peak run", "reference", "error",
                        "rms error", "rms diff.", "lag s", "correl.", "frequency error");
  for (const ColumnErrors& e : c.columns)
    text +=
        fmt::format("{:<28} {:>11.4g} {:>11.4g} {:>10} {:>10} {:>10} {:>9.4f} {:>8.4f} {:>18}\n", e.name, e.peak_run, e.peak_reference,
                    percent(e.peak_error), percent(e.rms_error), percent(e.difference), e.lag, e.correlation, percent(e.frequency_error));
  if (only_ground(c))
    text += "note        only the motion of the ground is compared; record the response under the same names, or use --columns\n";
  return c.collapse.known ? text + collapse_text(c.collapse) : text;
}

Json json_of(const RunComparison& c) {
  Json json;
  json["alignment"] = {{"method", words_of(c.shift.how)},
                       {"column", c.shift.column},
                       {"lag_s", c.shift.lag},
                       {"correlation", c.shift.correlation},
                       {"at_edge", c.shift.at_edge}};
  json["columns"] = Json::object();
  for (const ColumnErrors& e : c.columns)
    json["columns"][e.name] = {{"peak_run", e.peak_run},
                               {"peak_reference", e.peak_reference},
                               {"peak_error", e.peak_error},
                               {"rms_run", e.rms_run},
                               {"rms_reference", e.rms_reference},
                               {"rms_error", e.rms_error},
                               {"difference", e.difference},
                               {"lag_s", e.lag},
                               {"correlation", e.correlation},
                               {"frequency_run_Hz", e.frequency_run},
                               {"frequency_reference_Hz", e.frequency_reference},
                               {"frequency_error", e.frequency_error}};
  if (c.scenes) {
    const auto value = [](const std::optional<double>& v) { return v ? Json(*v) : Json(); };
    json["same_script"] = !c.scenes->script;
    json["params"] = Json::object();
    for (const ParamDifference& p : c.scenes->params)
      json["params"][p.name] = {{"run", value(p.run)}, {"reference", value(p.reference)}, {"unit", p.unit}};
    json["notes"] = {{"run", c.scenes->run_notes}, {"reference", c.scenes->reference_notes}};
  }
  const CollapseErrors& f = c.collapse;
  if (f.known)
    json["collapse"] = {{"run", f.run},
                        {"reference", f.reference},
                        {"time_run_s", f.time_run},
                        {"time_reference_s", f.time_reference},
                        {"time_error_s", f.time},
                        {"direction_error_deg", f.direction},
                        {"sequence_run", f.order_run},
                        {"sequence_reference", f.order_reference},
                        {"same_sequence", f.same_sequence}};
  return json;
}

}  // namespace erbs
