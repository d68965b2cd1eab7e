// The curve of a push as a figure: the multiplier over the displacement of the monitored point, and the joints that have opened and slid.
#pragma once
#include "engine/record/folder/run_folder.h"
#include "engine/record/plot/figure.h"
#include "render/run/run.h"

namespace erbs::render {

// `file`: name of curve.csv as gnuplot finds it.
plot::Figure push_figure(const std::string& file, const CsvTable& curve, const Run& run);

}  // namespace erbs::render
