#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <unordered_map>

#include "engine/base/spelling.h"
#include "engine/geometry/separation.h"
#include "engine/laws/laws.h"
#include "engine/scene/effects.h"
#include "engine/scene/load_size.h"
#include "engine/scene/scene.h"

namespace erbs {
namespace {

struct Report {
  std::vector<std::string> mistakes;
  template <class... A>
  void say(const Place& place, fmt::format_string<A...> text, A&&... values) {
    const std::string message = fmt::format(text, std::forward<A>(values)...);
    const std::string whole = place.file.empty() ? message : place.text() + ": " + message;
    if (std::find(mistakes.begin(), mistakes.end(), whole) == mistakes.end()) mistakes.push_back(whole);
  }
};

bool inside(double value, double low, double high) { return value >= low && value <= high; }  // false for NaN
bool inside(const Vec3& value, double low, double high) {
  return inside(value.x(), low, high) && inside(value.y(), low, high) && inside(value.z(), low, high);
}

// Checks each number of a field list against its range.
template <class T>
void check_fields(Report& report, const T& item, const std::string& label, const Place& place) {
  for (const Field<T>& field : T::fields())
    field.member.visit([&](auto member) {
      using Value = std::decay_t<decltype(item.*member)>;
      if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, int> || std::is_same_v<Value, Vec3>)
        if (!inside(item.*member, field.low, field.high))
          report.say(place, "{}: {} is out of range; allowed is {:g} to {:g} {}", label, field.name, field.low, field.high, field.unit);
    });
}

void check_materials(Report& report, const Scene& scene) {
  std::set<std::string> names;
  for (const Material& material : scene.materials) {
    check_fields(report, material, fmt::format("material \"{}\"", material.name), material.place);
    if (!names.insert(material.name).second)
      report.say(material.place, "material \"{}\" is there twice; give one of them another name", material.name);
  }
  std::map<std::pair<std::string, std::string>, double> said;
  for (const Material& material : scene.materials)
    for (const auto& [other, friction] : material.friction_with) {
      if (!names.contains(other))
        report.say(material.place, "material \"{}\": friction_with names \"{}\", and there is no such material{}", material.name, other,
                   did_you_mean(other, {names.begin(), names.end()}));
      if (!inside(friction, 0, 10))
        report.say(material.place, "material \"{}\": friction_with {} = {:g} is out of range; allowed is 0 to 10", material.name, other,
                   friction);
      const auto [first, fresh] = said.emplace(std::minmax(material.name, other), friction);
      if (!fresh && first->second != friction)
        report.say(material.place, "material \"{0}\": friction_with {1} = {2:g}, and \"{1}\" says {3:g}; say it once", material.name, other,
                   friction, first->second);
    }
}

// Volume that two parts share would count twice in mass and inertia. The bound is that of two blocks; within 1e-6 of the block's size the
// coordinates of a file in single precision say no more.
void check_parts(Report& report, const Block& block) {
  constexpr double most_shared = 1e-3;  // of the smaller edge
  std::vector<Box> box;
  std::vector<double> edge;
  Box all = bounding_box(block.parts[0]);
  for (const Polyhedron& part : block.parts) {
    box.push_back(bounding_box(part)), edge.push_back(smallest_edge(part));
    all = {all.low.cwiseMin(box.back().low), all.high.cwiseMax(box.back().high)};
  }
  size_t first = 0, second = 0;
  int found = 0;
  double deepest = 0, relative = 0;
  for (size_t i = 0; i < box.size(); ++i)
    for (size_t j = i + 1; j < box.size(); ++j) {
      if ((box[i].low.array() > box[j].high.array()).any() || (box[j].low.array() > box[i].high.array()).any()) continue;
      const double smaller = std::min(edge[i], edge[j]), depth = -separation(block.parts[i], block.parts[j], 0).gap;
      if (depth <= std::max(most_shared * smaller, 1e-6 * (all.high - all.low).norm())) continue;
      ++found;
      if (depth > relative * smaller) first = i + 1, second = j + 1, deepest = depth, relative = depth / smaller;
    }
  if (found == 0) return;
  report.say(
      block.place,
      "block \"{}\": its parts {} and {} overlap by {:.3g} mm, {:.2g} of their smaller edge{}, and what they share would weigh twice; "
      "cut them so that they only touch",
      block.name, first, second, 1e3 * deepest, relative, found > 1 ? fmt::format(" ({} more overlap)", found - 1) : "");
}

void check_blocks(Report& report, const Scene& scene) {
  if (scene.blocks.empty()) report.say({scene.file, 0}, "the scene has no blocks; add box{{ ... }}, block{{ ... }} or wall{{ ... }}");
  std::set<std::string> names;
  for (const Block& block : scene.blocks) {
    if (!names.insert(block.name).second) report.say(block.place, "block \"{}\" is there twice; give one of them another name", block.name);
    if (block.material < 0 || block.material >= static_cast<int>(scene.materials.size()))
      report.say(block.place, "block \"{}\" has no material; add material = \"...\"", block.name);
    if (block.parts.empty()) report.say(block.place, "block \"{}\" has no shape; give size, or vertices", block.name);
    bool sound = true;
    for (size_t i = 0; i < block.parts.size(); ++i) {
      const std::string problem = problem_of(block.parts[i]);
      if (problem.empty()) continue;
      sound = false;
      report.say(block.place, "block \"{}\"{}: {}; a block is made of closed convex parts, faces counter-clockwise seen from outside",
                 block.name, block.parts.size() > 1 ? fmt::format(", part {}", i + 1) : "", problem);
    }
    if (sound && block.parts.size() > 1) check_parts(report, block);
    check_fields(report, block.initial(), fmt::format("block \"{}\": initial", block.name), block.place);
    if (block.fixed && block.initial().given)
      report.say(block.place, "block \"{}\" is fixed and has an initial motion; remove one of them", block.name);
  }
}

std::vector<std::string> groups_of(const Scene& scene) {
  std::vector<std::string> groups;
  for (const Block& block : scene.blocks)
    if (!block.group.empty() && std::find(groups.begin(), groups.end(), block.group) == groups.end()) groups.push_back(block.group);
  return groups;
}

std::string without_digits(std::string name) {
  std::erase_if(name, [](unsigned char c) { return std::isdigit(c) != 0; });
  return name;
}

// A rule may name a group that this variant of a scene lacks: no lintel without a door, no storey3 in a house of two storeys. A name that
// differs from that of a group by a few letters, not only by digits, is a spelling mistake.
bool misspelt(const std::string& group, const std::vector<std::string>& groups) {
  const std::string near = nearest(group, groups);
  return !near.empty() && without_digits(near) != without_digits(group);
}

// Reports groups named by rules to which no block belongs. `mistakes`: misspelt names in rules that are not optional. Else the doubts: all
// others, less groups that a builder left empty, and less names in optional rules that resemble no group.
void name_groups(Report& report, const Scene& scene, bool mistakes) {
  std::vector<std::string> groups = groups_of(scene);
  groups.insert(groups.end(), scene.empty_groups.begin(), scene.empty_groups.end());
  for (const JointRule& rule : scene.joint_rules)
    for (const std::string& group : {rule.group_a, rule.group_b}) {
      if (group.empty() || std::find(groups.begin(), groups.end(), group) != groups.end()) continue;
      const bool slip = misspelt(group, groups);
      if ((slip && !rule.optional) != mistakes || (rule.optional && !slip)) continue;
      report.say(rule.place, "joint: no block is of group \"{}\"{}{}{}", group, mistakes ? "" : ", so that this rule joins nothing",
                 did_you_mean(group, groups), mistakes ? " (optional = true admits a group that this variant of the scene lacks)" : "");
    }
}

void check_joints(Report& report, const Scene& scene) {
  name_groups(report, scene, true);
  for (const JointRule& rule : scene.joint_rules) {
    if (!inside(rule.points_long, 1, 64) || !inside(rule.points_short, 1, 64))
      report.say(rule.place, "joint: points {} x {} is out of range; allowed is 1 to 64 along a side", rule.points_long, rule.points_short);
    else if (rule.rule == "trapezoid" && std::min(rule.points_long, rule.points_short) < 2)
      report.say(rule.place,
                 "joint: points = {{ {}, {} }}, and rule = \"trapezoid\" has a point at each end of a side; give at least 2 along "
                 "each, or leave the rule out",
                 rule.points_long, rule.points_short);
    check_fields(report, rule, "joint", rule.place);
    if (rule.none) continue;
    std::visit(
        [&](const auto& law) {
          using L = std::decay_t<decltype(law)>;
          check_fields(report, law, std::string(L::law_name), rule.place);
          if constexpr (requires { law.mistakes(); })
            for (const std::string& mistake : law.mistakes()) report.say(rule.place, "joint: {}", mistake);
        },
        rule.law);
  }
}

using Index = std::unordered_map<std::string, const Block*>;

// The block of that name; reports a mistake if there is none.
const Block* named(Report& report, const Index& index, const std::string& name, const Place& place, const std::string& who) {
  const auto found = index.find(name);
  if (found != index.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [known, block] : index) names.push_back(known);
  std::sort(names.begin(), names.end());
  report.say(place, "{}: there is no block \"{}\"{}", who, name, did_you_mean(name, names));
  return nullptr;
}

void check_loads(Report& report, const Scene& scene, const Index& index) {
  using Kind = Load::Kind;
  std::set<std::string> driven;
  for (const Load& load : scene.loads)
    if (load.kind == Kind::motion || load.kind == Kind::turning) driven.insert(load.block);
  for (const Load& load : scene.loads) {
    if (!(std::abs(load.direction.norm() - 1) < 1e-6))
      report.say(load.place, "load \"{}\": its direction has no length; give a vector", load.name);
    if (const std::string size = load_size_mistake(load, scene.analysis.duration); !size.empty()) report.say(load.place, "{}", size);
    if (load.kind == Kind::ground || load.kind == Kind::tilt) continue;
    const char* who = load_word(load.kind);
    const Block* block = named(report, index, load.block, load.place, who);
    if (block && block->fixed && load.kind != Kind::motion && load.kind != Kind::turning)
      report.say(load.place, "{}: block \"{}\" is fixed and feels none; name a free block", who, load.block);
    else if ((load.kind == Kind::force || load.kind == Kind::moment) && driven.contains(load.block))
      report.say(load.place, "{}: block \"{}\" is driven by motion{{}} or turning{{}} and moves as they say; leave the {} out", who,
                 load.block, who);
    if (!inside(load.point, -1e6, 1e6)) report.say(load.place, "{}: its point is not a finite place; give numbers", who);
  }
}

// Recorders are checked in engine/record, which knows the quantities.
void check_cameras(Report& report, const Scene& scene) {
  std::set<std::string> cameras;
  for (const Camera& camera : scene.cameras)
    if (!cameras.insert(camera.name).second)
      report.say(camera.place, "camera \"{}\" is there twice; give one of them another name", camera.name);
}

// The number of steps must be countable. Rows and frames are never more than steps.
void check_counts(Report& report, const Analysis& analysis, const Place& place) {
  constexpr double most_steps = 9007199254740992.0;  // 2^53: beyond it t + dt equals t
  if (analysis.dt > 0 && !(analysis.duration / analysis.dt < most_steps))
    report.say(place, "analysis: dt = {:g} s makes more than 2^53 steps of {:g} s; take a longer step", analysis.dt, analysis.duration);
}

void check_analysis(Report& report, const Scene& scene) {
  const Analysis& analysis = scene.analysis;
  const Place place = analysis.place.file.empty() ? Place{scene.file, 0} : analysis.place;
  if (analysis.duration == 0 && !scene.push.quasi_static())
    report.say(place, "the run has no duration; add analysis{{ duration = 10 }} (seconds)");
  else if (analysis.duration > 0) {
    Analysis given = analysis;
    given.levels = analysis.contact_levels();
    check_fields(report, given, "analysis", place);
  }
  check_counts(report, analysis, place);
  check_fields(report, scene.damping, "damping", scene.damping.place);
  if (scene.damping.at > 0 && scene.damping.joint_ratio <= 0)
    report.say(scene.damping.place, "damping: at = {:g} Hz is the frequency of a ratio that is not given; add joint_ratio = 0.02, say",
               scene.damping.at);
  if (analysis.solver == "sequential" && (scene.damping.stiffness > 0 || scene.damping.joint_ratio > 0))
    report.say(scene.damping.place, "damping: the sequential solver knows no dashpots of joints; use mass, or solver = \"leapfrog\"");
  if (analysis.solver == "sequential" && analysis.sleep)
    report.say(place, "analysis: the sequential solver lets no debris sleep; leave sleep out, or take solver = \"leapfrog\"");
  if (const char* one_level = one_level_only(scene); analysis.levels > 1 && one_level != nullptr)
    report.say(place, "analysis: {} has one level only; leave levels out, or give levels = 1", one_level);
  if (!inside(scene.gravity, -1000, 1000)) report.say({scene.file, 0}, "gravity is out of range; allowed is 0 to 1000 m/s2");
}

// Doubtful values, by kind. The message names the first value of a kind and counts the others.
class Doubts {
 public:
  template <class... A>
  void add(const std::string& kind, const Place& place, fmt::format_string<A...> text, A&&... values) {
    for (Doubt& doubt : all_)
      if (doubt.kind == kind) return void(++doubt.others);
    all_.push_back({kind, place, fmt::format(text, std::forward<A>(values)...), 0});
  }
  void tell(Report& report) const {
    for (const Doubt& doubt : all_)
      report.say(doubt.place, "{}{}; {}", doubt.text, doubt.others > 0 ? fmt::format(" (and {} more like it)", doubt.others) : "",
                 doubt.kind);
  }

