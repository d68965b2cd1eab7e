#include "engine/analysis/limit/problem.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/count.h"
#include "engine/base/units.h"
#include "engine/loads/loads.h"

namespace erbs::analysis {
namespace {

double weight_mass(const Model& m, int b) { return m.mass[z(b)] * (m.gravity_factor.empty() ? 1 : m.gravity_factor[z(b)]); }  // kg

// A place of a joint with the area of its bond.
struct Place2 {
  Vec3 at;          // m, world
  double area = 0;  // m2
};

Vec3 centre_of(const Model& m, const Joint& joint) { return m.rest[z(joint.a)] + joint.arm_a; }

// Corners of the overlap, and the contact points of the run where there is a bond.
std::vector<Place2> places_of(const Model& m, const Joint& joint, bool bonded) {
  const JointType& type = *joint.type;
  const Vec3 centre = centre_of(m, joint);
  std::vector<Place2> out;
  const auto add = [&](double s, double t, double area) {
    const Vec3 at = centre + s * type.frame.col(0) + t * type.frame.col(1);
    const auto same = std::find_if(out.begin(), out.end(), [&](const Place2& p) { return (p.at - at).norm() < 1e-9 * type.radius; });
    if (same == out.end()) out.push_back({at, area});
    else same->area += area;
  };
  for (int i = type.first_corner; i < type.first_corner + type.corners; ++i) {
    const Eigen::Vector2d& corner = m.overlap_corner[z(i)];
    add(corner.x(), corner.y(), 0);
  }
  for (int i = type.first_cell; bonded && i < type.first_cell + type.points; ++i)
    add(m.point[z(i)].s, m.point[z(i)].t, m.point[z(i)].weight);
  return out;
}

// Number of moving blocks; fills block_of and body_of.
void number_bodies(const Model& m, LimitProblem& p) {
  p.body_of.assign(z(m.nblock), -1);
  for (int b = 0; b < m.nblock; ++b) {
    if (m.kind[z(b)] != Kind::moving) continue;
    p.body_of[z(b)] = int(p.block_of.size());
    p.block_of.push_back(b);
  }
  p.nbody = int(p.block_of.size());
  if (p.nbody == 0) throw Error("limit analysis needs a block that can move; all blocks of this scene are fixed or driven");
}

// A part that does not lead to the ground falls, whatever is pushed.
void refuse_floating(const Model& m) {
  std::vector<int> root(z(m.nblock));
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int b) {
    while (root[z(b)] != b) b = root[z(b)] = root[z(root[z(b)])];
    return b;
  };
  int ground = -1;
  for (int b = 0; b < m.nblock; ++b)
    if (m.kind[z(b)] != Kind::moving) {
      if (ground < 0) ground = b;
      root[z(find(b))] = find(ground);
    }
  for (const Joint& joint : m.joint) root[z(find(joint.a))] = find(joint.b);
  std::vector<std::string> names;
  int floating = 0;
  for (int b = 0; b < m.nblock; ++b) {
    if (ground >= 0 && find(b) == find(ground)) continue;
    if (++floating <= 3) names.push_back(m.block_name[z(b)]);
  }
  if (floating == 0) return;
  throw Error(
      fmt::format("limit analysis: {} block{} no path of joints to the ground ({}{}); give a joint{{}} rule that reaches {}, or "
                  "leave {} out of the scene",
                  floating, floating == 1 ? " has" : "s have", fmt::join(names, ", "), floating > 3 ? ", ..." : "",
                  floating == 1 ? "it" : "them", floating == 1 ? "it" : "them"));
}

// Constant forces and moments (N, N m, world axes) of a block, and those of the pushing load.
struct Loads {
  std::vector<Twist> constant, push;  // linear: force, angular: moment [nblock]
};

Loads loads_of(const Model& m, const LimitLoad& load, double g, double factor) {
  Loads out{std::vector<Twist>(z(m.nblock)), std::vector<Twist>(z(m.nblock))};
  for (int b = 0; b < m.nblock; ++b) {
    out.constant[z(b)].linear = weight_mass(m, b) * m.gravity;
    if (load.pattern.empty()) out.push[z(b)].linear = weight_mass(m, b) * g * load.direction;
  }
  for (const auto& one : m.force_loads) {
    const Vec3 f = factor * value(one.wave, 0) * one.direction;
    (one.moment ? out.constant[z(one.block)].angular : out.constant[z(one.block)].linear) += f;
    if (!one.moment) out.constant[z(one.block)].angular += one.arm.cross(f);
  }
  for (const BlockLoad& one : load.pattern) {
    out.push[z(one.block)].linear += one.force;
    out.push[z(one.block)].angular += one.moment;
  }
  return out;
}

// Whether the corners of every joint, and all loads, are symmetric about the plane through the blocks' centres with the normal `across`.
// The mean of a solution and its mirror image is then a solution too, so that the problem has a plane one with the same multiplier.
bool symmetric_about(const Model& m, const Vec3& across, const LimitProblem& p, const Loads& loads) {
  const double middle = across.dot(m.rest[z(p.block_of.front())]);
  for (const int b : p.block_of) {
    if (std::fabs(across.dot(m.rest[z(b)]) - middle) > 1e-6 * m.smallest_edge[z(b)]) return false;
    for (const auto* of : {&loads.constant, &loads.push}) {
      const Twist& one = (*of)[z(b)];
      if (std::fabs(across.dot(one.linear)) > 1e-9 * one.linear.norm()) return false;
      if (across.cross(one.angular).norm() > 1e-9 * one.angular.norm()) return false;
    }
  }
  for (const Joint& joint : m.joint) {
    if (std::fabs(across.dot(joint.type->frame.col(2))) > 1e-6) return false;
    const std::vector<Place2> places = places_of(m, joint, false);
    const double near = 1e-6 * joint.type->radius;
    for (const Place2& one : places) {
      const Vec3 mirrored = one.at - 2 * (across.dot(one.at) - middle) * across;
      if (std::none_of(places.begin(), places.end(), [&](const Place2& other) { return (other.at - mirrored).norm() < near; }))
        return false;
    }
  }
  return true;
}

void choose_plane(const Model& m, const LimitLoad& load, const Loads& loads, LimitProblem& p) {
  const Vec3 up = m.gravity.norm() > 0 ? Vec3(-m.gravity.normalized()) : Vec3(Vec3::UnitZ());
  for (int i = 0; i < 3; ++i) p.axes[i] = Vec3::Unit(i);
  std::vector<Vec3> normals{up.cross(load.direction)};
  if (normals.front().norm() < 1e-9) normals = {Vec3::UnitY(), Vec3::UnitX()};
  for (Vec3 across : normals) {
    across.normalize();
    if (std::fabs(across.dot(up)) > 1e-9 || !symmetric_about(m, across, p, loads)) continue;
    p.plane = true;
    p.rows = 3, p.columns = 2;
    p.axes[0] = across.cross(up), p.axes[1] = up, p.axes[2] = -across;
    if (p.axes[0].dot(load.direction) < 0) p.axes[0] = -p.axes[0], p.axes[2] = -p.axes[2];
    return;
  }
}

// Scaled rows of a force and a moment (or of a velocity and a spin).
void add_rows(const LimitProblem& p, const Vec3& force, const Vec3& moment, double scale, double* rows) {
  for (int i = 0; i < (p.plane ? 2 : 3); ++i) rows[i] += scale * p.axes[i].dot(force);
  for (int i = p.plane ? 2 : 0; i < 3; ++i) rows[p.plane ? 2 : 3 + i] += scale * p.axes[i].dot(moment) / p.length;
}

ContactPoint contact_point(const Model& m, const LimitProblem& p, int j, const Place2& place, const PointLaw& law, const LimitLoad& load) {
  const Joint& joint = m.joint[z(j)];
  ContactPoint c;
  c.joint = j;
  c.at = place.at;
  c.mu = law.mu;
  const double ft = law.mu > 0 ? std::min(law.ft, law.c / law.mu) : law.ft;
  c.tension = ft * place.area / p.force;
  c.cohesion = law.c * place.area / p.force;
  const Vec3 n = joint.type->frame.col(2);
  // s along the push, so that an even number of facets has one in its direction
  Vec3 s = p.plane ? Vec3(p.axes[2].cross(n)) : Vec3(load.direction - load.direction.dot(n) * n);
  if (s.norm() < 1e-6) s = joint.type->frame.col(0);
  s.normalize();
  const Vec3 direction[3]{n, s, n.cross(s)};
  for (int side = 0; side < 2; ++side) {
    const int b = side == 0 ? joint.a : joint.b;
    c.body[side] = p.body_of[z(b)];
    c.on[side].setZero();
    for (int k = 0; k < p.columns; ++k)
      add_rows(p, direction[k], (place.at - m.rest[z(b)]).cross(direction[k]), side == 0 ? -1 : 1, c.on[side].col(k).data());
  }
  return c;
}

// In a plane problem, places behind each other count as one.
std::vector<Place2> in_plane(const LimitProblem& p, const std::vector<Place2>& places, const Vec3& middle, double radius) {
  std::vector<Place2> out;
  for (Place2 one : places) {
    one.at -= p.axes[2].dot(one.at - middle) * p.axes[2];
    const auto same = std::find_if(out.begin(), out.end(), [&](const Place2& other) { return (other.at - one.at).norm() < 1e-7 * radius; });
    if (same == out.end()) out.push_back(one);
    else same->area += one.area;
  }
  return out;
}

}  // namespace

