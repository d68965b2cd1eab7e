#include "engine/record/results/metrics.h"

#include <malloc.h>
#include <sys/resource.h>

#include "engine/model/state.h"
#include "engine/record/results/mechanism.h"

namespace erbs {
namespace {

Json numbers(const std::vector<std::pair<std::string, double>>& pairs) {
  Json json = Json::object();
  for (const auto& [name, value] : pairs) json[name] = value;
  return json;
}

}  // namespace

std::vector<std::pair<std::string, double>> energy_terms(const Energy& e) {
  return {{"base_work_J", e.base_work},
          {"external_work_J", e.external_work},
          {"tilt_work_J", e.tilt_work},
          {"kinetic_J", e.kinetic},
          {"gravity_J", e.gravity},
          {"elastic_J", e.elastic},
          {"friction_J", e.friction},
          {"fracture_J", e.fracture},
          {"crushing_J", e.crushing},
          {"damping_J", e.damping},
          {"contact_damping_J", e.contact_damping},
          {"reset_J", e.reset},
          {"sleep_J", e.sleep}};
}

std::vector<std::string> metric_keys(const std::vector<std::string>& groups) {
  Metrics all;
  all.energy = energy_terms(Energy{});
  all.capacity.emplace();
  for (const std::string& group : groups) all.capacity->walls.emplace_back(group, "");
  all.capacity->limit.emplace().bonded.emplace();
  all.capacity->performance.emplace();
  std::vector<std::string> keys;
  const auto add = [&keys](auto& self, const Json& json, const std::string& before) -> void {
    for (const auto& [key, value] : json.items()) {
      if (value.is_object() && !value.empty()) self(self, value, before + key + ".");
      else if (before + key != "metrics") keys.push_back(before + key);
    }
  };
  add(add, to_json(all), "");
  return keys;
}

Metrics::Collapse::Mechanism mechanism_metrics(const Mechanism& mechanism, const Model& model) {
  Metrics::Collapse::Mechanism out;
  if (mechanism.time < 0) return out;
  out.time_s = mechanism.time;
  out.summary = summary(mechanism, model);
  out.hinges = count(mechanism, Movement::hinge);
  out.slides = count(mechanism, Movement::slide);
  out.parted = count(mechanism, Movement::part);
  for (const MovedJoint& moved : mechanism.moved)
    out.joints.push_back({{"joint", model.joint_name(moved.joint)},
                          {"kind", word(moved.kind)},
                          {"opening_m", moved.opening},
                          {"slip_m", moved.slip},
                          {"gap_m", moved.gap},
                          {"rotation_rad", moved.rotation},
                          {"at_m", {moved.at[0], moved.at[1], moved.at[2]}}});
  return out;
}

Json to_json(const Metrics& m) {
  const double solve = m.wall_s.solve;
  const double simulated = m.simulated_s < 0 ? m.time_s : m.simulated_s;
  Json json;
  json["status"] = m.status;
  json["time_s"] = m.time_s;
  json["steps"] = m.steps;
  json["dt_s"] = m.dt_s;
  json["dt_critical_s"] = m.dt_critical_s;
  json["dt_block_bound_s"] = m.dt_block_bound_s;
  json["threads"] = m.threads;
  json["blocks"] = m.blocks;
  json["joints"] = m.joints;
  json["contact_points"] = m.contact_points;
  json["joints_broken"] = m.joints_broken;
  json["blocks_asleep"] = m.blocks_asleep;
  json["wall_s"] = {{"total", m.wall_s.total},   {"setup", m.wall_s.setup},         {"solve", solve},
                    {"joints", m.wall_s.joints}, {"contact", m.wall_s.contact},     {"search", m.wall_s.search},
                    {"ledger", m.wall_s.ledger}, {"integrate", m.wall_s.integrate}, {"record", m.wall_s.record}};
  json["realtime_factor"] = solve > 0 ? simulated / solve : 0.0;
  json["point_updates"] = m.point_updates;
  json["point_updates_per_s"] = solve > 0 ? double(m.point_updates) / solve : 0.0;
  json["peak_memory_bytes"] = m.peak_memory_bytes;
  json["effects"] = {{"on", m.effects_on}, {"off", m.effects_off}};
  json["energy"] = {{"frame", m.energy_frame}};
  json["energy"].update(numbers(m.energy));
  json["energy"]["residual_relative"] = m.residual_relative;
  json["momentum_residual"] = m.momentum_residual;
  json["max_penetration_relative"] = m.max_penetration_relative;
  Json& collapse = json["collapse"];
  collapse["collapsed"] = m.collapse.collapsed;
  collapse["under_gravity"] = m.collapse.under_gravity;
  if (m.collapse.under_gravity) collapse["under"] = m.collapse.under;
  collapse["time_s"] = m.collapse.time_s ? Json(*m.collapse.time_s) : Json();
  collapse["direction"] = m.collapse.direction ? Json(*m.collapse.direction) : Json();
  collapse["fallen_fraction"] = m.collapse.fallen_fraction;
  collapse["moving_fraction"] = m.collapse.moving_fraction;
  json["trust"] = {{"energy_residual", m.diagnostics.energy_residual},
                   {"energy_residual_time_s", m.diagnostics.energy_residual_time},
                   {"energy_residual_where", m.diagnostics.energy_residual_where},
                   {"max_penetration_relative", m.diagnostics.penetration},
                   {"dt_margin", m.diagnostics.dt_margin},
                   {"reset_share", m.diagnostics.reset_share},
                   {"warned_share", m.diagnostics.warned_share},
                   {"past_gate_share", m.diagnostics.past_tolerance_share},
                   {"past_step_share", m.diagnostics.past_step_share},
                   {"sinking_share", m.diagnostics.sinking_share},
                   {"momentum_residual", m.diagnostics.momentum_residual},
                   {"twin", m.diagnostics.twin},
                   {"chaos_horizon_s", m.diagnostics.chaos_horizon ? Json(*m.diagnostics.chaos_horizon) : Json()}};
  collapse["moved"] = m.collapse.moved;
  collapse["course"] = m.collapse.course;
  collapse["sequence"] = m.collapse.sequence;
  const auto& mechanism = m.collapse.mechanism;
  collapse["mechanism"] = {{"time_s", mechanism.time_s ? Json(*mechanism.time_s) : Json()},
                           {"summary", mechanism.summary},
                           {"hinges", mechanism.hinges},
                           {"slides", mechanism.slides},
                           {"parted", mechanism.parted},
                           {"joints", mechanism.joints}};
  if (m.capacity) json["capacity"] = to_json(*m.capacity);
  json["equilibrium"] = {{"iterations", m.equilibrium.iterations},
                         {"unbalanced_relative", m.equilibrium.unbalanced},
                         {"islands_without", m.equilibrium.islands_without},
                         {"wall_s", m.equilibrium.wall}};
  json["state_hash"] = m.state_hash;
  json["expectations"] = {{"passed", m.expectations_passed}, {"failed", m.expectations_failed}};
  json["metrics"] = numbers(m.metrics);
  return json;
}

Metrics::Diagnostics diagnostics_of(const Json& metrics) {
  Metrics::Diagnostics t;
  const auto number = [&](const char* key) {
    const Json* value = find_key(metrics, key);
    return value != nullptr && value->is_number() ? value->get<double>() : 0.0;
  };
  t.energy_residual = number("trust.energy_residual");
  t.energy_residual_time = number("trust.energy_residual_time_s");
  if (const Json* where = find_key(metrics, "trust.energy_residual_where"); where != nullptr && where->is_string())
    t.energy_residual_where = *where;
  t.penetration = number("trust.max_penetration_relative");
  t.dt_margin = number("trust.dt_margin");
  t.reset_share = number("trust.reset_share");
  t.warned_share = number("trust.warned_share");
  t.past_tolerance_share = number("trust.past_gate_share");
  t.past_step_share = number("trust.past_step_share");
  t.sinking_share = number("trust.sinking_share");
  t.momentum_residual = number("trust.momentum_residual");
  if (const Json* twin = find_key(metrics, "trust.twin"); twin != nullptr && twin->is_boolean()) t.twin = *twin;
  if (const Json* horizon = find_key(metrics, "trust.chaos_horizon_s"); horizon != nullptr && horizon->is_number())
    t.chaos_horizon = horizon->get<double>();
  return t;
}

void write_metrics(const std::string& dir, const Metrics& metrics) { write_json(dir + "/metrics.json", to_json(metrics)); }

Json read_metrics(const std::string& dir) { return read_json(dir + "/metrics.json"); }

std::uint64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::uint64_t(usage.ru_maxrss) * 1024;  // Linux reports KiB
}

void return_free_memory() { ::malloc_trim(0); }

}  // namespace erbs
