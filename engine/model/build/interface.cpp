#include "engine/model/build/interface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "engine/base/count.h"
#include "engine/geometry/clip.h"
#include "engine/geometry/separation.h"

namespace erbs {
namespace {

using std::size_t;
constexpr double facing = 1e-3;          // rad, largest angle between facing faces
constexpr double least_fraction = 1e-4;  // of the smaller face: a smaller overlap is no interface
constexpr double least_facing = 0.1;     // of the smaller face: faces with a smaller overlap are not reported as unjoined
constexpr double most_beyond = 0.25;     // of the smaller edge: a wider gap is intended
constexpr double least_overlap = 1e-6;   // of the smaller edge: a smaller depth is round-off

// A part with the data that the search needs.
struct Part {
  int block, part;
  const Polyhedron* shape;
  Box box;
  double edge;  // m, smallest
  std::vector<Plane> planes;
};

std::vector<Part> parts_of(std::span<const InterfaceBlock> blocks) {
  std::vector<Part> parts;
  for (size_t b = 0; b < blocks.size(); ++b) {
    for (size_t p = 0; p < blocks[b].parts.size(); ++p) {
      const Polyhedron& shape = blocks[b].parts[p];
      parts.push_back({static_cast<int>(b), static_cast<int>(p), &shape, bounding_box(shape), smallest_edge(shape), planes(shape)});
    }
  }
  return parts;
}

// Calls visit(i, j) for parts whose boxes are closer than `margin`, until it returns false. The sweep runs along the axis of largest
// spread, so that one huge slab costs one pass and not a full grid.
template <class Visit>
void near_pairs(const std::vector<Part>& parts, double margin, Visit&& visit) {
  Vec3 mean = Vec3::Zero(), spread = Vec3::Zero();
  for (const Part& p : parts) mean += (p.box.low + p.box.high) / 2 / static_cast<double>(parts.size());
  for (const Part& p : parts) spread += ((p.box.low + p.box.high) / 2 - mean).cwiseAbs2();
  int axis = 0;
  spread.maxCoeff(&axis);
  std::vector<int> order(parts.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int i, int j) { return std::make_pair(parts[z(i)].box.low[axis], i) < std::make_pair(parts[z(j)].box.low[axis], j); });
  std::vector<int> open;  // parts that still extend to the sweep plane
  for (int i : order) {
    const Box& p = parts[z(i)].box;
    size_t kept = 0;
    for (int j : open) {
      const Box& q = parts[z(j)].box;
      if (q.high[axis] + margin < p.low[axis]) continue;
      open[kept++] = j;
      if (((q.low.array() - margin) <= p.high.array()).all() && ((p.low.array() - margin) <= q.high.array()).all() && !visit(i, j)) return;
    }
    open.resize(kept);
    open.push_back(i);
  }
}

bool group_matches(const std::string& wanted, std::string_view group) { return wanted.empty() || wanted == group; }

// Index of the last matching rule, -1 if there is none. Results are cached per pair of groups.
class RuleTable {
 public:
  explicit RuleTable(std::span<const JointRule> rules) : rules_(rules) {}
  int find(std::string_view a, std::string_view b) {
    auto [place, fresh] = known_.try_emplace({a, b}, -1);
    if (!fresh) return place->second;
    for (size_t r = 0; r < rules_.size(); ++r) {
      const JointRule& j = rules_[r];
      if ((group_matches(j.group_a, a) && group_matches(j.group_b, b)) || (group_matches(j.group_a, b) && group_matches(j.group_b, a))) {
        place->second = static_cast<int>(r);
      }
    }
    return place->second;
  }

