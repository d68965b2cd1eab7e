#include "engine/joints/response.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/geometry/clip.h"
#include "engine/laws/yield.h"
#include "engine/model/levels.h"

namespace erbs {

using namespace ERBS_TARGET;  // the laws, for one number

namespace {

struct PointGap {
  double s, t, n;  // m
};

PointGap gap_at(const double* gap, double s, double t) {
  return {gap[0] - gap[5] * t, gap[1] + gap[5] * s, gap[2] + gap[3] * t - gap[4] * s};
}

// Closed-form integrals over a polygon of max(p, 0), p = sign times the gap (linear in s, t), of its first moments and of its square. Over
// a triangle with corner values p_i: Int p s = A/12 (sum p sum s + sum p_i s_i), Int p^2 = A/12 ((sum p)^2 + sum p_i^2).
struct Positive {
  double p = 0, s = 0, t = 0, square = 0;  // m3; m4: Int p s, Int p t; m4: Int p^2
};

struct Corner {
  double s, t, p;  // m
};

void add_triangle(const Corner& a, const Corner& b, const Corner& c, Positive& out) {
  const double area = 0.5 * ((b.s - a.s) * (c.t - a.t) - (c.s - a.s) * (b.t - a.t));
  const double p = a.p + b.p + c.p;
  out.p += area / 3 * p;
  out.s += area / 12 * (p * (a.s + b.s + c.s) + a.p * a.s + b.p * b.s + c.p * c.s);
  out.t += area / 12 * (p * (a.t + b.t + c.t) + a.p * a.t + b.p * b.t + c.p * c.t);
  out.square += area / 12 * (p * p + a.p * a.p + b.p * b.p + c.p * c.p);
}

// For any simple loop: signed triangles from its first corner.
Positive positive_part(const Eigen::Vector2d* corner, int corners, const double* gap, double sign) {
  Positive sum;
  std::array<Corner, 3> fan{};
  int count = 0;
  const auto value = [&](int i) { return sign * gap_at(gap, corner[i].x(), corner[i].y()).n; };
  cut_polygon(
      corners, [&](int i) -> const Vec2& { return corner[i]; }, value,
      [&](const Vec2& at, double p) {
        fan[std::size_t(std::min(count++, 2))] = {at.x(), at.y(), p};
        if (count < 3) return;
        add_triangle(fan[0], fan[1], fan[2], sum);
        fan[1] = fan[2];
      });
  return sum;
}

// The same where the face lies in its points.
Positive positive_at(const Point* point, int points, const double* gap, double sign) {
  Positive sum;
  for (int i = 0; i < points; ++i) {
    const double p = std::max(0.0, sign * gap_at(gap, point[i].s, point[i].t).n), volume = point[i].weight * p;
    sum.p += volume, sum.s += volume * point[i].s, sum.t += volume * point[i].t, sum.square += volume * p;
  }
  return sum;
}

// The no-tension integral over the overlap polygon: N = kn Int max(-g, 0) dA, its first moments and its energy.
Pressed compression(const Model& m, const Joint& joint, const double* gap, double kn) {
  const double share = kn / m.laws[std::size_t(joint.type->law)].kn;
  // open everywhere: no force; closed everywhere: a linear pressure about the centroid
  const double reach = std::fabs(gap[3]) * joint.type->half_t + std::fabs(gap[4]) * joint.type->half_s;
  if (gap[2] - reach >= 0) return {};
  if (gap[2] + reach < 0) {
    const Pressed c{share * (-joint.type->stiffness[2] * gap[2]), share * (joint.type->face[1] * gap[4] - joint.type->face[2] * gap[3]),
                    share * (joint.type->face[2] * gap[4] - joint.type->face[0] * gap[3]), 0};
    return {c.force, c.s, c.t, 0.5 * (c.s * gap[4] - c.force * gap[2] - c.t * gap[3])};
  }
  const std::size_t first = std::size_t(joint.type->first_cell);
  const Positive p = m.cell[first].lumped()
                         ? positive_at(&m.point[first], joint.type->points, gap, -1)
                         : positive_part(&m.overlap_corner[std::size_t(joint.type->first_corner)], joint.type->corners, gap, -1);
  return {kn * p.p, kn * p.s, kn * p.t, 0.5 * kn * p.square};
}

// Rate of the dashpots of the closed part from the force `then` to `now` (N): they may not pull.
double compression_rate(double rate, double now, double then) {
  const double pull = rate * (then - now);
  return pull > now ? rate * now / pull : rate;
}

// The gap as a plane over s, t.
std::array<double, 3> gap_plane(const double* gap) { return {gap[2], -gap[4], gap[3]}; }

// The same for a face that may have been crushed.
Pressed compression(const Model& m, const Joint& joint, const CrushedFace* crushed, const double* gap, double kn) {
  if (crushed == nullptr || crushed->planes == 0) return compression(m, joint, gap, kn);
  return pressed(compression_face(m, joint, kn), *crushed, gap_plane(gap).data());
}

// Tension of the cell of point i at unit stiffness: Int max(g, 0) dA and its first moments. The cells of undamaged points and the
// compression add up to the intact joint. So a crack changes no other part of a joint, and no tangent is stiffer than the intact one.
struct Pull {
  double n = 0, s = 0, t = 0;  // m3, m4, m4
};

Pull pull_of(const Model& m, int i, const double* gap) {
  const Cell& cell = m.cell[std::size_t(i)];
  const Positive p = cell.lumped() ? positive_at(&m.point[std::size_t(i)], 1, gap, 1)
                                   : positive_part(&m.cell_loop[std::size_t(cell.first)], cell.corners, gap, 1);
  return {p.p, p.s, p.t};
}

PointLaw law_of(const Model& m, const Joint& joint, const JointPast& past) {
  PointLaw law = m.laws[std::size_t(joint.type->law)];
  law.kn *= past.share.n, law.ks *= past.share.s;
  return law;
}

double work_of(const Pull& p, const double* gap) { return p.n * gap[2] + p.t * gap[3] - p.s * gap[4]; }

// Widest opening of the cell of point i; it damages the bond. The opening of the point itself would be wrong: a crack could stop at the
// border of the cell, and the cell could pull with any stress beyond it. sign = -1: the deepest closing.
double widest(const Model& m, int i, const double* gap, double at_point, double sign = 1) {
  const Cell& cell = m.cell[std::size_t(i)];
  double most = sign * at_point;
  for (int k = cell.first; k < cell.first + cell.corners; ++k) {
    const auto& c = m.tension_loop[std::size_t(k)];
    most = std::max(most, sign * gap_at(gap, c.x(), c.y()).n);
  }
  return most;
}

// Shear of one point. `normal`: its compressive force (N); `sigma`: its tension (Pa); `limit` receives what it can transmit (N).
InPlane<double> shear(const PointLaw& law, const Point& point, double normal, double sigma, const double* gap_before, const PointGap& now,
                      Bond<double>& bond, PointHistory& h, JointEnergy& energy, double& limit) {
  const double k = law.ks * point.weight;
  const auto strength = [&] { return bond_shear(law, sigma, bond.damage) * point.weight + friction_at(law, bond.damage) * normal; };
  SlipReturn<double> slip{{now.s - h.slip_s, now.t - h.slip_t}, {h.slip_s, h.slip_t}, 0, 0};
  limit = strength();
  const double size = k * std::sqrt(square(slip.elastic));
  if (size <= limit) return {k * slip.elastic.s, k * slip.elastic.t};
  const PointGap then = gap_at(gap_before, point.s, point.t);
  return_slip(law, bond, law.has_bond(), true, k, point.weight, size, limit, normal, sigma, {then.s - h.slip_s, then.t - h.slip_t}, slip);
  limit = strength();
  h.slip_s = slip.plastic.s, h.slip_t = slip.plastic.t;
  energy.friction += slip.friction;
  energy.fracture += slip.fracture;
  return {k * slip.elastic.s, k * slip.elastic.t};
}

// For rules that are not exact in bending: an intact joint has the stiffness of its points, a cracked joint that of its true faces. The
// change sets energy free (or takes it up), which is booked with the crack. It is the difference of the mixed energies q0 K q1 / 2, since
// the work of the step is the mean of its two forces.
double change_of_form(const Joint& joint, const double* gap_before, const double* gap_now) {
  return 0.5 * ((joint.type->stiffness[3] - joint.type->face[0]) * gap_before[3] * gap_now[3] +
                (joint.type->stiffness[4] - joint.type->face[1]) * gap_before[4] * gap_now[4] +
                joint.type->face[2] * (gap_before[3] * gap_now[4] + gap_before[4] * gap_now[3]));
}

}  // namespace

bool stays_intact(const Model& m, const Joint& joint, const double* gap) {
  const PointLaw& law = m.laws[std::size_t(joint.type->law)];
  for (int i = 0; i < joint.type->corners; ++i) {
    const auto& c = m.overlap_corner[std::size_t(joint.type->first_corner + i)];
    if (corner_yields(law, gap_at(gap, c.x(), c.y()).n)) return false;
  }
  for (int i = 0; i < joint.type->points; ++i) {
    const Point& x = m.point[std::size_t(joint.type->first_cell + i)];
    const PointGap g = gap_at(gap, x.s, x.t);
    if (point_yields(law, g.n, g.s * g.s + g.t * g.t)) return false;
  }
  return true;
}

JointPast past_of(const Model& m, State& s, int j) {
  JointPast past(&s.joints.history[std::size_t(m.joint[std::size_t(j)].first_point)],
                 s.joints.crushed.empty() ? nullptr : &s.joints.crushed[std::size_t(j)]);
  past.share = stiffness_share(s, j);
  return past;
}

double stored_in_compression(const Model& m, const Joint& joint, const JointPast& past, const double* gap) {
  const PointLaw law = law_of(m, joint, past);
  return compression(m, joint, law.crushes() ? past.crushed : nullptr, gap, law.kn).energy;
}

double asperity_lift(const PointLaw& law, const JointMemory& memory) {
  double lift = 0;
  with_face(law, [&](auto face) {
    if constexpr (decltype(face)::lifts) lift = memory.own[face.uplift];
  });
  return lift;
}

double lift_by_asperities(const Model& m, const Joint& joint, const JointMemory& memory, double gap[6]) {
  const PointLaw& law = m.laws[std::size_t(joint.type->law)];
  double lift = asperity_lift(law, memory);
  gap[2] -= lift;
  with_face(law, [&](auto face) {
    if constexpr (decltype(face)::lifts) {
      const double force = compression(m, joint, gap, law.kn).force;
      const double rise = face.coming_rise(law, memory.own, gap[0], gap[1], force, joint.type->stiffness[0] / law.ks);
      gap[2] -= rise;
      lift += rise;
    }
  });
  return lift;
}

double advance_asperities(const Model& m, const Joint& joint, const PointHistory* point, double across, double lift, JointMemory& memory) {
  const PointLaw& law = m.laws[std::size_t(joint.type->law)];
  double work = 0;
  with_face(law, [&](auto face) {
    if constexpr (decltype(face)::lifts) {
      work = across * (lift - memory.own[face.used]);
      InPlane<double> slip{0, 0};
      for (int i = 0; i < joint.type->points; ++i) {
        const double share = m.point[std::size_t(joint.type->first_cell + i)].weight / joint.type->area;
        slip = {slip.s + share * point[i].slip_s, slip.t + share * point[i].slip_t};
      }
      face.advance(law, memory.own, slip, lift);
    }
  });
  return work;
}

bool may_release(const Joint& joint, const PointLaw& law, const JointMemory& memory) {
  double released = 1;
  with_face(law, [&](auto face) {
    if constexpr (decltype(face)::lifts) released = face.released(law, memory.own, memory.gap, joint.type->half_s, joint.type->half_t);
  });
  return released > 0;
}

CompressionFace compression_face(const Model& m, const Joint& joint, double kn) {
  const PointLaw& law = m.laws[std::size_t(joint.type->law)];
  const std::size_t first = std::size_t(joint.type->first_cell);
  if (m.cell[first].lumped()) return {kn, law.fc / kn, 0, nullptr, law.crush_depth, joint.type->points, &m.point[first].s};
  return {kn, law.fc / kn, joint.type->corners, m.overlap_corner[std::size_t(joint.type->first_corner)].data(), law.crush_depth};
}

namespace {

// Friction needs the pressure at the points: the force of the closed-form integral is distributed by the depths of the points. If no point
// is pressed, the deepest one receives all of it.
void distribute_pressure(const Model& m, const Joint& joint, const CrushedFace* crushed, const double* gap, double kn, double force,
                         double* at_points) {
  const Point* point = &m.point[std::size_t(joint.type->first_cell)];
  const bool flattened = crushed != nullptr && crushed->planes > 0;
  const CompressionFace face = compression_face(m, joint, kn);
  double share = 0, least = 0;
  int deepest = 0;
  for (int i = 0; i < joint.type->points; ++i) {
    const double g = gap_at(gap, point[i].s, point[i].t).n;
    const double depth = flattened ? pressed_depth(face, *crushed, gap_plane(gap).data(), point[i].s, point[i].t) : std::max(0.0, -g);
    at_points[i] = depth * point[i].weight;
    share += at_points[i];
    if (i == 0 || g < least) least = g, deepest = i;
  }
  const double scale = share > 0 ? force / share : 0;
  for (int i = 0; i < joint.type->points; ++i) at_points[i] *= scale;
  if (share == 0) at_points[deepest] = force;
}

}  // namespace

InterlockStep interlock_step(const Model& m, const State& s) {
  const TimeStep& t = s.time;
  const bool levels = has_levels(t);
  const int macro_steps = std::max(1, interlock_every / t.substeps);  // between two updates, with levels
  const bool due = levels ? at_macro_step(t) && t.macro % macro_steps == 0 : t.step % interlock_every == 0;
  return {m.gravity.norm(), t.last_dt, t.last_dt, due ? (levels ? macro_steps * t.last_substeps : interlock_every) * t.last_dt : 0};
}

bool respond(const Model& m, int j, bool intact, const double* gap_before, const double* gap, JointPast past, double* resultant,
             JointEnergy& energy, double* shear_limit) {
  const Joint& joint = m.joint[std::size_t(j)];
  const PointLaw law = law_of(m, joint, past);
  if (intact && stays_intact(m, joint, gap)) {
    for (int i = 0; i < 6; ++i) {
      resultant[i] = joint.type->stiffness[i] * gap[i];
      energy.elastic += 0.5 * resultant[i] * gap[i];
    }
    return true;
  }
  const Point* point = &m.point[std::size_t(joint.type->first_cell)];
  std::array<double, most_points_per_joint> pressure;  // N, compressive force of each point
  if (law.crushes())
    energy.crushing += crush(compression_face(m, joint, law.kn), *past.crushed, gap_plane(gap_before).data(), gap_plane(gap).data());
  const CrushedFace* crushed = law.crushes() ? past.crushed : nullptr;
  const Pressed closed = compression(m, joint, crushed, gap, law.kn);
  resultant[0] = resultant[1] = resultant[5] = 0;
  resultant[2] = -closed.force;
  resultant[3] = -closed.t;
  resultant[4] = closed.s;
  energy.elastic += closed.energy;
  if (intact) energy.fracture += change_of_form(joint, gap_before, gap);
  const double then = past.rate > 0 ? compression(m, joint, crushed, gap_before, law.kn).force : 0;
  const double pressing = std::max(0.0, closed.force - compression_rate(past.rate, closed.force, then) * (then - closed.force));
  distribute_pressure(m, joint, crushed, gap, law.kn, past.rate > 0 ? pressing : closed.force, pressure.data());
  const bool slow = slides_slowly(past.interlock, gap, gap_before, joint.type->radius);
  for (int i = 0; i < joint.type->points; ++i) {
    PointHistory& h = past.point[i];
    const PointGap g = gap_at(gap, point[i].s, point[i].t);
    const int cell = joint.type->first_cell + i;
    const bool holds = h.damage < 1 && law.has_bond();
    Bond<double> bond{h.damage, h.secant, h.kappa};
    const double before = bond.stiffness(law);
    double sigma = 0, limit = 0;
    if (holds) {
      sigma = damage_by_opening(law, bond, holds, widest(m, cell, gap, g.n), g.n);
      if (law.closing_ultimate > 0) damage_by_closing(law, bond, holds, widest(m, cell, gap, g.n, -1), sigma);
    }
    const double weight = point[i].weight, stress = pressure[std::size_t(i)] / weight;
    if (intact && !law.has_bond()) h.mean_pressure = stress;  // under which its asperities have been interlocked so far
    const double held = interlocked_stress(past.interlock, h.mean_pressure, h.lent, g.n, stress, slow);
    const InPlane<double> tau = shear(law, point[i], weight * held, sigma, gap_before, g, bond, h, energy, limit);
    h.lent = lent_after(
        past.interlock, h.lent, stress, held,
        pressure_of_friction(std::sqrt(square(tau)), bond_shear(law, sigma, bond.damage) * weight, friction_at(law, bond.damage), weight));
    h.damage = bond.damage, h.secant = bond.secant, h.kappa = bond.kappa;
    if (shear_limit != nullptr) shear_limit[i] = limit;
    resultant[0] += tau.s;
    resultant[1] += tau.t;
    resultant[5] += tau.t * point[i].s - tau.s * point[i].t;
    energy.elastic += 0.5 * (tau.s * (g.s - h.slip_s) + tau.t * (g.t - h.slip_t));
    if (!holds) continue;
    const double after = bond.stiffness(law);
    const Pull pull = pull_of(m, cell, gap);
    // Half the loss of stiffness times Int g0 g1 over the open part of the cell, as the mean over the open parts before and after.
    if (before != after) {
      const double both = work_of(pull, gap_before) + work_of(pull_of(m, cell, gap_before), gap);
      energy.fracture += 0.25 * (before - after) * std::max(0.0, both);
    }
    resultant[2] += after * pull.n;
    resultant[3] += after * pull.t;
    resultant[4] -= after * pull.s;
    energy.elastic += 0.5 * after * work_of(pull, gap);
  }
  return false;
}

void viscous_response(const Model& m, int j, const double* gap_before, const double* gap, const PointHistory* before, JointPast after,
                      const double* shear_limit, double rate, double* resultant) {
  const Joint& joint = m.joint[std::size_t(j)];
  const PointLaw law = law_of(m, joint, after);
  for (int i = 0; i < 6; ++i) resultant[i] = 0;
  for (int i = 0; i < joint.type->points; ++i) {
    const Point& point = m.point[std::size_t(joint.type->first_cell + i)];
    const PointHistory& h = after.point[i];
    const PointGap g0 = gap_at(gap_before, point.s, point.t), g1 = gap_at(gap, point.s, point.t);
    const bool holds = h.damage < 1 && law.has_bond();
    if ((holds || g1.n < 0) && h.slip_s == before[i].slip_s && h.slip_t == before[i].slip_t) {
      const double k = law.ks * point.weight, s = rate * k * (g1.s - g0.s), t = rate * k * (g1.t - g0.t);
      const double x = share_of_drag({k * (g1.s - h.slip_s), k * (g1.t - h.slip_t)}, {s, t}, shear_limit[i]);
      resultant[0] += x * s;
      resultant[1] += x * t;
      resultant[5] += x * (t * point.s - s * point.t);
    }
    if (!holds) continue;
    const double k = rate * (h.damage > 0 ? h.secant : law.kn);
    const Pull p0 = pull_of(m, joint.type->first_cell + i, gap_before), p1 = pull_of(m, joint.type->first_cell + i, gap);
    resultant[2] += k * (p1.n - p0.n);
    resultant[3] += k * (p1.t - p0.t);
    resultant[4] -= k * (p1.s - p0.s);
  }
  const CrushedFace* crushed = law.crushes() ? after.crushed : nullptr;
  const Pressed now = compression(m, joint, crushed, gap, law.kn), then = compression(m, joint, crushed, gap_before, law.kn);
  const double share = compression_rate(rate, now.force, then.force);
  resultant[2] += share * (then.force - now.force);
  resultant[3] += share * (then.t - now.t);
  resultant[4] -= share * (then.s - now.s);
}

}  // namespace erbs
