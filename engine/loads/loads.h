// THE LIST of time functions a load can follow. A new one is one header and one entry here.
// A step takes the exact mean over itself, so that a pulse loses nothing at its edges whatever the step.
// Each wave has its own
//   value(wave, t)         zero outside the time it acts; at a jump the value from then on
//   area(wave, t)          Int from its own start to t of value; double_area: the same of area
//   mean(wave, t0, t1)     of the value, in closed form on each piece: right to round-off however short the interval
//   end_time(wave)
#pragma once
#include <variant>

#include "engine/loads/pulse.h"
#include "engine/loads/record.h"
#include "engine/loads/sine.h"
#include "engine/loads/table.h"

namespace erbs {

using Wave = std::variant<Sine, HalfSine, FullSine, Pulse, Table, Record>;

double value(const Wave& wave, double t);
double integral(const Wave& wave, double t);          // Int_0^t value: velocity of an acceleration
double second_integral(const Wave& wave, double t);   // Int_0^t integral: its displacement
double mean(const Wave& wave, double t0, double t1);  // (integral(t1) - integral(t0)) / (t1 - t0) without its cancellation; t0 = t1: value
double end_time(const Wave& wave);                    // after which the value stays (infinity for an endless sine)

}  // namespace erbs
