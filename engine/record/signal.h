// Numbers drawn from a recorded column: y[i] at times t[i] (s).
#pragma once
#include <limits>
#include <vector>

namespace erbs {

struct SamplePeak {
  double value = 0;  // the sample of largest magnitude, with its sign
  double time = 0;   // s
};
SamplePeak peak(const std::vector<double>& t, const std::vector<double>& y);

double rms(const std::vector<double>& t, const std::vector<double>& y);  // sqrt of the time mean of y^2, y linear between samples
double mean(const std::vector<double>& t, const std::vector<double>& y);

// Hz, of the highest peak of the amplitude spectrum: mean removed, Hann window, zeros appended to at least 4 times the length,
// parabola through the logarithms of the three highest bins (exact for a Gaussian, 1e-3 of a bin for Hann so padded). Columns of
// uneven time are first made even by linear interpolation. NaN where there are fewer than 8 rows or the column is constant.
// Only frequencies of at least `from` and below `to` are looked at.
double dominant_frequency(const std::vector<double>& t, const std::vector<double>& y, double from = 0,
                          double to = std::numeric_limits<double>::infinity());

struct Spectrum {
  std::vector<double> frequency;  // Hz
  std::vector<double> amplitude;  // unit of y: a sine of amplitude A shows a peak of A
};
Spectrum spectrum(const std::vector<double>& t, const std::vector<double>& y);

// Times (s) at which y - level changes sign, linear between samples; rising: only from below to above.
std::vector<double> crossings(const std::vector<double>& t, const std::vector<double>& y, double level = 0, bool rising = false);

// s, mean time between rising crossings of zero; NaN with fewer than two.
double period(const std::vector<double>& t, const std::vector<double>& y);

}  // namespace erbs
