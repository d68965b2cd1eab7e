#include "render/run/excerpt.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "engine/base/error.h"
#include "engine/base/spelling.h"
#include "engine/base/text.h"

namespace erbs::render {

Section read_section(const std::string& text) {
  Section section;
  const bool long_enough = text.size() >= 3;
  const std::string_view number = long_enough ? std::string_view(text).substr(2) : std::string_view();
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), section.at);
  const std::size_t sign = long_enough ? std::string("<=>").find(text[1]) : std::string::npos;
  const bool good = long_enough && text[0] >= 'x' && text[0] <= 'z' && sign != std::string::npos && error == std::errc() &&
                    end == number.data() + number.size() && std::isfinite(section.at);
  if (!good) throw Error("--section " + shown(text, 60) + " is no plane; try x=1.2, or z<2 for what lies below 2 m");
  section.axis = text[0] - 'x';
  section.keep = static_cast<double>(sign) - 1;
  return section;
}

std::vector<bool> in_groups(const MotionScene& scene, const std::vector<std::string>& groups, const std::string& option) {
  std::set<std::string> known;
  for (const MotionBlock& block : scene.blocks)
    if (!block.group.empty()) known.insert(block.group);
  for (const std::string& group : groups) {
    if (known.contains(group)) continue;
    const std::vector<std::string> names(known.begin(), known.end());
    if (names.empty())
      throw Error(option + " " + shown(group, 60) + ": the blocks of this run are in no group; give them one in the scene");
    const std::string near = nearest(group, names);
    throw Error(option + " " + shown(group, 60) + " is no group of this run" +
                (near.empty() ? "; its" : "; did you mean \"" + near + "\"? Its") +
                fmt::format(" groups: {}", shown(fmt::format("{}", fmt::join(names, ", ")), 400)));
  }
  std::vector<bool> inside;
  for (const MotionBlock& block : scene.blocks) inside.push_back(std::find(groups.begin(), groups.end(), block.group) != groups.end());
  return inside;
}

Excerpt without_groups(const MotionScene& scene, const std::vector<std::string>& groups) {
  const std::vector<bool> hidden = in_groups(scene, groups, "--hide");
  Excerpt excerpt{{scene.shapes, {}, {}}, {}, {}, groups.empty()};
  std::vector<int> place(scene.blocks.size(), -1);
  bool loose = false;
  for (std::size_t b = 0; b < scene.blocks.size(); ++b) {
    if (hidden[b]) continue;
    place[b] = static_cast<int>(excerpt.blocks.size());
    excerpt.blocks.push_back(b);
    excerpt.scene.blocks.push_back(scene.blocks[b]);
    loose = loose || !scene.blocks[b].fixed;
  }
  if (!groups.empty() && !loose)
    throw Error(
        fmt::format("--hide {} leaves no block that can move; name fewer groups", shown(fmt::format("{}", fmt::join(groups, ",")), 200)));
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    const int a = place[static_cast<std::size_t>(scene.joints[j].a)], b = place[static_cast<std::size_t>(scene.joints[j].b)];
    if (a < 0 || b < 0) continue;
    excerpt.joints.push_back(j);
    excerpt.scene.joints.push_back(scene.joints[j]);
    excerpt.scene.joints.back().a = a, excerpt.scene.joints.back().b = b;
  }
  return excerpt;
}

MotionFrame excerpt_of(const Excerpt& excerpt, MotionFrame frame) {
  if (excerpt.whole) return frame;
  MotionFrame part;
  part.t = frame.t;
  for (const std::size_t b : excerpt.blocks) {
    part.poses.insert(part.poses.end(), frame.poses.begin() + static_cast<std::ptrdiff_t>(7 * b),
                      frame.poses.begin() + static_cast<std::ptrdiff_t>(7 * b + 7));
    if (!frame.derived.empty()) part.derived.push_back(frame.derived[b]);
  }
  for (const std::size_t j : excerpt.joints) {
    part.damage.push_back(frame.damage[j]), part.opening.push_back(frame.opening[j]);
    if (frame.force.empty()) continue;
    const auto at = static_cast<std::ptrdiff_t>(3 * j);
    part.force.insert(part.force.end(), frame.force.begin() + at, frame.force.begin() + at + 3);
    part.force_at.insert(part.force_at.end(), frame.force_at.begin() + at, frame.force_at.begin() + at + 3);
  }
  return part;
}

}  // namespace erbs::render
