#include "engine/scene/effects.h"

#include "engine/base/spelling.h"

namespace erbs {
namespace {

Effect effect(std::string name, const Place* place) { return {std::move(name), place != nullptr, place != nullptr ? place->text() : ""}; }

const Place* load_with(const Scene& scene, Load::Kind kind, int component = -1) {
  for (const Load& load : scene.loads)
    if (load.kind == kind && (component < 0 || load.direction[component] != 0)) return &load.place;
  return nullptr;
}

const Place* any_joint(const Scene& scene) {
  for (const JointRule& rule : scene.joint_rules)
    if (!rule.none) return &rule.place;
  return nullptr;
}

// Blocks can meet if a joint can break (every law can), or if a block stands or flies without a joint.
const Place* may_meet(const Scene& scene) {
  if (scene.blocks.size() < 2) return nullptr;
  if (const Place* joined = any_joint(scene)) return joined;
  for (const Block& block : scene.blocks)
    if (!block.fixed) return &block.place;
  return nullptr;
}

// An impact of two materials loses energy if the smaller of their restitutions is below 1.
const Place* dissipating(const Scene& scene) {
  for (const Block& block : scene.blocks) {
    if (block.fixed || block.material < 0) continue;
    const Material& material = scene.materials[static_cast<std::size_t>(block.material)];
    if (material.restitution < 1) return &material.place;
  }
  return nullptr;
}

void drop_ground(Scene& scene, int component) {
  for (Load& load : scene.loads)
    if (load.kind == Load::Kind::ground) load.direction[component] = 0;
  std::erase_if(scene.loads, [](const Load& load) { return load.kind == Load::Kind::ground && load.direction.norm() == 0; });
}

void drop(Scene& scene, Load::Kind kind) {
  std::erase_if(scene.loads, [=](const Load& load) { return load.kind == kind; });
}

// Calls f(effect) for each effect of each joint law, in their order.
template <class F, class... L>
void each_law_effect(F&& f, LawList<L...>) {
  const auto of_one = [&]<class One>(const One*) {
    if constexpr (requires { One::effects(); })
      for (const LawEffect<One>& effect : One::effects()) f(effect);
  };
  (of_one(static_cast<const L*>(nullptr)), ...);
}

template <class L>
const Place* rule_with(const Scene& scene, const LawEffect<L>& effect) {
  for (const JointRule& rule : scene.joint_rules) {
    const auto* law = std::get_if<L>(&rule.law);
    if (law != nullptr && !rule.none && effect.on(*law)) return &rule.place;
  }
  return nullptr;
}

// True if `name` is an effect of a joint law.
bool switch_off_in_laws(Scene& scene, const std::string& name) {
  bool known = false;
  each_law_effect(
      [&]<class L>(const LawEffect<L>& effect) {
        if (name != effect.name) return;
        known = true;
        for (JointRule& rule : scene.joint_rules)
          if (auto* law = std::get_if<L>(&rule.law)) effect.off(*law);
      },
      Laws{});
  return known;
}

struct Switch {
  const char* name;
  void (*off)(Scene&);
};

const Switch switches[] = {
    {"ground x", [](Scene& s) { drop_ground(s, 0); }},
    {"ground y", [](Scene& s) { drop_ground(s, 1); }},
    {"ground z", [](Scene& s) { drop_ground(s, 2); }},
    {"forces on blocks", [](Scene& s) { drop(s, Load::Kind::force); }},
    {"moments on blocks", [](Scene& s) { drop(s, Load::Kind::moment); }},
    {"tilting gravity", [](Scene& s) { drop(s, Load::Kind::tilt); }},
    {"prescribed motion", [](Scene& s) { drop(s, Load::Kind::motion); }},
    {"prescribed turning", [](Scene& s) { drop(s, Load::Kind::turning); }},
    {"mass damping", [](Scene& s) { s.damping.mass = 0; }},
    {"dashpots of joints", [](Scene& s) { s.damping.stiffness = s.damping.joint_ratio = s.damping.at = 0; }},
    {"sequential sweep", [](Scene& s) { s.analysis.solver = "leapfrog"; }},
    {"rotation of joint frames", [](Scene& s) { s.analysis.lazy_rotation = 1e9; }},  // small rotations about the start only
    {"debris contact", [](Scene& s) { s.analysis.debris = false; }},
    {"contact dashpots",
     [](Scene& s) {
       for (Material& m : s.materials) m.restitution = 1;
     }},
    {"sleep of debris", [](Scene& s) { s.analysis.sleep = false; }},
    {"levels of contacts", [](Scene& s) { s.analysis.levels = 1; }},
    {"gyroscopic term", [](Scene& s) { s.analysis.gyroscopic = false; }},
    {"energy ledger", [](Scene& s) { s.analysis.ledger = false; }},
    {"recorders", [](Scene& s) { s.recorders.clear(); }},
};

}  // namespace

void switch_off(Scene& scene, const std::string& name) {
  for (const Switch& item : switches)
    if (name == item.name) return item.off(scene);
  if (switch_off_in_laws(scene, name)) return;
  std::vector<std::string> names;
  for (const Effect& effect : effects_of(scene)) names.push_back(effect.name);
  std::string near = nearest(name, names);
  for (const std::string& one : names)
    if (near.empty() && !name.empty() && one.find(name) != std::string::npos) near = one;
  throw Error(fmt::format("there is no effect \"{}\", only {}{}", name, fmt::join(names, ", "),
                          near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near)));
}

