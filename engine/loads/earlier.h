// A wave shifted in time.
#pragma once
#include "engine/loads/loads.h"

namespace erbs {

Wave earlier(const Wave& wave, double by);  // value(earlier(wave, by), t) = value(wave, t + by)

}  // namespace erbs
