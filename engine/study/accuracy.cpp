#include "engine/study/accuracy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/error.h"

namespace erbs::study {
namespace {

using Series = std::vector<std::pair<double, double>>;  // size, value

// Settings of a knob that gave a value, from fine to coarse.
Series series_of(const std::string& knob, std::size_t index, const std::vector<Measured>& all) {
  Series s;
  for (const Measured& m : all)
    if (m.setting.knob == knob && m.values[index]) s.emplace_back(m.setting.size, *m.values[index]);
  std::sort(s.begin(), s.end());
  return s;
}

const Measured* as_it_is(const std::vector<Measured>& all) {
  for (const Measured& m : all)
    if (m.setting.knob.empty()) return &m;
  return nullptr;
}

bool varies_several(const std::string& knob) { return knob == quality_knob || knob == together_knob; }

// Names of the knobs that the scene declares, in their order.
std::vector<std::string> declared_knobs(const std::vector<Measured>& all) {
  std::vector<std::string> names;
  for (const Measured& m : all)
    if (m.setting.declared && !varies_several(m.setting.knob) && std::find(names.begin(), names.end(), m.setting.knob) == names.end())
      names.push_back(m.setting.knob);
  return names;
}

// The run at the finest values of all knobs of the scene, or nullptr.
const Measured* at_the_finest(std::size_t index, const std::vector<Measured>& all) {
  const Measured* found = nullptr;
  for (const Measured& m : all)
    if (m.setting.declared && !varies_several(m.setting.knob) && m.values[index] && (!found || m.setting.size < found->setting.size))
      found = &m;
  return found != nullptr && found->setting.size <= 1 ? found : nullptr;
}

// The limit of a knob. Beds of finite stiffness err with its cube root, so that declared knobs may have low orders.
Limit limit_of(const Goal& q, const std::string& knob, bool declared, std::size_t index, const std::vector<Measured>& all) {
  const Series series = series_of(knob, index, all);
  if (q.scatters && declared) {  // runs of a statistic scatter about its value: no order
    for (const Measured& m : all)
      if (!series.empty() && m.setting.knob == knob && m.setting.size == series[0].first)
        return {series[0].second, m.scatter.value_or(0), 0};
    return {};
  }
  return declared ? richardson(series, 1, 0.2) : richardson(series, 2);
}

double scale_of(const Goal& q) { return q.reference != 0 ? std::fabs(q.reference) : 1; }

// Slope of a line fitted by least squares.
double slope_of(const std::vector<std::pair<double, double>>& points) {
  double x = 0, y = 0, xx = 0, xy = 0;
  const double n = double(points.size());
  for (const auto& [u, v] : points) x += u, y += v, xx += u * u, xy += u * v;
  return (n * xy - x * y) / (n * xx - x * x);
}

double correlation_of(const std::vector<std::pair<double, double>>& points) {
  double x = 0, y = 0, xx = 0, yy = 0, xy = 0;
  const double n = double(points.size());
  for (const auto& [u, v] : points) x += u, y += v, xx += u * u, yy += v * v, xy += u * v;
  return (n * xy - x * y) / std::sqrt((n * xx - x * x) * (n * yy - y * y));
}

constexpr double worth_telling = 0.9;  // an error above this share of a cheaper setting's may be lower by chance

std::string percent(double share) { return fmt::format("{:.2g} %", 100 * share); }

std::string error_text(const Goal& q, double error) { return q.reference != 0 ? percent(error) : fmt::format("{:.2g} {}", error, q.unit); }

std::string seconds_text(double s) { return s < 0.995 ? fmt::format("{:.2g} s", s) : fmt::format("{:.3g} s", s); }

}  // namespace

double Knob::size(double value) const { return values.back() > values.front() ? values.back() / value : value / values.back(); }

std::string mistake_in(const std::vector<double>& values) {
  if (values.size() < 2) return "values must be two numbers or more, from coarse to fine, such as { 1e10, 1e11, 1e12 }";
  const bool rising = values[1] > values[0];
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(values[i] > 0) || !std::isfinite(values[i])) return fmt::format("values must be above zero, and {:g} is not", values[i]);
    if (i > 0 && (values[i] > values[i - 1]) != rising)
      return fmt::format("values go from coarse to fine without turning back, and {:g} follows {:g}; put them in order", values[i],
                         values[i - 1]);
    if (i > 0 && values[i] == values[i - 1]) return fmt::format("values must differ, and {:g} is there twice", values[i]);
  }
  return "";
}

