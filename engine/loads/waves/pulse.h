// Rectangular pulse: `amplitude` from start for `duration`, zero outside.
#pragma once
#include "engine/base/field.h"

namespace erbs {

struct Pulse {
  double amplitude = 0;         // in the unit of its load: m/s2, N, N m, rad or m
  double start = 0;             // s
  double duration = unbounded;  // s

  static constexpr std::string_view wave_name = "pulse";
  static constexpr std::string_view help = "A rectangular pulse, exact at its edges whatever the time step.";
  static Fields<Pulse> fields() {
    return {
        {"amplitude", &Pulse::amplitude, "", "value inside, in the unit of the load", -unbounded, unbounded, true},
        {"start", &Pulse::start, "s", "time of the rising edge", -1e9, 1e9},
        {"duration", &Pulse::duration, "s", "duration (default: for ever, a step)", 0, unbounded},
    };
  }
};

// loads.h explains the six functions.
double value(const Pulse& wave, double t);
double area(const Pulse& wave, double t);
double double_area(const Pulse& wave, double t);
double mean(const Pulse& wave, double t0, double t1);
double end_time(const Pulse& wave);
inline double resolution(const Pulse& wave) { return 0.1 * wave.duration; }

}  // namespace erbs
