#include "engine/analysis/limit/report.h"

#include <algorithm>
#include <cmath>

#include "engine/base/count.h"
#include "engine/base/units.h"
#include "engine/record/format/csv.h"

namespace erbs::analysis {
namespace {

Json to_json(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Json to_json(const Multiplier& m) {
  return {{"lower", m.lower}, {"upper", m.upper}, {"converged", m.converged}, {"iterations", m.iterations}, {"wall_s", m.seconds}};
}

}  // namespace

std::optional<double> tilt_angle(const LimitResult& r, const LimitLoad& load, const Model& m) {
  if (load.tilt && r.stands && !r.unbounded) return std::atan(r.last().middle()) * 180 / pi;
  const bool bonded = std::ranges::any_of(r.problem.contacts, [](const ContactPoint& p) { return p.tension > 0 || p.cohesion > 0; });
  const bool level = m.gravity.norm() > 0 && std::fabs(load.direction.dot(m.gravity)) < 1e-9 * m.gravity.norm();
  if (!r.stands || r.unbounded || bonded || !level || !load.pattern.empty() || !m.force_loads.empty()) return std::nullopt;
  return std::atan(r.last().middle()) * 180 / pi;
}

Json limit_json(const LimitResult& r, const LimitLoad& load, const Model& m) {
  const LimitMechanism mechanism = limit_mechanism(r, m);
  Json joints = Json::array();
  for (const MovedJoint& one : mechanism.joints.moved)
    joints.push_back({{"joint", m.joint_name(one.joint)}, {"kind", word(one.kind)}, {"at_m", {one.at[0], one.at[1], one.at[2]}}});
  Json out{{"blocks", r.problem.nbody},
           {"joints", m.njoint},
           {"contact_points", r.problem.contacts.size()},
           {"plane_problem", r.problem.plane},
           {"method", r.method},
           {"load", load.pattern.empty() ? "mass times g" : "pattern of forces"},
           {"direction", to_json(load.direction)},
           {"stands", r.stands},
           {"standing_share", r.standing_share},
           {"unbounded", r.unbounded},
           {"associated", r.stands ? to_json(r.associated) : Json(nullptr)},
           {"nonassociated", r.has_nonassociated ? to_json(r.nonassociated) : Json(nullptr)}};
  if (r.has_nonassociated) {
    out["nonassociated"]["rounds"] = r.rounds;
    out["nonassociated"]["friction_excess_share"] = r.friction_excess;
  }
  const std::optional<double> tilt = tilt_angle(r, load, m);
  out["tilt_deg"] = tilt ? Json(*tilt) : Json(nullptr);
  out["mechanism"] = {{"kind", mechanism.kind},
                      {"words", mechanism.words},
                      {"moving_blocks", mechanism.moving},
                      {"hinges", count(mechanism.joints, Movement::hinge)},
                      {"slides", count(mechanism.joints, Movement::slide)},
                      {"parted", count(mechanism.joints, Movement::part)},
                      {"drift", to_json(mechanism.drift)},
                      {"joints", joints}};
  out["wall_s"] = r.seconds;
  return out;
}

void write_mechanism(const LimitResult& r, const Model& m, const std::string& path) {
  CsvWriter table(path, {"block", "x_m", "y_m", "z_m", "vx_m_s", "vy_m_s", "vz_m_s", "wx_rad_s", "wy_rad_s", "wz_rad_s"});
  for (int b = 0; b < m.nblock; ++b) {
    std::vector<std::string> cells{m.block_name[z(b)]};
    const Twist v = r.velocity.empty() ? Twist{} : r.velocity[z(b)];
    for (const Vec3& of : {m.rest[z(b)], v.linear, v.angular})
      for (int i = 0; i < 3; ++i) cells.push_back(fmt::format("{:.9g}", of[i]));
    table.text_row(cells);
  }
  table.flush();
}

void write_thrusts(const LimitResult& r, const Model& m, const std::string& path) {
  const std::vector<Thrust> all = thrusts(r, m);
  std::vector<const char*> state(z(m.njoint), "closed");
  for (const MovedJoint& one : limit_mechanism(r, m).joints.moved) state[z(one.joint)] = word(one.kind);
  CsvWriter table(path, {"joint", "state", "x_m", "y_m", "z_m", "fx_N", "fy_N", "fz_N", "compression_N", "shear_N"});
  for (int j = 0; j < m.njoint; ++j) {
    const Thrust& one = all[z(j)];
    std::vector<std::string> cells{m.joint_name(j), state[z(j)]};
    for (const Vec3& of : {one.at, one.force})
      for (int i = 0; i < 3; ++i) cells.push_back(fmt::format("{:.9g}", of[i]));
    cells.push_back(fmt::format("{:.9g}", one.normal));
    cells.push_back(fmt::format("{:.9g}", one.shear));
    table.text_row(cells);
  }
  table.flush();
}

}  // namespace erbs::analysis
