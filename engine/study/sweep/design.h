// What a sweep varies: the points of a study, each a value for every varied param of its scene. Plain data, as the study file says.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/base/error.h"

namespace erbs::study {

using Value = std::variant<double, std::string>;  // of a param: a number, or a word such as the name of a record
std::string text_of(const Value& value);          // for a table: shortest digits that read back to the same number, or the word
std::string expression_of(const Value& value);    // for -D: the same, a word in quotes

// Params that change together, with their values row by row.
struct Axis {
  std::vector<std::string> params;
  std::vector<std::vector<Value>> rows;  // [rows][params]
  int group = 0;                         // number of the call that made it
  double noise = 0;                      // m and rad, of perturbations{}
  bool by_scene = false;                 // of a grid{}: the axes of the group follow the order of the scene's params
  Place place;
};

// Range of a random param. The values are uniform in x, or in ln x.
struct Range {
  std::string param;
  double lo = 0, hi = 1;
  bool log = false;
};
// Latin hypercube (McKay, Beckman and Conover 1979): each of n equal strata of each range holds one value, at a random place in it.
double in_range(const Range& range, double share);  // the value at a share of the range, 0 to 1
Axis latin_hypercube(const std::vector<Range>& ranges, int n, double seed);
Axis random_points(const std::vector<Range>& ranges, int n, double seed);  // independent of each other

// Bisection of a param at every point.
struct Bisection {
  std::string param;
  double lo = 0, hi = 0;
  double rel = 0.01;
  int points = 1;
  std::string key = "collapse.collapsed";  // of metrics.json; the verdict is yes where it is true or not 0, ...
  std::optional<double> above;             // ... or above this number
  bool stability = false;                  // a run that diverged may answer yes, never no: for limits of stability
  Place place;
};

// A known curve beside the results in the figure.
struct PlanCurve {
  std::string label;
  std::vector<double> x, y;
};

// Calibration: params of the scene are fitted so that its metrics come near to known values.
struct CalibrationStage {
  std::vector<Range> params;  // fitted by least squares; or one that is raised until ...
  std::string key;            // ... this key of metrics.json is below a number; "": least squares
  double below = 0;
};
struct CalibrationTarget {
  std::string label;
  std::vector<std::string> keys;  // of metrics.json
  std::vector<double> values;     // wanted, as many as keys
  double scale = 1;               // a residual is (got - wanted) / scale
};
struct KnownHistory {
  std::string column, label, known;  // of histories.csv; label of the axis; of the known curve
  std::vector<double> t, values;     // s, of the known curve
};
struct Calibration {
  std::vector<CalibrationStage> stages;  // one after the other; a stage keeps what those before it have found
  std::vector<CalibrationTarget> targets;
  std::optional<KnownHistory> history;
  double rel = 1e-3;       // of a range: the smallest step of a fit
  int rounds = 20;         // of a stage, at most
  bool rel_given = false;  // rel is the width of the last bracket of a raise too, which is 0.02 of its range otherwise
};

// Fragility of the structure from the runs of the study (study/fragility).
struct FragilityPlan {
  std::string im;                    // intensity: a varied or bisected param, or a key of metrics.json
  std::string collapse = "verdict";  // 1 or 0: a key of metrics.json, or the verdict of a bisection
  std::optional<double> above;       // collapse is where the key lies above this number
  std::vector<std::string> damage;   // keys whose fractiles are wanted
  std::vector<std::string> by;       // params that tell structures apart: one fragility for each combination
  std::string along;                 // the param that grows within a case; "": im, if it is one
  Place place;
  bool falls = false;  // time and direction of the collapses are wanted
};

// Where the first key of metrics.json tells a collapse, the second tells whether what stands has come to rest.
inline constexpr const char *collapsed_key = "collapse.collapsed", *moving_key = "collapse.moving_fraction";
// The keys of metrics.json that falls takes: s, and the unit vector in plan.
inline constexpr std::array fall_keys = {"collapse.time_s", "collapse.direction.0", "collapse.direction.1"};

constexpr const char* perturbation = "perturbation";  // name of the axis of perturbations{}: seeds of a noise, and no param of the scene
constexpr const char* variant = "setting";            // name of an axis whose values name Sweep::variants, and no param either
inline bool is_perturbation(const Axis& axis) { return axis.params == std::vector<std::string>{perturbation}; }

struct Plan {
  std::string scene;                 // as the study file says
  std::vector<Axis> axes;            // outermost first
  std::optional<Bisection> bisect;   // none: one run per point
  std::vector<std::string> collect;  // keys of metrics.json
  std::string question;              // what runs call the metric "study", their answer to a study of a scene; "" in a sweep
  std::string keep = "metrics";      // of each run: none, metrics, all
  double max_wall = 0, memory = 0;   // s and bytes, of each run; 0: no limit
  std::string title;                 // of the figure
  std::string x, y;                  // labels of its axes; "": the columns
  std::string split;                 // param each of whose values has a figure of its own; "": none
  std::vector<PlanCurve> curves;
  std::optional<Calibration> calibration;  // of calibration{}: then axes holds the ends of the fitted ranges, for checks only
  std::optional<FragilityPlan> fragility;
  double noise = 1e-9;  // m and rad, of perturbations{}
  Place place;
};

using Point = std::vector<std::pair<std::string, Value>>;  // params with their values

// Number of points: the product of the axes. Throws Error beyond ten million.
std::int64_t point_count(const Plan& plan);
Point point_at(const Plan& plan, std::int64_t index);  // the last axis changes fastest
std::vector<std::string> varied_params(const Plan& plan);

// Sorts the axes of each grid in the order of the scene's params: a table of Lua has no order.
void order_grids(Plan& plan, const std::vector<std::string>& params);

}  // namespace erbs::study
