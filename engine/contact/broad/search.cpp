#include "engine/contact/broad/search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "engine/base/count.h"
#include "engine/contact/broad/approach.h"
#include "engine/contact/law/pair_lanes.h"

namespace erbs {
namespace {

using std::size_t;

auto key_of(const auto& p) { return std::tie(p.a, p.b, p.part_a, p.part_b); }

// Parts of ordinary size, sorted by the cell of their centre; huge ones (ground, floor slabs) apart.
struct Grid {
  double cell = 1;
  std::vector<std::pair<std::uint64_t, int>> sorted;  // (cell, shape)
  std::vector<double> x, y, z, radius;                // m, of these; padded by seven
  std::vector<int> huge;
  std::vector<std::uint8_t> is_huge;
};

std::uint64_t cell_key(long x, long y, long z) {
  constexpr long middle = 1L << 20;
  auto part = [&](long i) { return static_cast<std::uint64_t>(std::clamp(i + middle, 0L, 2 * middle - 1)); };
  return part(x) << 42 | part(y) << 21 | part(z);
}

std::array<long, 3> cell_of(const double* x, double cell) {
  auto index = [&](double v) { return static_cast<long>(std::floor(std::clamp(v / cell, -1e6, 1e6))); };
  return {index(x[0]), index(x[1]), index(x[2])};
}

Grid make_grid(const std::vector<OrientedBox>& parts, double margin) {
  Grid g;
  std::vector<double> radii;
  for (const OrientedBox& p : parts) radii.push_back(p.radius);
  std::nth_element(radii.begin(), radii.begin() + static_cast<long>(radii.size() / 2), radii.end());
  const double ordinary = 3 * radii[radii.size() / 2];
  double largest = 0;
  for (const OrientedBox& p : parts) {
    g.is_huge.push_back(p.radius > ordinary);
    if (p.radius <= ordinary) largest = std::max(largest, p.radius);
  }
  g.cell = 2 * largest + margin;
  for (size_t i = 0; i < parts.size(); ++i) {
    if (g.is_huge[i]) {
      g.huge.push_back(static_cast<int>(i));
      continue;
    }
    const auto c = cell_of(parts[i].centre, g.cell);
    g.sorted.emplace_back(cell_key(c[0], c[1], c[2]), static_cast<int>(i));
  }
  std::sort(g.sorted.begin(), g.sorted.end());
  for (const auto& [cell, i] : g.sorted) {
    const OrientedBox& p = parts[z(i)];
    g.x.push_back(p.centre[0]), g.y.push_back(p.centre[1]), g.z.push_back(p.centre[2]), g.radius.push_back(p.radius);
  }
  for (std::vector<double>* v : {&g.x, &g.y, &g.z, &g.radius}) v->resize(g.sorted.size() + 7);
  return g;
}

// m, distance of the farthest point of all parts of block b from its centroid.
double reach_of(const ContactShapes& shapes, size_t b) {
  double reach = 0;
  for (int s = shapes.first[b]; s < shapes.first[b + 1]; ++s) reach = std::max(reach, shapes.part(z(s)).reach);
  return reach;
}

// Box around part `i`, and around where it is after a `travel` (m) of its block.
OrientedBox oriented_box(const ContactShapes& shapes, std::span<const ContactBlock> blocks, size_t i, double travel) {
  const ContactBlock& b = blocks[z(shapes.block[i])];
  const ContactShape& shape = shapes.part(i);
  OrientedBox box;
  // relative to block 0 at rest, so that a scene 1e4 m from the origin loses no digits
  const Vec3 centre = (b.rest - blocks[0].rest) + b.u + b.rotation * shape.centre;
  std::copy_n(centre.data(), 3, box.centre);
  std::copy_n(b.rotation.data(), 9, box.rotation);
  for (int k = 0; k < 3; ++k) box.half[k] = shape.half[k] + travel;
  box.radius = shape.radius + std::sqrt(3.0) * travel;
  return box;
}

// Finds the pairs of parts that are close.
class Finder {
 public:
  Finder(double margin, std::span<const double> travel, const ContactShapes& shapes, std::span<const ContactBlock> blocks,
         std::span<const std::uint8_t> loose, std::span<const std::uint64_t> excluded)
      : margin_(margin), shapes_(shapes), blocks_(blocks), loose_(loose), excluded_(excluded), parts_(shapes.of.size()) {
    for (size_t i = 0; i < parts_.size(); ++i) parts_[i] = oriented_box(shapes, blocks, i, travel.empty() ? 0 : travel[z(shapes.block[i])]);
  }

  std::vector<PartPair> find() {
    const Grid grid = make_grid(parts_, margin_);
    for (size_t first = 0; first < grid.sorted.size();) {
      size_t last = first + 1;
      while (last < grid.sorted.size() && grid.sorted[last].first == grid.sorted[first].first) ++last;
      around(grid, first, last);
      first = last;
    }
    for (const int i : grid.huge) {
      if (!is_loose(i)) continue;
      for (size_t j = 0; j < parts_.size(); ++j) visit_if_near(i, static_cast<int>(j));
      judge(i);
    }
    std::sort(found_.begin(), found_.end(), [](const PartPair& x, const PartPair& y) { return key_of(x) < key_of(y); });
    return std::move(found_);
  }

