// A few bodies with gravity and contact: the simplest leapfrog that can test the contact law, with a complete energy ledger.
#pragma once
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "engine/contact/broad/search.h"
#include "engine/geometry/mass.h"

namespace erbs::trial {

struct Body {
  std::vector<Polyhedron> parts;  // m, world axes at the start
  double density = 1800;          // kg/m3; 0: fixed
  Vec3 v = Vec3::Zero(), w = Vec3::Zero();
};

inline Polyhedron brick(double l = 0.30, double b = 0.125, double h = 0.10) {
  return box_polyhedron({-l / 2, -b / 2, -h / 2}, {l / 2, b / 2, h / 2});
}

// Components of the standard normal distribution.
inline Vec3 random_vector(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return {normal(random), normal(random), normal(random)};
}

struct Bodies {
  ContactShapes shapes;
  ContactSettings settings;
  PairLaw law;
  PairList list;
  std::vector<ContactBlock> block;
  std::vector<double> mass;
  std::vector<Mat3> inertia, inverse_inertia;  // axes at rest
  std::vector<Quat> q;
  std::vector<Vec3> spin;  // kg m2/s, world
  std::vector<PairResult> result;
  std::vector<Vec3> force, moment;
  OverlapRoom room;
  Vec3 gravity = Vec3::Zero();
  double dt = 0, t = 0, mass_damping = 0;
  // ledger, J
  double friction = 0, damping = 0, reset = 0, through = 0;
  double kinetic = 0, height = 0, elastic = 0, tangential = 0;
  double max_depth = 0, least_friction = 0;
  bool want_energy = true;

  explicit Bodies(const std::vector<Body>& bodies, const PairLaw& pair_law_, double step) : law(pair_law_), dt(step) {
    std::vector<std::vector<Polyhedron>> parts;
    for (const Body& b : bodies) {
      const MassProperties m = mass_properties(b.parts);
      parts.emplace_back();
      for (const Polyhedron& p : b.parts) parts.back().push_back(translated(p, -m.centroid));
      ContactBlock c;
      c.rest = m.centroid;
      c.v = b.v;
      c.w = b.w;
      mass.push_back(b.density * m.volume);
      inertia.push_back(b.density * m.inertia);
      inverse_inertia.push_back(b.density > 0 ? Mat3(inertia.back().inverse()) : Mat3(Mat3::Zero()));
      if (b.density > 0) {
        c.inverse_mass = 1 / mass.back();
        c.inverse_tensor = inverse_inertia.back();
        c.inverse_inertia = 1 / Eigen::SelfAdjointEigenSolver<Mat3>(inertia.back()).eigenvalues()[0];
      }
      block.push_back(c);
      q.push_back(Quat::Identity());
      spin.push_back(inertia.back() * b.w);
    }
    shapes = contact_shapes(parts);
    std::vector<double> thickness;
    for (const ContactShape& s : shapes.shape) thickness.push_back(s.thickness);
    list.margin = suggested_margin(thickness);
    force.resize(block.size());
    moment.resize(block.size());
  }

  void forces() {
    if (needs_search(list, shapes, block)) {
      const std::vector<std::uint8_t> loose(block.size(), 1);
      reset += search(list, shapes, block, loose, {}, [&](int, int) { return law; });
    }
    for (std::size_t i = 0; i < block.size(); ++i) {
      force[i] = mass[i] * gravity;
      moment[i].setZero();
    }
    result.resize(list.pair.size());
    elastic = tangential = max_depth = 0;
    for (std::size_t i = 0; i < list.pair.size(); ++i) {
      ContactPair& p = list.pair[i];
      const auto a = static_cast<std::size_t>(p.a), b = static_cast<std::size_t>(p.b);
      PairResult& r = result[i];
      if (!pair_force(p, shapes, block[a], block[b], settings, t > 0 ? dt : 0, want_energy, room, r)) continue;
      force[a] -= r.wrench.force;
      moment[a] += r.wrench.moment_a;
      force[b] += r.wrench.force;
      moment[b] += r.wrench.moment_b;
      friction += r.friction;
      damping += r.damping;
      least_friction = std::min(least_friction, r.friction);
      elastic += r.elastic;
      tangential += r.tangential;
      max_depth = std::max(max_depth, r.depth);
    }
  }

  Mat3 inverse_world(std::size_t i, const Quat& at) const {
    const Mat3 turn = at.toRotationMatrix();
    return turn * inverse_inertia[i] * turn.transpose();
  }

  // Forces at the present pose, then a kick and a drift over a whole step. `first`: half a kick, since velocities are still those of the
  // start.
  void step(bool first = false) {
    forces();
    kinetic = height = 0;
    for (std::size_t i = 0; i < block.size(); ++i) {
      if (block[i].inverse_mass == 0) continue;
      ContactBlock& b = block[i];
      const double h = first ? dt / 2 : dt;
      const Vec3 v0 = b.v, s0 = spin[i];
      b.v = ((1 - mass_damping * h / 2) * b.v + h * b.inverse_mass * force[i]) / (1 + mass_damping * h / 2);
      spin[i] = ((1 - mass_damping * h / 2) * spin[i] + h * moment[i]) / (1 + mass_damping * h / 2);
      const Vec3 w_now = inverse_world(i, q[i]) * spin[i];
      kinetic += first ? 0.5 * mass[i] * v0.squaredNorm() + 0.5 * s0.dot(inverse_world(i, q[i]) * s0)
                       : 0.5 * mass[i] * v0.dot(b.v) + 0.5 * s0.dot(w_now);
      height -= mass[i] * gravity.dot(b.u);
      const Quat half = rotation(dt / 2 * w_now) * q[i];
      b.w = inverse_world(i, half) * spin[i];
      q[i] = (rotation(dt * b.w) * q[i]).normalized();
      b.rotation = q[i].toRotationMatrix();
      b.u += dt * b.v;
      through += std::abs(dt * force[i].dot(b.v)) / 2;
    }
    t += dt;
  }

  void run(double until) {
    while (t < until - dt / 2) step(t == 0);
  }

  double stored() const { return kinetic + height + elastic + tangential; }
  double total() const { return stored() + friction + damping + reset; }
  Vec3 momentum() const {
    Vec3 p = Vec3::Zero();
    for (std::size_t i = 0; i < block.size(); ++i) p += mass[i] * block[i].v;
    return p;
  }
  // About the rest position of body 0, with poses and velocities half a step apart. For a pair of free bodies it is constant up to v x v.
  Vec3 angular_momentum() const {
    Vec3 p = Vec3::Zero();
    for (std::size_t i = 0; i < block.size(); ++i)
      p += spin[i] + mass[i] * ((block[i].rest - block[0].rest) + block[i].u).cross(block[i].v);
    return p;
  }
};

// 2 / omega of a body resting on its largest face.
inline double step_unit(double kn, double mass, double area) { return 2 / std::sqrt(kn * area / mass); }

}  // namespace erbs::trial
