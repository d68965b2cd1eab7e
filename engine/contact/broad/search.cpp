#include "engine/contact/broad/search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "engine/contact/law/pair_lanes.h"

namespace erbs {
namespace {

using std::size_t;
size_t at(int i) { return static_cast<size_t>(i); }

struct Found {
  int a, b, part_a, part_b;
  auto key() const { return std::tie(a, b, part_a, part_b); }
};

auto key_of(const ContactPair& p) { return std::tie(p.a, p.b, p.part_a, p.part_b); }

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
    const OrientedBox& p = parts[at(i)];
    g.x.push_back(p.centre[0]), g.y.push_back(p.centre[1]), g.z.push_back(p.centre[2]), g.radius.push_back(p.radius);
  }
  for (std::vector<double>* v : {&g.x, &g.y, &g.z, &g.radius}) v->resize(g.sorted.size() + 7);
  return g;
}

// m, distance of the farthest point of all parts of block b from its centroid.
double reach_of(const ContactShapes& shapes, size_t b) {
  double reach = 0;
  for (int s = shapes.first[b]; s < shapes.first[b + 1]; ++s) reach = std::max(reach, shapes.part(at(s)).reach);
  return reach;
}

// Boxes around the parts, and around where they are after a `travel` (m) of their blocks.
std::vector<OrientedBox> oriented_boxes(const ContactShapes& shapes, std::span<const ContactBlock> blocks, std::span<const double> travel) {
  std::vector<OrientedBox> parts(shapes.of.size());
  for (size_t i = 0; i < parts.size(); ++i) {
    const ContactBlock& b = blocks[at(shapes.block[i])];
    const ContactShape& shape = shapes.part(i);
    // relative to block 0 at rest, so that a scene 1e4 m from the origin loses no digits
    const Vec3 centre = (b.rest - blocks[0].rest) + b.u + b.rotation * shape.centre;
    std::copy_n(centre.data(), 3, parts[i].centre);
    std::copy_n(b.rotation.data(), 9, parts[i].rotation);
    const double way = travel[at(shapes.block[i])];
    for (int k = 0; k < 3; ++k) parts[i].half[k] = shape.half[k] + way;
    parts[i].radius = shape.radius + std::sqrt(3.0) * way;
  }
  return parts;
}

// Finds the pairs of parts that are close.
class Finder {
 public:
  Finder(const PairList& list, const ContactShapes& shapes, std::span<const ContactBlock> blocks, std::span<const std::uint8_t> loose,
         std::span<const std::uint64_t> excluded)
      : margin_(list.margin),
        shapes_(shapes),
        blocks_(blocks),
        loose_(loose),
        excluded_(excluded),
        parts_(oriented_boxes(shapes, blocks, list.travel)) {}

  std::vector<Found> find() {
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
    std::sort(found_.begin(), found_.end(), [](const Found& x, const Found& y) { return x.key() < y.key(); });
    return std::move(found_);
  }

 private:
  bool is_loose(int i) const { return loose_[at(shapes_.block[at(i)])] != 0; }