LimitProblem limit_problem(const Model& m, const LimitLoad& load, const LimitModelling& modelling) {
  if (load.pattern.empty() && std::fabs(load.direction.norm() - 1) > 1e-6)
    throw Error("limit analysis: the direction of the load has no length; give one such as x, -x or 1,1,0");
  LimitProblem p;
  number_bodies(m, p);
  refuse_floating(m);
  const double g = m.gravity.norm() > 0 ? m.gravity.norm() : standard_g;
  double mass = 0;
  for (const int b : p.block_of) mass += weight_mass(m, b);
  p.force = mass * g / p.nbody;
  p.length = 0;
  for (const Joint& joint : m.joint) p.length += joint.type->radius / m.njoint;
  const Loads loads = loads_of(m, load, g, modelling.factor);
  choose_plane(m, load, loads, p);
  for (int j = 0; j < m.njoint; ++j) {
    const Joint& joint = m.joint[z(j)];
    PointLaw law = m.laws[z(joint.type->law)];
    law.ft *= modelling.no_tension ? 0 : modelling.factor, law.c *= modelling.no_tension ? 0 : modelling.factor;
    std::vector<Place2> places = places_of(m, joint, law.ft > 0 || law.c > 0);
    if (p.plane) places = in_plane(p, places, m.rest[z(p.block_of.front())], joint.type->radius);
    for (const Place2& place : places) p.contacts.push_back(contact_point(m, p, j, place, law, load));
  }
  p.constant = p.push = VecX::Zero(p.nbody * p.rows);
  for (int i = 0; i < p.nbody; ++i) {
    const Twist &constant = loads.constant[z(p.block_of[z(i)])], &push = loads.push[z(p.block_of[z(i)])];
    add_rows(p, constant.linear, constant.angular, 1 / p.force, p.constant.data() + i * p.rows);
    add_rows(p, push.linear, push.angular, 1 / p.force, p.push.data() + i * p.rows);
  }
  if (p.push.norm() < 1e-12)
    throw Error("limit analysis: the load is zero on every block that can move; give a direction or a pattern that pushes one");
  return p;
}

Twist velocity_of(const LimitProblem& p, const VecX& rates, int body) {
  const double* r = rates.data() + body * p.rows;
  Twist out;
  for (int i = 0; i < (p.plane ? 2 : 3); ++i) out.linear += r[i] * p.axes[i];
  for (int i = p.plane ? 2 : 0; i < 3; ++i) out.angular += r[p.plane ? 2 : 3 + i] / p.length * p.axes[i];
  return out;
}

}  // namespace erbs::analysis
