// Two signals over time against each other: how much later one is, and when each begins to move.
#pragma once
#include <string>
#include <vector>

namespace erbs {

// Values y[i] at rising times t[i] (s), linear between them.
struct Samples {
  std::vector<double> t, y;
  double at(double time) const;  // constant outside
  double step() const;           // s, mean time between samples
};

struct Lag {
  double lag = 0;          // s, by which the first signal is later than the second
  double correlation = 0;  // Pearson's coefficient of the aligned signals, NaN if one of them is constant
  bool at_edge = false;    // the best lag is the largest one searched: the true one may lie beyond
};

// The lag of the largest correlation, searched over |lag| <= reach (s), with an overlap of at least half the shorter signal. Pearson's
// coefficient of the overlap is taken on the finer of the two time steps, or 3000 steps if there are more. A parabola through the three
// values about the largest one refines it. That of a band-limited signal is even and smooth at its peak, so that the error falls with the
// square of the step.
Lag lag_of(const Samples& first, const Samples& second, double reach);

std::string lag_text(double lag);  // "0.3000 s later", "0.3000 s earlier"

// The time at which |y - y[0]| first passes a share of its peak, linear between samples; NaN for a constant signal.
double first_motion(const Samples& signal, double share = 0.05);

}  // namespace erbs
