#include "engine/model/build/check_overlaps.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "engine/base/count.h"

namespace erbs {
namespace {

constexpr double most_slant = 5e-3;  // of the smaller edge: blocks laid a little askew in their joints

// Overlaps of blocks made by the same two script lines are one mistake. The message names the deepest and counts the others.
struct Overlapping {
  const Overlap* deepest = nullptr;
  int others = 0;
};

std::string overlap_text(const Block& a, const Block& b, const Overlap& o) {
  return fmt::format("blocks '{}' ({}) and '{}' ({}) overlap by {:.3g} mm, {:.2g} of their smaller edge", a.name, a.place.text(), b.name,
                     b.place.text(), 1e3 * o.depth, o.relative);
}

}  // namespace

std::size_t most_overlaps(const Scene& scene) { return scene.analysis.overlap == "stress_free" ? 1000000 : 1000; }

std::vector<InterfaceBlock> interface_blocks(const Scene& scene) {
  std::vector<InterfaceBlock> blocks;
  for (const Block& b : scene.blocks) blocks.push_back({b.parts, b.group, b.fixed, b.joint, b.widest_joint});
  return blocks;
}

void check_overlaps(const Scene& scene, const std::vector<Overlap>& overlaps, bool cut, std::vector<std::string>& errors,
                    std::vector<std::string>& warnings, std::vector<std::string>& notes) {
  std::map<std::tuple<int, std::string, int, std::string, bool>, Overlapping> by_lines;
  for (const Overlap& o : overlaps) {
    const Block &a = scene.blocks[z(o.a)], &b = scene.blocks[z(o.b)];
    if (a.fixed && b.fixed) continue;
    const bool wrong = o.relative > most_overlap && scene.analysis.overlap != "stress_free";
    Overlapping& group = by_lines[{b.place.line, b.place.file, a.place.line, a.place.file, wrong}];
    if (group.deepest) ++group.others;
    if (!group.deepest || o.relative > group.deepest->relative) group.deepest = &o;
  }
  std::vector<std::string> borne;  // overlaps that are accepted
  int pairs = 0;
  std::string worst;
  double deepest = 0;  // relative to the smaller edge
  for (const auto& [key, group] : by_lines) {
    const Overlap& o = *group.deepest;
    const Block &a = scene.blocks[z(o.a)], &b = scene.blocks[z(o.b)];
    const std::string more =
        group.others > 0 ? fmt::format(" ({}{} more pair(s) of these lines do so, too)", cut ? "at least " : "", group.others) : "";
    const std::string pair = overlap_text(a, b, o);
    const std::string what = pair + more;
    if (std::get<bool>(key))
      errors.push_back(fmt::format("{}: {}; at most {:g} is allowed: part them, or say analysis{{ overlap = \"stress_free\" }}",
                                   b.place.text(), what, most_overlap));
    if (std::get<bool>(key)) continue;
    pairs += 1 + group.others;
    if (o.relative > deepest) deepest = o.relative, worst = pair;
    borne.push_back(what);
  }
  if (borne.empty()) return;
  const std::string taken = "; taken as free of force at rest";
  if (borne.size() == 1) return warnings.push_back(borne.front() + taken);
  warnings.push_back(fmt::format("{} pairs of blocks overlap{}; the deepest: {}; log.txt of a run lists all", pairs, taken, worst));
  notes.insert(notes.end(), borne.begin(), borne.end());
}

std::vector<std::string> overlap_mistakes(const Scene& scene) {
  for (const Block& block : scene.blocks)
    for (const Polyhedron& part : block.parts)
      if (!problem_of(part).empty()) return {};
  std::vector<std::string> errors, warnings, notes;
  const Interfaces found = find_interfaces(interface_blocks(scene), {}, 0.05, most_overlaps(scene));
  check_overlaps(scene, found.overlaps, found.cut, errors, warnings, notes);
  return errors;
}

void warn_of_pressed_starts(const Scene& scene, const Model& m, const State& s, std::vector<std::string>& warnings) {
  std::vector<Parts> placed(scene.blocks.size());
  std::vector<InterfaceBlock> blocks = interface_blocks(scene);
  bool any = false;
  for (int b = 0; b < m.nblock; ++b) {
    const Initial& initial = scene.blocks[z(b)].initial();
    if (initial.position.isZero(0) && initial.rotation.isZero(0)) continue;
    const Quat& q = s.pose.q[z(b)];
    const Vec3 by = m.rest[z(b)] + Vec3(s.pose.u[z(b)]) - q * m.rest[z(b)];
    for (const Polyhedron& part : scene.blocks[z(b)].parts) placed[z(b)].push_back(transformed(part, q, by));
    blocks[z(b)].parts = placed[z(b)];
    any = true;
  }
  if (!any) return;
  const Interfaces found = find_interfaces(blocks, {}, 0.05, most_overlaps(scene));
  const auto joined = [&m](const Overlap& o) {
    return std::ranges::any_of(m.joint, [&o](const Joint& joint) { return joint.a == o.a && joint.b == o.b; });
  };
  const Overlap* deepest = nullptr;
  int others = -1;
  for (const Overlap& o : found.overlaps) {
    if (o.relative <= most_overlap || (o.relative <= most_slant && joined(o)) || (placed[z(o.a)].empty() && placed[z(o.b)].empty()))
      continue;
    if (!deepest || o.relative > deepest->relative) deepest = &o;
    ++others;
  }
  if (!deepest) return;
  const Block &a = scene.blocks[z(deepest->a)], &b = scene.blocks[z(deepest->b)];
  warnings.push_back(
      fmt::format("{}: {}{} where `initial` puts them, and press each other apart from the first step on; turn a block about "
                  "an edge that stays (initial.about), or raise it",
                  (placed[z(deepest->b)].empty() ? a : b).place.text(), overlap_text(a, b, *deepest),
                  others > 0 ? fmt::format(" ({} more pair(s) do so, too)", others) : ""));
}

}  // namespace erbs
