// The performance point of a run folder: its curve.csv and shape.csv in, performance.json out.
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

// Where the performance point of the scene's own spectrum is, and where that of another one goes: performance_tbsc_2018_sds_0.9.json.
std::string own_performance(const std::string& dir);
std::string performance_of_spectrum(const std::string& dir, const DesignSpectrum& spectrum);

// Writes the JSON file `path`. An Error of performance_of() passes.
Performance evaluate_performance(const std::string& dir, const PerformanceDemand& demand, const std::string& path);

}  // namespace erbs
