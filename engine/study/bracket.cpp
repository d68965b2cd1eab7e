#include "engine/study/bracket.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/error.h"

namespace erbs::study {

std::string said(const Answer& a) { return fmt::format("at {:.10g}: {}", a.x, a.reason); }

std::string first_reason(const std::vector<Answer>& answers) {
  for (const Answer& a : answers)
    if (!a.value) return said(a);
  return "";
}

Bracket::Bracket(double lo, double hi, double rel, int points) : first_(lo), last_(hi), rel_(rel), points_(points) {}

std::vector<double> Bracket::next() const {
  if (!trouble_.empty()) return {};
  if (!asked_) return {first_, last_};
  std::vector<double> xs;
  if (std::fabs(hi() - lo()) > last_width())
    for (int i = 1; i <= points_; ++i) xs.push_back(at(lo_ + (hi_ - lo_) * i / (points_ + 1)));
  return xs;
}

// A threshold of zero has no larger end, which is what the share of the range is for. The last term keeps the values of a round apart.
double Bracket::last_width() const {
  constexpr double least = 1e-3;  // share of the range
  const double size = std::max({std::fabs(lo()), std::fabs(hi()), least * std::fabs(last_ - first_)});
  const double rounding = std::numeric_limits<double>::epsilon() * std::max(std::fabs(first_), std::fabs(last_));
  return std::max(rel_ * size, 8.0 * (points_ + 1) * rounding);
}

void Bracket::take_ends(const std::vector<Answer>& ends) {
  asked_ = true;
  if (!ends[0].value || !ends[1].value) {
    trouble_ = "no answer at an end: " + first_reason(ends);
    return;
  }
  const bool low = *ends[0].value != 0, high = *ends[1].value != 0;
  const bool rises = last_ > first_;  // lo may be the larger end
  if (low && high) trouble_ = fmt::format("the verdict is yes at lo = {:.6g} already; {} it", first_, rises ? "lower" : "raise");
  else if (low) trouble_ = fmt::format("the verdict is yes at lo = {:.6g} and no at hi = {:.6g}; exchange them", first_, last_);
  else if (!high) trouble_ = fmt::format("the verdict is no at hi = {:.6g} still; {} it", last_, rises ? "raise" : "lower");
  else known_ = true;
}

void Bracket::take(const std::vector<Answer>& answers) {
  if (!asked_) return take_ends(answers);
  const double from = lo_, to = hi_;
  const auto share = [&](std::size_t i) { return from + (to - from) * double(i + 1) / (points_ + 1); };
  for (std::size_t i = 0; i < answers.size(); ++i)
    if (answers[i].value && *answers[i].value != 0) hi_ = std::min(hi_, share(i));
  for (std::size_t i = 0; i < answers.size(); ++i)
    if (answers[i].value && *answers[i].value == 0 && share(i) < hi_) lo_ = std::max(lo_, share(i));
  if (lo_ == from && hi_ == to)
    trouble_ = fmt::format("no run between {:.6g} and {:.6g} gave an answer: {}", at(from), at(to), first_reason(answers));
}

}  // namespace erbs::study
