#include "engine/contact/broad.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace erbs {
namespace {

using std::size_t;
size_t at(int i) { return static_cast<size_t>(i); }

// A part where it is now, positions relative to block 0 at rest so that 1e4 m from the origin costs no digits.
struct Placed {
  Vec3 centre;  // m
  const Mat3* turn;
  const ContactShape* shape;
};

struct Found {
  int a, b, part_a, part_b;
  auto key() const { return std::tie(a, b, part_a, part_b); }
};

auto key_of(const Pair& p) { return std::tie(p.a, p.b, p.part_a, p.part_b); }

// Separating axes of two oriented boxes grown by the margin: the three faces of each and the nine products of edges.
bool boxes_apart(const Placed& p, const Placed& q, double margin) {
  const Mat3 turn = p.turn->transpose() * *q.turn;
  const Mat3 size = turn.cwiseAbs();
  const Vec3 d = p.turn->transpose() * (q.centre - p.centre);
  const Vec3 a = p.shape->half, b = q.shape->half;
  if (((d.cwiseAbs() - a - size * b).array() > margin).any()) return true;
  if ((((turn.transpose() * d).cwiseAbs() - b - size.transpose() * a).array() > margin).any()) return true;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Vec3 axis = Vec3::Unit(i).cross(turn.col(j));
      const double length = axis.norm();
      if (length < 1e-6) continue;
      const double reach = axis.cwiseAbs().dot(a) + (turn.transpose() * axis).cwiseAbs().dot(b);
      if (std::abs(axis.dot(d)) - reach > margin * length) return true;
    }
  }
  return false;
}

// Parts of ordinary size sorted by the cell that holds their centre; huge ones (ground, floor slabs) stand apart.
struct Grid {
  double cell = 1;
  std::vector<std::pair<std::uint64_t, int>> sorted;  // (cell, shape)
  std::vector<int> huge;
  std::vector<std::uint8_t> is_huge;
};

std::uint64_t cell_key(long x, long y, long z) {
  constexpr long middle = 1L << 20;
  auto part = [&](long i) { return static_cast<std::uint64_t>(std::clamp(i + middle, 0L, 2 * middle - 1)); };
  return part(x) << 42 | part(y) << 21 | part(z);
}

std::array<long, 3> cell_of(const Vec3& x, double cell) {
  auto index = [&](double v) { return static_cast<long>(std::floor(std::clamp(v / cell, -1e6, 1e6))); };
  return {index(x.x()), index(x.y()), index(x.z())};
}

Grid make_grid(const std::vector<Placed>& parts, double margin) {
  Grid g;
  std::vector<double> radii;
  for (const Placed& p : parts) radii.push_back(p.shape->radius);
  std::nth_element(radii.begin(), radii.begin() + static_cast<long>(radii.size() / 2), radii.end());
  const double ordinary = 3 * radii[radii.size() / 2];
  double largest = 0;
  for (const Placed& p : parts) {
    g.is_huge.push_back(p.shape->radius > ordinary);
    if (p.shape->radius <= ordinary) largest = std::max(largest, p.shape->radius);
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
  return g;
}

// Calls visit(i, j) for candidates of part i: its 27 cells and the huge parts, or every part if i is huge itself.
template <class Visit>
void candidates(const Grid& g, const std::vector<Placed>& parts, int i, Visit&& visit) {
  if (g.is_huge[at(i)]) {
    for (size_t j = 0; j < parts.size(); ++j) visit(static_cast<int>(j));
    return;
  }
  for (int j : g.huge) visit(j);
  const auto c = cell_of(parts[at(i)].centre, g.cell);
  for (long x = c[0] - 1; x <= c[0] + 1; ++x) {
    for (long y = c[1] - 1; y <= c[1] + 1; ++y) {
      // Cells along z are consecutive keys: one look-up for three cells.
      const std::uint64_t last = cell_key(x, y, c[2] + 1);
      auto place = std::lower_bound(g.sorted.begin(), g.sorted.end(), std::make_pair(cell_key(x, y, c[2] - 1), -1));
      for (; place != g.sorted.end() && place->first <= last; ++place) visit(place->second);
    }
  }
}

std::vector<Placed> place(const ContactShapes& shapes, std::span<const ContactBlock> blocks) {
  std::vector<Placed> parts;
  parts.reserve(shapes.shape.size());
  for (size_t i = 0; i < shapes.shape.size(); ++i) {
    const ContactBlock& b = blocks[at(shapes.block[i])];
    parts.push_back({(b.rest - blocks[0].rest) + b.u + b.turn * shapes.shape[i].centre, &b.turn, &shapes.shape[i]});
  }
  return parts;
}

std::vector<Found> close_parts(const PairList& list, const ContactShapes& shapes, std::span<const ContactBlock> blocks,
                               std::span<const std::uint8_t> loose, std::span<const std::uint64_t> excluded) {
  const std::vector<Placed> parts = place(shapes, blocks);
  const Grid grid = make_grid(parts, list.margin);
  std::vector<Found> found;
  for (int i = 0; i < static_cast<int>(parts.size()); ++i) {
    const int bi = shapes.block[at(i)];
    if (!loose[at(bi)]) continue;
    candidates(grid, parts, i, [&](int j) {
      const int bj = shapes.block[at(j)];
      if (bi == bj || (loose[at(bj)] && j < i)) return;  // two loose parts are met twice: once is enough
      if (blocks[at(bi)].inverse_mass == 0 && blocks[at(bj)].inverse_mass == 0) return;
      const Placed &p = parts[at(i)], &q = parts[at(j)];
      const double reach = p.shape->radius + q.shape->radius + list.margin;
      if ((p.centre - q.centre).squaredNorm() > reach * reach || boxes_apart(p, q, list.margin)) return;
      const int pi = i - shapes.first[at(bi)], pj = j - shapes.first[at(bj)];
      const Found f = bi < bj ? Found{bi, bj, pi, pj} : Found{bj, bi, pj, pi};
      if (!std::binary_search(excluded.begin(), excluded.end(), pair_key(f.a, f.b))) found.push_back(f);
    });
  }
  std::sort(found.begin(), found.end(), [](const Found& x, const Found& y) { return x.key() < y.key(); });
  return found;
}

}  // namespace

