// Calibration: runs of a scene fit some of its params to known values, stage by stage. The runs are those of a sweep, each a process.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/study/sweep/sweep.h"

namespace erbs::study {

struct FittedParam {
  std::string param;
  double value = 0, deviation = 0;  // standard deviation in the unit of the param, linear theory; infinite: the param moves no residual
  bool at_end = false;              // at an end of its range
};

struct FittedStage {
  std::vector<FittedParam> params;
  bool raised = false;   // until CalibrationStage::key was below its number; otherwise by least squares
  double key_value = 0;  // of that key
  // of the raised param: where the key is not below its number, and where it is; none: it is so from the start
  std::optional<std::pair<double, double>> bracket;
  double rms = 0;          // root of the mean square of all residuals
  bool converged = false;  // within CalibrationPlan::rounds
};

struct Calibrated {
  std::vector<FittedStage> stages;
  std::vector<std::pair<std::string, double>> values;  // fitted params, the last word of each
  std::vector<double> got, got_before;                 // the targets in their order, with the fitted params and as the scene is written
  double rms = 0, rms_before = 0;                      // NaN: that run has no answer
  int runs = 0, discarded = 0;                         // discarded: they do not give all targets
  std::string first_discarded;                         // "run 3: diverged: ..."
  bool interrupted = false;
};

// Names of the files in the folder of a calibration, and of the two runs it keeps in runs/.
constexpr const char* calibration_table = "calibration.csv";
constexpr const char* calibration_file = "calibration.json";
constexpr const char* calibration_stem = "calibration";
constexpr const char* best_run = "best";
constexpr const char* first_run = "start";

// `sweep.plan.calibration` says what to fit, `sweep.collected` has a column for each of `calibrated_keys()`. Throws Error if no run of a
// stage gives residuals, or a raised key stays above its number. `resume`: the runs of the table that is there are not made again.
Calibrated calibrate(const Sweep& sweep, bool resume = false);

std::vector<std::string> calibrated_keys(const Calibration& calibration);  // all keys it reads, without repetition

// calibration.svg and .png: the known history with that of the fitted run, the targets, and residuals below each. Throws Error.
void draw_calibration(const Sweep& sweep, const Calibrated& result);

}  // namespace erbs::study
