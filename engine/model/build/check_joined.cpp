#include "engine/model/build/check_joined.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "engine/base/count.h"
#include "engine/base/text.h"
#include "engine/geometry/separation.h"

namespace erbs {
namespace {

// Bounding box of a block in the given axes; the third axis points upward.
Box upright_box(const Block& block, const Mat3& axes) {
  Box box{Vec3::Constant(std::numeric_limits<double>::infinity()), Vec3::Constant(-std::numeric_limits<double>::infinity())};
  for (const Polyhedron& part : block.parts)
    for (const Vec3& v : part.vertices) {
      const Vec3 x = axes.transpose() * v;
      box.low = box.low.cwiseMin(x), box.high = box.high.cwiseMax(x);
    }
  return box;
}

// m, along the normal of the faces between them, which on a slope is not the vertical. `enough`: a larger gap is of no interest.
double gap_between(const Block& one, const Block& other, double enough) {
  double least = std::numeric_limits<double>::infinity();
  for (const Polyhedron& p : one.parts)
    for (const Polyhedron& q : other.parts) least = std::min(least, separation(p, q, enough).gap);
  return least;
}

// ": 'b1' lies 3 mm above 'ground'": the smallest gap of an island to a block below; "" if there is none. `root`: island of each block.
std::string nearest_below(const Scene& scene, const std::vector<int>& root, int island) {
  constexpr double touching = 1e-7;  // m
  if (!(scene.gravity.norm() > 0)) return "";
  const Vec3 up = -scene.gravity.normalized(), across = up.unitOrthogonal();
  Mat3 axes;
  axes << across, up.cross(across), up;
  std::vector<Box> box;
  for (const Block& block : scene.blocks) box.push_back(upright_box(block, axes));
  std::vector<int> own;
  for (int b = 0; b < int(root.size()); ++b)
    if (root[z(b)] == island) own.push_back(b);
  const std::size_t lowest = std::min<std::size_t>(own.size(), 100);
  std::partial_sort(own.begin(), own.begin() + std::ptrdiff_t(lowest), own.end(),
                    [&](int b, int c) { return std::make_pair(box[z(b)].low.z(), b) < std::make_pair(box[z(c)].low.z(), c); });
  own.resize(lowest);
  double least = std::numeric_limits<double>::infinity();
  std::string text;
  for (const int b : own)
    for (int c = 0; c < int(root.size()); ++c) {
      const Box &p = box[z(b)], &q = box[z(c)];
      const bool over = p.low.x() < q.high.x() && q.low.x() < p.high.x() && p.low.y() < q.high.y() && q.low.y() < p.high.y();
      if (root[z(c)] == island || !over || q.low.z() > p.low.z() || p.low.z() - q.high.z() >= least) continue;
      const double gap = gap_between(scene.blocks[z(c)], scene.blocks[z(b)], least);
      if (gap >= least) continue;
      least = gap;
      const std::string how = gap > touching ? fmt::format("lies {:.4g} mm above", 1e3 * gap) : "touches";
      text = fmt::format(": '{}' {} '{}'", scene.blocks[z(b)].name, how, scene.blocks[z(c)].name);
    }
  return text;
}

// Blocks without a joint that neither start in motion nor have free = true. Blocks of one script line are one mistake.
void check_loose(const Scene& scene, const Interfaces& found, const std::vector<Kind>& kind, std::vector<std::string>& errors) {
  const int nblock = int(scene.blocks.size());
  std::vector<int> degree(z(nblock), 0);
  for (const Interface& face : found.all) ++degree[z(face.a)], ++degree[z(face.b)];
  std::map<std::pair<int, std::string>, std::pair<const Block*, int>> by_line;
  for (int b = 0; b < nblock; ++b) {
    const Block& block = scene.blocks[z(b)];
    if (degree[z(b)] > 0 || kind[z(b)] != Kind::moving || block.free || block.initial().given) continue;
    auto& [first, others] = by_line[{block.place.line, block.place.file}];
    if (first) ++others;
    else first = &block;
  }
  std::vector<int> alone(z(nblock));
  std::iota(alone.begin(), alone.end(), 0);
  for (const auto& [line, group] : by_line) {
    const auto& [block, others] = group;
    const std::string who = others > 0 ? fmt::format("block '{}' and {} more of this line have", block->name, others)
                                       : fmt::format("block '{}' has", block->name);
    errors.push_back(
        fmt::format("{}: {} no joint with any other{}; let a face meet a neighbour within a joint's thickness and tolerance, "
                    "give a joint{{}} rule for its group, or say free = true",
                    block->place.text(), who, nearest_below(scene, alone, int(block - scene.blocks.data()))));
  }
}

bool has_group(const Scene& scene, const std::string& group) {
  return group.empty() || std::any_of(scene.blocks.begin(), scene.blocks.end(), [&](const Block& b) { return b.group == group; });
}

// A rule without any joint is legal (a later rule may win), but often a mistake in its groups or its thickness. Groups without blocks have
// been reported before.
void check_rules(const Scene& scene, const Interfaces& found, std::vector<std::string>& warnings) {
  std::vector<int> faces(scene.joint_rules.size(), 0);
  for (const Interface& face : found.all) ++faces[z(face.rule)];
  for (size_t r = 0; r < faces.size(); ++r) {
    const JointRule& rule = scene.joint_rules[r];
    if (faces[r] > 0 || rule.none || !has_group(scene, rule.group_a) || !has_group(scene, rule.group_b)) continue;
    const auto named = [](const std::string& group) { return group.empty() ? "any block" : "\"" + group + "\""; };
    warnings.push_back(
        fmt::format("{}: this joint rule joins nothing: between {} and {} no faces lie at most {:g} mm apart, or later "
                    "rules take them; look at between, thickness and tolerance",
                    rule.place.text(), named(rule.group_a), named(rule.group_b), 1e3 * (rule.thickness + rule.tolerance)));
  }
}

// "no gap", "a gap of 3 mm", "gaps of 2 to 3 mm".
std::string gaps_of(std::size_t count, double least, double most) {
  constexpr double none = 1e-9;  // m; below it a gap is round-off of coordinates
  if (most < none) return "no gap";
  const std::string low = fmt::format("{:.4g}", least < none ? 0 : 1e3 * least), high = fmt::format("{:.4g}", 1e3 * most);
  return low == high ? fmt::format("{} of {} mm", count > 1 ? "gaps" : "a gap", low) : fmt::format("gaps of {} to {} mm", low, high);
}

// Joints of one rule whose gaps differ from its thickness.
struct OffWidth {
  const Interface* first = nullptr;
  int count = 0;
  double least = std::numeric_limits<double>::infinity(), most = 0;  // m

