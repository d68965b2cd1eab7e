// Near-fault velocity pulse of Mavroeidis and Papageorgiou (2003), eq. (3), as the acceleration that makes it (their eq. 4):
//   v(t) = A / 2 (1 + cos(2 pi f x / gamma)) cos(2 pi f x + nu)   for |x| <= gamma / (2 f), x = t - middle, gamma > 1; else 0
// A: amplitude of the envelope, f: prevailing frequency, nu: phase, gamma: number of half cycles. The product is a sum of three cosines, so
// that all integrals are closed. The ground starts and ends at rest, with no jump of its acceleration. It ends displaced by
//   D = -A cos(nu) sin(pi gamma) / (2 pi f (gamma^2 - 1)),
// which is zero for whole gamma and for nu = +-90 deg.
#pragma once
#include <array>

#include "engine/base/field.h"

namespace erbs {

struct MpPulse {
  double amplitude = 0;  // m/s, of the velocity; in the integral of the unit of its load
  double frequency = 0;  // Hz
  double phase = 0;      // rad
  double gamma = 0;      // above 1
  double start = 0;      // s

  static constexpr std::string_view wave_name = "mp_pulse";
  static constexpr std::string_view help =
      "The near-fault pulse of Mavroeidis and Papageorgiou (2003), given by its velocity, as an acceleration. It leaves the ground at "
      "rest, "
      "displaced by -amplitude cos(phase) sin(pi gamma) / (2 pi frequency (gamma^2 - 1)).";
  static Fields<MpPulse> fields() {
    return {
        {"amplitude", &MpPulse::amplitude, "m/s", "amplitude A of the velocity's envelope", -unbounded, unbounded, true},
        {"frequency", &MpPulse::frequency, "Hz", "prevailing frequency f_p", 1e-9, 1e9, true},
        {"phase", &MpPulse::phase, "rad", "phase nu: 0 for a symmetric velocity, 90 deg for an antisymmetric one", -1e3, 1e3},
        {"gamma", &MpPulse::gamma, "", "oscillatory character: the pulse lasts gamma / f_p", 1.0001, 1e3, true},
        {"start", &MpPulse::start, "s", "time of the first value; the envelope peaks gamma / (2 f_p) later", -1e9, 1e9},
    };
  }
};

double residual_displacement(const MpPulse& wave);  // m, D

// loads.h explains the six functions.
double value(const MpPulse& wave, double t);
double area(const MpPulse& wave, double t);
double double_area(const MpPulse& wave, double t);
double mean(const MpPulse& wave, double t0, double t1);
double end_time(const MpPulse& wave);
inline double resolution(const MpPulse& wave) { return 0.02 / wave.frequency; }

}  // namespace erbs
