// The figure of a sweep: a map over two params of a grid, else the answer over one param with a line for each choice of the others.
#pragma once
#include <string>

#include "engine/study/sweep/sweep.h"

namespace erbs::study {

// Draws results.csv in the folder of the sweep. Does nothing if there is no number to draw. Throws Error.
void draw_results(const Sweep& sweep, const std::string& path);

}  // namespace erbs::study
