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
  std::string file;                       // path that can be opened
  double peak = 0;                        // m/s2, required peak acceleration; 0: as recorded times scale
  double scale = 1;                       // factor on the acceleration
  double time_factor = 1;                 // factor on time: 0.707 for a model at half scale; displacement scales with its square
  double start = 0;                       // s, simulated time at time 0 of the file
  int column = 0;                         // of the values in a file of several columns, from 1; 0: the column after time
  double dt = 0;                          // s, step of a file without times (one column of values)
  double first_time = 0;                  // s, time of the first value of such a file
  std::string unit;                       // of the values, if the file names none: g, mg, m/s2, cm/s2, gal, ...
  std::string decimal = "auto";           // decimal mark of the file: auto | point | comma
  std::string quantity = "acceleration";  // of the file: acceleration | velocity | displacement
  double smoothing = 0;                   // Hz, corner of the spline that turns a velocity or displacement into an acceleration
  std::string baseline = "none";          // polynomial that is taken from the acceleration: none | constant | linear | quadratic | cubic
  double low = 0, high = 0;               // Hz, corners of the band-pass; 0: none
  int band_order = 4;                     // of the filter in one of its two passes

  // Found by read_record.
  std::string title;      // from the file
  std::string format;     // "PEER AT2", "CSV", "text, 2 columns", ...
  std::string hash;       // of the bytes of the file, for the manifest
  int points = 0;         // values in the file
  double file_dt = 0;     // s, step of the file; 0 if uneven
  double file_peak = 0;   // m/s2, peak acceleration before scaling, corrected
  std::string note;       // what has been done to the values of the file, in sentences; "": nothing
  Polyline acceleration;  // s after `start`, and m/s2; both scaled

  static constexpr std::string_view wave_name = "record";
  static constexpr std::string_view help = "A ground-motion record from a file, scaled in amplitude and time.";
  static Fields<Record> fields() {
    return {
        {"file", &Record::file, "", "PEER AT2, ESM, COSMOS or CSMIP V2, CSV or text of columns", -unbounded, unbounded, true},
        {"peak", &Record::peak, "m/s2", "largest absolute acceleration after scaling (default: as recorded)", 0, 1e4},
        {"scale", &Record::scale, "", "factor on the acceleration, instead of peak", -1e6, 1e6},
        {"time_factor", &Record::time_factor, "", "factor on time", 1e-3, 1e3},
        {"start", &Record::start, "s", "simulated time of time 0 in the file", -1e9, 1e9},
        {"column", &Record::column, "", "column of the values, counted from 1 (default: the one after time)", 0, 1000},
        {"dt", &Record::dt, "s", "time step, for a file with one column of values", 0, 1e3},
        {"first_time", &Record::first_time, "s", "time of the first value of such a file", 0, 1e3},
        {"unit", &Record::unit, "",
         "unit of the values, if the file does not give one: g, mg, m/s2, cm/s2, gal, mm/s2, ft/s2, in/s2; m/s, ... or m, ... by quantity"},
        {"decimal", &Record::decimal, "", "decimal mark of the file (auto: a comma where commas cannot part columns)", 0, 0, false,
         "auto|point|comma"},
        {"quantity", &Record::quantity, "", "what the file holds; all but an acceleration needs `smoothing`", 0, 0, false,
         "acceleration|velocity|displacement"},
        {"smoothing", &Record::smoothing, "Hz",
         "corner at which the spline that differentiates a velocity or displacement halves its amplitude", 0, 1e4},
        {"baseline", &Record::baseline, "", "polynomial taken from the acceleration, by the best fit of its integral to the velocity", 0, 0,
         false, "none|constant|linear|quadratic|cubic"},
        {"low", &Record::low, "Hz", "lower corner of a Butterworth band-pass without phase lag (0: none)", 0, 1e4},
        {"high", &Record::high, "Hz", "its upper corner, below half the sampling rate (0: none)", 0, 1e4},
        {"band_order", &Record::band_order, "", "order of the band-pass in each of its two passes, forwards and backwards", 1, 10},
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
