#include "engine/scene/push.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "engine/base/spelling.h"
#include "engine/base/units.h"
#include "engine/scene/scene.h"

namespace erbs {
namespace {

constexpr double most_tilt = 89.001 * pi / 180;  // rad

struct PushCheck {
  const Scene& scene;
  const PushSettings& push;
  std::vector<std::string> mistakes;

  template <class... A>
  void say(fmt::format_string<A...> text, A&&... values) {
    mistakes.push_back(push.place.text() + ": analysis: " + fmt::format(text, std::forward<A>(values)...));
  }
  const Block* block(const std::string& name, const char* who) {
    std::vector<std::string> names;
    for (const Block& one : scene.blocks) {
      if (one.name == name) return &one;
      names.push_back(one.name);
    }
    say("{}: there is no block \"{}\"{}", who, name, did_you_mean(name, names));
    return nullptr;
  }
};

void check_pattern(PushCheck& c) {
  for (const PatternForce& one : c.push.pattern) {
    if (one.block.empty() == one.group.empty()) c.say("pattern: each force names one block, or one group");
    else if (!one.block.empty()) {
      if (const Block* block = c.block(one.block, "pattern"); block && block->fixed)
        c.say("pattern: block \"{}\" is fixed and feels no force; name a free block", one.block);
    } else {
      std::vector<std::string> groups;
      bool there = false;
      for (const Block& block : c.scene.blocks) groups.push_back(block.group), there = there || (block.group == one.group && !block.fixed);
      if (!there) c.say("pattern: group \"{}\" has no free blocks{}", one.group, did_you_mean(one.group, groups));
    }
    if (!(one.force.norm() > 0 && std::isfinite(one.force.norm()))) c.say("pattern: a force has no length; give {{x, y, z}} in N");
  }
  // Forces at one place cancel; those of a couple do not.
  std::map<std::pair<std::string, std::string>, Vec3> sums;
  double most = 0;
  for (const PatternForce& one : c.push.pattern) {
    sums.try_emplace({one.block, one.group}, Vec3::Zero()).first->second += one.force;
    most = std::max(most, one.force.norm());
  }
  if (most > 0 && std::all_of(sums.begin(), sums.end(), [most](const auto& sum) { return sum.second.norm() < 1e-9 * most; }))
    c.say("pattern: its forces cancel each other on every block; leave one of them out");
}

// m, of a point from the box around a block; less than a hundredth of its size counts as on it.
double distance_from(const Block& block, const Vec3& point) {
  Vec3 low = Vec3::Constant(unbounded), high = -low;
  for (const Polyhedron& part : block.parts)
    for (const Vec3& v : part.vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
  const double away = (point - point.cwiseMax(low).cwiseMin(high)).norm();
  return away < 0.01 * (high - low).norm() ? 0 : away;
}

void check_monitor(PushCheck& c) {
  const Monitor& monitor = c.push.monitor;
  if (!monitor.block.empty()) {
    const Block* block = c.block(monitor.block, "monitor");
    if (block && block->fixed) c.say("monitor: block \"{}\" is fixed and never moves; name a free block", monitor.block);
    if (block && monitor.has_point && monitor.point.allFinite())
      if (const double away = distance_from(*block, monitor.point); away > 0)
        c.say(
            "monitor: the point {{ {:g}, {:g}, {:g} }} lies {:.3g} m outside block \"{}\"; give a point of it at rest, or leave point out",
            monitor.point.x(), monitor.point.y(), monitor.point.z(), away, monitor.block);
  } else if (monitor.has_point) {
    c.say("monitor: a point belongs to a block; add block = \"...\"");
  }
  if (!monitor.point.allFinite()) c.say("monitor: its point is not a finite place; give numbers");
}

void check_loads_of_push(PushCheck& c) {
  for (const Load& load : c.scene.loads) {
    const Pulse* pulse = std::get_if<Pulse>(&load.wave);  // of a number, without end
    const bool constant =
        (load.kind == Load::Kind::force || load.kind == Load::Kind::moment) && pulse && pulse->start <= 0 && std::isinf(pulse->duration);
    if (!constant)
      c.mistakes.push_back(load.place.text() + ": kind = \"" + c.push.kind +
                           "\" has no time: it takes constant forces and moments only; remove this load, or take kind = \"dynamic\"");
  }
}

void check_numbers(PushCheck& c) {
  const PushSettings& push = c.push;
  if (!(std::abs(push.direction.norm() - 1) < 1e-6)) c.say("direction has no length; give a vector");
  const double most = push.up_to > 0 ? push.up_to : push.tilts() ? 1.0 : 2.0;
  if (push.step > most) c.say("step = {:g} is beyond up_to = {:g}; take a smaller step", push.step, most);
  if (push.tilts() && push.up_to > most_tilt)
    c.say("up_to = {:g} rad is beyond 89 degrees, where the tangent that is the multiplier of a tilt ends; give 89*deg at most",
          push.up_to);
  for (const double one : push.path)
    if (!(std::abs(one) <= most)) c.say("path: {:g} is beyond up_to = {:g}; raise up_to, or leave it out", one, most);
  if (push.control == "displacement") {
    if (push.tilts()) c.say("control = \"displacement\" belongs to a pushover; leave it out, or take kind = \"pushover\"");
    if (!(push.displacement > 0))
      c.say("control = \"displacement\" needs the displacement at which the push ends; add displacement = 50*mm, say");
    if (push.displacement > 0 && push.displacement_step > push.displacement)
      c.say("displacement_step = {:g} m is beyond displacement = {:g} m; take a smaller step", push.displacement_step, push.displacement);
    if (!push.path.empty()) c.say("path is a list of multipliers, which control = \"displacement\" does not set; leave one of them out");
  } else if (push.displacement > 0 || push.displacement_step > 0) {
    c.say("displacement is for control = \"displacement\"; add it, or leave displacement out");
  }
}

void check_performance(PushCheck& c) {
  const PerformanceDemand& demand = c.scene.performance;
  if (!demand.given()) return;
  const auto say = [&](const std::string& text) { c.mistakes.push_back(demand.place.text() + ": spectrum: " + text); };
  if (c.push.kind != "pushover")
    say("a performance point lies on the curve of a pushover; take analysis{ kind = \"pushover\" }, or leave spectrum out");
  for (const std::string& mistake : check_spectrum(demand.spectrum)) say(mistake);
  if (!demand.group.empty() && !demand.blocks.empty()) say("give a group or the names of blocks, not both");
  if (!demand.blocks.empty()) {
    std::map<std::string, bool> moves;  // by name
    std::vector<std::string> names;
    for (const Block& block : c.scene.blocks) moves[block.name] = !block.fixed, names.push_back(block.name);
    bool any = false;
    for (const std::string& name : demand.blocks) {
      const auto found = moves.find(name);
      if (found == moves.end()) say(fmt::format("there is no block \"{}\"{}", name, did_you_mean(name, names)));
      else any = any || found->second;
    }
    if (!any) say("none of its blocks moves; name others, or leave blocks out");
  }
  if (demand.group.empty()) return;
  std::vector<std::string> groups;
  bool there = false;
  for (const Block& block : c.scene.blocks) groups.push_back(block.group), there = there || (block.group == demand.group && !block.fixed);
  if (!there) say(fmt::format("group \"{}\" has no free blocks{}", demand.group, did_you_mean(demand.group, groups)));
}

}  // namespace

std::vector<std::string> check_push(const Scene& scene) {
  const PushSettings& push = scene.push;
  PushCheck c{scene, push, {}};
  check_performance(c);
  if (!push.quasi_static()) return c.mistakes;
  check_numbers(c);
  check_pattern(c);
  check_monitor(c);
  check_loads_of_push(c);
  const Analysis& analysis = scene.analysis;
  if (analysis.duration > 0) c.say("kind = \"{}\" has no duration: it ends with the collapse; leave duration out", push.kind);
  if (analysis.solver == "sequential") c.say("kind = \"{}\" needs solver = \"leapfrog\"; leave solver out", push.kind);
  if (analysis.levels > 1) c.say("kind = \"{}\" has one time level; leave levels out", push.kind);
  if (push.tilts() && !push.pattern.empty())
    c.say("a tilt turns gravity and takes no pattern; leave pattern out, or take kind = \"pushover\"");
  const double g = scene.gravity.norm();
  if (push.tilts() && g == 0) c.say("a tilt turns gravity, and there is none; add gravity(g)");
  if (push.tilts() && g > 0 && scene.gravity.cross(push.direction).norm() < 1e-3 * g)
    c.say("direction is that of gravity, so that nothing tilts; give a horizontal one");
  return c.mistakes;
}

}  // namespace erbs
