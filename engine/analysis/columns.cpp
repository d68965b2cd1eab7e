#include "engine/analysis/columns.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace erbs::analysis {
namespace {

constexpr double near = 1e-2;   // of the smaller edge: loose blocks so close at the start lie on each other
constexpr double above = 0.25;  // of the smaller edge: a block so much higher lies on the other, rather than beside it

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

// Loose blocks that touch at the start.
template <class F>
void each_loose_pair(const Model& m, const State& s, F&& f) {
  if (s.topology.unjoined == 0) return;
  std::vector<Box> boxes;
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
      if ((a.low - b.high).maxCoeff() <= gap && (b.low - a.high).maxCoeff() <= gap) f(a.block, b.block);
    }
}

// Supports belong to no column, or all that stands on them would be one.
struct Link {
  int lower, upper;
};
std::vector<Link> links_of(const Model& m, const State& s, const std::vector<double>& height) {
  std::vector<Link> links;
  const auto add = [&](int a, int b) {
    if (m.kind[z(a)] != Kind::moving || m.kind[z(b)] != Kind::moving) return;
    if (std::fabs(height[z(a)] - height[z(b)]) < above * std::min(m.smallest_edge[z(a)], m.smallest_edge[z(b)])) return;
    links.push_back(height[z(a)] < height[z(b)] ? Link{a, b} : Link{b, a});
  };
  for (const Joint& joint : m.joint) add(joint.a, joint.b);
  each_loose_pair(m, s, add);
  return links;
}

// The longest way up or down from a block, itself included.
struct Way {
  int courses = 1;
  double settles = 0;  // m, sum of what each of its blocks settles on its own bed
};
void lengthen(Way& way, const Way& by, double own) {
  if (by.courses + 1 > way.courses) way = {by.courses + 1, by.settles + own};
}

}  // namespace

// n courses of mass m on springs k settle by n (n + 1) / 2 m g / k. The bound of a block gives k / m = 2 / dt^2; of unequal blocks the mean
// counts. The longest ways up and down from a block through blocks that lie on each other are its column: a brick in the air or a tower
// far off is none of it, nor is the tower that a low wall leans on.
std::vector<Hop> hops_of(const Model& m, const State& s, std::span<const double> bounds) {
  const double g = m.gravity.norm();
  if (!(g > 0)) return {};
  std::vector<double> height(z(m.nblock)), own(z(m.nblock));
  std::vector<Way> up(z(m.nblock)), down(z(m.nblock));
  for (int b = 0; b < m.nblock; ++b) {
    height[z(b)] = -m.gravity.dot(m.rest[z(b)] + Vec3(s.pose.u[z(b)])) / g;
    own[z(b)] = g * bounds[z(b)] * bounds[z(b)] / 2;
    up[z(b)].settles = down[z(b)].settles = own[z(b)];
  }
  std::vector<Link> links = links_of(m, s, height);
  std::ranges::stable_sort(links, {}, [&](const Link& link) { return height[z(link.upper)]; });
  for (const auto& [lower, upper] : links) lengthen(down[z(upper)], down[z(lower)], own[z(upper)]);
  std::ranges::stable_sort(links, std::greater{}, [&](const Link& link) { return height[z(link.lower)]; });
  for (const auto& [lower, upper] : links) lengthen(up[z(lower)], up[z(upper)], own[z(lower)]);
  std::vector<Hop> hops(z(m.nblock));
  for (int b = 0; b < m.nblock; ++b) {
    if (m.kind[z(b)] != Kind::moving || !std::isfinite(own[z(b)])) continue;
    const int n = up[z(b)].courses + down[z(b)].courses - 1;
    const double mean = (up[z(b)].settles + down[z(b)].settles - own[z(b)]) / n, time = std::sqrt(0.5 * n * (n + 1) * mean / g);
    hops[z(b)] = {time, std::min<double>(n, interlock_loan) * time};
  }
  return hops;
}

}  // namespace erbs::analysis