Limit richardson(const Series& series, double order, double least) {
  if (series.empty()) return {};
  if (series.size() == 1) return {series[0].second, 0, 0};
  const auto [h1, q1] = series[0];
  const auto [h2, q2] = series[1];
  if (series.size() >= 3) {
    const auto [h3, q3] = series[2];
    const double ratio = (q3 - q2) / (q2 - q1);
    // Fits q = limit + c h^p to three values; the expression grows with p.
    const auto excess = [h1 = h1, h2 = h2, h3 = h3, ratio](double p) {
      return (std::pow(h3, p) - std::pow(h2, p)) / (std::pow(h2, p) - std::pow(h1, p)) - ratio;
    };
    double low = least, high = 4;
    if (std::isfinite(ratio) && excess(low) < 0 && excess(high) > 0) {
      for (int iteration = 0; iteration < 60; ++iteration) (excess(0.5 * (low + high)) < 0 ? low : high) = 0.5 * (low + high);
      order = 0.5 * (low + high);
    }
  }
  const double left = (q1 - q2) / (std::pow(h2 / h1, order) - 1);
  return {q1 + left, std::fabs(left), order};
}

void settle_reference(Goal& q, std::size_t index, const std::vector<Measured>& all) {
  const Measured *base = as_it_is(all), *finest = at_the_finest(index, all);
  if (base != nullptr && base->values[index]) {
    const double at_base = *base->values[index];
    double step_and_points = 0;
    std::vector<std::string> knobs;
    q.own_limit = at_base, q.own_uncertainty = 0;
    for (const char* knob : {"time step", "points, simpson"}) {
      if (series_of(knob, index, all).size() < 2) continue;
      const Limit limit = limit_of(q, knob, false, index, all);
      step_and_points += limit.value - at_base;
      q.own_uncertainty += limit.uncertainty;
      knobs.emplace_back(knob);
    }
    q.own_limit += step_and_points;
    q.reference = q.own_limit, q.uncertainty = q.own_uncertainty;
    if (finest != nullptr) {
      q.reference = *finest->values[index] + step_and_points;
      for (const std::string& knob : declared_knobs(all)) {
        const Limit limit = limit_of(q, knob, true, index, all);
        q.reference += limit.value - *finest->values[index];
        q.uncertainty += limit.uncertainty;
        knobs.push_back(knob);
      }
    }
    q.from = knobs.empty() ? "the scene as it is; nothing could be refined" : fmt::format("Richardson in {}", fmt::join(knobs, " and "));
    // Steps and points move a statistic by less than its scatter: their limits would be limits of chance.
    if (finest != nullptr && q.scatters)
      q.reference = q.own_limit = *finest->values[index], q.uncertainty = q.own_uncertainty = finest->scatter.value_or(0),
      q.from = "the finest run, within its standard error";
  }
  if (q.expected) q.reference = *q.expected, q.uncertainty = 0, q.from = "the scene's expectation";
}

std::optional<double> own_error_of(const Goal& q, std::size_t index, const Measured& run, const std::vector<Measured>& all) {
  if (!run.values[index] || q.from.empty()) return std::nullopt;
  double limit = q.own_limit;
  if (run.setting.knob == together_knob) {
    if (const Measured* finest = at_the_finest(index, all)) {
      limit = *finest->values[index];
      for (const std::string& knob : declared_knobs(all)) limit += limit_of(q, knob, true, index, all).value - *finest->values[index];
    }
  } else if (run.setting.declared) {
    limit = limit_of(q, run.setting.knob, true, index, all).value;
  }
  const double error = std::fabs(*run.values[index] - limit);
  if (!std::isfinite(error)) return std::nullopt;
  return std::max(error, q.scatters ? run.scatter.value_or(0) : 0) / scale_of(q);
}

