// Cost of accuracy. One scene is run with each of its knobs varied alone. Errors are measured against the expected value, or else against a
// Richardson limit. Results are slopes, the Pareto front, and the cheapest setting for a target. Plain data and sums; the caller makes the
// runs.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace erbs::study {

// One setting of a knob.
struct Setting {
  std::string knob;                // "time step", "points, midpoint", ...; "" for the scene as it is
  std::string name;                // "dt 0.25 of the limit", "9 points, midpoint"
  std::string line;                // line to add to the scene for it
  std::vector<std::string> words;  // arguments of erbs run for it
  double size = 0;                 // the error should fall with a power of it: dt over its limit, 1 / points along a side, ...
  bool advised = true;             // false: for comparison only, such as a solver that feeds energy
};

struct Measured {
  Setting setting;
  std::vector<std::optional<double>> values;  // per quantity; none if the run failed
  std::string reason;                         // reason of a failure
  double cpu = 0, updates = 0;                // s, processor time; contact points evaluated
};

// Step and points varied together, for comparison with single knobs. No curve is drawn through its settings.
constexpr const char* quality_knob = "quality";

// A quantity of the study, with its reference value.
struct Goal {
  std::string name, unit;
  std::optional<double> expected;  // by the scene
  double reference = 0, uncertainty = 0;
  std::string from;  // source of the reference; "" while there is none
};

// Richardson (1911): limit of the values at sizes h1 < h2 (< h3), with the order that the three values show, else with `order`. The
// uncertainty is the distance of the limit from the finest value.
struct Limit {
  double value = 0, uncertainty = 0, order = 0;
};
Limit richardson(const std::vector<std::pair<double, double>>& size_and_value, double order);

// Chooses the reference of a quantity: the expected value, else the value of the scene as it is, corrected for two knobs. `time step` and
// `points, simpson` each contribute their distance to the limit, without their mutual influence.
void settle_reference(Goal& quantity, std::size_t index, const std::vector<Measured>& all);

// |value - reference|, relative to the reference unless that is zero.
std::optional<double> error_of(const Goal& quantity, const std::optional<double>& value);

struct Curve {
  std::string knob;
  std::vector<std::size_t> at;  // indices into the measurements, from coarse to fine
  std::optional<double> slope;  // of ln error over ln size; none if the error follows no line
};
std::vector<Curve> curves_of(const Goal& quantity, std::size_t index, const std::vector<Measured>& all);

// Advised settings that no other advised setting beats in both error and cost, from cheap to expensive. `by_updates`: cost in evaluations,
// if known, which does not depend on the machine; else in seconds.
std::vector<std::size_t> pareto(const Goal& quantity, std::size_t index, const std::vector<Measured>& all, bool by_updates);

// "An error of 2 % in the collapse multiplier costs 3.1 s with ...; below 0.1 % the points, not the step, are the error."
std::string plain_sentence(const Goal& quantity, std::size_t index, const std::vector<Measured>& all);

// The cheapest setting (in evaluations) with an error up to `target`; the most accurate one within `budget` seconds. None if there is none.
std::optional<std::size_t> cheapest(const Goal& quantity, std::size_t index, const std::vector<Measured>& all, double target);
std::optional<std::size_t> best_within(const Goal& quantity, std::size_t index, const std::vector<Measured>& all, double budget);
// Names the largest part of the remaining error of the best setting: "the points, not the step, are the error".
std::string what_limits(const Goal& quantity, std::size_t index, const std::vector<Measured>& all);

}  // namespace erbs::study
