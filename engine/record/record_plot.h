// The picture of a ground-motion record: acceleration, velocity, displacement, response spectrum.
#pragma once
#include <string>

#include "engine/loads/record_report.h"

namespace erbs {

// An SVG at `path`, drawn by gnuplot. `report` is that of `record`.
void write_record_plot(const Record& record, const RecordReport& report, const std::string& path);

}  // namespace erbs
