// Many runs of one scene with a parameter changed: a threshold by bisection, an order of convergence, an ensemble. What each asks
// of its runs and makes of their answers; how the runs are carried out is children.h.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/error.h"

namespace erbs {

struct Study {
  enum class Kind { bisect, converge, ensemble } kind = Kind::bisect;
  std::string name;            // stem of its metrics
  std::string param;           // of the scene: what the runs change
  std::string unit;            // of the answer
  bool collapse = false;       // the answer is collapse.collapsed, not a function of the scene's own
  double lo = 0, hi = 0;       // bisect: where it stands, where it collapses
  double rel = 0.01;           // bisect: width of the last bracket over its larger end
  int points = 3;              // bisect: runs between the ends at a time; not by the machine, so that the answer is the same on all
  std::vector<double> values;  // converge
  bool finest = false;         // converge: the error is the distance from the answer at the smallest value
  int n = 0;                   // ensemble
  double seed = 1;             // ensemble: of the seeds of its runs
  Place place;
};

// What one run said. No value: `reason` says why (a crash, a divergence, a NaN, a mistake of the scene).
struct Answer {
  double x = 0;  // of the parameter
  std::optional<double> value;
  std::string reason;
  double wall_s = 0;
  double updates = 0;  // contact points evaluated
};

// Runs the scene at each x, side by side; the answers in the order asked.
using RunAll = std::function<std::vector<Answer>(const std::vector<double>&)>;

struct StudyResult {
  std::vector<std::pair<std::string, std::optional<double>>> metrics;  // names as metric_names
  std::string trouble;                                                 // why a metric has no value; "" where all do
  double updates = 0;                                                  // contact points its runs evaluated
};

StudyResult carry_out(const Study& study, const RunAll& runs);
std::vector<std::string> metric_names(const Study& study);

// The seeds of an ensemble: whole numbers below 2^31, all different streams for different `seed` (splitmix64, Steele, Lea and
// Flood 2014).
std::vector<double> seeds(double seed, int n);

}  // namespace erbs
