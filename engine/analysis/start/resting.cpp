#include "engine/analysis/start/resting.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/error.h"
#include "engine/contact/broad/search.h"
#include "engine/solve/contacts/bodies.h"

namespace erbs::analysis {
namespace {

constexpr double near = 1e-3;        // of the thinner block: so far a block may fall first, or start within the other
constexpr double least_slope = 0.1;  // cosine between the common normal and the vertical; on steeper faces blocks stand side by side
std::size_t z(int i) { return std::size_t(i); }

// Sets of blocks that lie together.
class Heaps {
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

}  // namespace

Resting::Resting(const Model& model, const State& state)
    : loose_(z(model.nblock)),
      joined_(z(model.nblock)),
      lies_(z(model.nblock)),
      bears_(z(model.nblock)),
      gives_way_(z(model.nblock)),
      island_(state.topology.island) {
  for (int b = 0; b < model.nblock; ++b) {
    const bool rests = model.kind[z(b)] == Kind::moving && state.motion.v[z(b)].isZero(0) && state.motion.spin_momentum[z(b)].isZero(0);
    const bool grounded = state.topology.grounded[z(b)] != 0;
    loose_[z(b)] = rests && !grounded, joined_[z(b)] = rests && grounded;
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
    out.push_back({of.a, of.b, (a.rotation * face.n).dot(model.gravity) / model.gravity.norm()});
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

void Resting::sort() {
  const int n = int(loose_.size());
  Heaps heaps(n);
  for (int b = 0; b < n; ++b)
    if (loose_[z(b)] != 0 && loose_[z(island_[z(b)])] != 0) heaps.unite(b, island_[z(b)]);
  for (const Touch& t : touch_)
    if (loose_[z(t.a)] != 0 && loose_[z(t.b)] != 0) heaps.unite(t.a, t.b);
  std::vector<std::uint8_t> rests(z(n), 0), falls(z(n), 0);  // by heap
  std::vector<std::uint8_t> bears(z(n), 0);                  // by island
  const auto on_structure = [&](const auto& visit) {         // visit(heap, island)
    for (const Touch& t : touch_) {
      if (loose_[z(t.a)] != 0 && joined_[z(t.b)] != 0 && t.down > least_slope) visit(z(heaps.of(t.a)), z(island_[z(t.b)]));
      if (loose_[z(t.b)] != 0 && joined_[z(t.a)] != 0 && -t.down > least_slope) visit(z(heaps.of(t.b)), z(island_[z(t.a)]));
    }
  };
  on_structure([&](std::size_t heap, std::size_t island) { rests[heap] = 1, falls[heap] |= gives_way_[island]; });
  on_structure([&](std::size_t heap, std::size_t island) { bears[island] |= falls[heap] == 0; });
  for (int b = 0; b < n; ++b) {
    const auto heap = z(heaps.of(b));
    lies_[z(b)] = loose_[z(b)] != 0 && rests[heap] != 0 && falls[heap] == 0;
    bears_[z(b)] = joined_[z(b)] != 0 && bears[z(island_[z(b)])] != 0;
  }
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