 private:
  std::span<const JointRule> rules_;
  std::map<std::pair<std::string_view, std::string_view>, int> known_;
};

// Width (m) beyond the joints of a rule, up to which an unjoined gap is reported.
double forgotten(const JointRule& rule) { return rule.none ? 0 : std::max(2 * rule.thickness, 0.03); }

// Overlap of face fa of p and face fb of q, as a polygon midway between them. False if there is none, or less than `fraction` of a face.
bool overlap_polygon(const Part& p, int fa, const Part& q, int fb, double fraction, Interface& out) {
  const Plane& pa = p.planes[z(fa)];
  const Plane& pb = q.planes[z(fb)];
  const Vec3 n = (pa.n - pb.n).normalized();
  const Vec3 t = n.unitOrthogonal(), s = n.cross(t);
  const Vec3 origin = p.shape->vertices[z(p.shape->faces[z(fa)][0])];
  auto project = [&](const Polyhedron& shape, int face, bool reversed) {
    Polygon2 flat;
    for (int v : shape.faces[z(face)]) {
      const Vec3 r = shape.vertices[z(v)] - origin;
      flat.emplace_back(t.dot(r), s.dot(r));
    }
    if (reversed) std::reverse(flat.begin(), flat.end());
    return flat;
  };
  const Polygon2 flat_a = project(*p.shape, fa, false), flat_b = project(*q.shape, fb, true);
  const double smaller = std::min(moments(flat_a).area, moments(flat_b).area);
  const Polygon2 common = simplified(clip_convex(flat_a, flat_b), 1e-9 * std::sqrt(smaller));
  if (common.size() < 3) return false;
  const PolygonMoments m = moments(common);
  if (m.area < fraction * smaller) return false;
  // Height of a plane above a point of the flat polygon, along n.
  auto height = [&](const Plane& plane, const Vec2& x) {
    const Vec3 r = origin + x.x() * t + x.y() * s;
    return (plane.d - plane.n.dot(r)) / plane.n.dot(n);
  };
  out.gap = height(pb, m.centroid) - height(pa, m.centroid);
  out.area = m.area;
  out.normal = n;
  out.polygon.clear();
  for (const Vec2& x : common) out.polygon.push_back(origin + x.x() * t + x.y() * s + (height(pa, x) + height(pb, x)) / 2 * n);
  return true;
}

// Widest gap between two blocks that the rule joins (m).
double widest_gap(const InterfaceBlock& a, const InterfaceBlock& b, const JointRule& rule) {
  const double most = rule.thickness + rule.tolerance;
  if (std::max(a.joint, b.joint) > most) return most;
  return std::max(most, std::min(a.widest_joint, b.widest_joint) + rule.tolerance);
}

// Adds all interfaces of two parts with gaps up to `most`, and the facing pairs that are slightly too far apart.
void find_faces(const Part& p, const Part& q, const JointRule& rule, int rule_index, double overlap, double most, Interfaces& result) {
  const double cosine = -std::cos(facing);
  const double least = -std::max(rule.tolerance, overlap * std::min(p.edge, q.edge));
  const double far = most + std::min(forgotten(rule), most_beyond * std::min(p.edge, q.edge));
  const double slack = facing * std::max((p.box.high - p.box.low).norm(), (q.box.high - q.box.low).norm());
  for (size_t fa = 0; fa < p.planes.size(); ++fa) {
    const Vec3 on_a = p.shape->vertices[z(p.shape->faces[fa][0])];
    for (size_t fb = 0; fb < q.planes.size(); ++fb) {
      if (p.planes[fa].n.dot(q.planes[fb].n) > cosine) continue;
      const Vec3 on_b = q.shape->vertices[z(q.shape->faces[fb][0])];
      const double distance = p.planes[fa].n.dot(on_b - on_a);
      if (distance < least - slack || distance > far + slack) continue;
      Interface found{p.block, q.block, p.part, q.part, static_cast<int>(fa), static_cast<int>(fb), {}, Vec3::Zero(), 0, 0, rule_index};
      if (!overlap_polygon(p, found.face_a, q, found.face_b, least_fraction, found) || found.gap < least || found.gap > far) continue;
      if (found.gap <= most) result.all.push_back(std::move(found));
      else if (overlap_polygon(p, found.face_a, q, found.face_b, least_facing, found))
        result.unjoined.push_back({p.block, q.block, found.gap, rule_index});
    }
  }
}

bool boxes_overlap(const Box& a, const Box& b, double depth) {
  return ((a.high - b.low).array() > depth).all() && ((b.high - a.low).array() > depth).all();
}

// Reduces `unjoined` to pairs without any joint, each with its smallest gap. `all` must be sorted.
void keep_pairs_without_joint(Interfaces& found) {
  std::sort(found.unjoined.begin(), found.unjoined.end(),
            [](const Unjoined& x, const Unjoined& y) { return std::tie(x.a, x.b, x.gap) < std::tie(y.a, y.b, y.gap); });
  const auto again = [](const Unjoined& x, const Unjoined& y) { return x.a == y.a && x.b == y.b; };
  found.unjoined.erase(std::unique(found.unjoined.begin(), found.unjoined.end(), again), found.unjoined.end());
  std::erase_if(found.unjoined, [&](const Unjoined& x) {
    const auto first = std::lower_bound(found.all.begin(), found.all.end(), x, [](const Interface& y, const Unjoined& wanted) {
      return std::tie(y.a, y.b) < std::tie(wanted.a, wanted.b);
    });
    return first != found.all.end() && first->a == x.a && first->b == x.b;
  });
}

}  // namespace

