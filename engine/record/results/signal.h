// Evaluation of a recorded column with values y[i] at times t[i] (s).
#pragma once
#include <limits>
#include <vector>

namespace erbs {

struct SamplePeak {
  double value = 0;  // sample of largest magnitude, with its sign
  double time = 0;   // s
};
SamplePeak peak(const std::vector<double>& t, const std::vector<double>& y);

double rms(const std::vector<double>& t, const std::vector<double>& y);  // sqrt of the time mean of y^2, y^2 linear between samples
double mean(const std::vector<double>& t, const std::vector<double>& y);

// Frequency (Hz) of the highest peak of the amplitude spectrum, at least `from` and below `to`. Method: mean removed, Hann window, zeros
// appended to at least 4 times the length. A parabola through the logarithms of the three highest bins refines the peak. It is exact for a
// Gaussian; its error is 1e-3 of a bin for a Hann window so padded. Linear interpolation first resamples columns with uneven time steps.
// NaN for fewer than 8 rows or a constant column.
double dominant_frequency(const std::vector<double>& t, const std::vector<double>& y, double from = 0,
                          double to = std::numeric_limits<double>::infinity());

struct Spectrum {
  std::vector<double> frequency;  // Hz
  std::vector<double> amplitude;  // in the unit of y: a sine of amplitude A gives a peak of A
};
Spectrum spectrum(const std::vector<double>& t, const std::vector<double>& y);

// Times (s) at which y - level changes sign, linear between samples. rising: only crossings from below to above.
std::vector<double> crossings(const std::vector<double>& t, const std::vector<double>& y, double level = 0, bool rising = false);

// Mean time (s) between rising zero crossings; NaN if there are fewer than two.
double period(const std::vector<double>& t, const std::vector<double>& y);

}  // namespace erbs
