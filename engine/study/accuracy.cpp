#include "engine/study/accuracy.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/base/error.h"

namespace erbs {
namespace {

using Series = std::vector<std::pair<double, double>>;  // size, value

// The stops of a knob that gave a value, from fine to coarse.
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
    // of q = limit + c h^p; the left side grows with p
    const auto excess = [&](double p) { return (std::pow(h3, p) - std::pow(h2, p)) / (std::pow(h2, p) - std::pow(h1, p)) - ratio; };
    double low = 0.5, high = 4;
    if (std::isfinite(ratio) && excess(low) < 0 && excess(high) > 0) {
      for (int turn = 0; turn < 60; ++turn) (excess(0.5 * (low + high)) < 0 ? low : high) = 0.5 * (low + high);
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
    if (all[i].setting.knob.empty() || !error_of(q, all[i].values[index])) continue;
    auto found = std::find_if(curves.begin(), curves.end(), [&](const Curve& c) { return c.knob == all[i].setting.knob; });
    if (found == curves.end()) found = curves.insert(curves.end(), {all[i].setting.knob, {}, {}});
    found->at.push_back(i);
  }
  for (Curve& c : curves) {
    std::sort(c.at.begin(), c.at.end(), [&](std::size_t a, std::size_t b) { return all[a].setting.size > all[b].setting.size; });
    // The knob's own error: its distance from its own limit, so that what the other knobs leave does not bend the line.
    Series series = series_of(c.knob, index, all);
    if (series.size() < 3) continue;
    const Limit limit = richardson(series, 2);
    const double scale = q.reference != 0 ? std::fabs(q.reference) : 1;
    double x = 0, y = 0, xx = 0, xy = 0, n = 0;
    for (std::size_t i = 1; i < series.size(); ++i) {  // the finest made the limit
      const double error = std::fabs(series[i].second - limit.value) / scale;
      if (!(error > 1e-11) || series[i].first <= 0) continue;  // round-off
      const double u = std::log(series[i].first), v = std::log(error);
      x += u, y += v, xx += u * u, xy += u * v, ++n;
    }
    const double spread = n * xx - x * x;
    if (n >= 2 && spread > 0) c.slope = (n * xy - x * y) / spread;
  }
  return curves;
}

std::vector<std::size_t> pareto(const Goal& q, std::size_t index, const std::vector<Measured>& all, bool by_updates) {
  const auto cost = [&](std::size_t i) { return by_updates ? all[i].updates : all[i].cpu; };
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (error_of(q, all[i].values[index])) order.push_back(i);
  const auto error = [&](std::size_t i) { return *error_of(q, all[i].values[index]); };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return cost(a) != cost(b) ? cost(a) < cost(b) : error(a) < error(b); });
  std::vector<std::size_t> front;
  for (const std::size_t i : order)
    if (front.empty() || error(i) < error(front.back())) front.push_back(i);
  return front;
}

std::optional<std::size_t> cheapest(const Goal& q, std::size_t index, const std::vector<Measured>& all, double target) {
  for (const std::size_t i : pareto(q, index, all, false))
    if (*error_of(q, all[i].values[index]) <= target) return i;
  return std::nullopt;
}

std::optional<std::size_t> best_within(const Goal& q, std::size_t index, const std::vector<Measured>& all, double budget) {
  std::optional<std::size_t> best;
  for (const std::size_t i : pareto(q, index, all, false))
    if (all[i].cpu <= budget) best = i;
  return best;
}

std::string what_limits(const Goal& q, std::size_t index, const std::vector<Measured>& all) {
  std::string worst;
  double most = -1;
  for (const auto& [knob, word] : {std::pair{"time step", "the step"}, {"points, simpson", "the points"}}) {
    const Series series = series_of(knob, index, all);
    if (series.size() < 2) continue;
    // what the other knobs leave when this one is at its limit
    Goal own = q;
    const auto left = error_of(own, richardson(series, 2).value);
    if (left && *left > most) most = *left, worst = word;
  }
  if (worst.empty()) return "the scene itself: no knob moves the answer";
  // With one knob at its limit the rest is the other's: name that one.
  const bool both = !series_of("time step", index, all).empty() && !series_of("points, simpson", index, all).empty();
  if (!both) return q.expected ? "what the scene is made of, not " + worst : worst;
  return worst == "the step" ? "the points, not the step," : "the step, not the points,";
}

std::string plain_sentence(const Goal& q, std::size_t index, const std::vector<Measured>& all) {
  const std::vector<std::size_t> front = pareto(q, index, all, false);
  if (front.empty()) return fmt::format("{}: no run gave a value.", q.name);
  std::string text;
  double told = std::numeric_limits<double>::infinity();
  std::vector<std::string> parts;
  for (const std::size_t i : front) {
    const double error = *error_of(q, all[i].values[index]);
    if (!parts.empty() && error > 0.3 * told) continue;  // only what is worth another sentence
    told = error;
    const std::string with = all[i].setting.knob.empty() ? "as the scene is" : "with " + all[i].setting.name;
    parts.push_back(parts.empty() ? fmt::format("{} in {} costs {} {}", error_text(q, error), q.name, seconds_text(all[i].cpu), with)
                                  : fmt::format("{} costs {} {}", error_text(q, error), seconds_text(all[i].cpu), with));
    if (parts.size() == 4) break;
  }
  for (const auto& part : parts) text += (text.empty() ? "" : "; ") + part;
  const double least = *error_of(q, all[front.back()].values[index]);
  return text + fmt::format("; below {} {} are the error.",
                            error_text(q, std::max(least, q.reference != 0 ? q.uncertainty / std::fabs(q.reference) : q.uncertainty)),
                            what_limits(q, index, all));
}

}  // namespace erbs