  // Finds the neighbours of parts [first, last) of one cell: in this cell, in the 26 around it, and among the huge parts.
  void around(const Grid& g, size_t first, size_t last) {
    const auto some = [&](size_t k) { return is_loose(g.sorted[k].second); };
    while (first < last && !some(first)) ++first;
    if (first == last) return;
    const auto c = cell_of(parts_[at(g.sorted[first].second)].centre, g.cell);
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
      const OrientedBox& part = parts_[at(i)];
      const double one[4] = {part.centre[0], part.centre[1], part.centre[2], part.radius};
      for (const auto& [from, to] : runs) {
        const int near = pair_kernels().close_balls(balls, from, to, one, margin_, close_.data());
        for (int k = 0; k < near; ++k) visit(i, g.sorted[at(close_[at(k)])].second);
      }
      for (const int j : g.huge) visit_if_near(i, j);
      judge(i);
    }
  }

  void visit_if_near(int i, int j) {
    const OrientedBox &p = parts_[at(i)], &q = parts_[at(j)];
    const double reach = p.radius + q.radius + margin_;
    if (!((Vec3::Map(p.centre) - Vec3::Map(q.centre)).squaredNorm() > reach * reach)) visit(i, j);
  }

  void visit(int i, int j) {
    const int bi = shapes_.block[at(i)], bj = shapes_.block[at(j)];
    if (bi == bj || (loose_[at(bj)] && j < i)) return;  // two loose parts are found twice; once is enough
    if (blocks_[at(bi)].inverse_mass == 0 && blocks_[at(bj)].inverse_mass == 0) return;
    candidates_[waiting_++] = j;
    if (waiting_ == 8) judge(i);
  }

  void judge(int i) {
    if (waiting_ == 0) return;
    const OrientedBox* other[8];
    for (int l = 0; l < 8; ++l) other[l] = &parts_[at(candidates_[l < waiting_ ? l : 0])];
    const unsigned close = pair_kernels().close_boxes(parts_[at(i)], other, margin_);
    for (int l = 0; l < waiting_; ++l) {
      if ((close >> l & 1u) == 0) continue;
      const int j = candidates_[l], bi = shapes_.block[at(i)], bj = shapes_.block[at(j)];
      const int pi = i - shapes_.first[at(bi)], pj = j - shapes_.first[at(bj)];
      const Found f = bi < bj ? Found{bi, bj, pi, pj} : Found{bj, bi, pj, pi};
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
  std::vector<Found> found_;
  std::vector<int> close_;
  int candidates_[8], waiting_ = 0;
};

// The two greatest of many numbers.
struct Farthest {
  double greatest = 0, second = 0;

  void take(double x) {
    if (!(x <= greatest)) second = std::exchange(greatest, x);
    else second = std::max(second, x);
  }
  double two() const { return greatest + second; }
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
  // The motion of two bodies towards each other does not contain the common motion of all bodies.
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  const auto is_still = [&](size_t b) { return !still.empty() && still[b] != 0; };
  const auto come = [&](size_t b) -> Vec3 { return is_still(b) ? Vec3(Vec3::Zero()) : Vec3(blocks[b].u - list.u[b]); };
  for (size_t b = 0; b < blocks.size(); ++b) low = low.cwiseMin(come(b)), high = high.cwiseMax(come(b));
  const Vec3 together = (low + high) / 2;
  Farthest all, apart;
  for (size_t b = 0; b < blocks.size(); ++b) {
    const Vec3 moved = come(b);
    double rotated = 0;
    // |R - R0| (Frobenius) is 2 sqrt 2 sin(angle / 2); the chord of the farthest point is reach times that / sqrt 2.
    if (!is_still(b)) rotated = reach_of(shapes, b) * std::sqrt(0.5) * (blocks[b].rotation - list.rotation[b]).norm();
    const double foreseen = 0.5 * list.travel[b];
    all.take(std::max(0.0, moved.norm() + rotated - foreseen));
    apart.take(std::max(0.0, (moved - together).norm() + rotated - foreseen));
  }
  // half the margin: this test runs every few steps only, and a pair listed late would begin inside the other block
  return !(std::min(all.two(), apart.two()) <= 0.5 * list.margin);
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
  const std::vector<Found> found = shapes.shape.empty() ? std::vector<Found>{} : Finder(list, shapes, blocks, looking, excluded).find();
  std::vector<ContactPair>& now = list.spare;
  now.clear();
  double dropped = 0;
  double restitution = std::numeric_limits<double>::quiet_NaN(), impact = 0;  // of the last new pair; most pairs have the same
  auto old = list.pair.begin();
  const auto leave = [&](const ContactPair& p) {
    const bool stays = !looking[at(p.a)] && !looking[at(p.b)] && (loose[at(p.a)] || loose[at(p.b)]);
    if (stays) now.push_back(p);
    else dropped += p.tangential;
  };
  for (const Found& f : found) {
    for (; old != list.pair.end() && key_of(*old) < f.key(); ++old) leave(*old);
    if (old != list.pair.end() && key_of(*old) == f.key()) {
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
  const Found wanted{a, b, part_a, part_b};
  auto place = std::lower_bound(list.pair.begin(), list.pair.end(), wanted,
                                [](const ContactPair& p, const Found& f) { return key_of(p) < f.key(); });
  return place != list.pair.end() && key_of(*place) == wanted.key() ? static_cast<int>(place - list.pair.begin()) : -1;
}

}  // namespace erbs
