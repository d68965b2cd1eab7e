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

Limit richardson(const Series& series, double order) {
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
    double low = 0.5, high = 4;
    if (std::isfinite(ratio) && excess(low) < 0 && excess(high) > 0) {
      for (int iteration = 0; iteration < 60; ++iteration) (excess(0.5 * (low + high)) < 0 ? low : high) = 0.5 * (low + high);
      order = 0.5 * (low + high);
    }
  }
  const double left = (q1 - q2) / (std::pow(h2 / h1, order) - 1);
  return {q1 + left, std::fabs(left), order};
}

void settle_reference(Goal& q, std::size_t index, const std::vector<Measured>& all) {
  if (q.expected) {
    q.reference = *q.expected;
    q.uncertainty = 0;
    q.from = "the scene's expectation";
    return;
  }
  const Measured* base = as_it_is(all);
  if (base == nullptr || !base->values[index]) return;
  const double at_base = *base->values[index];
  q.reference = at_base;
  q.uncertainty = 0;
  std::string knobs;
  for (const char* knob : {"time step", "points, simpson"}) {
    const Series series = series_of(knob, index, all);
    if (series.size() < 2) continue;
    const Limit limit = richardson(series, 2);
    q.reference += limit.value - at_base;
    q.uncertainty += limit.uncertainty;
    knobs += (knobs.empty() ? "" : " and ") + std::string(knob);
  }
  q.from = knobs.empty() ? "the scene as it is; nothing could be refined" : "Richardson in " + knobs;
}

std::optional<double> error_of(const Goal& q, const std::optional<double>& value) {
  if (!value || q.from.empty()) return std::nullopt;
  const double error = std::fabs(*value - q.reference);
  return q.reference != 0 ? error / std::fabs(q.reference) : error;
}

std::vector<Curve> curves_of(const Goal& q, std::size_t index, const std::vector<Measured>& all) {
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].setting.knob.empty() || all[i].setting.knob == quality_knob || !error_of(q, all[i].values[index])) continue;
    auto found = std::find_if(curves.begin(), curves.end(), [&](const Curve& c) { return c.knob == all[i].setting.knob; });
    if (found == curves.end()) found = curves.insert(curves.end(), {all[i].setting.knob, {}, {}});
    found->at.push_back(i);
  }
  for (Curve& c : curves) {
    std::sort(c.at.begin(), c.at.end(), [&](std::size_t a, std::size_t b) { return all[a].setting.size > all[b].setting.size; });
    // Error of this knob alone: distance from its own limit. The errors of the other knobs then do not bend the line.
    Series series = series_of(c.knob, index, all);
    if (series.size() < 3) continue;
    const Limit limit = richardson(series, 2);
    const double scale = q.reference != 0 ? std::fabs(q.reference) : 1;
    std::vector<std::pair<double, double>> points;     // ln size, ln error, from fine to coarse
    for (std::size_t i = 1; i < series.size(); ++i) {  // the finest value was used for the limit
      const double error = std::fabs(series[i].second - limit.value) / scale;
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

std::vector<std::size_t> pareto(const Goal& q, std::size_t index, const std::vector<Measured>& all, bool by_updates) {
  const auto cost = [&](std::size_t i) { return by_updates && all[i].updates > 0 ? all[i].updates : all[i].cpu; };
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].setting.advised && error_of(q, all[i].values[index])) order.push_back(i);
  const auto error = [&](std::size_t i) { return *error_of(q, all[i].values[index]); };
  // at equal cost the scene as it is comes first
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (cost(a) != cost(b)) return cost(a) < cost(b);
    const bool first = all[a].setting.knob.empty(), second = all[b].setting.knob.empty();
    return first != second ? first : error(a) < error(b);
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order)
    if (front.empty() || error(i) < worth_telling * error(front.back())) front.push_back(i);
  return front;
}

std::optional<std::size_t> cheapest(const Goal& q, std::size_t index, const std::vector<Measured>& all, double target) {
  for (const std::size_t i : pareto(q, index, all, true))
    if (*error_of(q, all[i].values[index]) <= target) return i;
  return std::nullopt;
}

std::optional<std::size_t> best_within(const Goal& q, std::size_t index, const std::vector<Measured>& all, double budget) {
  std::optional<std::size_t> best;
  for (const std::size_t i : pareto(q, index, all, true))
    if (all[i].cpu <= budget) best = i;
  return best;
}

std::string what_limits(const Goal& q, std::size_t index, const std::vector<Measured>& all) {
  const std::vector<std::size_t> front = pareto(q, index, all, true);
  const Measured* base = as_it_is(all);
  if (front.empty() || base == nullptr || !base->values[index]) return "the runs that failed are the error";
  const Measured& best = all[front.back()];
  double most = -1, rest = q.reference - *best.values[index];
  std::string phrase;
  for (const auto& [knob, words] : {std::pair{"time step", "the step, not the points, is the error"},
                                    {"points, simpson", "the points, not the step, are the error"},
                                    {"block size", "the size of the blocks, not step or points, is the error"}}) {
    const Series series = series_of(knob, index, all);
    if (series.size() < 2) continue;
    const double left = richardson(series, 2).value - (best.setting.knob == knob ? *best.values[index] : *base->values[index]);
    rest -= left;
    if (std::fabs(left) > most) most = std::fabs(left), phrase = words;
  }
  // the part that no knob explains
  if (phrase.empty() || std::fabs(rest) > most) return "the scene itself (its stiffnesses, its loading), not step or points, is the error";
  return phrase;
}

std::string plain_sentence(const Goal& q, std::size_t index, const std::vector<Measured>& all) {
  const std::vector<std::size_t> front = pareto(q, index, all, true);
  if (front.empty()) {
    const auto told = std::find_if(all.begin(), all.end(), [](const Measured& m) { return !m.reason.empty(); });
    return fmt::format(
        "{}: no run gave a value; {}", q.name,
        told == all.end() ? "the metric returned none: look at its function" : "the first that failed says: " + told->reason);
  }
  std::string text;
  double told = std::numeric_limits<double>::infinity();
  int parts = 0;
  for (const std::size_t i : front) {
    const double error = *error_of(q, all[i].values[index]);
    if (parts > 0 && error > 0.3 * told) continue;  // report only a clear gain
    told = error;
    const std::string with = all[i].setting.knob.empty() ? "as the scene is" : "with " + all[i].setting.name;
    text +=
        parts == 0 ? fmt::format("An error of {} in {}", error_text(q, error), q.name) : fmt::format("; one of {}", error_text(q, error));
    text += fmt::format(" costs {} {}", seconds_text(all[i].cpu), with);
    if (++parts == 4) break;
  }
  const double least = *error_of(q, all[front.back()].values[index]);
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
