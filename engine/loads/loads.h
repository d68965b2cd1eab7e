// THE LIST of time functions a load can follow. A new one is one header and one entry here.
// Each has value(t) and integral(t) = Int_0^t value: a step takes the exact mean (integral(t1) - integral(t0)) / (t1 - t0), so
// that a pulse loses nothing at its edges whatever the step.
#pragma once
#include <variant>

#include "engine/loads/pulse.h"
#include "engine/loads/record.h"
#include "engine/loads/sine.h"
#include "engine/loads/table.h"

namespace erbs {

using Wave = std::variant<Sine, HalfSine, FullSine, Pulse, Table, Record>;

double value(const Wave& wave, double t);
double integral(const Wave& wave, double t);
double second_integral(const Wave& wave, double t);  // Int_0^t integral: displacement of an acceleration
double end_time(const Wave& wave);                   // after which the value stays (infinity for an endless sine)

}  // namespace erbs
