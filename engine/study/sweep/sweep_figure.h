// The figure of a sweep: a map over two params of a grid, else the answer over one param with a line for each choice of the others.
#pragma once
#include <string>

#include "engine/study/sweep/sweep.h"

namespace erbs::study {

constexpr const char* results_stem = "results";  // of the names of the figures

// Draws results.csv as results.svg and results.png in the folder of the sweep. With Plan::split each value of that param has files of its
// own, such as results_method_1.svg. Does nothing if there is no number to draw. Throws Error.
void draw_results(const Sweep& sweep);

}  // namespace erbs::study
