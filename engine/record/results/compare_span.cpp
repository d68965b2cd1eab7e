#include "engine/record/results/compare_span.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"

namespace erbs {
namespace {

constexpr double least_share = 0.95;  // rows and frames end up to some steps apart, collapses stop runs some rows apart

// A run that was stopped says nothing of what would have come.
bool has_ended(const std::string& status) { return status.empty() || status == "completed" || status == "inaccurate"; }

std::string seconds(double t) { return fmt::format("{:.4g} s", t); }

}  // namespace

ComparedSpan span_of(const std::vector<ColumnPair>& pairs, const TimeShift& shift, const TimeSpan& chosen, bool two_runs) {
  double first = HUGE_VAL, last = -HUGE_VAL, first_reference = HUGE_VAL, last_reference = -HUGE_VAL;  // s
  for (const ColumnPair& pair : pairs) {
    first = std::min(first, pair.run.t.front()), last = std::max(last, pair.run.t.back());
    first_reference = std::min(first_reference, pair.reference.t.front());
    last_reference = std::max(last_reference, pair.reference.t.back());
  }
  ComparedSpan span;
  span.run = last - first, span.reference = last_reference - first_reference;
  span.from = std::max({first - shift.lag, first_reference, chosen.from});
  span.to = std::min({last - shift.lag, last_reference, chosen.to});
  span.chosen = std::isfinite(chosen.from) || std::isfinite(chosen.to);
  const double from = std::isfinite(chosen.from) ? chosen.from : first_reference,
               to = std::isfinite(chosen.to) ? chosen.to : std::max(last - shift.lag, last_reference);
  span.wanted = span.chosen ? to - from : (two_runs ? std::max(span.run, span.reference) : span.reference) - std::abs(shift.lag);
  return span;
}

std::vector<std::string> gaps_of(const ComparedSpan& span) {
  std::vector<std::string> gaps;
  const auto say_unfinished = [&](const char* which, const std::string& status) {
    if (!span.chosen && !has_ended(status))
      gaps.push_back(
          fmt::format("the {} is {}, so that what would have come is not compared; let it end with erbs run --resume, or say "
                      "with --time T0:T1 which part you mean",
                      which, status));
  };
  say_unfinished("run", span.status_run);
  say_unfinished("reference", span.status_reference);
  if (span.share() < least_share)
    gaps.push_back(fmt::format("only {:.2g} % of {} ({}) are compared; {}", 100 * span.share(),
                               span.chosen                     ? "the span that --time asks for"
                               : span.status_reference.empty() ? "the measurement"
                                                               : "the longer run",
                               seconds(span.wanted), span.chosen ? "ask for what both have" : "say with --time T0:T1 which part you mean"));
  return gaps;
}

std::string table_of(const ComparedSpan& span) {
  std::string text = fmt::format("span        {:.4g} to {} in common{}: run of {}, reference of {}\n", span.from, seconds(span.to),
                                 span.chosen ? ", by --time" : "", seconds(span.run), seconds(span.reference));
  text += fmt::format("status      run {}", span.status_run);
  return text + (span.status_reference.empty() ? "" : ", reference " + span.status_reference) + "\n";
}

Json json_of(const ComparedSpan& span) {
  Json json{{"from_s", span.from},           {"to_s", span.to},       {"run_s", span.run},
            {"reference_s", span.reference}, {"share", span.share()}, {"status_run", span.status_run}};
  if (!span.status_reference.empty()) json["status_reference"] = span.status_reference;
  json["whole"] = gaps_of(span).empty();
  return json;
}

}  // namespace erbs
