// Kick and drift of blocks, eight side by side; integrate.h and integrate.cpp say what is computed.
#pragma once
#include "engine/joints/gather.h"
#include "engine/joints/kernels.h"
#include "engine/simd/transpose.h"
#include "engine/simd/vec3.h"

namespace erbs::ERBS_TARGET {

// Total wrench on eight blocks: intact joints that they own, intact joints that their neighbours own, wrench rows of other joints, contacts
// and loads.
ERBS_INLINE void sum_wrenches(const KickDrift& s, const BlockArrays& A, const BlockConstants& c, int group, Pack out[6]) {
  const long first = 8L * pack_size * group;
  const bool carried = c.carried;
  for (int i = 0; i < 6; ++i) out[i] = carried ? load(A.owner_sum[group].x[i]) : Pack(0);
  for (int k = c.first_gather; carried && k < c.first_gather + c.gathers; ++k) {
    Pack from_neighbours[6];
    gather(A.neighbour_force, A.gather_in[k], from_neighbours);
    for (int i = 0; i < 6; ++i) out[i] += from_neighbours[i];
  }
  if (A.contact_wrench == nullptr && A.load_wrench == nullptr && A.inertia == nullptr && c.wrench_slots == 0) return;
  Pack rows[pack_size] = {}, sum[8];
  const auto add = [&](const double* row) {
    for (int l = 0; l < pack_size; ++l) rows[l] += load(row + 8 * l);
  };
  if (A.contact_wrench != nullptr) add(A.contact_wrench + first);
  if (A.inertia != nullptr) add(A.inertia + first);
  if (A.load_wrench != nullptr && A.load_since == nullptr) add(A.load_wrench + first);
  for (int l = 0; l < pack_size && A.load_wrench != nullptr && A.load_since != nullptr; ++l) {
    const long b = 1L * pack_size * group + l;
    rows[l] += (A.load_since[b] + A.load_next[b]) / (2 * s.kick) * load(A.load_wrench + 8 * b);
  }
  for (int k = 0; k < c.wrench_slots; ++k) add(A.wrench + 8L * pack_size * (c.first_wrench_slot + k));  // none where there are no rows
  transpose<8>(rows, sum);
  for (int i = 0; i < 6; ++i) out[i] += sum[i];
}

// 1 / x and 1 / sqrt(x) for x close to 1, as it is unless something spins fast: then as it comes.
ERBS_INLINE Pack inverse_near_one(Pack x) {
  const Pack e = x - 1;
  const Mask far = abs(e) > 1e-6;
  const Pack near = 1 - e * (1 - e);
  return any(far) ? select(far, 1 / x, near) : near;
}
ERBS_INLINE Pack inverse_root_near_one(Pack x) {
  const Pack e = x - 1;
  const Mask far = abs(e) > 1e-6;
  const Pack near = 1 - e * (0.5 - 0.375 * e);
  return any(far) ? select(far, 1 / sqrt(x), near) : near;
}

// Spin at the middle of the step for body momentum p: w = I^-1 (p + p x h + h (h.p)) / (1 + h.h), h = w dt / 2, by fixed point from
// w = I^-1 p. A round shrinks the error by some |h|: one round is exact to round-off for a swaying wall, tumbling debris takes a few.
ERBS_INLINE Pack3 middle_spin(const BlockConstants& c, Pack3 p, Pack3 w, double dt) {
  Mask more{};
  for (int round = 0; round < 40; ++round) {
    const Pack3 h = 0.5 * dt * w;
    const Pack hh = dot(h, h), scale = inverse_near_one(1 + hh), hp = dot(h, p);
    const Pack3 unscaled = (p + cross(p, h)) + hp * h, m = scale * unscaled;
    const Pack3 next = load6(c.inverse_inertia) * m, change = next - w;
    // what the next round would change, with a factor of 4 for flat bodies, is below the last bit
    const Mask left = dot(change, change) * (16 * hh) > 1e-32 * dot(next, next);
    // a block stops when it is done itself, whatever stands in the lanes beside it: the same bits for any width
    w = round == 0 ? next : select(more, next, w);
    more = round == 0 ? left : more & left;
    if (!any(more)) break;
  }
  return w;
}

// Attitude by the Cayley map of h = w dt / 2 in the body.
ERBS_INLINE Quat<Pack> rotated(Quat<Pack> q, Pack3 w, double dt) {
  const Pack3 h = 0.5 * dt * w;
  const Pack x = q.x + (q.w * h.x + q.y * h.z - q.z * h.y), y = q.y + (q.w * h.y + q.z * h.x - q.x * h.z),
             z = q.z + (q.w * h.z + q.x * h.y - q.y * h.x), s = q.w - (q.x * h.x + q.y * h.y + q.z * h.z);
  const Pack scale = inverse_root_near_one(x * x + y * y + z * z + s * s);
  return {x * scale, y * scale, z * scale, s * scale};
}

// 2 sin(angle / 2) about its axis of the turn from b to q.
ERBS_INLINE Pack3 rotation_since(Quat<Pack> q, Quat<Pack> b) {
  const Pack c = q.w * b.w + q.x * b.x + q.y * b.y + q.z * b.z, sign = select(c < 0, Pack(-2), Pack(2));
  return {sign * (b.w * q.x - q.w * b.x - q.y * b.z + q.z * b.y), sign * (b.w * q.y - q.w * b.y - q.z * b.x + q.x * b.z),
          sign * (b.w * q.z - q.w * b.z - q.x * b.y + q.y * b.x)};
}

// Parts of the impulse of a load before and after this kick, over its force (s).
struct LoadInterval {
  Pack since, next;
};
ERBS_INLINE LoadInterval load_interval(const KickDrift& s, const BlockArrays& A, int group) {
  if (A.load_since == nullptr) return {Pack(s.half_last), Pack(s.half_next)};
  const long first = 1L * pack_size * group;
  return {0.5 * load(A.load_since + first), 0.5 * load(A.load_next + first)};
}

// Work of this step's forces: half the last drift with the old velocity, half the next with the new one. A sample keeps the halves
// apart, for the ledger is settled between them.
template <bool damped, bool sample>
ERBS_INLINE void book(const KickDrift& s, const BlockConstants& c, LoadInterval load_for, Pack3 v0, Pack3 v1, Pack3 p0, Pack3 p1, Pack3 u,
                      bool apart, BlockWork& work) {
  const Pack mass = load(c.mass), heavy = damped ? mass * load(c.gravity_factor) : mass;
  const auto ground = [&](Pack3 v) { return -(s.ground[0] * v.x + s.ground[1] * v.y + s.ground[2] * v.z); };
  if (!sample && s.shaken) {
    const Pack base = heavy * ground(load_for.since * v0 + load_for.next * v1);
    add_to(work.base, base);
    add_to(work.absolute, abs(base));
  }
  if (!sample && !damped) return;
  const Pack3 vd = s.damping_explicit ? v0 : 0.5 * (v0 + v1), pd = s.damping_explicit ? p0 : 0.5 * (p0 + p1);
  const Pack rate = load(c.damped) * s.damping;
  if (!sample) {
    const Pack3 spin = load6(c.inverse_inertia) * (s.half_last * p0 + s.half_next * p1);
    add_to(work.damping, rate * (mass * dot(vd, s.half_last * v0 + s.half_next * v1) + dot(pd, spin)));
    return;
  }
  const Pack3 s0 = load6(c.inverse_inertia) * p0, s1 = load6(c.inverse_inertia) * p1;
  const Pack base0 = load_for.since * (heavy * ground(v0)), base1 = load_for.next * (heavy * ground(v1));
  add_to(work.base, base0);
  add_to(work.absolute, abs(base0));
  add_to(work.base_after, base1);
  add_to(work.absolute_after, abs(base1));
  if (damped) {
    add_to(work.damping, s.half_last * (rate * (mass * dot(vd, v0) + dot(pd, s0))));
    add_to(work.damping_after, s.half_next * (rate * (mass * dot(vd, v1) + dot(pd, s1))));
  }
  // before the first drift the old velocity is the mirror image of the new one about the start
  const Pack3 old = s.first ? 2.0 * v0 - v1 : v0, old_spin = s.first ? 2.0 * s0 - s1 : s0;
  // where the step changes, the new velocity is the one that the last step would have led to: with another the identity of energy.h does
  // not hold
  const double more = s.first ? 0 : s.more;
  Pack3 v = v1 + more * (v1 - v0);
  const Pack3 p = p1 + more * (p1 - p0);
  if (apart) {  // loads have an interval of their own
    const Pack rest = (2 * load_for.since - (1 + more) * (load_for.since + load_for.next)) * load(c.moving);
    v = v + Pack3{rest * (s.gravity[0] - s.ground[0]), rest * (s.gravity[1] - s.ground[1]), rest * (s.gravity[2] - s.ground[2])};
  }
  add_to(work.kinetic, 0.5 * (mass * dot(old, v) + dot(old_spin, p)));
  add_to(work.height, -(heavy * (s.gravity[0] * u.x + s.gravity[1] * u.y + s.gravity[2] * u.z)));
}

// Local damping: a force of this share of the unbalanced force, component by component, against the motion (Cundall 1987).
ERBS_INLINE Pack3 braked(double share, Pack3 force, Pack3 motion) {
  const auto one = [share](Pack f, Pack v) { return select(v > 0, -share * abs(f), select(v < 0, share * abs(f), Pack(0))); };
  return {one(force.x, motion.x), one(force.y, motion.y), one(force.z, motion.z)};
}

// Where the step changes from h to k, the kinetic energy from which the next drift starts is not the one to which the last drift led, but
// more by (h - k) (h + k) / 8 f . M^-1 f, f the force of the kick. Next to nothing in true motions; what a coarse inertia lets swing in
// forty steps has accelerations that none of them has. Its work counts as damping, and so does this.
template <bool sample>
ERBS_INLINE void book_change(const KickDrift& s, const BlockConstants& c, Pack3 dv, Pack3 dp, BlockWork& work) {
  const Pack energy = load(c.mass) * dot(dv, dv) + load(c.moving) * dot(dp, load6(c.inverse_inertia) * dp);
  add_to(sample ? work.damping_after : work.damping, -s.shortens * energy);
}

// Velocities and momenta by the kick, positions by the drift; `w` is the spin of the drift, in the body.
template <bool damped, bool sample>
ERBS_INLINE Mask kick(const KickDrift& s, const BlockArrays& A, int group, const Pack wrench[6], Pack3& w, BlockWork& work) {
  const BlockConstants& c = A.constant[group];
  const Pack moving = load(c.moving), inverse = load(c.inverse_mass);
  double(*const u)[pack_size] = A.u[group].x, (*const v)[pack_size] = A.v[group].x, (*const momentum)[pack_size] = A.momentum[group].x;
  const Pack3 v0 = load3(v), L0 = load3(momentum), u0 = load3(u);
  Pack keep = Pack(1), kick = Pack(s.kick);
  if (damped) {
    keep = 1 + load(c.damped) * s.damped_keep;
    kick = s.kick * (1 + load(c.damped) * s.damped_kick);
  }
  const auto kicked = [&](Pack x, Pack force) { return damped ? keep * x + kick * force : x + kick * force; };
  const bool apart = A.load_since != nullptr;
  const LoadInterval interval = load_interval(s, A, group);
  const Pack full = apart ? moving * ((interval.since + interval.next) / s.kick) : moving;
  const Pack loaded = damped ? full * load(c.gravity_factor) : full;
  const auto pushed = [&](int i) { return wrench[i] * inverse + loaded * (s.gravity[i] - s.ground[i]); };
  Pack3 force{pushed(0), pushed(1), pushed(2)}, moment{moving * wrench[3], moving * wrench[4], moving * wrench[5]};
  Pack3 brake{}, brake_moment{};
  if (damped && s.local > 0) {
    brake = braked(s.local, force, v0), brake_moment = braked(s.local, moment, L0);
    force = force + brake, moment = moment + brake_moment;
  }
  const Pack3 v1{kicked(v0.x, force.x), kicked(v0.y, force.y), kicked(v0.z, force.z)};
  const Pack3 L1{kicked(L0.x, moment.x), kicked(L0.y, moment.y), kicked(L0.z, moment.z)};
  const Mat3<Pack> t = rotation_of(load4(A.q[group].x)), back = transposed(t);
  const Pack3 p1 = back * L1;
  if (damped && s.local > 0) {  // its work, as in `book()`
    const Pack3 force_on = load(c.mass) * brake, spin0 = t * (load6(c.inverse_inertia) * (back * L0)),
                spin1 = t * (load6(c.inverse_inertia) * p1);
    add_to(work.damping, -s.half_last * (dot(force_on, v0) + dot(brake_moment, spin0)));
    add_to(sample ? work.damping_after : work.damping, -s.half_next * (dot(force_on, v1) + dot(brake_moment, spin1)));
  }
  if (damped && s.shortens != 0) book_change<sample>(s, c, v1 - v0, back * (L1 - L0), work);
  if (damped || sample) book<damped, sample>(s, c, interval, v0, v1, back * L0, p1, u0, apart, work);
  else book<damped, sample>(s, c, interval, v0, v1, Pack3{}, Pack3{}, Pack3{}, apart, work);
  const Pack dt = s.dt * moving;
  store3(u, u0 + dt * v1);
  store3(v, v1);
  store3(momentum, L1);
  w = load6(c.inverse_inertia) * p1;
  if (s.gyroscopic) w = middle_spin(c, p1, w, s.dt);
  const Pack3 wx = t * w, told = load3(A.w[group].x);  // of a held block: as it is told elsewhere
  const Mask free = moving > 0;
  store3(A.w[group].x, select(free, wx, told));
  return !(dot(v1, v1) < 1e12);  // not a number, too
}

// Attitudes by the drift, and the rows that joints read.
template <bool rows, bool carried>
ERBS_INLINE void rotate_by(const KickDrift& s, const BlockArrays& A, int group, Pack3 w, BlockWork& work) {
  double(*const to)[pack_size] = A.q[group].x;
  const Quat<Pack> q0 = load4(to), q = rotated(q0, w, s.dt);
  const Pack3 u = load3(A.u[group].x);
  const long first = 8L * pack_size * group;
  if (rows && A.pose != nullptr) {
    const Pack pose[8] = {u.x, u.y, u.z, q.x, q.y, q.z, q.w, Pack(0)};
    pack_to_rows(pose, A.pose + first, side_by_side);
  }
  if (carried) {
    const Pack3 t = rotation_since(q, load4(A.ref_q[group].x)), du = u - load3(A.ref_u[group].x);
    const Pack square = dot(t, t);
    const Pack3 theta = (1 + 0.375 * square) * t;  // tan(angle), to fourth order (kinematics.h)
    const Pack row[8] = {du.x, du.y, du.z, theta.x, theta.y, theta.z, theta.y, theta.z};
    if (rows && A.pose_row != nullptr) pack_to_rows(row, A.pose_row + first, side_by_side);
    for (int i = 0; i < 6; ++i) store(A.increment[group].x[i], row[i]);
    add_to(work.outdated, select(square > load(A.constant[group].rotation_limit), Pack(1), Pack(0)));
  }
  store(to[0], q.x), store(to[1], q.y), store(to[2], q.z), store(to[3], q.w);
  if (!s.gyroscopic) {  // Gu and Miao's scalar equation (1): the spin in the body stays and the momentum turns with it. For comparison
                        // only.
    double(*const momentum)[pack_size] = A.momentum[group].x;
    store3(momentum, rotation_of(q) * (transposed(rotation_of(q0)) * load3(momentum)));
  }
}

inline constexpr int groups_at_once = 4;  // groups

// Attitudes of some groups.
template <bool rows, bool carried>
ERBS_INLINE void rotate_groups(const KickDrift& step, const BlockArrays& A, int from, int to, const Pack3* w, BlockWork& work) {
  for (int k = from; k < to; ++k) rotate_by<rows, carried>(step, A, k, w[k - from], work);
}

// A step of a block is one long chain of operations: some groups together go through it in stages, so that their chains overlap.
template <bool damped, bool sample>
static bool advance_pass(const KickDrift& step, const BlockArrays& A, int first, int last, BlockWork& work) {
  Mask broken{};
  Pack wrench[groups_at_once][6];
  Pack3 w[groups_at_once];
  for (int from = first; from < last; from += groups_at_once) {
    const int to = from + groups_at_once < last ? from + groups_at_once : last;
    bool rows = false, carried = false;
    for (int k = from; k < to; ++k) rows |= A.constant[k].wrench_slots > 0, carried |= A.constant[k].carried;
    if (rows) {
      for (int k = from; k < to; ++k) sum_wrenches(step, A, A.constant[k], k, wrench[k - from]);
      for (int k = from; k < to; ++k) broken |= kick<damped, sample>(step, A, k, wrench[k - from], w[k - from], work);
      if (carried) rotate_groups<true, true>(step, A, from, to, w, work);
      else rotate_groups<true, false>(step, A, from, to, w, work);
      continue;
    }
    for (int k = from; k < to; ++k) {
      Pack sum[6];
      sum_wrenches(step, A, A.constant[k], k, sum);
      broken |= kick<damped, sample>(step, A, k, sum, w[k - from], work);
    }
    if (carried) rotate_groups<false, true>(step, A, from, to, w, work);
    else rotate_groups<false, false>(step, A, from, to, w, work);
  }
  return any(broken);
}

static void forces(const KickDrift& step, const BlockArrays& A, int first, int last, VectorPack<6>* out) {
  for (int k = first; k < last; ++k) {
    const BlockConstants& c = A.constant[k];
    Pack sum[6];
    sum_wrenches(step, A, c, k, sum);
    const Pack moving = load(c.moving), heavy = moving * load(c.mass) * load(c.gravity_factor);
    for (int i = 0; i < 3; ++i) store(out[k].x[i], moving * sum[i] + heavy * (step.gravity[i] - step.ground[i]));
    for (int i = 3; i < 6; ++i) store(out[k].x[i], moving * sum[i]);
  }
}

static bool advance(const KickDrift& step, const BlockArrays& A, int first, int last, bool sample, BlockWork& work) {
  if (step.relaxes)
    return sample ? advance_pass<true, true>(step, A, first, last, work) : advance_pass<true, false>(step, A, first, last, work);
  return sample ? advance_pass<false, true>(step, A, first, last, work) : advance_pass<false, false>(step, A, first, last, work);
}

}  // namespace erbs::ERBS_TARGET