Interfaces find_interfaces(std::span<const InterfaceBlock> blocks, std::span<const JointRule> rules, double overlap,
                           std::size_t most_deep) {
  const std::vector<Part> parts = parts_of(blocks);
  RuleTable table(rules);
  double joined = 0, beyond = 0;
  for (const JointRule& r : rules) {
    if (r.none) continue;
    joined = std::max(joined, r.thickness + r.tolerance);
    beyond = std::max(beyond, forgotten(r));
    for (const InterfaceBlock& b : blocks) joined = std::max(joined, b.widest_joint + r.tolerance);
  }
  Interfaces result;
  if (parts.empty()) return result;
  std::map<std::pair<int, int>, Overlap> deepest;
  std::size_t deep = 0;
  near_pairs(parts, joined + beyond, [&](int i, int j) {
    const bool in_order = std::make_pair(parts[z(i)].block, parts[z(i)].part) < std::make_pair(parts[z(j)].block, parts[z(j)].part);
    const Part& p = parts[z(in_order ? i : j)];
    const Part& q = parts[z(in_order ? j : i)];
    const InterfaceBlock& a = blocks[z(p.block)];
    const InterfaceBlock& b = blocks[z(q.block)];
    if (p.block == q.block || (a.fixed && b.fixed)) return true;
    const double edge = std::min(p.edge, q.edge);
    if (boxes_overlap(p.box, q.box, least_overlap * edge)) {
      const double depth = -separation(*p.shape, *q.shape, -least_overlap * edge).gap;
      if (depth > least_overlap * edge) {
        Overlap& o = deepest.try_emplace({p.block, q.block}, Overlap{p.block, q.block, 0, 0}).first->second;
        if (o.relative <= most_overlap && depth / edge > most_overlap && ++deep > most_deep) result.cut = true;
        if (depth / edge > o.relative) o = {p.block, q.block, depth, depth / edge};
        if (result.cut) return false;
      }
    }
    if (!boxes_overlap(p.box, q.box, -joined - std::min(beyond, most_beyond * edge))) return true;
    const int rule = table.find(a.group, b.group);
    if (rule >= 0 && !rules[z(rule)].none) find_faces(p, q, rules[z(rule)], rule, overlap, widest_gap(a, b, rules[z(rule)]), result);
    return true;
  });
  std::sort(result.all.begin(), result.all.end(), [](const Interface& x, const Interface& y) {
    return std::tie(x.a, x.b, x.part_a, x.part_b, x.face_a, x.face_b) < std::tie(y.a, y.b, y.part_a, y.part_b, y.face_a, y.face_b);
  });
  keep_pairs_without_joint(result);
  for (const auto& [key, o] : deepest) result.overlaps.push_back(o);
  return result;
}

}  // namespace erbs
