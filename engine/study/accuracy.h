// What accuracy costs: one scene run with each of its knobs turned alone, errors against what is expected or against a Richardson
// reference, and what follows: slopes, the Pareto front, the cheapest setting for a target. Plain data and sums; the runs are made
// by the caller.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace erbs {

// A knob at one of its stops.
struct Setting {
  std::string knob;                // "time step", "points, midpoint", ...; "" for the scene as it is
  std::string name;                // "dt 0.25 of the limit", "9 points, midpoint"
  std::string line;                // what to put into the scene for it
  std::vector<std::string> words;  // what to say to erbs run for it
  double size = 0;                 // error is expected to fall with a power of it: dt over its limit, 1 / points along a side, ...
  bool advised = true;             // false: run for comparison only, such as a solver that feeds itself energy
};

struct Measured {
  Setting setting;
  std::vector<std::optional<double>> values;  // by quantity; none where the run failed
  std::string reason;                         // why it failed
  double cpu = 0, updates = 0;                // s of processor; contact points evaluated
};

// Step and points together, for comparison with the knobs turned alone: no curve is drawn through its stops.
constexpr const char* quality_knob = "quality";

// A number the study is about, and what it should be.
struct Goal {
  std::string name, unit;
  std::optional<double> expected;  // of the scene
  double reference = 0, uncertainty = 0;
  std::string from;  // where the reference is from; "" while there is none
};

// Richardson (1911): the limit of values at sizes h1 < h2 (< h3), of the order that the three show, else `order`. Its uncertainty is
// its distance from the finest value.
struct Limit {
  double value = 0, uncertainty = 0, order = 0;
};
Limit richardson(const std::vector<std::pair<double, double>>& size_and_value, double order);

// Settles what each quantity is compared with: the expected value, else the value of the scene as it is, corrected by what is left of
// each of the knobs `time step` and `points, simpson` to its limit (first order in their mutual influence).
void settle_reference(Goal& quantity, std::size_t index, const std::vector<Measured>& all);

// |value - reference| relative to the reference where it is not zero.
std::optional<double> error_of(const Goal& quantity, const std::optional<double>& value);

struct Curve {
  std::string knob;
  std::vector<std::size_t> at;  // into the measured, from coarse to fine
  std::optional<double> slope;  // of ln error over ln size, over the points that are above what the other knobs leave
};
std::vector<Curve> curves_of(const Goal& quantity, std::size_t index, const std::vector<Measured>& all);

// Of those advised the ones that no other beats in both error and cost, from cheap to dear. `by_updates`: cost in evaluations (where there are any),
// which no machine changes, else in seconds.
std::vector<std::size_t> pareto(const Goal& quantity, std::size_t index, const std::vector<Measured>& all, bool by_updates);

// "An error of 2 % in the collapse multiplier costs 3.1 s with ...; below 0.1 % the points, not the step, are the error."
std::string plain_sentence(const Goal& quantity, std::size_t index, const std::vector<Measured>& all);

// The cheapest (in evaluations) that is at least as accurate as `target`; the most accurate within `budget` seconds. None: there is none.
std::optional<std::size_t> cheapest(const Goal& quantity, std::size_t index, const std::vector<Measured>& all, double target);
std::optional<std::size_t> best_within(const Goal& quantity, std::size_t index, const std::vector<Measured>& all, double budget);
// What is left of the error of the best setting, by its largest part: "the points, not the step, are the error".
std::string what_limits(const Goal& quantity, std::size_t index, const std::vector<Measured>& all);

}  // namespace erbs
