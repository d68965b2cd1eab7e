// The performance point of a run folder: its curve.csv and shape.csv in, performance.json and performance.svg out.
#pragma once
#include <string>
#include <vector>

#include "engine/record/performance/performance.h"

namespace erbs {

// DIR/shape.csv: the monitored point, then every block that moves.
void write_shape(const std::string& dir, const PushShape& shape);
PushShape read_shape(const std::string& dir);

// Of DIR/curve.csv, with the times of DIR/histories.csv. Error if the folder is not one of a pushover.
BaseShearCurve read_base_shear_curve(const std::string& dir);

// Writes DIR/performance.json. An Error of performance_of() passes.
Performance evaluate_performance(const std::string& dir, const PerformanceDemand& demand);

}  // namespace erbs