std::optional<double> error_of(const Goal& q, std::size_t index, const Measured& run, const std::vector<Measured>& all) {
  if (!run.values[index] || q.from.empty()) return std::nullopt;
  double error = std::fabs(*run.values[index] - q.reference);
  if (q.scatters) error = std::max(error, run.scatter.value_or(0));
  error /= scale_of(q);
  for (const std::string& part : run.setting.parts)
    for (const Measured& m : all)
      if (m.setting.name == part) error = std::max(error, own_error_of(q, index, m, all).value_or(0));
  return error;
}

std::vector<Curve> curves_of(const Goal& q, std::size_t index, const std::vector<Measured>& all) {
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].setting.knob.empty() || varies_several(all[i].setting.knob) || !error_of(q, index, all[i], all)) continue;
    auto found = std::find_if(curves.begin(), curves.end(), [&](const Curve& c) { return c.knob == all[i].setting.knob; });
    if (found == curves.end()) found = curves.insert(curves.end(), {all[i].setting.knob, {}, {}});
    found->at.push_back(i);
  }
  for (Curve& c : curves) {
    std::sort(c.at.begin(), c.at.end(), [&](std::size_t a, std::size_t b) { return all[a].setting.size > all[b].setting.size; });
    // Error of this knob alone: distance from its own limit. The errors of the other knobs then do not bend the line.
    Series series = series_of(c.knob, index, all);
    if (series.size() < 3) continue;
    const bool declared = all[c.at.front()].setting.declared;
    const Limit limit = limit_of(q, c.knob, declared, index, all);
    const double scale = scale_of(q);
    std::vector<std::pair<double, double>> points;     // ln size, ln error, from fine to coarse
    for (std::size_t i = 1; i < series.size(); ++i) {  // the finest value was used for the limit
      double error = std::fabs(series[i].second - limit.value) / scale;
      if (q.scatters && declared) error = own_error_of(q, index, all[c.at[series.size() - 1 - i]], all).value_or(error);
      if (!(error > 1e-11) || series[i].first <= 0) continue;  // round-off
      points.emplace_back(std::log(series[i].first), std::log(error));
    }
    // An order of convergence holds for small errors and small steps only.
    const auto coarse = [&](const auto& p) { return c.knob == "time step" && p.first > std::log(1.01 / 8); };
    if (points.size() >= 4 && !coarse(points[3])) std::erase_if(points, coarse);
    while (points.size() > 2 && points.back().second > std::log(0.1)) points.pop_back();
    // An error that neither falls monotonically nor follows a line does not come from this knob: no order is reported.
    const bool falls = std::is_sorted(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.second <= b.second; });
    const bool told = points.size() >= 2 && (falls || (points.size() >= 6 && correlation_of(points) > 0.9));
    if (told) c.slope = slope_of(points);
  }
  return curves;
}

std::vector<std::size_t> pareto(const Goal& q, std::size_t index, const std::vector<Measured>& all, bool by_updates, bool own) {
  const auto cost = [&](std::size_t i) { return by_updates && all[i].updates > 0 ? all[i].updates : all[i].cpu; };
  std::vector<std::size_t> order;
  std::vector<double> errors(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto error = own ? own_error_of(q, index, all[i], all) : error_of(q, index, all[i], all);
    if (all[i].setting.advised && error && !(own && all[i].setting.declared)) order.push_back(i), errors[i] = *error;
  }
  // at equal cost the scene as it is comes first
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (cost(a) != cost(b)) return cost(a) < cost(b);
    const bool first = all[a].setting.knob.empty(), second = all[b].setting.knob.empty();
    return first != second ? first : errors[a] < errors[b];
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order)
    if (front.empty() || errors[i] < worth_telling * errors[front.back()]) front.push_back(i);
  return front;
}

std::optional<std::size_t> cheapest(const Goal& q, std::size_t index, const std::vector<Measured>& all, double target) {
  const auto within = [&](std::optional<double> error) { return error && *error <= target; };
  for (const std::size_t i : pareto(q, index, all, true))  // an error of its own that another one happens to cancel does not count
    if (within(error_of(q, index, all[i], all)) && within(own_error_of(q, index, all[i], all))) return i;
  return std::nullopt;
}

