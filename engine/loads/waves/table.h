// Table of values, linear between its points.
#pragma once
#include "engine/base/field.h"
#include "engine/loads/waves/polyline.h"

namespace erbs {

struct Table {
  Polyline line;           // s, and the unit of its load
  bool hold = false;       // outside the table the nearest value holds; else zero
  bool says_hold = false;  // the script gives `hold`; else motion, turning and tilt hold, as a place or an angle does not vanish

  static constexpr std::string_view wave_name = "table_wave";
  static constexpr std::string_view help = "Given values at given times, linear in between.";
  // The two arrays `times` and `values` are not fields; make_table takes them.
  static Fields<Table> fields() {
    return {{"hold", &Table::hold, "", "outside the table the nearest value holds (default: zero; of motion, turning and tilt: it holds)"}};
  }
};

// Needs increasing times and at least two points. Otherwise throws an Error that counts points from 1.
Table make_table(std::vector<double> times, std::vector<double> values, bool hold);

// loads.h explains the six functions.
double value(const Table& wave, double t);
double area(const Table& wave, double t);
double double_area(const Table& wave, double t);
double mean(const Table& wave, double t0, double t1);
double end_time(const Table& wave);
inline double resolution(const Table& wave) { return shortest_interval(wave.line); }

}  // namespace erbs
