#include "engine/study/sweep/design.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "engine/base/random.h"

namespace erbs::study {
namespace {

constexpr std::int64_t most_points = 10'000'000;

Random random_of(double seed) {
  Random random;
  std::memcpy(&random.state, &seed, sizeof random.state);
  return random;
}

Axis axis_of(const std::vector<Range>& ranges, int n) {
  Axis axis;
  for (const Range& range : ranges) axis.params.push_back(range.param);
  axis.rows.assign(std::size_t(n), std::vector<Value>(ranges.size()));
  return axis;
}

}  // namespace

double in_range(const Range& range, double share) {
  if (!range.log) return range.lo + share * (range.hi - range.lo);
  return range.lo * std::exp(share * std::log(range.hi / range.lo));
}

std::string text_of(const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("{}", *number);
  return std::get<std::string>(value);
}

std::string expression_of(const Value& value) {
  if (std::holds_alternative<double>(value)) return text_of(value);
  std::string out = "\"";
  for (const char c : std::get<std::string>(value)) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

Axis latin_hypercube(const std::vector<Range>& ranges, int n, double seed) {
  Axis axis = axis_of(ranges, n);
  Random random = random_of(seed);
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    std::vector<int> strata(static_cast<std::size_t>(n));
    std::iota(strata.begin(), strata.end(), 0);
    for (std::size_t i = strata.size(); i > 1; --i) std::swap(strata[i - 1], strata[std::size_t(random.uniform() * double(i))]);
    for (std::size_t i = 0; i < strata.size(); ++i)
      axis.rows[i][k] = in_range(ranges[k], (double(strata[i]) + random.uniform()) / double(n));
  }
  return axis;
}

Axis random_points(const std::vector<Range>& ranges, int n, double seed) {
  Axis axis = axis_of(ranges, n);
  Random random = random_of(seed);
  for (auto& row : axis.rows)
    for (std::size_t k = 0; k < ranges.size(); ++k) row[k] = in_range(ranges[k], random.uniform());
  return axis;
}

std::int64_t point_count(const Plan& plan) {
  std::int64_t count = 1;
  for (const Axis& axis : plan.axes) {
    count *= std::int64_t(axis.rows.size());
    if (count > most_points)
      throw Error(fmt::format("study: more than {} points; a study of fewer values, or of latin{{ n = ... }}, says as much", most_points),
                  plan.place);
  }
  return count;
}

Point point_at(const Plan& plan, std::int64_t index) {
  std::vector<const std::vector<Value>*> rows(plan.axes.size());
  for (std::size_t a = plan.axes.size(); a-- > 0;) {
    const auto n = std::int64_t(plan.axes[a].rows.size());
    rows[a] = &plan.axes[a].rows[std::size_t(index % n)];
    index /= n;
  }
  Point point;
  for (std::size_t a = 0; a < rows.size(); ++a)
    for (std::size_t k = 0; k < rows[a]->size(); ++k) point.emplace_back(plan.axes[a].params[k], (*rows[a])[k]);
  return point;
}

std::vector<std::string> varied_params(const Plan& plan) {
  std::vector<std::string> params;
  for (const Axis& axis : plan.axes) params.insert(params.end(), axis.params.begin(), axis.params.end());
  return params;
}

void order_grids(Plan& plan, const std::vector<std::string>& params) {
  const auto place = [&](const Axis& axis) { return std::find(params.begin(), params.end(), axis.params.front()); };
  for (auto first = plan.axes.begin(); first != plan.axes.end();) {
    const auto last = std::find_if(first, plan.axes.end(), [&](const Axis& axis) { return axis.group != first->group; });
    if (first->by_scene) std::stable_sort(first, last, [&](const Axis& a, const Axis& b) { return place(a) < place(b); });
    first = last;
  }
}

}  // namespace erbs::study
