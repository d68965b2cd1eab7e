// A wave shifted in time.
#pragma once
#include "engine/loads/loads.h"

namespace erbs {

double start_time(const Wave& wave);        // s, of the first value, in the time of the wave
Wave earlier(const Wave& wave, double by);  // value(earlier(wave, by), t) = value(wave, t + by)

}  // namespace erbs