 private:
  bool is_loose(int i) const { return loose_[z(shapes_.block[z(i)])] != 0; }

  // Finds the neighbours of parts [first, last) of one cell: in this cell, in the 26 around it, and among the huge parts.
  void around(const Grid& g, size_t first, size_t last) {
    const auto some = [&](size_t k) { return is_loose(g.sorted[k].second); };
    while (first < last && !some(first)) ++first;
    if (first == last) return;
    const auto c = cell_of(parts_[z(g.sorted[first].second)].centre, g.cell);
    std::pair<int, int> runs[9];
    int count = 0;
    for (long x = c[0] - 1; x <= c[0] + 1; ++x) {
      for (long y = c[1] - 1; y <= c[1] + 1; ++y) {
        // Cells along z have consecutive keys: one search for three cells.
        const auto from = std::lower_bound(g.sorted.begin(), g.sorted.end(), std::make_pair(cell_key(x, y, c[2] - 1), -1));
        const std::uint64_t end = cell_key(x, y, c[2] + 1);
        auto to = from;
        while (to != g.sorted.end() && to->first <= end) ++to;
        runs[count++] = {static_cast<int>(from - g.sorted.begin()), static_cast<int>(to - g.sorted.begin())};
      }
    }
    const Balls balls{g.x.data(), g.y.data(), g.z.data(), g.radius.data()};
    close_.resize(g.sorted.size());
    for (; first < last; ++first) {
      if (!some(first)) continue;
      const int i = g.sorted[first].second;
      const OrientedBox& part = parts_[z(i)];
      const double one[4] = {part.centre[0], part.centre[1], part.centre[2], part.radius};
      for (const auto& [from, to] : runs) {
        const int near = pair_kernels().close_balls(balls, from, to, one, margin_, close_.data());
        for (int k = 0; k < near; ++k) visit(i, g.sorted[z(close_[z(k)])].second);
      }
      for (const int j : g.huge) visit_if_near(i, j);
      judge(i);
    }
  }

  void visit_if_near(int i, int j) {
    const OrientedBox &p = parts_[z(i)], &q = parts_[z(j)];
    const double reach = p.radius + q.radius + margin_;
    if (!((Vec3::Map(p.centre) - Vec3::Map(q.centre)).squaredNorm() > reach * reach)) visit(i, j);
  }

  void visit(int i, int j) {
    const int bi = shapes_.block[z(i)], bj = shapes_.block[z(j)];
    if (bi == bj || (loose_[z(bj)] && j < i)) return;  // two loose parts are found twice; once is enough
    if (blocks_[z(bi)].inverse_mass == 0 && blocks_[z(bj)].inverse_mass == 0) return;
    candidates_[waiting_++] = j;
    if (waiting_ == 8) judge(i);
  }

  void judge(int i) {
    if (waiting_ == 0) return;
    const OrientedBox* other[8];
    for (int l = 0; l < 8; ++l) other[l] = &parts_[z(candidates_[l < waiting_ ? l : 0])];
    const unsigned close = pair_kernels().close_boxes(parts_[z(i)], other, margin_);
    for (int l = 0; l < waiting_; ++l) {
      if ((close >> l & 1u) == 0) continue;
      const int j = candidates_[l], bi = shapes_.block[z(i)], bj = shapes_.block[z(j)];
      const int pi = i - shapes_.first[z(bi)], pj = j - shapes_.first[z(bj)];
      const PartPair f = bi < bj ? PartPair{bi, bj, pi, pj} : PartPair{bj, bi, pj, pi};
      if (!std::binary_search(excluded_.begin(), excluded_.end(), pair_key(f.a, f.b))) found_.push_back(f);
    }
    waiting_ = 0;
  }

