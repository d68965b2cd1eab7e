// Tables and figures of the fragility that a study asks for, from the runs of its folder.
#pragma once
#include <string>
#include <vector>

#include "engine/study/fragility/observations.h"

namespace erbs::study {

// One row of fragility.csv. Of incremental runs the capacities of the cases count, with their bounds; the runs counted one by one are not
// independent of each other then, so that their confidence is too narrow.
struct Fragility {
  std::string group, method;  // method: capacities, runs
  Fit fit;
  std::string words;  // "" or what to think of it
};

inline constexpr const char* fragility_files[] = {"fragility.csv", "stripes.csv", "fractiles.csv", "fragility.svg", "fragility.png",
                                                  "ida.svg",       "ida.png",     "falls.csv",     "falls.svg",     "falls.png"};

// Writes fragility.csv, stripes.csv and, where wanted, fractiles.csv and falls.csv into the folder of the sweep.
std::vector<Fragility> write_fragility(const Sweep& sweep, const std::vector<Group>& groups);
// Draws fragility.*, ida.* and falls.*. Throws Error.
void draw_fragility(const Sweep& sweep, const std::vector<Group>& groups, const std::vector<Fragility>& found);

std::string unit_of_im(const Sweep& sweep);  // column name of the intensity with its unit

// How figures write intensities: accelerations as shares of g, all else in SI.
struct ShownIntensity {
  double factor = 1;                    // from SI
  std::string words, unit;              // "pga", "g"
  std::string label() const;            // "pga [g]"
  std::string number(double im) const;  // "1.2 g"
};
ShownIntensity shown_intensity(const Sweep& sweep);

}  // namespace erbs::study
