#include "engine/study/study.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "engine/base/random.h"

namespace erbs::study {
namespace {

struct Tally {
  int runs = 0, failed = 0;
  void add(const std::vector<Answer>& answers) {
    runs += int(answers.size());
    failed += int(std::count_if(answers.begin(), answers.end(), [](const Answer& a) { return !a.value; }));
  }
};

StudyResult bisect(const Study& s, const RunAll& runs) {
  StudyResult out;
  Tally tally;
  Bracket bracket(s.lo, s.hi, s.rel, s.points);
  for (std::vector<double> xs = bracket.next(); !xs.empty(); xs = bracket.next()) {
    const std::vector<Answer> answers = runs(xs);
    tally.add(answers);
    bracket.take(answers);
  }
  out.trouble = bracket.trouble();
  out.metrics = {{s.name, bracket.found() ? std::optional(bracket.middle()) : std::nullopt},
                 {s.name + "_lo", bracket.known() ? std::optional(bracket.lo()) : std::nullopt},
                 {s.name + "_hi", bracket.known() ? std::optional(bracket.hi()) : std::nullopt},
                 {s.name + "_runs", tally.runs},
                 {s.name + "_failed", tally.failed}};
  return out;
}

// Slope of ln error over ln value, by least squares.
StudyResult converge(const Study& s, const RunAll& runs) {
  StudyResult out;
  Tally tally;
  const std::vector<Answer> answers = runs(s.values);
  tally.add(answers);
  const auto finest = std::min_element(answers.begin(), answers.end(), [](const Answer& a, const Answer& b) { return a.x < b.x; });
  std::vector<std::pair<double, double>> points;
  std::optional<double> best, least, most;
  double smallest = std::numeric_limits<double>::infinity();
  for (const Answer& a : answers) {
    if (a.value) least = std::min(least.value_or(*a.value), *a.value), most = std::max(most.value_or(*a.value), *a.value);
    if (!a.value || (s.finest && (&a == &*finest || !finest->value))) continue;
    const double error = std::fabs(s.finest ? *a.value - *finest->value : *a.value);
    if (a.x < smallest) smallest = a.x, best = error;
    if (error > 0) points.emplace_back(std::log(a.x), std::log(error));
  }
  std::optional<double> slope;
  if (points.size() >= 2) {
    double x = 0, y = 0, xx = 0, xy = 0;
    for (const auto& [u, v] : points) x += u, y += v;
    x /= double(points.size()), y /= double(points.size());
    for (const auto& [u, v] : points) xx += (u - x) * (u - x), xy += (u - x) * (v - y);
    slope = xy / xx;
  } else if (tally.failed > 0) {  // where all agree, or two values are asked for, there is no slope to find
    out.trouble = "fewer than two errors above zero: " + first_reason(answers);
  }
  out.metrics = {{s.name + "_slope", slope}, {s.name + "_error", best},      {s.name + "_least", least},
                 {s.name + "_most", most},   {s.name + "_runs", tally.runs}, {s.name + "_failed", tally.failed}};
  return out;
}

StudyResult ensemble(const Study& s, const RunAll& runs) {
  StudyResult out;
  Tally tally;
  const std::vector<Answer> answers = runs(seeds(s.seed, s.n));
  tally.add(answers);
  std::vector<double> v;
  for (const Answer& a : answers)
    if (a.value) v.push_back(*a.value);
  std::optional<double> mean, deviation, least, most, median, error;
  if (!v.empty()) {
    double sum = 0, square = 0;
    for (const double x : v) sum += x;
    mean = sum / double(v.size());
    for (const double x : v) square += (x - *mean) * (x - *mean);
    if (v.size() > 1) deviation = std::sqrt(square / double(v.size() - 1)), error = *deviation / std::sqrt(double(v.size()));
    std::sort(v.begin(), v.end());
    least = v.front(), most = v.back();
    median = 0.5 * (v[(v.size() - 1) / 2] + v[v.size() / 2]);
  } else {
    out.trouble = "no run gave an answer: " + first_reason(answers);
  }
  out.metrics = {{s.name + "_mean", mean},       {s.name + "_deviation", deviation}, {s.name + "_least", least},
                 {s.name + "_most", most},       {s.name + "_median", median},       {s.name + "_error", error},
                 {s.name + "_runs", tally.runs}, {s.name + "_failed", tally.failed}};
  return out;
}

}  // namespace

StudyResult carry_out(const Study& study, const RunAll& runs) {
  StudyResult out = study.kind == Study::Kind::bisect     ? bisect(study, runs)
                    : study.kind == Study::Kind::converge ? converge(study, runs)
                                                          : ensemble(study, runs);
  if (!out.trouble.empty()) out.trouble = Error(study.name + ": " + out.trouble, study.place).what();
  return out;
}

std::string question_words(const Study& s) {
  const char* words = s.kind == Study::Kind::bisect     ? "collapsed_when of bisect"
                      : s.kind == Study::Kind::ensemble ? "value of ensemble"
                      : s.finest                        ? "value of converge"
                                                        : "error of converge";
  return fmt::format("{} \"{}\"", words, s.name);
}

std::vector<std::string> metric_names(const Study& s) {
  std::vector<std::string> endings{"", "_lo", "_hi"};
  if (s.kind == Study::Kind::converge) endings = {"_slope", "_error", "_least", "_most"};
  if (s.kind == Study::Kind::ensemble) endings = {"_mean", "_deviation", "_least", "_most", "_median", "_error"};
  std::vector<std::string> names;
  for (const auto& ending : endings) names.push_back(s.name + ending);
  names.push_back(s.name + "_runs");
  names.push_back(s.name + "_failed");
  return names;
}

std::vector<double> seeds(double seed, int n) {
  Random random;
  std::memcpy(&random.state, &seed, sizeof random.state);
  std::vector<double> out;
  for (int i = 0; i < n; ++i) out.push_back(double(random.next() >> 33));
  return out;
}

}  // namespace erbs::study
