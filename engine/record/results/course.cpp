#include "engine/record/results/course.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "engine/base/count.h"
#include "engine/base/error.h"
#include "engine/base/units.h"

namespace erbs {
namespace {

constexpr double first_share = 0.1;  // of the mass of a group

std::vector<GroupFall> falls(const Collapse& collapse, const Model& model, const std::vector<std::string>& group) {
  struct Mass {
    double all = 0, fallen = 0;
    std::vector<std::pair<double, double>> falls;  // s, kg
  };
  std::map<std::string, Mass> of_group;
  for (int b = 0; b < model.nblock; ++b) {
    if (model.kind[z(b)] != Kind::moving) continue;
    Mass& mass = of_group[group[z(b)]];
    mass.all += model.mass[z(b)];
    if (!collapse.fallen[z(b)]) continue;
    mass.fallen += model.mass[z(b)];
    mass.falls.emplace_back(collapse.fall_time[z(b)], model.mass[z(b)]);
  }
  std::vector<GroupFall> out;
  for (auto& [name, mass] : of_group) {
    if (name.empty() || mass.fallen < first_share * mass.all) continue;
    std::ranges::sort(mass.falls);
    double sum = 0;
    for (const auto& [time, kg] : mass.falls)
      if ((sum += kg) >= first_share * mass.all) {
        out.push_back({name, time, mass.fallen / mass.all});
        break;
      }
  }
  std::ranges::stable_sort(out, {}, &GroupFall::time);
  return out;
}

std::optional<std::array<double, 2>> height_of(const Mechanism& mechanism, const Model& model) {
  if (mechanism.moved.empty()) return std::nullopt;
  double base = std::numeric_limits<double>::infinity();
  for (const Joint& joint : model.joint) base = std::min(base, model.rest[z(joint.a)].z() + joint.arm_a.z());
  std::vector<double> height;
  for (const MovedJoint& moved : mechanism.moved) height.push_back(moved.at[2] - base);
  std::ranges::sort(height);
  const auto at = [&](double share) { return height[std::size_t(share * double(height.size() - 1))]; };
  return std::array<double, 2>{at(0.1), at(0.9)};
}

// "+x", "-y", or "35 deg from x"; of a vector within 15 degrees of an axis, the axis.
std::string side(const std::array<double, 2>& d) {
  if (std::fabs(d[1]) < 0.26) return d[0] > 0 ? "+x" : "-x";
  if (std::fabs(d[0]) < 0.26) return d[1] > 0 ? "+y" : "-y";
  return fmt::format("{:.0f} deg from x to y", std::atan2(d[1], d[0]) * 180 / pi);
}

// "at its base", "0.3 m above its base", or a range of heights.
std::string where(const std::array<double, 2>& height) {
  const std::string low = fmt::format("{:.2g}", height[0]), high = fmt::format("{:.2g}", height[1]);
  if (low != high) return fmt::format("between {} and {} m above its base", low, high);
  return std::fabs(height[0]) < 1e-3 ? "at its base" : low + " m above its base";
}

}  // namespace

Course course_of(const Collapse& collapse, const Model& model, const std::vector<std::string>& group,
                 const std::optional<std::array<double, 2>>& direction, int names) {
  Course out;
  if (!collapse.collapsed) return out;
  out.groups = falls(collapse, model, group);
  out.height = height_of(collapse.mechanism, model);
  if (out.height) out.text = "gives way " + where(*out.height);
  for (int i = 0; i < std::min(names, int(out.groups.size())); ++i) {
    const GroupFall& one = out.groups[z(i)];
    out.text += fmt::format("{}{} ({:.2f} s)",
                            i > 0              ? ", "
                            : out.text.empty() ? "falls in the order "
                                               : "; falls in the order ",
                            one.group, one.time);
  }
  if (int(out.groups.size()) > names) out.text += fmt::format(" and {} more", int(out.groups.size()) - names);
  if (direction) out.text += (out.text.empty() ? "falls towards " : "; towards ") + side(*direction);
  return out;
}

}  // namespace erbs
