#include "engine/solve/contacts/neighbour_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "engine/base/count.h"
#include "engine/base/rotation.h"
#include "engine/base/units.h"
#include "engine/contact/broad/approach.h"
#include "engine/contact/broad/edge_neighbours.h"
#include "engine/solve/blocks/prescribed.h"

namespace erbs {
namespace {

constexpr double list_margins = 3;  // margins of the list of contacts: blocks of a structure that sways are seldom listed anew
constexpr double least_sine = 0.1;  // of the angle between two planes that separate blocks along an edge
constexpr double lever = 3;  // greatest change of a gap along the normal of a face that rotates, over the path of its body's farthest point
constexpr double greatest_acceleration = 4 * standard_g;  // towards each other, that is looked for

PairFrame frame(const PartPair& of, const ContactShapes& shapes, const ContactBlock& a, const ContactBlock& b) {
  return part_frame(shape_of(shapes, of.a, of.part_a), shape_of(shapes, of.b, of.part_b), a, b);
}

// Greatest length of the vectors or quaternions of all blocks; of their change if `from` is given.
template <class Array>
double greatest(const Array& all, const Array* from = nullptr) {
  constexpr int n = sizeof(typename Array::Row) / sizeof(double) / pack_size;
  double most[pack_size] = {};
  for (std::size_t g = 0; g < (all.size() + pack_size - 1) / pack_size; ++g) {
    double square[pack_size] = {};
    for (int i = 0; i < n; ++i)
      for (int l = 0; l < pack_size; ++l) {
        const double x = all.data()[g].x[i][l] - (from ? from->data()[g].x[i][l] : 0);
        square[l] += x * x;
      }
    for (int l = 0; l < pack_size; ++l) most[l] = std::max(most[l], square[l]);
  }
  return std::sqrt(*std::ranges::max_element(most));
}

// m, greatest gap along the normal of a face at an angle to the face of the greatest gap.
double second_gap(const PairFrame& s) {
  const std::vector<FaceGap> faces = face_gaps(s);
  const Vec3 n = std::ranges::max(faces, {}, &FaceGap::gap).n;
  double second = -std::numeric_limits<double>::infinity();
  for (const FaceGap& face : faces)
    if (n.cross(face.n).norm() > least_sine) second = std::max(second, face.gap);
  return second;
}

}  // namespace

NeighbourWatch::NeighbourWatch(const Model& model, const State& state, const ContactBodies& bodies, double margin)
    : model_(model),
      state_(state),
      bodies_(bodies),
      least_margin_(list_margins * margin),
      narrow_(margin / 2),
      least_distance_(margin / 4) {}

bool NeighbourWatch::find(double time, std::vector<std::uint8_t>& loose) {
  acceleration_ = greatest_acceleration;
  for (const Model::ForceLoad& load : model_.force_loads)
    if (!load.moment)
      acceleration_ = std::max(acceleration_, std::fabs(value(load.wave, state_.time.t + time)) * model_.inverse_mass[z(load.block)]);
  if (!u_.empty() && quiet(time)) return false;
  place(time);
  if (u_.empty() || !(closes(time) <= margin_)) list(time, loose);
  bool any = false;
  for (const Neighbours& pair : pairs_) {
    const std::size_t a = z(pair.parts.a), b = z(pair.parts.b);
    if (loose[a] || loose[b] || !may_touch(pair, time)) continue;
    for (const std::size_t one : {a, b}) loose[one] = model_.kind[one] != Kind::fixed;
    any = true;
  }
  if (any) u_.clear();  // the next look lists anew: pairs of these blocks no longer count
  return any;
}

// True if no pair can count, by the greatest motion of any block since the pairs were listed and the greatest speed.
bool NeighbourWatch::quiet(double time) const {
  // Of a change dq of a quaternion, a point at the distance `reach` moves by at most 4 reach |dq|.
  const double moved = greatest(state_.pose.u, &listed_u_) + 4 * lever * reach_ * greatest(state_.pose.q, &listed_q_);
  double speed = greatest(state_.motion.v) + reach_ * greatest(state_.motion.w);
  for (const Model::PrescribedMotion& driven : model_.prescribed_motions) {
    const auto [v, w] = driven_motion(driven.block, time);
    speed = std::max(speed, v.norm() + reach_ * w.norm());
  }
  return 2 * moved + ahead(2 * speed, time) < slack_;
}

// Speed and spin of a driven block, at rest though it may be: now or, if faster, on average from now on.
NeighbourWatch::Motion NeighbourWatch::driven_motion(int b, double time) const {
  const Vec3 v = state_.motion.v[z(b)], w = state_.motion.w[z(b)];
  const auto [u, q] = prescribed_pose(model_, b, state_.time.t + time, state_.pose.q[z(b)]);
  const Vec3 v_ahead = (u - Vec3(state_.pose.u[z(b)])) / time, w_ahead = rotation_vector(q * state_.pose.q[z(b)].conjugate()) / time;
  return {v_ahead.norm() > v.norm() ? v_ahead : v, w_ahead.norm() > w.norm() ? w_ahead : w};
}

void NeighbourWatch::place(double time) {
  if (block_.empty()) block_ = bodies_.block;
  rotated_.assign(block_.size(), 0.0);
  for (std::size_t b = 0; b < block_.size(); ++b) {
    ContactBlock& one = block_[b];
    one.u = state_.pose.u[b], one.v = state_.motion.v[b], one.w = state_.motion.w[b];
    if (model_.kind[b] == Kind::driven) std::tie(one.v, one.w) = driven_motion(int(b), time);
    one.rotation = Quat(state_.pose.q[b]).toRotationMatrix();
    if (bodies_.axes_of_group(b / pack_size)) one.rotation *= bodies_.axes_of(int(b));
    if (!u_.empty()) rotated_[b] = turning_path(rotation_[b], one.rotation, lever * bodies_.reach[b]);
  }
}

// m, distance that two blocks may close within `time` (s) at the `speed` (m/s) towards each other, and accelerated.
double NeighbourWatch::ahead(double speed, double time) const {
  return std::max(least_distance_, time * speed + 0.5 * acceleration_ * time * time);
}

// m, by which any two blocks may have come closer since the pairs were listed, `time` (s) from now.
double NeighbourWatch::closes(double time) const {
  const auto moved = [&](std::size_t b) -> Vec3 { return block_[b].u - u_[b]; };
  const auto speed = [&](std::size_t b) -> Vec3 { return block_[b].v; };
  const auto spin = [&](std::size_t b) { return bodies_.reach[b] * block_[b].w.norm(); };
  return greatest_approach(block_.size(), moved, [&](std::size_t b) { return rotated_[b]; }) +
         ahead(greatest_approach(block_.size(), speed, spin), time);
}

void NeighbourWatch::list(double time, const std::vector<std::uint8_t>& loose) {
  u_.resize(block_.size());
  rotation_.resize(block_.size());
  for (std::size_t b = 0; b < block_.size(); ++b) u_[b] = block_[b].u, rotation_[b] = block_[b].rotation;
  rotated_.assign(block_.size(), 0.0);
  margin_ = std::max(least_margin_, 2 * closes(time));
  std::vector<std::uint8_t> looking(block_.size());  // `loose` has an entry for the lane of no block
  for (std::size_t b = 0; b < looking.size(); ++b) looking[b] = !loose[b] && model_.kind[b] != Kind::fixed;
  pairs_.clear();
  listed_u_ = state_.pose.u, listed_q_ = state_.pose.q;
  reach_ = 0;
  for (std::size_t b = 0; b < block_.size(); ++b)
    if (model_.kind[b] != Kind::fixed) reach_ = std::max(reach_, bodies_.reach[b]);
  slack_ = margin_;
  for (const PartPair& parts : close_parts(margin_, {}, bodies_.shapes, block_, looking, jointed_pairs(model_, state_)))
    if (!loose[z(parts.a)] && !loose[z(parts.b)]) pairs_.push_back(listed(parts));
  for (const Neighbours& pair : pairs_) slack_ = std::min(slack_, pair.narrow ? narrow_ - shift_bound(pair) : pair.gap);
}

NeighbourWatch::Neighbours NeighbourWatch::listed(const PartPair& parts) const {
  Neighbours out{parts, greatest_gap(frame(parts, bodies_.shapes, block_[z(parts.a)], block_[z(parts.b)])), false, {}};
  const auto joined_to_b = [&](int c) { return bodies_.were_joined(c, parts.b); };
  if (std::ranges::none_of(bodies_.neighbours[z(parts.a)], joined_to_b)) return out;
  ContactBlock a = block_[z(parts.a)], b = block_[z(parts.b)];
  a.u = b.u = Vec3::Zero();
  a.rotation = bodies_.axes_of(parts.a), b.rotation = bodies_.axes_of(parts.b);
  const PairFrame rest = frame(parts, bodies_.shapes, a, b);
  out.narrow = second_gap(rest) >= -narrow_;
  out.rest = rest.pose;
  return out;
}

bool NeighbourWatch::may_touch(const Neighbours& pair, double time) const {
  const PartPair& of = pair.parts;
  if (pair.narrow) return shifted(pair);
  const ContactBlock &a = block_[z(of.a)], &b = block_[z(of.b)];
  const double moved = ((b.u - u_[z(of.b)]) - (a.u - u_[z(of.a)])).norm() + rotated_[z(of.a)] + rotated_[z(of.b)];
  const double speed = (b.v - a.v).norm() + bodies_.reach[z(of.a)] * a.w.norm() + bodies_.reach[z(of.b)] * b.w.norm();
  const double near = ahead(speed, time);
  if (pair.gap - moved > near || !boxes_within(near, bodies_.shapes, block_, of)) return false;
  return greatest_gap(frame(of, bodies_.shapes, a, b)) <= near;
}

// True if the relative motion since rest exceeds what a narrow strip bears.
bool NeighbourWatch::shifted(const Neighbours& pair) const {
  if (shift_bound(pair) <= narrow_) return false;
  const PairPose now = frame(pair.parts, bodies_.shapes, block_[z(pair.parts.a)], block_[z(pair.parts.b)]).pose;
  const double rotated = turning_path(pair.rest.rotation, now.rotation, bodies_.reach[z(pair.parts.b)]);
  return (now.shift - pair.rest.shift).norm() + rotated > narrow_;
}

// m, upper bound of this motion, quickly.
double NeighbourWatch::shift_bound(const Neighbours& pair) const {
  const std::size_t a = z(pair.parts.a), b = z(pair.parts.b);
  const double rotated = 2 * (Quat(state_.pose.q[a]).vec().norm() + Quat(state_.pose.q[b]).vec().norm());
  return (block_[b].u - block_[a].u).norm() + (bodies_.reach[a] + bodies_.reach[b]) * rotated;
}

}  // namespace erbs
