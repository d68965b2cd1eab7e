#include "engine/analysis/start/resting.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/count.h"
#include "engine/base/error.h"
#include "engine/base/rotation.h"
#include "engine/contact/broad/search.h"
#include "engine/solve/contacts/bodies.h"

namespace erbs::analysis {
namespace {

constexpr double near = 1e-3;         // of the thinner block: so far a block may fall first, or start within the other
constexpr double least_slope = 0.01;  // cosine between the common normal and the vertical; on steeper faces blocks stand side by side
constexpr double aside = 0.05;        // of its thickness: a block has left its place

Vec3 seen_from(int lower, int upper, const Model& m, const State& s) {
  return Quat(s.pose.q[z(lower)]).conjugate() * (m.rest[z(upper)] + s.pose.u[z(upper)] - m.rest[z(lower)] - s.pose.u[z(lower)]);
}

}  // namespace

// Sets of blocks that lie together.
class Resting::Heaps {
 public:
  explicit Heaps(int count) : parent_(z(count)) { std::iota(parent_.begin(), parent_.end(), 0); }
  int of(int b) {
    while (parent_[z(b)] != b) b = parent_[z(b)] = parent_[z(parent_[z(b)])];
    return b;
  }
  void unite(int a, int b) { parent_[z(std::max(of(a), of(b)))] = std::min(of(a), of(b)); }

