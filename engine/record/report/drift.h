// Displacement and drift over the height of a structure, from the poses of all its blocks, as a profile and as a figure.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "engine/record/folder/motion_file.h"
#include "engine/record/plot/figure.h"

namespace erbs {

// A level is a course, or as many courses together as leave at most `levels` of them. The displacement of a level is the mean of those of
// its blocks, without the tenth that moved most and the tenth that moved least, so that a brick that falls out does not count. The drift
// between two levels is the difference of their displacements over that of their heights; the ground is the lowest.
struct DriftProfile {
  std::string run;
  std::vector<double> height;                       // m above the support, mean of the blocks of a level  [levels]
  std::array<std::vector<double>, 2> displacement;  // m, largest absolute one over time, along x and y    [levels]
  std::vector<double> between;                      // m above the support, middle of two levels           [levels]
  std::array<std::vector<double>, 2> drift;         // ratio, largest absolute one over time               [levels]
};

// Fixed blocks are the ground. `group`: only blocks of this group; "": all.
// Error for no frame, or no block that may move.
DriftProfile drift_profile(const MotionScene& scene, const std::vector<MotionFrame>& frames, int levels, const std::string& group = "");

// Displacement and drift over height, side by side, of one run or of several over each other. `note`: second line of the title.
plot::Figure drift_figure(const std::vector<DriftProfile>& profiles, const std::string& note);

}  // namespace erbs