const char* one_level_only(const Scene& scene) {
  if (scene.analysis.solver == "sequential") return "the sequential solver";
  if (scene.analysis.kernel == "reference") return "kernel = \"reference\"";
  if (scene.analysis.unstable) return "a step beyond the limit";
  return scene.damping.stiffness > 0 || scene.damping.joint_ratio > 0 ? "damping of intact joints" : nullptr;
}

std::vector<Effect> effects_of(const Scene& scene) {
  std::vector<Effect> out;
  out.push_back(effect("ground x", load_with(scene, Load::Kind::ground, 0)));
  out.push_back(effect("ground y", load_with(scene, Load::Kind::ground, 1)));
  out.push_back(effect("ground z", load_with(scene, Load::Kind::ground, 2)));
  out.push_back(effect("forces on blocks", load_with(scene, Load::Kind::force)));
  out.push_back(effect("moments on blocks", load_with(scene, Load::Kind::moment)));
  out.push_back(effect("tilting gravity", load_with(scene, Load::Kind::tilt)));
  out.push_back(effect("prescribed motion", load_with(scene, Load::Kind::motion)));
  out.push_back(effect("prescribed turning", load_with(scene, Load::Kind::turning)));
  const bool damped = scene.damping.mass > 0 && scene.damping.scope != "none";
  out.push_back(effect("mass damping", damped ? &scene.damping.place : nullptr));
  const bool dashpots = scene.damping.stiffness > 0 || scene.damping.joint_ratio > 0;
  out.push_back(effect("dashpots of joints", dashpots ? &scene.damping.place : nullptr));
  const bool sweeps = scene.analysis.solver == "sequential";  // the sequential solver has no dashpots
  each_law_effect(
      [&](const auto& of_law) { out.push_back(effect(of_law.name, sweeps && of_law.dashpots ? nullptr : rule_with(scene, of_law))); },
      Laws{});
  out.push_back(effect("sequential sweep", sweeps ? &scene.analysis.place : nullptr));
  const Place* joined = any_joint(scene);
  const Place* debris = may_meet(scene);
  out.push_back(effect("rotation of joint frames", joined));
  out.push_back(effect("debris contact", debris));
  out.push_back(effect("contact dashpots", debris != nullptr ? dissipating(scene) : nullptr));
  const bool sleeps = scene.analysis.sleep && debris != nullptr && !sweeps && scene.gravity.norm() > 0;
  out.push_back(effect("sleep of debris", sleeps ? &scene.analysis.place : nullptr));
  constexpr std::size_t heap = 30;  // blocks; fewer loose ones are not divided (`ContactBound::divide`)
  const bool levels = scene.analysis.contact_levels() > 1 && debris != nullptr && (joined != nullptr || scene.blocks.size() > heap) &&
                      one_level_only(scene) == nullptr;
  out.push_back({"levels of contacts", levels, !levels ? "" : scene.analysis.levels > 0 ? scene.analysis.place.text() : "by default"});
  out.push_back({"gyroscopic term", scene.analysis.gyroscopic, scene.analysis.gyroscopic ? "by default" : ""});
  out.push_back({"energy ledger", true, "every run"});
  out.push_back(effect("recorders", scene.recorders.empty() ? nullptr : &scene.recorders.front().place));
  return out;
}

}  // namespace erbs