std::optional<std::size_t> best_within(const Goal& q, std::size_t index, const std::vector<Measured>& all, double budget) {
  std::optional<std::size_t> best;
  for (const std::size_t i : pareto(q, index, all, true))
    if (all[i].cpu <= budget) best = i;
  return best;
}

std::optional<Ending> ending_of(const Goal& q, std::size_t index, const std::vector<Measured>& all) {
  const std::vector<std::size_t> front = pareto(q, index, all, true);
  const Measured *base = as_it_is(all), *finest = at_the_finest(index, all);
  if (front.empty() || base == nullptr || !base->values[index]) return std::nullopt;
  const Measured& best = finest != nullptr ? *finest : all[front.back()];
  std::vector<std::pair<std::string, bool>> knobs{{"time step", false}, {"points, simpson", false}};
  for (const std::string& knob : declared_knobs(all)) knobs.emplace_back(knob, true);
  double rest = q.reference - *best.values[index];
  Ending most{"", -1};
  for (const auto& [knob, declared] : knobs) {
    if (series_of(knob, index, all).size() < 2 || (q.scatters && !declared) || (declared && finest == nullptr)) continue;
    const bool own = declared || best.setting.knob == knob;
    double left = limit_of(q, knob, declared, index, all).value - (own ? *best.values[index] : *base->values[index]);
    rest -= left;
    if (q.scatters) left = best.scatter.value_or(0);
    if (std::fabs(left) > most.error) most = {knob, std::fabs(left)};
  }
  // the part that no knob explains
  if (most.error < 0 || std::fabs(rest) > most.error) most = {"", std::fabs(rest)};
  // Where theory is known, so is the error, unless those of several knobs cancel.
  const double known = std::fabs(q.reference - *best.values[index]);
  if (q.expected) most.error = declared_knobs(all).size() > 1 ? std::max(known, most.error) : known;
  most.error /= scale_of(q);
  return most;
}

std::string what_limits(const Goal& q, std::size_t index, const std::vector<Measured>& all) {
  const auto ending = ending_of(q, index, all);
  if (!ending) return "the runs that failed are the error";
  if (ending->knob == "time step") return "the step, not the points, is the error";
  if (ending->knob == "points, simpson") return "the points, not the step, are the error";
  if (!ending->knob.empty()) return fmt::format("\"{}\", not step or points, is the error", ending->knob);
  if (!declared_knobs(all).empty()) return "the scene itself, none of its knobs, is the error";
  return "the scene itself (its stiffnesses, its loading), not step or points, is the error";
}

std::string plain_sentence(const Goal& q, std::size_t index, const std::vector<Measured>& all) {
  const std::vector<std::size_t> front = pareto(q, index, all, true);
  if (front.empty()) {
    const bool ended = std::ranges::any_of(all, [](const Measured& m) { return m.reason.empty(); });
    return fmt::format("{}: no run gave a value; {}", q.name,
                       ended ? "the metric returned none: look at its function" : "the first that failed says: " + all.front().reason);
  }
  std::string text;
  double told = std::numeric_limits<double>::infinity();
  int parts = 0;
  for (const std::size_t i : front) {
    const double error = *error_of(q, index, all[i], all);
    if (parts > 0 && error > 0.3 * told) continue;  // report only a clear gain
    told = error;
    const std::string with = all[i].setting.knob.empty() ? "as the scene is" : "with " + all[i].setting.name;
    text +=
        parts == 0 ? fmt::format("An error of {} in {}", error_text(q, error), q.name) : fmt::format("; one of {}", error_text(q, error));
    text += fmt::format(" costs {} {}", seconds_text(all[i].cpu), with);
    if (++parts == 4) break;
  }
  const double least = *error_of(q, index, all[front.back()], all);
  const double uncertain = q.reference != 0 ? q.uncertainty / std::fabs(q.reference) : q.uncertainty;
  text += fmt::format("; below {} {}.", error_text(q, std::max(least, uncertain)), what_limits(q, index, all));
  if (!q.expected)
    text += fmt::format(
        "\nErrors are those against the scene's own limit ({}): what theory or a test says may lie further away. To measure by a known "
        "value write expect(\"{}\", VALUE, {{ rel = 0.01 }}).",
        q.from, q.name);
  return text;
}

}  // namespace erbs::study
