// A function of time that is linear between points: what tables and ground-motion records have in common.
#pragma once
#include <vector>

namespace erbs {

// Made by make_polyline only, which fills the sums.
struct Polyline {
  std::vector<double> times;        // s, increasing                            [points]
  std::vector<double> values;       //                                          [points]
  std::vector<double> area;         // Int from times[0] to times[i] of value   [points]
  std::vector<double> double_area;  // the same of that integral                [points]
};

// At least two points, all finite, times increasing; else an Error that counts points from 1.
Polyline make_polyline(std::vector<double> times, std::vector<double> values);

// i such that times[i] <= t < times[i + 1], at the ends the first or last segment.
int segment(const Polyline& line, double t);

// Between the first and the last point; t outside is moved to the nearer end.
double value_inside(const Polyline& line, double t);
double area_inside(const Polyline& line, double t);         // from times[0]
double double_area_inside(const Polyline& line, double t);  // from times[0]
// Int from t0 to t1 without the cancellation of a difference of sums: exact however close t0 and t1 are.
double area_between(const Polyline& line, double t0, double t1);

}  // namespace erbs
