// THE LIST of time functions that a load can follow. A new one is one file and one entry here.
// A step uses the exact mean over its interval, so that a pulse loses nothing at its edges, whatever the step.
// Each wave defines
//   value(wave, t)         zero outside its duration; at a jump the value after it
//   area(wave, t)          Int of value from the wave's own start to t
//   double_area(wave, t)   the same of area
//   mean(wave, t0, t1)     mean of value, in closed form on each segment: exact to round-off for any short interval
//   end_time(wave)
//   resolution(wave)       s, longest step that cannot miss a feature of it
// and, for scripts, wave_name, help and fields().
#pragma once
#include <variant>

#include "engine/loads/record/record.h"
#include "engine/loads/waves/curve.h"
#include "engine/loads/waves/mp_pulse.h"
#include "engine/loads/waves/pulse.h"
#include "engine/loads/waves/ricker.h"
#include "engine/loads/waves/sine.h"
#include "engine/loads/waves/table.h"

namespace erbs {

using Wave = std::variant<Sine, HalfSine, FullSine, Pulse, Table, Curve, Record, Ricker, FullCosine, MpPulse>;

double value(const Wave& wave, double t);
double integral(const Wave& wave, double t);          // Int_0^t value: velocity of an acceleration
double second_integral(const Wave& wave, double t);   // Int_0^t integral: its displacement
double mean(const Wave& wave, double t0, double t1);  // (integral(t1) - integral(t0)) / (t1 - t0) without its cancellation; t0 = t1: value
double end_time(const Wave& wave);                    // time after which the value is constant; infinite for an endless sine
double resolution(const Wave& wave);
// s, longest step that follows it: a twentieth of its period, of points of their mean one, but not less than their interval; infinite for
// pulses and ramps, whose mean over a step is all that counts.
double following_step(const Wave& wave);

}  // namespace erbs
