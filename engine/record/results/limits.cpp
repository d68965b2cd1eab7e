#include "engine/record/results/limits.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/spelling.h"
#include "engine/base/text.h"

namespace erbs {
namespace {

std::string without_spaces(std::string text) {
  text.erase(std::remove(text.begin(), text.end(), ' '), text.end());
  return text;
}

template <double ColumnErrors::*member>
std::vector<double> of_columns(const RunComparison& c) {
  if (only_ground(c))
    throw Error(
        "--expect: the two have only the motion of the ground in common, which is given and proves nothing; record the response in both "
        "under the same names, or pair their columns by --columns RUN=REFERENCE");
  std::vector<double> values;
  for (const ColumnErrors& e : c.columns) values.push_back(e.*member);
  return values;
}

std::vector<double> of_collapse(const RunComparison& c, double value) {
  return c.collapse.known ? std::vector<double>{value} : std::vector<double>{};
}

Limit limit_of(const std::string& part) {
  std::vector<std::string> known;
  for (const ComparedQuantity& q : compared_quantities()) known.emplace_back(q.name);
  const std::size_t at = part.find_first_of("<>");
  if (part.empty() || at == std::string::npos)
    throw Error(
        fmt::format("--expect: {} is no limit; write QUANTITY<BOUND, such as peak<5%", part.empty() ? "an empty part" : shown(part, 60)));
  Limit limit{part, part.substr(0, at), part[at], NAN};
  if (std::find(known.begin(), known.end(), limit.quantity) == known.end())
    throw Error(fmt::format("--expect: there is no quantity {}{}", shown(limit.quantity, 60), did_you_mean(limit.quantity, known)));
  std::string number = part.substr(at + 1);
  double factor = 1;
  if (number.ends_with("%")) number.pop_back(), factor = 0.01;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), limit.bound);
  if (error != std::errc() || end != number.data() + number.size() || !std::isfinite(limit.bound) || limit.bound < 0)
    throw Error(fmt::format("--expect: {} has no bound that is a number of zero or more; write peak<5% or lag<0.01", shown(part, 60)));
  limit.bound *= factor;
  return limit;
}

}  // namespace

const std::vector<ComparedQuantity>& compared_quantities() {
  using Comparison = const RunComparison&;
  static const std::vector<ComparedQuantity> list{
      {"peak", "", "error of the peak of each column", of_columns<&ColumnErrors::peak_error>, ""},
      {"rms", "", "error of the root mean square of each column", of_columns<&ColumnErrors::rms_error>, ""},
      {"difference", "", "rms of run - reference over the peak of the reference, of each column", of_columns<&ColumnErrors::difference>,
       ""},
      {"lag", "s", "lag of each column that remains after the alignment", of_columns<&ColumnErrors::lag>, ""},
      {"shift", "s", "lag that the alignment found", [](Comparison c) { return std::vector{c.shift.lag}; }, "alignment.lag_s"},
      {"correlation", "", "Pearson's coefficient of each column", of_columns<&ColumnErrors::correlation>, "alignment.correlation"},
      {"frequency", "", "error of the dominant frequency of each column", of_columns<&ColumnErrors::frequency_error>, ""},
      {"collapse_time", "s", "error of the time of collapse", [](Comparison c) { return of_collapse(c, c.collapse.time); }, ""},
      {"direction", "deg", "angle between the directions of collapse", [](Comparison c) { return of_collapse(c, c.collapse.direction); },
       "direction_error_deg"},
      {"sequence", "", "0 if groups fall in the same order, otherwise 1",
       [](Comparison c) { return of_collapse(c, c.collapse.same_sequence ? 0 : 1); }, ""},
      {"iou", "", "mean overlap of the silhouettes in the pictures", nullptr, "iou_mean"},
      {"ssim", "", "mean structural similarity of the pictures", nullptr, "ssim_mean"},
      {"flow", "deg", "mean angle between the motions in the pictures", nullptr, "flow_angle_mean_deg"},
      {"camera", "px", "reprojection residual of the marked points", nullptr, "camera.residual_px"},
  };
  return list;
}

std::string compared_names(bool of_film) {
  std::string names;
  for (const ComparedQuantity& q : compared_quantities()) {
    if (of_film ? *q.of_film == '\0' : q.of_runs == nullptr) continue;
    names += fmt::format("{}{}{}", names.empty() ? "" : ", ", q.name, *q.unit == '\0' ? "" : fmt::format(" ({})", q.unit));
  }
  return names;
}

std::vector<double> values_of(const RunComparison& comparison, const std::string& quantity) {
  for (const ComparedQuantity& q : compared_quantities())
    if (quantity == q.name && q.of_runs != nullptr) return q.of_runs(comparison);
  return {};
}

std::vector<double> values_of(const Json& frames, const std::string& quantity) {
  for (const ComparedQuantity& q : compared_quantities()) {
    if (quantity != q.name || *q.of_film == '\0') continue;
    const Json* value = find_key(frames, q.of_film);
    return {value != nullptr && value->is_number() ? value->get<double>() : NAN};
  }
  return {};
}

std::vector<Limit> limits_of(const std::string& text) {
  std::vector<Limit> limits;
  const std::string all = without_spaces(text);
  for (std::size_t at = 0; at <= all.size();) {
    const std::size_t comma = std::min(all.find(',', at), all.size());
    limits.push_back(limit_of(all.substr(at, comma - at)));
    at = comma + 1;
  }
  return limits;
}

std::vector<Judged> judge(const std::vector<Limit>& limits, const std::function<std::vector<double>(const std::string&)>& values) {
  std::vector<Judged> judged;
  for (const Limit& limit : limits) {
    Judged one{limit, values(limit.quantity), 0, false};
    if (one.values.empty()) throw Error(fmt::format("--expect: {} is not measured against this reference; leave it out", limit.quantity));
    one.worst = limit.sign == '<' ? 0 : HUGE_VAL;
    for (const double value : one.values) {
      if (std::isnan(value) || std::isnan(one.worst)) one.worst = NAN;
      else one.worst = limit.sign == '<' ? std::max(one.worst, std::abs(value)) : std::min(one.worst, value);
    }
    one.passed = limit.sign == '<' ? one.worst < limit.bound : one.worst > limit.bound;
    judged.push_back(one);
  }
  return judged;
}

Json json_of(const std::vector<Judged>& judged) {
  Json list = Json::array();
  for (const Judged& j : judged) list.push_back({{"limit", j.limit.text}, {"worst", j.worst}, {"passed", j.passed}});
  return list;
}

std::string table_of(const std::vector<Judged>& judged) {
  std::string text;
  for (const Judged& j : judged) text += fmt::format("{:<8} {:<24} worst {:.6g}\n", j.passed ? "passed" : "FAILED", j.limit.text, j.worst);
  return text;
}

}  // namespace erbs
