// Result of a push: the largest load in equilibrium, with its bracket, and what had happened to the structure by then.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/record/format/json.h"
#include "engine/record/performance/performance.h"

namespace erbs {

// A state of equilibrium on the curve of a push.
struct CurvePoint {
  double multiplier = 0;              // share of g or of the pattern; of a tilt the tangent of its angle
  double displacement = 0;            // m, of the monitored point along the push
  double most = 0;                    // m, of the block that moved most along the push
  double base_shear = 0;              // N, along the push, on fixed blocks; of the push and constant forces, without the weight
  double base_shear_over_weight = 0;  // of the weight of the moving blocks; NaN without gravity
  int opening = 0, slid = 0;          // joints that are open, that have slid
  double unbalanced = 0;              // mean unbalanced force over mean applied force
  double steps = 0;                   // of relaxation
};

// What limit analysis says of the multiplier (engine/analysis/limit).
struct LimitBracket {
  bool stands = true, unbounded = false;  // without the push; no multiple of it makes a mechanism
  bool converged = false;                 // the iteration for friction without dilatancy has settled
  double lower = 0, upper = 0;            // of its last round
  double associated_lower = 0, associated_upper = 0;
  std::optional<double> smooth;  // the multiplier without friction in upright joints, where the push bears less than with it
  std::string mechanism;
};
struct LimitBeside {
  LimitBracket dry;                    // without the bond of the mortar
  std::optional<LimitBracket> bonded;  // with it, as if it were ductile; none: there is no bond
};

struct Capacity {
  std::string kind;                                        // tilt | pushover
  CurvePoint peak;                                         // the state with the largest multiplier
  std::optional<double> above;                             // the least multiplier without equilibrium; none: none was met
  bool past_peak = false;                                  // control by displacement: the curve falls at its end
  bool gravity_alone = false;                              // there is no equilibrium without the push
  std::string mechanism, course;                           // in a word, and in words
  std::vector<std::pair<std::string, std::string>> walls;  // what each wall does, by group
  int states = 0, attempts = 0;
  double relaxation_steps = 0;
  std::optional<LimitBeside> limit;
  double worst_unbalanced = 0;             // of all states
  std::optional<Performance> performance;  // of a scene with a spectrum
};

Json to_json(const Capacity& capacity);

}  // namespace erbs
