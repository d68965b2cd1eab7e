// The frequency that dominates a history.
#pragma once
#include <complex>
#include <vector>

namespace erbs {

// In place, of a length that is a power of two (Cooley and Tukey 1965).
void fourier(std::vector<std::complex<double>>& values);

// Hz, of the largest line of the spectrum of `values`, `dt` apart: mean removed, Hann window, parabola through the logarithms of
// the largest line and its neighbours (error below 0.02 of 1 / (n dt) for a steady sine). 0 where there is no oscillation.
double dominant_frequency(const std::vector<double>& values, double dt);

}  // namespace erbs
