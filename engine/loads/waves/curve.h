// Smooth curve through given values: its slope and its curvature have no jump. Displacements that a block is made to follow need it, since
// every corner of a line is a jolt.
//
// Source: cubic spline (de Boor 1978, A practical guide to splines, chapter IV); its ends: `bend_of()`.
#pragma once
#include "engine/base/field.h"
#include "engine/loads/waves/polyline.h"

namespace erbs {

struct Curve {
  Polyline line;             // its points: s, and the unit of its load; the integrals are those of the curve
  std::vector<double> bend;  // second derivative   [points]
  bool hold = false;         // outside the curve the nearest value holds; else zero
  bool says_hold = false;    // the script gives `hold`; else motion, turning and tilt hold, as a place or an angle does not vanish

  static constexpr std::string_view wave_name = "curve_wave";
  static constexpr std::string_view help = "A smooth curve through given values at given times.";
  // The two arrays `times` and `values` are not fields; make_curve takes them.
  static Fields<Curve> fields() {
    return {{"hold", &Curve::hold, "", "outside the curve the nearest value holds (default: zero; of motion, turning and tilt: it holds)"}};
  }
};

// Needs increasing times and at least two points. Otherwise throws an Error that counts points from 1.
Curve make_curve(std::vector<double> times, std::vector<double> values, bool hold);

// loads.h explains the six functions.
double value(const Curve& wave, double t);
double area(const Curve& wave, double t);
double double_area(const Curve& wave, double t);
double mean(const Curve& wave, double t0, double t1);
double end_time(const Curve& wave);
inline double resolution(const Curve& wave) { return shortest_interval(wave.line); }

}  // namespace erbs