 private:
  std::vector<int> parent_;
};

Resting::Resting(const Model& model, const State& state)
    : loose_(z(model.nblock)),
      joined_(z(model.nblock)),
      lies_(z(model.nblock)),
      bears_(z(model.nblock)),
      gives_way_(z(model.nblock)),
      island_(state.topology.island),
      built_(state.pose) {
  for (int b = 0; b < model.nblock; ++b) {
    const bool moving = model.kind[z(b)] == Kind::moving, grounded = state.topology.grounded[z(b)] != 0;
    const bool still = state.motion.v[z(b)].isZero(0) && state.motion.spin_momentum[z(b)].isZero(0);
    loose_[z(b)] = moving && still && !grounded, joined_[z(b)] = moving && grounded;
  }
  const bool some_loose = std::ranges::any_of(loose_, [](std::uint8_t is) { return is != 0; });
  if (model.gravity.norm() > 0 && model.njoint > 0 && model.analysis.debris && some_loose) touch_ = touches(model, state);
  sort();
}

std::vector<Resting::Touch> Resting::touches(const Model& model, const State& state) const {
  ContactBodies bodies(model);
  bodies.initialise();
  for (std::size_t b = 0; b < bodies.block.size(); ++b) {
    bodies.block[b].u = state.pose.u[b];
    bodies.block[b].rotation = Quat(state.pose.q[b]).toRotationMatrix() * bodies.axes_of(int(b));
  }
  std::vector<Touch> out;
  const double margin = near * *std::ranges::max_element(model.smallest_edge);
  for (const PartPair& of : close_parts(margin, {}, bodies.shapes, bodies.block, loose_, {})) {
    const ContactBlock &a = bodies.block[z(of.a)], &b = bodies.block[z(of.b)];
    const PairFrame s = part_frame(shape_of(bodies.shapes, of.a, of.part_a), shape_of(bodies.shapes, of.b, of.part_b), a, b);
    const FaceGap face = std::ranges::max(face_gaps(s), {}, &FaceGap::gap);
    if (std::fabs(face.gap) > near * std::min(model.smallest_edge[z(of.a)], model.smallest_edge[z(of.b)])) continue;
    const double down = (a.rotation * face.n).dot(model.gravity) / model.gravity.norm();  // of the normal from a to b
    const bool a_above = loose_[z(of.b)] == 0 || (loose_[z(of.a)] != 0 && down > 0);
    const int upper = a_above ? of.a : of.b, lower = a_above ? of.b : of.a;
    out.push_back({upper, lower, a_above ? down : -down, seen_from(lower, upper, model, state)});
  }
  return out;
}

void Resting::drop(const std::vector<int>& blocks) {
  for (const int b : blocks) {
    if (joined_[z(b)] != 0) gives_way_[z(island_[z(b)])] = 1;
    loose_[z(b)] = 0;
  }
  sort();
}

Resting::Heaps Resting::heaps_of() const {
  const int n = int(loose_.size());
  Heaps heaps(n);
  for (int b = 0; b < n; ++b)
    if (loose_[z(b)] != 0 && loose_[z(island_[z(b)])] != 0) heaps.unite(b, island_[z(b)]);
  for (const Touch& t : touch_)
    if (loose_[z(t.upper)] != 0 && loose_[z(t.lower)] != 0) heaps.unite(t.upper, t.lower);
  return heaps;
}

bool Resting::lies_on_structure(const Touch& t) const { return on_joined(t) && t.down > least_slope; }

void Resting::sort() {
  const int n = int(loose_.size());
  Heaps heaps = heaps_of();
  std::vector<std::uint8_t> rests(z(n), 0), falls(z(n), 0);  // by heap
  std::vector<std::uint8_t> bears(z(n), 0);                  // by island
  for (const Touch& t : touch_) {
    if (!on_joined(t)) continue;
    const auto heap = z(heaps.of(t.upper));
    rests[heap] |= lies_on_structure(t);
    falls[heap] |= gives_way_[z(island_[z(t.lower)])];
  }
  for (const Touch& t : touch_)
    if (const auto heap = z(heaps.of(t.upper)); on_joined(t)) bears[z(island_[z(t.lower)])] |= rests[heap] != 0 && falls[heap] == 0;
  for (int b = 0; b < n; ++b) {
    const auto heap = z(heaps.of(b));
    lies_[z(b)] = loose_[z(b)] != 0 && rests[heap] != 0 && falls[heap] == 0;
    bears_[z(b)] = joined_[z(b)] != 0 && bears[z(island_[z(b)])] != 0;
  }
}

std::vector<std::uint8_t> Resting::tied_to_unfound(const std::vector<std::uint8_t>& found) const {
  const std::size_t n = loose_.size();
  Heaps heaps = heaps_of();
  std::vector<std::uint8_t> island(n, 0), heap(n, 0), out(n, 0);
  for (std::size_t b = 0; b < n; ++b)
    if (joined_[b] != 0 && found[b] == 0) island[z(island_[b])] = 1;
  for (bool grows = true; grows;) {
    grows = false;
    for (const Touch& t : touch_) {
      if (!on_joined(t)) continue;
      std::uint8_t &of_heap = heap[z(heaps.of(t.upper))], &of_island = island[z(island_[z(t.lower)])];
      if (of_heap == of_island) continue;
      of_heap = of_island = 1;
      grows = true;
    }
  }
  for (std::size_t b = 0; b < n; ++b)
    out[b] = loose_[b] != 0 ? heap[z(heaps.of(int(b)))] : std::uint8_t(joined_[b] != 0 && found[b] != 0 && island[z(island_[b])] != 0);
  return out;
}

void Resting::carry(const Model& m, State& s) const {
  Heaps heaps = heaps_of();
  std::vector<std::vector<int>> below(lies_.size());  // by heap
  for (const Touch& t : touch_)
    if (lies_on_structure(t)) below[z(heaps.of(t.upper))].push_back(t.lower);
  const Vec3 down = m.gravity.normalized();
  const auto built = [&](int b) -> Vec3 { return m.rest[z(b)] + built_.u[z(b)]; };
  const auto now = [&](int b) -> Vec3 { return m.rest[z(b)] + s.pose.u[z(b)]; };
  for (std::size_t heap = 0; heap < below.size(); ++heap) {
    if (below[heap].empty()) continue;
    const double share = 1 / double(below[heap].size());
    Vec3 angle = Vec3::Zero(), shift = Vec3::Zero();
    for (const int b : below[heap]) angle += share * rotation_vector(Quat(s.pose.q[z(b)]) * Quat(built_.q[z(b)]).conjugate());
    const Quat rotated = rotation(angle);
    for (const int b : below[heap]) shift += share * (now(b) - rotated * built(b));
    double into = 0;  // m
    for (const int b : below[heap]) into = std::max(into, (rotated * built(b) + shift - now(b)).dot(down));
    shift -= into * down;
    for (int b = 0; b < m.nblock; ++b) {
      if (lies_[z(b)] == 0 || z(heaps.of(b)) != heap) continue;
      s.pose.u[z(b)] = rotated * built(b) + shift - m.rest[z(b)];
      s.pose.q[z(b)] = rotated * Quat(built_.q[z(b)]);
    }
  }
}

std::vector<double> Resting::borne(const Model& model) const {
  Heaps heaps = heaps_of();
  std::vector<double> mass(lies_.size(), 0), out(lies_.size(), 0);  // by heap; by block
  std::vector<int> count(lies_.size(), 0);                          // of what bears a heap
  for (std::size_t b = 0; b < lies_.size(); ++b)
    if (lies_[b] != 0) mass[z(heaps.of(int(b)))] += model.mass[b];
  for (const Touch& t : touch_) count[z(heaps.of(t.upper))] += lies_on_structure(t);
  for (const Touch& t : touch_)
    if (lies_on_structure(t)) out[z(t.lower)] += mass[z(heaps.of(t.upper))] / count[z(heaps.of(t.upper))];
  return out;
}

std::vector<int> Resting::displaced(const Model& model, const State& state) const {
  std::vector<int> out;
  for (const Touch& t : touch_)
    if (lies_[z(t.upper)] != 0 && t.down > least_slope &&
        (seen_from(t.lower, t.upper, model, state) - t.at).norm() > aside * model.thickness[z(t.upper)])
      out.push_back(t.upper);
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::vector<int> Resting::blocks() const {
  std::vector<int> out;
  for (std::size_t b = 0; b < lies_.size(); ++b)
    if (lies_[b] != 0) out.push_back(int(b));
  return out;
}

std::string names_of(const Model& model, const std::vector<int>& blocks) {
  constexpr std::size_t most = 5;
  std::string names;
  for (std::size_t i = 0; i < std::min(most, blocks.size()); ++i) names += (i == 0 ? "" : ", ") + model.block_name[z(blocks[i])];
  return blocks.size() > most ? names + fmt::format(" and {} more", blocks.size() - most) : names;
}

}  // namespace erbs::analysis
