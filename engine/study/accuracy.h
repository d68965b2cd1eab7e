// Cost of accuracy. One scene is run with each of its knobs varied alone. Errors are measured against theory, that is the expected value,
// and apart from it against the limit that the scene itself approaches. Results are slopes, the Pareto front, what ends it, and the
// cheapest setting for a target. Plain data and sums; the caller makes the runs.
#pragma once
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/error.h"

namespace erbs::study {

// A param that the scene declares as a knob of accuracy: its error falls from each value to the next.
struct Knob {
  std::string param, name;     // name: in tables and figures
  std::vector<double> values;  // from coarse to fine, above zero, rising or falling
  std::string error;           // key of metrics.json that is itself the error of a run, such as the standard error of a mean; "": none
  Place place;
  double size(double value) const;  // 1 at the finest value, above 1 at the others
};
// What is wrong with the values of a knob, with the remedy; "" if nothing is.
std::string mistake_in(const std::vector<double>& values);

// One setting of a knob.
struct Setting {
  std::string knob;                     // "time step", "points, midpoint", ...; "" for the scene as it is
  std::string name;                     // "dt 0.25 of the limit", "9 points, midpoint"
  std::string line;                     // line to add to the scene for it
  std::vector<std::string> words;       // arguments of erbs run for it
  double size = 0;                      // the error should fall with a power of it: dt over its limit, 1 / points along a side, ...
  bool advised = true;                  // false: for comparison only, such as a solver that feeds energy
  bool declared = false;                // of a knob of the scene; the others of the scene have their finest values
  std::vector<std::string> parts = {};  // of several knobs at once: the names of the settings that have their values alone
};

struct Measured {
  Setting setting;
  std::vector<std::optional<double>> values;  // per quantity; none if the run failed
  std::string reason;                         // reason of a failure
  double cpu = 0, updates = 0;                // s, processor time; contact points evaluated
  std::optional<double> scatter = {};         // standard error of the quantity with Goal::scatters, by Knob::error
};

// Step and points varied together, for comparison with single knobs; all knobs of a scene varied together. No order is fitted to them.
constexpr const char* quality_knob = "quality";
constexpr const char* together_knob = "all knobs together";

// A quantity of the study, with the values that errors are measured by.
struct Goal {
  std::string name, unit;
  std::optional<double> expected;  // by the scene
  double reference = 0, uncertainty = 0;
  std::string from;                             // source of the reference; "" while there is none
  double own_limit = NAN, own_uncertainty = 0;  // of the scene as it is, with finer steps and more points
  bool scatters = false;                        // a statistic with the standard error Measured::scatter
};

// Richardson (1911): limit of the values at sizes h1 < h2 (< h3), with the order from `least` to 4 that the three values show, else with
// `order`. The uncertainty is the distance of the limit from the finest value.
struct Limit {
  double value = 0, uncertainty = 0, order = 0;
};
Limit richardson(const std::vector<std::pair<double, double>>& size_and_value, double order, double least = 0.5);

// Chooses the reference of a quantity: the expected value; else the value of the scene as it is, or at the finest values of its knobs,
// corrected by what is left of each knob. `time step`, `points, simpson` and declared knobs each contribute their distance to the limit,
// without their mutual influence.
void settle_reference(Goal& quantity, std::size_t index, const std::vector<Measured>& all);

// |value - reference|, relative to the reference unless that is zero. At least the standard error of the run and, with several knobs at
// once, the error of each alone: errors that cancel by chance are no accuracy.
std::optional<double> error_of(const Goal& quantity, std::size_t index, const Measured& run, const std::vector<Measured>& all);
// The same against the limit of its own knob. Of step, points and solver that is Goal::own_limit.
std::optional<double> own_error_of(const Goal& quantity, std::size_t index, const Measured& run, const std::vector<Measured>& all);

// The knobs without those that vary several things at once.
struct Curve {
  std::string knob;
  std::vector<std::size_t> at;  // indices into the measurements, from coarse to fine
  std::optional<double> slope;  // of ln error over ln size; none if the error follows no line
};
std::vector<Curve> curves_of(const Goal& quantity, std::size_t index, const std::vector<Measured>& all);

// Advised settings that no other advised setting beats in both error and cost, from cheap to expensive. `by_updates`: cost in evaluations,
// if known, which does not depend on the machine; else in seconds. `own`: own_error_of settings that no knob of the scene has made.
std::vector<std::size_t> pareto(const Goal& quantity, std::size_t index, const std::vector<Measured>& all, bool by_updates,
                                bool own = false);

// What is left of the error where all knobs are at their finest: its largest part. knob: "" if no knob removes it.
struct Ending {
  std::string knob;
  double error = 0;
};
std::optional<Ending> ending_of(const Goal& quantity, std::size_t index, const std::vector<Measured>& all);

// "An error of 2 % in the collapse multiplier costs 3.1 s with ...; below 0.1 % the points, not the step, are the error."
std::string plain_sentence(const Goal& quantity, std::size_t index, const std::vector<Measured>& all);

// The cheapest setting (in evaluations) with an error up to `target`; the most accurate one within `budget` seconds. None if there is none.
std::optional<std::size_t> cheapest(const Goal& quantity, std::size_t index, const std::vector<Measured>& all, double target);
std::optional<std::size_t> best_within(const Goal& quantity, std::size_t index, const std::vector<Measured>& all, double budget);
// Names the largest part of the remaining error: "the points, not the step, are the error".
std::string what_limits(const Goal& quantity, std::size_t index, const std::vector<Measured>& all);

}  // namespace erbs::study
