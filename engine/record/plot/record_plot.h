// Figure of a ground-motion record: acceleration, velocity, displacement, response spectrum.
#pragma once
#include <string>

#include "engine/loads/record/record_report.h"

namespace erbs {

// The same record before its correction, drawn in grey behind it.
struct Uncorrected {
  Record record;
  RecordReport report;
};

// Draws an SVG at `path` with gnuplot. `report` belongs to `record`.
void write_record_plot(const Record& record, const RecordReport& report, const std::string& path, const Uncorrected* before = nullptr);

}  // namespace erbs
