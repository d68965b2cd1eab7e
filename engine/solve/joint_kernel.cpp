#include "engine/solve/joint_kernel.h"

#include <cmath>

// Plain loops over lanes: the compiler turns each into vector instructions, for each instruction set below, and the loader takes
// the best one the machine has. -ffp-contract=off and the absence of sums across lanes make them give the same bits.
#if defined(__x86_64__) && !defined(ERBS_SANITIZED)
#define ERBS_KERNEL __attribute__((target_clones("default", "avx2", "arch=skylake-avx512")))
#else
#define ERBS_KERNEL
#endif
#define FOR_LANES _Pragma("omp simd") for (int l = 0; l < lanes; ++l)

namespace erbs {
namespace {

std::size_t z(int i) { return std::size_t(i); }

// Results of the elastic pass of one batch.
struct alignas(64) Lanes {
  double q[6][lanes], f[6][lanes];
  double y[3][lanes];   // m, turned-back distance of the centroids
  double th[3][lanes];  // rad, mean rotation since the refresh
  double near[lanes];   // > 0: the bound on tension or shear is passed
};

// joint_geometry.h gives the formulas. Bound: the greatest corner opening is exact for a rectangle and an upper bound for any
// other polygon; the greatest slip is an upper bound; compression capacity is looked at only where there is one.
ERBS_KERNEL void elastic(const JointBatch& B, const double* row, Lanes& o) {
  alignas(64) double du[3][lanes], ta[3][lanes], tb[3][lanes];
  for (int l = 0; l < lanes; ++l) {
    const double *ra = row + 8 * B.a[l], *rb = row + 8 * B.b[l];
    for (int i = 0; i < 3; ++i) {
      du[i][l] = rb[i] - ra[i];
      ta[i][l] = ra[3 + i];
      tb[i][l] = rb[3 + i];
    }
  }
  FOR_LANES {
    const double tx = 0.5 * (ta[0][l] + tb[0][l]), ty = 0.5 * (ta[1][l] + tb[1][l]), tz = 0.5 * (ta[2][l] + tb[2][l]);
    const double hx = 0.5 * (tb[0][l] - ta[0][l]), hy = 0.5 * (tb[1][l] - ta[1][l]), hz = 0.5 * (tb[2][l] - ta[2][l]);
    const double ex = hx - 0.5 * (ty * hz - tz * hy), ey = hy - 0.5 * (tz * hx - tx * hz), ez = hz - 0.5 * (tx * hy - ty * hx);
    const double X = B.apart[0][l] + du[0][l], Y = B.apart[1][l] + du[1][l], Z = B.apart[2][l] + du[2][l];
    const double cx = ty * Z - tz * Y, cy = tz * X - tx * Z, cz = tx * Y - ty * X;
    const double mx = du[0][l] - cx + 0.5 * (ty * cz - tz * cy), my = du[1][l] - cy + 0.5 * (tz * cx - tx * cz),
                 mz = du[2][l] - cz + 0.5 * (tx * cy - ty * cx);
    const double Sx = B.sum[0][l], Sy = B.sum[1][l], Sz = B.sum[2][l];
    const double dx = mx + (ey * Sz - ez * Sy), dy = my + (ez * Sx - ex * Sz), dz = mz + (ex * Sy - ey * Sx);
    o.y[0][l] = B.apart[0][l] + mx;
    o.y[1][l] = B.apart[1][l] + my;
    o.y[2][l] = B.apart[2][l] + mz;
    o.th[0][l] = tx;
    o.th[1][l] = ty;
    o.th[2][l] = tz;
    for (int i = 0; i < 3; ++i) {
      const double fx = B.frame[3 * i][l], fy = B.frame[3 * i + 1][l], fz = B.frame[3 * i + 2][l];
      o.q[i][l] = B.q[i][l] + fx * dx + fy * dy + fz * dz;
      o.q[3 + i][l] = B.q[3 + i][l] + 2 * (fx * ex + fy * ey + fz * ez);
    }
  }
  FOR_LANES {
    const double bend = std::fabs(o.q[3][l]) * B.half_t[l] + std::fabs(o.q[4][l]) * B.half_s[l];
    const double opening = o.q[2][l] + bend, closing = bend - o.q[2][l] - B.close_limit[l];
    const double slip = std::sqrt(o.q[0][l] * o.q[0][l] + o.q[1][l] * o.q[1][l]) + std::fabs(o.q[5][l]) * B.radius[l];
    const double over = opening - B.open_limit[l] > closing ? opening - B.open_limit[l] : closing;
    const double beyond = slip + B.slip_slope[l] * opening - B.slip_limit[l];
    o.near[l] = over > beyond ? over : beyond;
  }
  for (int i = 0; i < 6; ++i) FOR_LANES o.f[i][l] = B.stiffness[i][l] * o.q[i][l];
}

// Resultants to wrenches on both blocks: force at the midpoint of the material points, then everything turned by th.
ERBS_KERNEL void wrenches(const JointBatch& B, const Lanes& o, double* rows) {
  alignas(64) double F[3][lanes], A[3][lanes], M[3][lanes];
  FOR_LANES {
    double f[3], m[3];
    for (int i = 0; i < 3; ++i) {
      f[i] = B.frame[i][l] * o.f[0][l] + B.frame[3 + i][l] * o.f[1][l] + B.frame[6 + i][l] * o.f[2][l];
      m[i] = B.frame[i][l] * o.f[3][l] + B.frame[3 + i][l] * o.f[4][l] + B.frame[6 + i][l] * o.f[5][l];
    }
    const double ax = 0.5 * (B.sum[0][l] + o.y[0][l]), ay = 0.5 * (B.sum[1][l] + o.y[1][l]), az = 0.5 * (B.sum[2][l] + o.y[2][l]);
    const double bx = 0.5 * (B.sum[0][l] - o.y[0][l]), by = 0.5 * (B.sum[1][l] - o.y[1][l]), bz = 0.5 * (B.sum[2][l] - o.y[2][l]);
    const double px = m[0] + ay * f[2] - az * f[1], py = m[1] + az * f[0] - ax * f[2], pz = m[2] + ax * f[1] - ay * f[0];
    const double nx = m[0] + by * f[2] - bz * f[1], ny = m[1] + bz * f[0] - bx * f[2], nz = m[2] + bx * f[1] - by * f[0];
    const double tx = o.th[0][l], ty = o.th[1][l], tz = o.th[2][l];
    F[0][l] = f[0] + (ty * f[2] - tz * f[1]);
    F[1][l] = f[1] + (tz * f[0] - tx * f[2]);
    F[2][l] = f[2] + (tx * f[1] - ty * f[0]);
    A[0][l] = px + (ty * pz - tz * py);
    A[1][l] = py + (tz * px - tx * pz);
    A[2][l] = pz + (tx * py - ty * px);
    M[0][l] = -(nx + (ty * nz - tz * ny));
    M[1][l] = -(ny + (tz * nx - tx * nz));
    M[2][l] = -(nz + (tx * ny - ty * nx));
  }
  for (int l = 0; l < lanes; ++l) {
    double *ra = rows + 8 * B.row_a[l], *rb = rows + 8 * B.row_b[l];
    for (int i = 0; i < 3; ++i) {
      ra[i] = F[i][l];
      ra[3 + i] = A[i][l];
      rb[i] = -F[i][l];
      rb[3 + i] = M[i][l];
    }
  }
}

// q of lane l one step ago, for the joint that cracks now: the same pass with the rows of its blocks taken back by dt.
void before(const State& s, const JointBatch& B, int l, double q[6], double f[6]) {
  JointBatch one = B;
  alignas(64) double rows[2 * 8];
  for (int end = 0; end < 2; ++end) {
    const int b = end == 0 ? B.a[l] : B.b[l];
    for (int i = 0; i < 3; ++i) {
      rows[8 * end + i] = s.row[z(b) * 8 + z(i)] - s.last_dt * s.v[z(b)][i];
      rows[8 * end + 3 + i] = s.row[z(b) * 8 + 3 + z(i)] - s.last_dt * s.w[z(b)][i];
    }
  }
  for (int k = 0; k < lanes; ++k) one.a[k] = 0, one.b[k] = 1;
  Lanes o;
  elastic(one, rows, o);
  for (int i = 0; i < 6; ++i) q[i] = o.q[i][l], f[i] = o.f[i][l];
}

}  // namespace

void joint_by_points(const Model& m, State& s, int j, const double q[6], double f[6], JointSums& sums) {
  const bool sound = s.tier[z(j)] == Tier::intact;
  JointMemory& memory = s.memory[z(j)];
  if (sound) {
    before(s, s.batch[z(j / lanes)], j % lanes, memory.q, memory.f);
    memory.elastic = 0;
    for (int i = 0; i < 6; ++i) memory.elastic += 0.5 * memory.f[i] * memory.q[i];
  }
  JointEnergy e;
  const bool still = respond(m, j, sound, memory.q, q, &s.history[z(m.joint[z(j)].first_point)], f, e);
  if (sound && still) return;
  if (sound) {
    s.tier[z(j)] = Tier::cracked;
    s.slow[z(j / lanes)] = std::uint8_t(s.slow[z(j / lanes)] | 1u << (j % lanes));
    ++sums.cracked_now;
  }
  double work = 0;
  for (int i = 0; i < 6; ++i) work += 0.5 * (memory.f[i] + f[i]) * (q[i] - memory.q[i]);
  const double error = std::fabs(work - (e.elastic - memory.elastic) - e.friction - e.fracture - e.crushing);
  if (error > sums.largest_error) sums.largest_error = error, sums.worst_joint = j;
  for (int i = 0; i < 6; ++i) memory.q[i] = q[i], memory.f[i] = f[i];
  memory.elastic = e.elastic;
  sums.energy.friction += e.friction;
  sums.energy.fracture += e.fracture;
  sums.energy.crushing += e.crushing;
}

void joint_forces(const Model& m, State& s, int first, int last, bool sample, JointSums& sums) {
  Lanes o;
  if (sample) sums.energy.elastic = 0;
  for (int k = first; k < last; ++k) {
    const JointBatch& B = s.batch[z(k)];
    elastic(B, s.row.data(), o);
    unsigned slow = s.slow[z(k)];
    for (int l = 0; l < lanes; ++l) slow |= unsigned(o.near[l] > 0) << l;
    if (slow != 0) {
      for (int l = 0; l < lanes; ++l) {
        const int j = k * lanes + l;
        if ((slow >> l & 1u) == 0 || j >= m.njoint || s.tier[z(j)] == Tier::open) continue;
        double q[6], f[6];
        for (int i = 0; i < 6; ++i) q[i] = o.q[i][l];
        joint_by_points(m, s, j, q, f, sums);
        for (int i = 0; i < 6; ++i) o.f[i][l] = f[i];
      }
    }
    wrenches(B, o, s.wrench.data());
    if (!sample) continue;
    for (int l = 0; l < lanes && k * lanes + l < m.njoint; ++l) {
      const int j = k * lanes + l;
      if (s.tier[z(j)] == Tier::cracked) sums.energy.elastic += s.memory[z(j)].elastic;
      if (s.tier[z(j)] != Tier::intact) continue;
      for (int i = 0; i < 6; ++i) sums.energy.elastic += 0.5 * o.f[i][l] * o.q[i][l];
    }
  }
}

}  // namespace erbs