double suggested_margin(std::vector<double> t) {
  if (t.empty()) return 0.01;
  std::nth_element(t.begin(), t.begin() + static_cast<long>(t.size() / 2), t.end());
  return 0.1 * t[t.size() / 2];
}

bool needs_search(const PairList& list, const ContactShapes& shapes, std::span<const ContactBlock> blocks,
                  std::span<const std::uint8_t> still) {
  if (!list.valid || list.u.size() != blocks.size()) return true;
  double greatest = 0, second = 0;
  for (size_t b = 0; b < blocks.size(); ++b) {
    if (!still.empty() && still[b]) continue;
    double reach = 0;
    for (int s = shapes.first[b]; s < shapes.first[b + 1]; ++s) reach = std::max(reach, shapes.shape[at(s)].reach);
    // |R - R0| of Frobenius is 2 sqrt 2 sin(angle / 2): the chord of the farthest point is reach times that / sqrt 2.
    const double moved = (blocks[b].u - list.u[b]).norm() + reach * std::sqrt(0.5) * (blocks[b].turn - list.turn[b]).norm();
    if (!(moved <= greatest)) {
      second = greatest;
      greatest = moved;
    } else {
      second = std::max(second, moved);
    }
  }
  return !(greatest + second <= list.margin);
}

double search(PairList& list, const ContactShapes& shapes, std::span<const ContactBlock> blocks, std::span<const std::uint8_t> loose,
              std::span<const std::uint64_t> excluded, const std::function<PairLaw(int a, int b)>& law, std::span<const std::uint8_t> still,
              std::vector<int>* fresh) {
  std::vector<std::uint8_t> looking(loose.begin(), loose.end());
  for (size_t b = 0; b < still.size(); ++b) looking[b] = looking[b] && !still[b];
  const std::vector<Found> found = shapes.shape.empty() ? std::vector<Found>{} : close_parts(list, shapes, blocks, looking, excluded);
  std::vector<Pair> now;
  now.reserve(found.size());
  double dropped = 0;
  auto old = list.pair.begin();
  const auto leave = [&](const Pair& p) {
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
    now.push_back(new_pair(f.a, f.part_a, f.b, f.part_b, law(f.a, f.b), shapes));
  }
  for (; old != list.pair.end(); ++old) leave(*old);
  list.pair = std::move(now);
  list.u.resize(blocks.size());
  list.turn.resize(blocks.size());
  for (size_t b = 0; b < blocks.size(); ++b) {
    list.u[b] = blocks[b].u;
    list.turn[b] = blocks[b].turn;
  }
  list.valid = true;
  ++list.searches;
  return dropped;
}

PairLaw pair_law(const Material& a, const Material& b) {
  auto series = [](double x, double y) { return x + y > 0 ? 2 * x * y / (x + y) : 0.0; };
  return {series(a.kn, b.kn), series(a.ks, b.ks), std::min(a.friction, b.friction), std::min(a.restitution, b.restitution)};
}

int find_pair(const PairList& list, int a, int part_a, int b, int part_b) {
  const Found wanted{a, b, part_a, part_b};
  auto place =
      std::lower_bound(list.pair.begin(), list.pair.end(), wanted, [](const Pair& p, const Found& f) { return key_of(p) < f.key(); });
  return place != list.pair.end() && key_of(*place) == wanted.key() ? static_cast<int>(place - list.pair.begin()) : -1;
}

}  // namespace erbs
