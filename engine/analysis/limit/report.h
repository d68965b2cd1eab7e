// Files of a limit analysis: limit.json, mechanism.csv, thrust.csv, and the figure of thrust and mechanism.
#pragma once
#include <string>

#include "engine/analysis/limit/outcome.h"
#include "engine/record/format/json.h"

namespace erbs::analysis {

Json limit_json(const LimitResult& result, const LimitLoad& load, const Model& model);

// Velocity and spin of every block for 1 m/s of the fastest one.
void write_mechanism(const LimitResult& result, const Model& model, const std::string& path);
// Resultant of every joint with its centre of pressure: the thrust line.
void write_thrusts(const LimitResult& result, const Model& model, const std::string& path);

// Outlines in the plane of the push and the vertical: the structure with the thrusts in its joints, and its mechanism. SVG or PNG.
void draw_limit(const LimitResult& result, const LimitLoad& load, const Model& model, const std::string& title, const std::string& path);

}  // namespace erbs::analysis
