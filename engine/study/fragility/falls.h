// When and where to the runs of a study fall: the two standards by which a simulation of collapse is laid beside a test.
#pragma once
#include <string>
#include <vector>

#include "engine/study/fragility/observations.h"

namespace erbs::study {

// The collapses of a group at one intensity.
struct Falls {
  std::string group;
  double im = 0;
  int runs = 0;                                // standing ones too
  int collapsed = 0;                           // those without a time too, which do not stand under their own weight
  std::vector<double> times;                   // s, rising
  std::vector<std::array<double, 2>> towards;  // unit vectors in plan of those that have a direction

  // Mean direction, degrees from x towards y, and length of the mean vector: 1 where all fall one way, near 0 where none is preferred
  // (Mardia 1972, eq. 2.2.4). NaN without a direction.
  double mean_direction() const;
  double concentration() const;
};

std::vector<Falls> falls_of(const std::vector<Group>& groups);
// Shares of the runs that fall within 45 degrees of +x, +y, -x and -y.
std::array<double, 4> quarters(const Falls& falls);

void write_falls(const Sweep& sweep, const std::vector<Group>& groups);                            // falls.csv
void draw_falls(const Sweep& sweep, const std::vector<Group>& groups, const std::string& ending);  // falls.svg or .png

}  // namespace erbs::study
