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
  static const std::vector<ComparedQuantity> list{
      {"peak", "", "error of the peak of each column"},
      {"rms", "", "error of the root mean square of each column"},
      {"difference", "", "rms of run - reference over the peak of the reference, of each column"},
      {"lag", "s", "lag of each column that remains after the alignment"},
      {"shift", "s", "lag that the alignment found"},
      {"correlation", "", "Pearson's coefficient of each column"},
      {"frequency", "", "error of the dominant frequency of each column"},
      {"collapse_time", "s", "error of the time of collapse"},
      {"direction", "deg", "angle between the directions of collapse"},
      {"sequence", "", "0 if groups fall in the same order, otherwise 1"},
      {"iou", "", "mean overlap of the silhouettes in the pictures"},
      {"ssim", "", "mean structural similarity of the pictures"},
      {"flow", "deg", "mean angle between the motions in the pictures"},
      {"camera", "px", "reprojection residual of the marked points"},
  };
  return list;
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
