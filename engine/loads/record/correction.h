// Corrections of an accelerogram, by choice: a polynomial baseline and a Butterworth band-pass.
#pragma once
#include <string_view>
#include <vector>

#include "engine/base/error.h"

namespace erbs {

int baseline_degree(std::string_view word);  // of none, constant, linear, quadratic, cubic: -1 to 3

// Takes a polynomial of this degree from the acceleration (m/s2 at the times, s): the one whose integral fits the velocity best, since an
// offset that cannot be seen in the acceleration grows there (Chiu 1997 fits likewise). A drift of the same form is removed to round-off.
void remove_baseline(const std::vector<double>& times, std::vector<double>& acceleration, int degree);

struct Band {
  double low = 0, high = 0;  // Hz, corners; 0: none
  int order = 4;             // of one pass
};

// High-pass and low-pass of Butterworth type (Oppenheim and Schafer 1989, section 7.1: bilinear transform, corners prewarped), each run
// forwards and backwards. The phase is zero, and the amplitude
//   1 / ((1 + (tan(pi low dt) / tan(pi f dt))^(2 order)) (1 + (tan(pi f dt) / tan(pi high dt))^(2 order))).
// The record is padded with rest on both sides for 1.5 order / low (Converse and Brady 1992); the pads are cut off afterwards, so that
// times stay. dt: s, the even step. Throws Error if a corner lies at or above half the sampling rate.
void band_pass(double dt, std::vector<double>& values, const Band& band, const Place& file);

}  // namespace erbs
