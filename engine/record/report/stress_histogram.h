// Distribution of the stresses of joints over their area at one time, from the frames of a run.
#pragma once
#include <string>
#include <vector>

#include "engine/record/folder/motion_file.h"
#include "engine/record/plot/figure.h"

namespace erbs {

// Mean stress and area of each joint in one frame.
struct StressSample {
  std::string run;
  double t = 0;                      // s, of the frame
  std::vector<double> stress, area;  // Pa, tension positive; m2  [joints]
};

// `quantity`: normal_stress or shear_stress. `time`: seconds, whose nearest frame counts; "": the last frame.
// Error for a time that is none, and for a run without joints, frames or stresses.
StressSample stress_sample(const MotionReader& reader, const std::string& quantity, const std::string& time);

// Shares of the total area in bins of equal width, over which all samples are laid.
struct StressBins {
  double low = 0, width = 0;               // Pa
  std::vector<std::vector<double>> share;  // 0..1 [samples][bins]
};
StressBins stress_bins(const std::vector<StressSample>& samples);

plot::Figure stress_figure(const std::vector<StressSample>& samples, const std::string& quantity);

}  // namespace erbs
