// Piecewise linear function of time: the common part of tables and ground-motion records.
#pragma once
#include <vector>

namespace erbs {

// Only make_polyline creates it; it fills the integrals.
struct Polyline {
  std::vector<double> times;        // s, increasing                            [points]
  std::vector<double> values;       //                                          [points]
  std::vector<double> area;         // Int from times[0] to times[i] of value   [points]
  std::vector<double> double_area;  // the same of that integral                [points]
};

// Needs at least two points, all finite, with increasing times. Otherwise throws an Error that counts points from 1.
Polyline make_polyline(std::vector<double> times, std::vector<double> values);

// Index i with times[i] <= t < times[i + 1]; beyond the ends the first or the last segment.
int segment(const Polyline& line, double t);

// Value and integrals between the first and the last point; t outside is moved to the nearer end.
double value_inside(const Polyline& line, double t);
double area_inside(const Polyline& line, double t);         // from times[0]
double double_area_inside(const Polyline& line, double t);  // from times[0]
// Int from t0 to t1 without the cancellation of a difference of integrals: exact for any short interval.
double area_between(const Polyline& line, double t0, double t1);
double shortest_interval(const Polyline& line);  // s

}  // namespace erbs
