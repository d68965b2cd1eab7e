// A table of values, linear between its points.
#pragma once
#include "engine/base/field.h"
#include "engine/loads/polyline.h"

namespace erbs {

struct Table {
  Polyline line;      // s, and the unit of what it drives
  bool hold = false;  // outside: the nearest value; else zero

  static constexpr std::string_view wave_name = "table_wave";
  // Without the two arrays `times` and `values`, which go through make_table.
  static Fields<Table> fields() { return {{"hold", &Table::hold, "", "outside the table the nearest value holds (default: zero)"}}; }
};

// times increasing, at least two points; else an Error that counts points from 1.
Table make_table(std::vector<double> times, std::vector<double> values, bool hold);

// For the meaning of the five functions see loads.h.
double value(const Table& wave, double t);
double area(const Table& wave, double t);
double double_area(const Table& wave, double t);
double mean(const Table& wave, double t0, double t1);
double end_time(const Table& wave);

}  // namespace erbs