  void take(const Interface& face) {
    if (!first) first = &face;
    ++count;
    least = std::min(least, std::max(0.0, face.gap)), most = std::max(most, face.gap);
  }
};

// Joints whose gap is narrower than their rule states, or wider because the masonry widened it. Touching faces under a law with a thickness
// are a model of zero-thickness joints and cause no warning, unless the rule itself states the gap.
void check_gaps(const Scene& scene, const Interfaces& found, std::vector<std::string>& warnings) {
  std::vector<OffWidth> narrow(scene.joint_rules.size()), wide(narrow);
  for (const Interface& face : found.all) {
    const JointRule& rule = scene.joint_rules[z(face.rule)];
    const bool touching = face.gap <= rule.tolerance, is_narrow = face.gap < rule.thickness - (1 + 1e-9) * rule.tolerance;
    if (face.gap > rule.thickness + rule.tolerance) wide[z(face.rule)].take(face);
    else if (is_narrow && face.gap >= -rule.tolerance && (!touching || rule.has_thickness)) narrow[z(face.rule)].take(face);
  }
  for (std::size_t r = 0; r < narrow.size(); ++r) {
    const JointRule& rule = scene.joint_rules[r];
    const auto tell = [&](const OffWidth& n, const std::string& why) {
      if (n.count == 0) return;
      warnings.push_back(
          fmt::format("{}: {} of this rule bridge{} {}, {} (first between '{}' and '{}'); the law is that of the rule all the same",
                      rule.place.text(), counted(n.count, "joint"), n.count > 1 ? "" : "s", gaps_of(z(n.count), n.least, n.most), why,
                      scene.blocks[z(n.first->a)].name, scene.blocks[z(n.first->b)].name));
    };
    tell(narrow[r], fmt::format("not the {:g} mm it says", 1e3 * rule.thickness));
    tell(wide[r], fmt::format("which its masonry made wider than the {:g} mm it says", 1e3 * rule.thickness));
  }
}

// Faces that face each other slightly too far apart for a joint.
void check_unjoined(const Scene& scene, const Interfaces& found, std::vector<std::string>& warnings) {
  std::map<int, std::vector<const Unjoined*>> by_rule;
  for (const Unjoined& pair : found.unjoined) by_rule[pair.rule].push_back(&pair);
  for (const auto& [r, pairs] : by_rule) {
    const auto [least, most] = std::minmax_element(pairs.begin(), pairs.end(), [](auto x, auto y) { return x->gap < y->gap; });
    const JointRule& rule = scene.joint_rules[z(r)];
    const Unjoined& first = *pairs.front();
    warnings.push_back(
        fmt::format("{}: {} pair{} of blocks face each other across {} and are not joined (first '{}' and "
                    "'{}'): this rule joins up to {:g} mm; widen its thickness or tolerance if they should be",
                    rule.place.text(), pairs.size(), pairs.size() > 1 ? "s" : "", gaps_of(pairs.size(), (*least)->gap, (*most)->gap),
                    scene.blocks[z(first.a)].name, scene.blocks[z(first.b)].name, 1e3 * (rule.thickness + rule.tolerance)));
  }
}

// Groups of joined blocks without any path of joints to a fixed or driven block, in which no block starts in motion or has free = true.
void check_floating(const Scene& scene, const Interfaces& found, const std::vector<Kind>& kind, std::vector<std::string>& errors) {
  if (!(scene.gravity.norm() > 0)) return;
  const int nblock = int(scene.blocks.size());
  std::vector<int> root(z(nblock)), size(z(nblock), 0);
  std::iota(root.begin(), root.end(), 0);
  const auto top = [&](int b) {
    while (root[z(b)] != b) b = root[z(b)] = root[z(root[z(b)])];
    return b;
  };
  std::vector<std::uint8_t> held(z(nblock), 0);
  for (const Interface& face : found.all) {
    const bool a = kind[z(face.a)] == Kind::moving, b = kind[z(face.b)] == Kind::moving;
    if (!a && b) held[z(face.b)] = 1;
    if (a && !b) held[z(face.a)] = 1;
    if (!a || !b) continue;
    const int ra = top(face.a), rb = top(face.b);
    root[z(std::max(ra, rb))] = std::min(ra, rb);
  }
  for (int b = 0; b < nblock; ++b) {
    root[z(b)] = top(b);
    ++size[z(root[z(b)])];
    const Block& block = scene.blocks[z(b)];
    if (held[z(b)] || kind[z(b)] != Kind::moving || block.free || block.initial().given) held[z(root[z(b)])] = 1;
  }
  std::vector<int> floating;
  for (int b = 0; b < nblock; ++b)
    if (root[z(b)] == b && size[z(b)] > 1 && !held[z(b)]) floating.push_back(b);
  if (floating.empty()) return;
  const int first = floating.front(), others = int(floating.size()) - 1;
  const Block& block = scene.blocks[z(first)];
  errors.push_back(fmt::format(
      "{}: the {} blocks joined to '{}' have no way to the ground, no joint leads to a fixed block{}{}; bring them within a joint's "
      "thickness and tolerance, or say free = true where they are to fall",
      block.place.text(), size[z(first)], block.name, nearest_below(scene, root, first),
      others > 0 ? fmt::format(" ({})", counted(others, "more such group")) : ""));
}

}  // namespace

void check_joined(const Scene& scene, const Interfaces& found, const std::vector<Kind>& kind, std::vector<std::string>& errors,
                  std::vector<std::string>& warnings) {
  check_loose(scene, found, kind, errors);
  check_floating(scene, found, kind, errors);
  check_rules(scene, found, warnings);
  check_gaps(scene, found, warnings);
  check_unjoined(scene, found, warnings);
}

}  // namespace erbs
