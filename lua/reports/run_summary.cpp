#include "lua/reports/run_summary.h"

#include <algorithm>
#include <cstdio>
#include <type_traits>
#include <variant>

#include "engine/analysis/diagnostics.h"
#include "engine/base/text.h"
#include "engine/record/format/json.h"
#include "engine/record/performance/performance.h"
#include "engine/record/results/collapse.h"
#include "engine/record/results/metrics.h"
#include "lua/program/progress.h"
#include "lua/program/say.h"

namespace erbs::lua {
namespace {

// "3 blocks, 2 joints, 1 broken"; dry joints have no bond that could break.
std::string size_text(const Scene& scene, const Json& metrics) {
  const auto has_strength = [](const auto& law) {
    return std::ranges::any_of(std::decay_t<decltype(law)>::fields(), [](const auto& field) { return field.name == "ft"; });
  };
  const bool bonds =
      std::ranges::any_of(scene.joint_rules, [&](const JointRule& rule) { return !rule.none && std::visit(has_strength, rule.law); });
  return counted(metrics.value("blocks", 0), "block") + ", " + counted(metrics.value("joints", 0), "joint") +
         (bonds ? fmt::format(", {} broken", metrics.value("joints_broken", 0)) : "");
}

// What a structure does not stand under; older folders do not say it.
std::string under_text(const Json& metrics) {
  const Json* under = find_key(metrics, "collapse.under");
  return under && under->is_string() ? under->get<std::string>() : "its own weight";
}

// What has not come to rest at the end may fall yet.
std::string moving_text(const Json& metrics) {
  const double share = number_at(metrics, "collapse.moving_fraction");
  return share > 0 ? fmt::format("; at the end {:.3g} % of it still moves", 100 * share) : "";
}

std::string collapse_text(const Analysis& how, const Json& metrics) {
  const Json* collapsed = find_key(metrics, "collapse.collapsed");
  const double share = number_at(metrics, "collapse.fallen_fraction");
  if (!collapsed || !collapsed->is_boolean() || !collapsed->get<bool>())
    return (share > 0 ? fmt::format("no collapse; {:.2g} % of the mass fell", 100 * share) : "no collapse; no mass fell") +
           moving_text(metrics);
  const Json* weight = find_key(metrics, "collapse.under_gravity");
  const bool under_gravity = weight && weight->is_boolean() && weight->get<bool>();
  const Json* direction = find_key(metrics, "collapse.direction");
  const auto hundredths = [&](std::size_t i) { return std::round(100 * (*direction)[i].get<double>()) / 100 + 0.0; };  // no "-0.00"
  const std::string towards = direction && direction->is_array() && direction->size() >= 2
                                  ? fmt::format(" towards ({:+.2f}, {:+.2f})", hundredths(0), hundredths(1))
                                  : " in no single direction";
  std::string text = under_gravity
                         ? fmt::format("does not stand under {}; {:.0f} % of the mass fell by the end", under_text(metrics), 100 * share)
                         : fmt::format("collapse {}{}; {:.0f} % of the mass has fallen by the end",
                                       span_of_event(how, number_at(metrics, "collapse.time_s")), towards, 100 * share);
  text += moving_text(metrics);
  const Json* mechanism = find_key(metrics, "collapse.mechanism.summary");
  const Json* course = find_key(metrics, "collapse.course");
  if (course && course->is_string() && *course != "") text += "\ncourse: " + course->get<std::string>();
  if (mechanism && mechanism->is_string() && *mechanism != "") text += "\nmechanism: " + mechanism->get<std::string>();
  return text;
}

// The result of a push: capacity, where it stands on its curve, and the mechanism.
std::string capacity_text(const PushSettings& push, const Json& metrics) {
  const Json* capacity = find_key(metrics, "capacity");
  if (!capacity) return "";
  if (capacity->value("gravity_alone", false)) return "does not stand under " + under_text(metrics);
  const auto number = [&](const char* key) { return number_at(*capacity, key); };
  const bool tilts = capacity->value("kind", "") == "tilt";  // --set may have said another kind than the scene
  const char* unit = !tilts && push.pattern.empty() ? " g" : "";
  std::string text = tilts ? fmt::format("tilts to {:.3f} deg (tangent {:.5g})", number("angle_deg"), number("multiplier"))
                           : fmt::format("capacity {:.5g}{}", number("multiplier"), unit);
  text += (*capacity)["upper"].is_number()             ? fmt::format("; no equilibrium at {:.5g}{}", number("upper"), unit)
          : metrics.value("status", "") != "completed" ? " so far"
          : capacity->value("past_peak", false)        ? "; the peak of the curve"
          : push.control == "displacement"             ? "; the curve still rises at its end"
                                                       : "; no collapse up to there";
  const Json& shear = (*capacity)["base_shear_over_weight"];
  text += fmt::format("\nat the peak: displacement {:.4g} mm, base shear {}, {:.0f} joint{} opened, {:.0f} slid",
                      1e3 * number("displacement_m"),
                      shear.is_number() ? fmt::format("{:.4g} of the weight", shear.get<double>())
                                        : fmt::format("{:.4g} kN", 1e-3 * number("base_shear_N")),
                      number("joints_opened"), number("joints_opened") == 1 ? "" : "s", number("joints_slid"));
  if (const Json& limit = (*capacity)["limit"]; limit.is_object()) {
    const auto bracket = [](const Json& b) {
      return !b["stands"].get<bool>() ? std::string("does not stand")
             : b["lower"].is_number() ? fmt::format("{:.5g}{}", 0.5 * (b["lower"].get<double>() + b["upper"].get<double>()),
                                                    b["converged"].get<bool>() ? "" : " (not converged)")
                                      : std::string("no mechanism");
    };
    const Json* smooth = find_key(limit, "dry.smooth_uprights");
    text += fmt::format(
        "\nlimit analysis: {}{}{}", bracket(limit["dry"]),
        smooth && smooth->is_number()
            ? fmt::format(", by friction of upright joints that nothing need press at rest; {:.5g} without it", smooth->get<double>())
            : "",
        limit["bonded"].is_object() ? fmt::format(" without bond; {} with it, as if ductile", bracket(limit["bonded"])) : "");
  }
  if (const std::string mechanism = capacity->value("mechanism_text", ""); !mechanism.empty()) text += "\nmechanism: " + mechanism;
  std::string walls;
  const Json by_wall = capacity->value("walls", Json::object());
  for (const auto& [group, does] : by_wall.items())
    walls += fmt::format("{}{}: {}", walls.empty() ? "" : "; ", group, does.get<std::string>());
  if (!walls.empty()) text += "\nwalls: " + walls;
  return text + fmt::format("\n{:.0f} states in {:.0f} attempts, {:.3g} steps; mean unbalanced force {:.1e} of the applied one",
                            number("states"), number("attempts"), number("relaxation_steps"), number("unbalanced_relative"));
}

}  // namespace

void print_summary(const Scene& scene, const std::string& directory, const Json& metrics, const std::vector<Verdict>& verdicts,
                   std::size_t without_answer) {
  if (scene.push.quasi_static()) {
    const Json *performance = find_key(metrics, "capacity.performance"), *said = find_key(metrics, "capacity.kind");
    const std::string kind = said && said->is_string() ? said->get<std::string>() : scene.push.kind;
    say("{}: {}, {} in {}; {}\n{}\n", scene.name, metrics.value("status", ""), kind, duration_text(number_at(metrics, "wall_s.total")),
        size_text(scene, metrics), capacity_text(scene.push, metrics));
    if (performance) say("{}\n", performance_text(*performance));
  } else {
    say("{}: {}, {:g} s simulated in {} ({:.3g} x real time); {}\n", scene.name, metrics.value("status", ""), number_at(metrics, "time_s"),
        duration_text(number_at(metrics, "wall_s.total")), number_at(metrics, "realtime_factor"), size_text(scene, metrics));
    say("{}\nenergy residual {:.1e}\n{}\n", collapse_text(scene.analysis, metrics), number_at(metrics, "energy.residual_relative"),
        analysis::diagnostics_line(diagnostics_of(metrics)));
  }
  for (const auto& [name, unit] : scene.metric_units) {
    const Json* value = find_key(metrics, "metrics." + name);
    say("  {} = {}\n", name, value && value->is_number() ? fmt::format("{:.6g} {}", value->get<double>(), unit) : "none");
  }
  if (without_answer > 0) say("studies without an answer: {}; see above, and their tables in {}/studies\n", without_answer, directory);
  int failed = 0;
  for (const Verdict& v : verdicts) {
    if (v.passed) continue;
    ++failed;
    say("  FAILED {}: expected {} {}, got {} ({})\n", v.key, v.expected, v.tolerance, v.got, v.place);
  }
  if (!verdicts.empty()) say("expectations: {} passed, {} failed\n", verdicts.size() - static_cast<size_t>(failed), failed);
  const std::string status = metrics.value("status", "");
  say("{}results in {}\n",
      status == "completed" ? "" : fmt::format("{}{}; ", status, status == "inaccurate" ? ": not to be relied on" : ""), directory);
  std::fflush(stdout);
}

}  // namespace erbs::lua