 private:
  struct Doubt {
    std::string kind;
    Place place;
    std::string text;
    int others;
  };
  std::vector<Doubt> all_;
};

// Warns of numbers within their range that no masonry has. Mostly a unit is missing.
void doubt_units(Report& report, const Scene& scene) {
  Doubts doubts;
  std::set<int> moving;  // materials
  for (const Block& block : scene.blocks) {
    if (block.fixed) continue;
    moving.insert(block.material);
    Vec3 low = Vec3::Constant(unbounded), high = -low;
    for (const Polyhedron& part : block.parts)
      for (const Vec3& v : part.vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
    if (const double longest = (high - low).maxCoeff(); longest > 100)
      doubts.add("lengths are in m: write 300*mm", block.place, "block \"{}\" is {:.4g} m long", block.name, longest);
  }
  for (const int i : moving) {
    if (i < 0 || i >= static_cast<int>(scene.materials.size())) continue;
    const Material& material = scene.materials[static_cast<size_t>(i)];
    if (material.density < 200 || material.density > 20000)
      doubts.add("masonry has 1000 to 3000 kg/m3", material.place, "material \"{}\" has a density of {:g} kg/m3", material.name,
                 material.density);
    if (material.kn < 1e6)
      doubts.add("stiffnesses are in Pa/m: write 10*MPa/mm", material.place, "material \"{}\" has a contact stiffness of {:g} Pa/m",
                 material.name, material.kn);
  }
  for (const JointRule& rule : scene.joint_rules) {
    if (rule.none) continue;
    const PointLaw law = compile(rule.law);
    if (law.kn > 0 && law.kn < 1e6)
      doubts.add("stiffnesses are in Pa/m: write 10*MPa/mm", rule.place, "joint: its normal stiffness is {:g} Pa/m", law.kn);
    std::visit(
        [&]<class L>(const L& one) {
          if constexpr (requires { one.strengths(); })
            for (const auto& [name, strength] : one.strengths())
              if ((strength > 0 && strength < 1000) || strength > 1e9)
                doubts.add("strengths are in Pa: write 0.1*MPa", rule.place, "{}: {} = {:g} Pa", L::law_name, name, strength);
        },
        rule.law);
  }
  doubts.tell(report);
}

// Keys that another key would have to switch on.
void doubt_idle_keys(Report& report, const Scene& scene) {
  const Analysis &a = scene.analysis, usual;
  if (a.solver != "sequential") {
    std::vector<std::string> idle;
    if (a.variant != usual.variant) idle.emplace_back("variant");
    if (a.order != usual.order) idle.emplace_back("order");
    if (a.iterations != usual.iterations) idle.emplace_back("iterations");
    if (a.seed != usual.seed) idle.emplace_back("seed");
    if (!idle.empty())
      report.say(a.place, "analysis: without solver = \"sequential\" there is no use for {}; leave it out", fmt::join(idle, ", "));
  }
  const bool lies = std::ranges::any_of(scene.blocks, [](const Block& block) { return block.free; });  // on the structure, perhaps
  if (a.ramp_time > 0 && (a.start == "rest" || (a.start == "equilibrium" && !lies)))
    report.say(a.place, "analysis: ramp_time = {:g} s is that of start = \"ramp\"; {}", a.ramp_time,
               a.start == "rest" ? "start = \"rest\" has no ramp: leave it out"
                                 : "start = \"equilibrium\" takes it only where there is no equilibrium");
  for (const JointRule& rule : scene.joint_rules) {
    const Mortar* m = rule.none ? nullptr : std::get_if<Mortar>(&rule.law);
    if (m == nullptr) continue;
    for (const auto& [strength, energy, value, strength_value] : {std::tuple{"ft", "Gf1", m->Gf1, m->ft}, {"c", "Gf2", m->Gf2, m->c}})
      if (value > 0 && strength_value == 0)
        report.say(rule.place, "mortar: {0} = {1:g} J/m2 does nothing, since {2} = 0 leaves no bond to lose; give {2}, or leave {0} out",
                   energy, value, strength);
  }
}

}  // namespace

std::vector<std::string> check(const Scene& scene) {
  Report report;
  Index index;
  for (const Block& block : scene.blocks) index.emplace(block.name, &block);
  check_materials(report, scene);
  check_blocks(report, scene);
  check_joints(report, scene);
  check_loads(report, scene, index);
  check_cameras(report, scene);
  check_analysis(report, scene);
  for (std::string& mistake : check_push(scene)) report.mistakes.push_back(std::move(mistake));
  return report.mistakes;
}

std::vector<std::string> warnings(const Scene& scene) {
  Report report{scene.warnings};
  doubt_units(report, scene);
  doubt_idle_keys(report, scene);
  name_groups(report, scene, false);
  for (const JointRule& rule : scene.joint_rules) {
    if (rule.none) continue;
    std::visit(
        [&]<class L>(const L& law) {
          if constexpr (requires { law.warnings(); })
            for (const std::string& warning : law.warnings()) report.say(rule.place, "{}: {}", L::law_name, warning);
        },
        rule.law);
  }
  return report.mistakes;
}

}  // namespace erbs
