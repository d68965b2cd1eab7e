// Studies: many runs of one scene with a parameter varied. Kinds are a threshold by bisection, an order of convergence, and an ensemble.
// This file chooses the runs and evaluates their answers; sweep/ makes them.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/study/bracket.h"

namespace erbs::study {

struct Study {
  enum class Kind { bisect, converge, ensemble } kind = Kind::bisect;
  std::string name;            // stem of its metrics
  std::string param;           // parameter of the scene that the runs vary
  std::string unit;            // of the answer
  bool collapse = false;       // the answer is collapse.collapsed, not a function of the scene
  double lo = 0, hi = 0;       // bisect: value at which the structure stands, value at which it collapses
  double rel = 0.01;           // bisect: width of the last bracket over its larger end, or over a thousandth of hi - lo
  int points = 3;              // bisect: runs between the ends at a time; the same on all machines, and so is the answer
  std::vector<double> values;  // converge
  bool finest = false;         // converge: errors are distances from the answer at the smallest value
  int n = 0;                   // ensemble: number of runs
  double seed = 1;             // ensemble: seed of the seeds of its runs
  Place place;
};

// Runs the scene at each x, in parallel; the answers keep the order of the values.
using RunAll = std::function<std::vector<Answer>(const std::vector<double>&)>;

struct StudyResult {
  std::vector<std::pair<std::string, std::optional<double>>> metrics;  // names as metric_names
  std::string trouble;                                                 // why a metric has no value; "" if all have one
};

// What messages call the function of the scene that each run answers: value of ensemble "falls_at".
std::string question_words(const Study& study);

StudyResult carry_out(const Study& study, const RunAll& runs);
std::vector<std::string> metric_names(const Study& study);

// Seeds of an ensemble: whole numbers below 2^31, with a different sequence for each `seed` (splitmix64, Steele, Lea and Flood 2014).
std::vector<double> seeds(double seed, int n);

}  // namespace erbs::study
