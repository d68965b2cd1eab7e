// The runs of a study as observations of fragility: cases, their intensities, who collapses, how far the others are damaged.
#pragma once
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "engine/study/fragility/fit.h"
#include "engine/study/sweep/sweep.h"

namespace erbs::study {

struct Run {
  double im = 0;
  bool collapsed = false;
  std::vector<double> damage;  // in the order of FragilityPlan::damage; NaN without a value
  // Of a collapse, where the plan asks for falls: s, and the unit vector of its direction in plan. NaN without.
  double time = std::nan("");
  std::array<double, 2> direction = {std::nan(""), std::nan("")};
};

// Runs that differ in intensity alone, by rising intensity: a record, a draw of strengths, a perturbation.
struct Case {
  std::string name;
  std::vector<Run> runs;
  Interval capacity() const;  // from the last standing run below the first collapse up to that
};

// Cases of one structure.
struct Group {
  std::string name;  // values of FragilityPlan::by; "" without
  std::vector<Case> cases;
  int left_out = 0;  // runs without an answer
  int untold = 0;    // runs in which the key that tells a collapse has no number
  int unshaken = 0;  // runs at intensity zero, where the probability is zero by any fit
  int negative = 0;  // runs at an intensity below zero
  int wordy = 0;     // runs whose intensity is no number
  int restless = 0;  // runs without a collapse that still move at their end
  int unclear = 0;   // runs that are neither 1 nor 0 where that tells a collapse
  std::vector<Interval> single_runs() const;
  std::vector<Interval> capacities() const;
  bool incremental() const;  // some case has several runs
};

std::vector<Group> read_groups(const Sweep& sweep);  // from runs.csv, in an order that depends on the values alone

// Fractile of a damage over the cases at an intensity, linear between the runs of a case. A collapsed case counts as infinite damage, as in
// Vamvatsikos and Cornell (2002); a case without a run at or above the intensity does not count.
struct Fractiles {
  double im = 0;
  int cases = 0;
  double p16 = 0, p50 = 0, p84 = 0;
};
std::vector<Fractiles> fractiles_of(const Group& group, std::size_t damage);
double fractile(std::vector<double> values, double share);  // linear between the order statistics; infinite where one of them is

std::vector<double> levels_of(const Group& group);  // intensities of the runs, each once

}  // namespace erbs::study
