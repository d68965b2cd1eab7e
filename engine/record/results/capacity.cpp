#include "engine/record/results/capacity.h"

#include <cmath>

#include "engine/base/units.h"

namespace erbs {
namespace {

Json bracket_json(const LimitBracket& b) {
  Json json = {{"stands", b.stands}, {"converged", b.converged}, {"mechanism", b.mechanism}};
  for (const auto& [key, value] : {std::pair{"lower", b.lower},
                                   {"upper", b.upper},
                                   {"associated_lower", b.associated_lower},
                                   {"associated_upper", b.associated_upper}})
    json[key] = b.stands && !b.unbounded ? Json(value) : Json();
  json["unbounded"] = b.unbounded;
  json["smooth_uprights"] = b.smooth ? Json(*b.smooth) : Json();
  return json;
}

}  // namespace

Json to_json(const Capacity& c) {
  const bool tilt = c.kind == "tilt";
  const CurvePoint& p = c.peak;
  Json json = {{"kind", c.kind}, {"multiplier", p.multiplier}, {"lower", p.multiplier}, {"upper", c.above ? Json(*c.above) : Json()}};
  json["angle_deg"] = tilt ? Json(std::atan(p.multiplier) * 180 / pi) : Json();
  json["displacement_m"] = p.displacement;
  json["largest_displacement_m"] = p.most;
  json["base_shear_N"] = p.base_shear;
  json["base_shear_over_weight"] = std::isnan(p.base_shear_over_weight) ? Json() : Json(p.base_shear_over_weight);
  json["joints_opened"] = p.opening;
  json["joints_slid"] = p.slid;
  json["past_peak"] = c.past_peak;
  json["gravity_alone"] = c.gravity_alone;
  json["mechanism"] = c.mechanism;
  json["mechanism_text"] = c.course;
  json["walls"] = Json::object();
  for (const auto& [group, does] : c.walls) json["walls"][group] = does;
  json["states"] = c.states;
  json["attempts"] = c.attempts;
  json["relaxation_steps"] = c.relaxation_steps;
  json["unbalanced_relative"] = c.worst_unbalanced;
  json["limit"] = Json();
  if (c.limit) json["limit"] = {{"dry", bracket_json(c.limit->dry)}, {"bonded", c.limit->bonded ? bracket_json(*c.limit->bonded) : Json()}};
  if (c.performance) json["performance"] = to_json(*c.performance);
  return json;
}

}  // namespace erbs
