#include "engine/solve/integrate.h"

#include <cmath>

namespace erbs {
namespace {

std::size_t z(int i) { return std::size_t(i); }

// Free rotation over dt with the momentum L (world) held: implicit midpoint in the body, which keeps |L| and the energy exactly
// (both are quadratic), with the Cayley map for the attitude, which keeps L in the world (Simo and Wong 1991, Int. J. Numer. Meth.
// Eng. 31, section 4, in its momentum form). Returns the spin at the middle of the step, world axes.
Vec3 turn(Quat& q, const Vec3& L, const Mat3& inverse_inertia, double dt) {
  const Mat3 r = q.toRotationMatrix();
  const Vec3 p = r.transpose() * L;
  Vec3 w = inverse_inertia * p;
  for (int i = 0; i < 30; ++i) {
    const Vec3 h = 0.5 * dt * w;
    // middle momentum pm = p + pm x h  ->  (1 + h x) pm = p:  pm = (p + p x h + h (h.p)) / (1 + h.h)
    const Vec3 next = inverse_inertia * ((p + p.cross(h) + h * h.dot(p)) / (1 + h.squaredNorm()));
    const double change = (next - w).squaredNorm();
    w = next;
    if (change <= 1e-32 * w.squaredNorm()) break;
  }
  const Vec3 h = 0.5 * dt * w;
  q = q * Quat(1, h.x(), h.y(), h.z());
  q.coeffs() *= 1 / q.norm();
  return r * w;
}

// The same for Gu and Miao's scalar equation (1), without the gyroscopic term: the spin in the body stays. For comparison only.
Vec3 turn_without_gyroscopic(Quat& q, Vec3& L, const Mat3& inverse_inertia, double dt) {
  const Mat3 r = q.toRotationMatrix();
  const Vec3 p = r.transpose() * L, w = inverse_inertia * p, h = 0.5 * dt * w;
  q = q * Quat(1, h.x(), h.y(), h.z());
  q.coeffs() *= 1 / q.norm();
  L = q * p;
  return r * w;
}

void update_row(State& s, int b, double tolerance, BlockSums& sums) {
  double* row = &s.row[z(b) * 8];
  const Quat since = s.q[z(b)] * s.base_q[z(b)].conjugate();
  double turned = 0;
  for (int i = 0; i < 3; ++i) {
    row[i] = s.u[z(b)][i] - s.base_u[z(b)][i];
    row[3 + i] = 2 * (since.w() < 0 ? -since.vec()[i] : since.vec()[i]);  // angle below the tolerance: its cube is beyond a double
    turned += row[3 + i] * row[3 + i];
  }
  if (turned > tolerance * tolerance && s.joined[z(b)]) sums.stale = true;
}

}  // namespace

Vec6 joint_wrench(const Model& m, const State& s, int b) {
  alignas(64) double sum[8] = {};
  for (int row = m.first_row[z(b)]; row < m.first_row[z(b) + 1]; ++row)
    for (int i = 0; i < 8; ++i) sum[i] += s.wrench[z(row) * 8 + z(i)];
  return Eigen::Map<const Vec6>(sum);
}

void advance(const Model& m, State& s, const Excitation& e, const double* push, const double* load, int first, int last, bool sample,
             BlockSums& sums) {
  const double half_last = 0.5 * s.last_dt, half_next = 0.5 * s.dt;
  sums.base_work += sums.base_after;
  sums.external_work += sums.external_after;
  sums.damping += sums.damping_after;
  sums.absolute_work += sums.absolute_after;
  sums.base_after = sums.external_after = sums.damping_after = sums.absolute_after = 0;
  sums.fastest = 0;
  if (sample) sums.kinetic = sums.height = 0;
  for (int b = first; b < last; ++b) {
    if (m.kind[z(b)] != Kind::moving) continue;
    const double mass = m.mass[z(b)];
    Vec6 w = joint_wrench(m, s, b) + Eigen::Map<const Vec6>(push + 6 * b);
    if (load != nullptr) w += Eigen::Map<const Vec6>(load + 6 * b);
    const Vec3 moment = w.tail<3>();
    const double a = m.damping.mass > 0 && (m.damping_all || s.grounded[z(b)]) ? m.damping.mass : 0;
    const Vec3 inertial = -mass * e.ground, force = w.head<3>() + inertial + mass * e.gravity;
    const Vec3 v0 = s.v[z(b)], L0 = s.spin_momentum[z(b)];
    Vec3 v1, L1;
    const Mat3 r = s.q[z(b)].toRotationMatrix();
    const Mat3 J = r * m.inverse_inertia[z(b)] * r.transpose();
    // centred: damping on the mean of old and new velocity; explicit: on the old one, unstable past a dt = 2 (to repeat Fig. 6)
    if (m.damping_explicit) {
      v1 = v0 + e.kick * (force / mass - a * v0);
      L1 = L0 + e.kick * (moment - a * L0);
    } else {
      const double f = 0.5 * a * e.kick;
      v1 = ((1 - f) * v0 + e.kick / mass * force) / (1 + f);
      L1 = ((1 - f) * L0 + e.kick * moment) / (1 + f);
    }
    // Work of this step's forces: half the last drift with the old velocity, half the next with the new one.
    const Vec3 w0 = J * L0, w1 = J * L1;
    const Vec3 vd = m.damping_explicit ? v0 : Vec3(0.5 * (v0 + v1)), Ld = m.damping_explicit ? L0 : Vec3(0.5 * (L0 + L1));
    const double base0 = half_last * inertial.dot(v0), base1 = half_next * inertial.dot(v1);
    sums.base_work += base0;
    sums.base_after += base1;
    sums.absolute_work += std::fabs(base0);
    sums.absolute_after += std::fabs(base1);
    sums.damping += half_last * a * (mass * vd.dot(v0) + Ld.dot(w0));
    sums.damping_after += half_next * a * (mass * vd.dot(v1) + Ld.dot(w1));
    if (load != nullptr) {
      const Eigen::Map<const Vec3> F(load + 6 * b), M(load + 6 * b + 3);
      const double out0 = half_last * (F.dot(v0) + M.dot(w0)), out1 = half_next * (F.dot(v1) + M.dot(w1));
      sums.external_work += out0;
      sums.external_after += out1;
      sums.absolute_work += std::fabs(out0);
      sums.absolute_after += std::fabs(out1);
    }
    if (sample) {
      // before the first drift the old velocity is the mirror image of the new one about the start
      const Vec3 vm = s.last_dt > 0 ? v0 : Vec3(2 * v0 - v1), wm = s.last_dt > 0 ? w0 : Vec3(2 * w0 - w1);
      sums.kinetic += 0.5 * (mass * vm.dot(v1) + wm.dot(L1));
      sums.height -= mass * e.gravity.dot(s.u[z(b)]);
    }
    s.v[z(b)] = v1;
    s.u[z(b)] += s.dt * v1;
    s.w[z(b)] = m.analysis.gyroscopic ? turn(s.q[z(b)], L1, m.inverse_inertia[z(b)], s.dt)
                                      : turn_without_gyroscopic(s.q[z(b)], L1, m.inverse_inertia[z(b)], s.dt);
    s.spin_momentum[z(b)] = L1;
    const double speed = v1.squaredNorm();
    if (!(speed < 1e12)) sums.broken = true;
    sums.fastest = std::max(sums.fastest, speed);
    update_row(s, b, m.analysis.lazy_rotation, sums);
  }
}

}  // namespace erbs
