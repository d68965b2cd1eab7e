#include "engine/analysis/settlement.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

namespace erbs::analysis {
namespace {

constexpr double near = 1e-2;  // of the smaller edge: blocks so close at the start lie on each other

std::size_t z(int i) { return std::size_t(i); }

struct Box {
  Vec3 low, high;  // m
  int block;
};

Box box_of(const Model& m, const State& s, int b) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Box box{Vec3::Constant(infinite), Vec3::Constant(-infinite), b};
  const Quat& q = s.pose.q[z(b)];
  for (const Polyhedron& part : m.parts[z(b)])
    for (const Vec3& vertex : part.vertices) {
      const Vec3 at = m.rest[z(b)] + Vec3(s.pose.u[z(b)]) + q * (vertex - m.rest[z(b)]);
      box.low = box.low.cwiseMin(at), box.high = box.high.cwiseMax(at);
    }
  return box;
}

// The pile of each moving block, named by one of its blocks: blocks that joints hold together, and loose ones that lie on each other.
class Piles {
 public:
  Piles(const Model& m, const State& s) : of_(z(m.nblock)) {
    std::iota(of_.begin(), of_.end(), 0);
    std::vector<Box> boxes;
    for (const Joint& joint : m.joint) unite(m, joint.a, joint.b);
    if (s.topology.unjoined == 0) return;
    for (int b = 0; b < m.nblock; ++b)
      if (m.kind[z(b)] == Kind::moving) boxes.push_back(box_of(m, s, b));
    std::ranges::sort(boxes, {}, [](const Box& box) { return box.low.x(); });
    double widest = 0;  // largest distance at which blocks lie on each other
    for (const Box& box : boxes) widest = std::max(widest, near * m.smallest_edge[z(box.block)]);
    for (std::size_t i = 0; i < boxes.size(); ++i)
      for (std::size_t k = i + 1; k < boxes.size() && boxes[k].low.x() <= boxes[i].high.x() + widest; ++k) {
        const Box &a = boxes[i], &b = boxes[k];
        if (s.topology.joined[z(a.block)] && s.topology.joined[z(b.block)]) continue;
        const double gap = near * std::min(m.smallest_edge[z(a.block)], m.smallest_edge[z(b.block)]);
        if ((a.low - b.high).maxCoeff() <= gap && (b.low - a.high).maxCoeff() <= gap) unite(m, a.block, b.block);
      }
  }

  int of(int b) {
    while (of_[z(b)] != b) b = of_[z(b)] = of_[z(of_[z(b)])];
    return b;
  }

 private:
  // Supports belong to no pile, or all that stands on them would be one.
  void unite(const Model& m, int a, int b) {
    if (m.kind[z(a)] == Kind::moving && m.kind[z(b)] == Kind::moving) of_[z(of(a))] = of(b);
  }
  std::vector<int> of_;
};

}  // namespace

// n courses of mass m on springs k settle by n (n + 1) / 2 m g / k. The block bound of the time step gives k / m = 2 / dt^2. Blocks that
// do not lie on each other do not press each other: a brick in the air or a tower far off is none of the pile.
double settlement_of(const Model& m, const State& s, double block_bound) {
  struct Pile {
    double low = 1e300, high = -1e300, edges = 0, blocks = 0;
  };
  const double g = m.gravity.norm();
  const Vec3 up = -m.gravity / g;
  Piles piles(m, s);
  std::map<int, Pile> of;
  for (int b = 0; b < m.nblock; ++b) {
    if (m.kind[z(b)] != Kind::moving) continue;
    Pile& pile = of[piles.of(b)];
    const double at = up.dot(m.rest[z(b)] + Vec3(s.pose.u[z(b)])), edge = m.smallest_edge[z(b)];
    pile.low = std::min(pile.low, at - edge / 2), pile.high = std::max(pile.high, at + edge / 2), pile.edges += edge, ++pile.blocks;
  }
  double courses = 1;
  for (const auto& [name, pile] : of) courses = std::max(courses, (pile.high - pile.low) * pile.blocks / pile.edges);
  return 0.5 * courses * (courses + 1) * g * block_bound * block_bound / 2;
}

}  // namespace erbs::analysis
