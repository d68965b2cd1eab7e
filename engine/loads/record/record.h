// Ground-motion record: acceleration linear between its points, scaled in amplitude and time. Velocity and displacement are integrated
// analytically (piecewise quadratic and cubic). The ground is at rest before the start; its acceleration is zero after the end.
#pragma once
#include <string>

#include "engine/base/error.h"
#include "engine/base/field.h"
#include "engine/loads/waves/polyline.h"

namespace erbs {

struct Record {
  // From the script.
  std::string file;        // path that can be opened
  double peak = 0;         // m/s2, required peak acceleration; 0: as recorded times scale
  double scale = 1;        // factor on the acceleration
  double time_factor = 1;  // factor on time: 0.707 for a model at half scale; displacement scales with its square
  double start = 0;        // s, simulated time at time 0 of the file
  int column = 0;          // of the values in a file of several columns, from 1; 0: the column after time
  double dt = 0;           // s, step of a file without times (one column of values)
  double first_time = 0;   // s, time of the first value of such a file
  std::string unit;        // of the values, if the file names none: g, m/s2, cm/s2, gal, ...

  // Found by read_record.
  std::string title;      // from the file
  std::string format;     // "PEER AT2", "CSV", "text, 2 columns", ...
  std::string hash;       // of the bytes of the file, for the manifest
  int points = 0;         // values in the file
  double file_dt = 0;     // s, step of the file; 0 if uneven
  double file_peak = 0;   // m/s2, peak acceleration of the file
  Polyline acceleration;  // s after `start`, and m/s2; both scaled

  static constexpr std::string_view wave_name = "record";
  static constexpr std::string_view help = "A ground-motion record from a file, scaled in amplitude and time.";
  static Fields<Record> fields() {
    return {
        {"file", &Record::file, "", "PEER AT2, CSV or text of one or two columns", -unbounded, unbounded, true},
        {"peak", &Record::peak, "m/s2", "largest absolute acceleration after scaling (default: as recorded)", 0, 1e4},
        {"scale", &Record::scale, "", "factor on the acceleration, instead of peak", -1e6, 1e6},
        {"time_factor", &Record::time_factor, "", "factor on time", 1e-3, 1e3},
        {"start", &Record::start, "s", "simulated time of time 0 in the file", -1e9, 1e9},
        {"column", &Record::column, "", "column of the values, counted from 1 (default: the one after time)", 0, 1000},
        {"dt", &Record::dt, "s", "time step, for a file with one column of values", 0, 1e3},
        {"first_time", &Record::first_time, "s", "time of the first value of such a file", 0, 1e3},
        {"unit", &Record::unit, "", "unit of the values, if the file does not give one: g, m/s2, cm/s2, gal, mm/s2, ft/s2, in/s2"},
    };
  }
};

// Reads wanted.file and applies the other members. `place`: the script line of the record. A mistake in the file names file and line.
Record read_record(Record wanted, const Place& place = {});

// loads.h explains the six functions. area is the velocity of the ground, double_area its displacement.
double value(const Record& wave, double t);
double area(const Record& wave, double t);
double double_area(const Record& wave, double t);
double mean(const Record& wave, double t0, double t1);
double end_time(const Record& wave);
inline double resolution(const Record& wave) { return shortest_interval(wave.acceleration); }

}  // namespace erbs
