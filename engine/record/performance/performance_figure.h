// The performance point as a figure: acceleration over displacement of the oscillator, with the spectrum in the same axes (ADRS).
#pragma once
#include "engine/record/performance/performance.h"
#include "engine/record/plot/figure.h"

namespace erbs {

plot::Figure performance_figure(const Performance& performance, const DesignSpectrum& spectrum, const std::string& title);
// The picture `path`, with gnuplot; nothing without a performance point.
void draw_performance(const std::string& path, const Performance& performance, const DesignSpectrum& spectrum, const std::string& title);

}  // namespace erbs
