// Files of a limit analysis: limit.json, mechanism.csv, thrust.csv, and the figure of thrust and mechanism.
#pragma once
#include <optional>
#include <string>

#include "engine/analysis/limit/outcome.h"
#include "engine/record/format/json.h"

namespace erbs::analysis {

// Tilt (deg) of the base at which the mechanism forms: atan of the multiplier of a tilt, and of a push where only the ratio of horizontal
// load to weight counts. A bond or a force does not turn with gravity: there a tilt is another load than the push, and there is none.
std::optional<double> tilt_angle(const LimitResult& result, const LimitLoad& load, const Model& model);

Json limit_json(const LimitResult& result, const LimitLoad& load, const Model& model);

// Velocity and spin of every block for 1 m/s of the fastest one.
void write_mechanism(const LimitResult& result, const Model& model, const std::string& path);
// Resultant of every joint with its centre of pressure: the thrust line.
void write_thrusts(const LimitResult& result, const Model& model, const std::string& path);

// Outlines in the plane of the push and the vertical: the structure with the thrusts in its joints, and its mechanism. SVG or PNG.
void draw_limit(const LimitResult& result, const LimitLoad& load, const Model& model, const std::string& title, const std::string& path);

}  // namespace erbs::analysis
