// Sine waves: endless or cut off, and the half-sine and full-sine pulses of the overturning literature (Housner 1963). Pulses may begin at
// any phase and always end at a zero of the sine. All are exactly zero outside their duration.
// As the acceleration of the ground from rest, amplitude a, omega = 2 pi f, phase 0: a half sine leaves it at the velocity 2 a / omega; a
// full sine (the type-A pulse of Makris 1997) stops it at the displacement 2 pi a / omega^2; a full cosine (type B) brings it back to rest
// at its place.
#pragma once
#include "engine/base/field.h"
#include "engine/base/units.h"

namespace erbs {

// amplitude sin(2 pi frequency (t - start) + phase) from `start` on, for `duration`.
struct Sine {
  double amplitude = 0;         // in the unit of its load: m/s2, N, N m, rad or m
  double frequency = 0;         // Hz
  double phase = 0;             // rad, at start
  double start = 0;             // s
  double duration = unbounded;  // s

  static constexpr std::string_view wave_name = "sine";
  static constexpr std::string_view help = "A sine from `start` on, for `duration`: amplitude sin(2 pi frequency (t - start) + phase).";
  static Fields<Sine> fields() {
    return {
        {"amplitude", &Sine::amplitude, "", "peak value, in the unit of the load", -unbounded, unbounded, true},
        {"frequency", &Sine::frequency, "Hz", "cycles per second", 1e-9, 1e9, true},
        {"phase", &Sine::phase, "rad", "phase at the start", -1e3, 1e3},
        {"start", &Sine::start, "s", "time of the first value", -1e9, 1e9},
        {"duration", &Sine::duration, "s", "duration (default: for ever)", 0, unbounded},
    };
  }
};

// One lobe, from `phase` at `start` to the zero at pi. Duration (pi - phase) / (2 pi frequency).
struct HalfSine {
  double amplitude = 0;  // in the unit of its load
  double frequency = 0;  // Hz, of the whole sine: a lobe from phase 0 lasts 1 / (2 frequency)
  double phase = 0;      // rad, 0..pi, at start
  double start = 0;      // s

  static constexpr std::string_view wave_name = "half_sine";
  static constexpr std::string_view help =
      "One lobe of a sine, from any phase to its zero at pi. From phase 0 it leaves the ground at the velocity amplitude / (pi frequency).";
  static Fields<HalfSine> fields() {
    return {
        {"amplitude", &HalfSine::amplitude, "", "peak value, in the unit of the load", -unbounded, unbounded, true},
        {"frequency", &HalfSine::frequency, "Hz", "frequency of the whole sine; the lobe lasts 1 / (2 frequency)", 1e-9, 1e9, true},
        {"phase", &HalfSine::phase, "rad", "phase at the start; the pulse ends at pi", 0, pi},
        {"start", &HalfSine::start, "s", "time of the first value", -1e9, 1e9},
    };
  }
};

// One cycle, from `phase` at `start` to the zero at 2 pi. Duration (2 pi - phase) / (2 pi frequency).
struct FullSine {
  double amplitude = 0;  // in the unit of its load
  double frequency = 0;  // Hz
  double phase = 0;      // rad, 0..2 pi, at start
  double start = 0;      // s

  static constexpr std::string_view wave_name = "full_sine";
  static constexpr std::string_view help =
      "One cycle of a sine, from any phase to its zero at 2 pi. From phase 0 it leaves the ground at rest, displaced by amplitude / (2 pi "
      "frequency^2).";
  static Fields<FullSine> fields() {
    return {
        {"amplitude", &FullSine::amplitude, "", "peak value, in the unit of the load", -unbounded, unbounded, true},
        {"frequency", &FullSine::frequency, "Hz", "frequency; the cycle lasts 1 / frequency", 1e-9, 1e9, true},
        {"phase", &FullSine::phase, "rad", "phase at the start; the pulse ends at 2 pi", 0, 2 * pi},
        {"start", &FullSine::start, "s", "time of the first value", -1e9, 1e9},
    };
  }
};

// One cycle of a cosine from its peak to its next one. Duration 1 / frequency.
struct FullCosine {
  double amplitude = 0;  // in the unit of its load
  double frequency = 0;  // Hz
  double start = 0;      // s

  static constexpr std::string_view wave_name = "full_cosine";
  static constexpr std::string_view help = "One cycle of a cosine, from peak to peak. It leaves the ground at rest at its place.";
  static Fields<FullCosine> fields() {
    return {
        {"amplitude", &FullCosine::amplitude, "", "peak value, in the unit of the load", -unbounded, unbounded, true},
        {"frequency", &FullCosine::frequency, "Hz", "frequency; the cycle lasts 1 / frequency", 1e-9, 1e9, true},
        {"start", &FullCosine::start, "s", "time of the first value", -1e9, 1e9},
    };
  }
};

// loads.h explains the six functions.
double value(const Sine& wave, double t);
double value(const HalfSine& wave, double t);
double value(const FullSine& wave, double t);
double value(const FullCosine& wave, double t);
double area(const Sine& wave, double t);
double area(const HalfSine& wave, double t);
double area(const FullSine& wave, double t);
double area(const FullCosine& wave, double t);
double double_area(const Sine& wave, double t);
double double_area(const HalfSine& wave, double t);
double double_area(const FullSine& wave, double t);
double double_area(const FullCosine& wave, double t);
double mean(const Sine& wave, double t0, double t1);
double mean(const HalfSine& wave, double t0, double t1);
double mean(const FullSine& wave, double t0, double t1);
double mean(const FullCosine& wave, double t0, double t1);
double end_time(const Sine& wave);
double end_time(const HalfSine& wave);
double end_time(const FullSine& wave);
double end_time(const FullCosine& wave);
inline double resolution(const Sine& wave) { return 0.02 / wave.frequency; }
inline double resolution(const HalfSine& wave) { return 0.02 / wave.frequency; }
inline double resolution(const FullSine& wave) { return 0.02 / wave.frequency; }
inline double resolution(const FullCosine& wave) { return 0.02 / wave.frequency; }

}  // namespace erbs