  double margin_;
  const ContactShapes& shapes_;
  std::span<const ContactBlock> blocks_;
  std::span<const std::uint8_t> loose_;
  std::span<const std::uint64_t> excluded_;
  std::vector<OrientedBox> parts_;
  std::vector<PartPair> found_;
  std::vector<int> close_;
  int candidates_[8], waiting_ = 0;
};

// Times the least time ahead: that of blocks that travel by no more than two margins in it. More would list too many pairs.
constexpr double longer = 6;

}  // namespace

double suggested_margin(std::vector<double> t) {
  if (t.empty()) return 0.01;
  std::nth_element(t.begin(), t.begin() + static_cast<long>(t.size() / 2), t.end());
  return 0.1 * t[t.size() / 2];
}

bool needs_search(const PairList& list, const ContactShapes& shapes, std::span<const ContactBlock> blocks,
                  std::span<const std::uint8_t> still) {
  if (!list.valid || list.u.size() != blocks.size() || list.travel.size() != blocks.size()) return true;
  const auto is_still = [&](size_t b) { return !still.empty() && still[b] != 0; };
  const auto moved = [&](size_t b) -> Vec3 { return is_still(b) ? Vec3(Vec3::Zero()) : Vec3(blocks[b].u - list.u[b]); };
  const auto path = [&](size_t b) {
    const double rotated = is_still(b) ? 0 : turning_path(list.rotation[b], blocks[b].rotation, reach_of(shapes, b));
    return rotated - 0.5 * list.travel[b];  // half of what was foreseen
  };
  // half the margin: this test runs every few steps only, and a pair listed late would begin inside the other block
  return !(greatest_approach(blocks.size(), moved, path) <= 0.5 * list.margin);
}

std::vector<PartPair> close_parts(double margin, std::span<const double> travel, const ContactShapes& shapes,
                                  std::span<const ContactBlock> blocks, std::span<const std::uint8_t> looking,
                                  std::span<const std::uint64_t> excluded) {
  if (shapes.shape.empty()) return {};
  return Finder(margin, travel, shapes, blocks, looking, excluded).find();
}

bool boxes_within(double margin, const ContactShapes& shapes, std::span<const ContactBlock> blocks, const PartPair& pair) {
  const OrientedBox one = oriented_box(shapes, blocks, z(shapes.first[z(pair.a)] + pair.part_a), 0),
                    two = oriented_box(shapes, blocks, z(shapes.first[z(pair.b)] + pair.part_b), 0);
  const OrientedBox* other[8];
  std::ranges::fill(other, &two);
  return (pair_kernels().close_boxes(one, other, margin) & 1u) != 0;
}

double search(PairList& list, const ContactShapes& shapes, std::span<const ContactBlock> blocks, std::span<const std::uint8_t> loose,
              std::span<const std::uint64_t> excluded, const std::function<PairLaw(int a, int b)>& law, double ahead,
              std::span<const std::uint8_t> still, std::vector<int>* fresh) {
  const bool known = list.u.size() == blocks.size() && list.travel.size() == blocks.size() && still.size() == blocks.size();
  list.travel.resize(blocks.size());
  list.u.resize(blocks.size());
  list.rotation.resize(blocks.size());
  for (size_t b = 0; b < blocks.size(); ++b) {
    if (known && still[b]) continue;
    list.u[b] = blocks[b].u;
    list.rotation[b] = blocks[b].rotation;
    const double way = ahead * (blocks[b].v.norm() + blocks[b].w.norm() * reach_of(shapes, b));
    list.travel[b] = std::max(way, std::min(longer * way, 2 * list.margin));
  }
  std::vector<std::uint8_t> looking(loose.begin(), loose.end());
  for (size_t b = 0; b < still.size(); ++b) looking[b] = looking[b] && !still[b];
  const std::vector<PartPair> found = close_parts(list.margin, list.travel, shapes, blocks, looking, excluded);
  std::vector<ContactPair>& now = list.spare;
  now.clear();
  double dropped = 0;
  double restitution = std::numeric_limits<double>::quiet_NaN(), impact = 0;  // of the last new pair; most pairs have the same
  auto old = list.pair.begin();
  const auto leave = [&](const ContactPair& p) {
    const bool stays = !looking[z(p.a)] && !looking[z(p.b)] && (loose[z(p.a)] || loose[z(p.b)]);
    if (stays) now.push_back(p);
    else dropped += p.tangential;
  };
  for (const PartPair& f : found) {
    for (; old != list.pair.end() && key_of(*old) < key_of(f); ++old) leave(*old);
    if (old != list.pair.end() && key_of(*old) == key_of(f)) {
      now.push_back(*old++);
      continue;
    }
    if (fresh != nullptr) fresh->push_back(static_cast<int>(now.size()));
    const PairLaw of = law(f.a, f.b);
    if (of.restitution != restitution) restitution = of.restitution, impact = impact_factor(restitution);
    now.push_back(new_pair(f.a, f.part_a, f.b, f.part_b, of, impact, shapes));
  }
  for (; old != list.pair.end(); ++old) leave(*old);
  std::swap(list.pair, now);
  list.valid = true;
  ++list.searches;
  return dropped;
}

double friction_between(const Material& a, const Material& b) {
  for (const auto& [one, other] : {std::pair(&a, &b), std::pair(&b, &a)})
    for (const auto& [name, friction] : one->friction_with)
      if (name == other->name) return friction;
  return std::min(a.friction, b.friction);
}

PairLaw pair_law(const Material& a, const Material& b) {
  auto series = [](double x, double y) { return x + y > 0 ? 2 * x * y / (x + y) : 0.0; };
  return {series(a.kn, b.kn), series(a.ks, b.ks), friction_between(a, b), std::min(a.restitution, b.restitution)};
}

int find_pair(const PairList& list, int a, int part_a, int b, int part_b) {
  const PartPair wanted{a, b, part_a, part_b};
  auto place = std::lower_bound(list.pair.begin(), list.pair.end(), wanted,
                                [](const ContactPair& p, const PartPair& f) { return key_of(p) < key_of(f); });
  return place != list.pair.end() && key_of(*place) == key_of(wanted) ? static_cast<int>(place - list.pair.begin()) : -1;
}

}  // namespace erbs
