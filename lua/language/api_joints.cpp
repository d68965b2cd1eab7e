// Functions of a script: joint laws, made from their field lists, and the rules that assign them to faces.
#include <cmath>
#include <lua5.4/lua.hpp>

#include "lua/language/api.h"

namespace erbs {
namespace {

std::string text_of(std::string_view law) {
  if (law == "mortar") return "A mortar joint: linear, with tension cut-off, Coulomb shear with cohesion, and optional softening.";
  if (law == "dry") return "A dry joint: linear in compression, no tension, Coulomb friction.";
  return fmt::format("The joint law {}.", law);
}

void complete(Call&, Arguments&, auto&) {}

void complete(Call&, Arguments& arguments, DryFriction& law) {
  if (!arguments.has("ks")) law.ks = 0.4 * law.kn;
}

void complete(Call&, Arguments& arguments, Mortar& law) {
  if (law.kn == 0 && law.E == 0) arguments.mistake("there is no stiffness; give E (with the thickness of the bed) or kn");
  if (law.kn > 0 && law.ks == 0 && law.G == 0 && law.E == 0) law.ks = 0.4 * law.kn;
}

template <class L>
int make_law(Call& call) {
  Arguments arguments = call.arguments();
  L law;
  arguments.read(law);
  complete(call, arguments, law);
  push_law(call.lua, call.context, law);
  return 1;
}

template <class... L>
void add_laws(std::vector<Function>& functions, const std::variant<L...>*) {
  (functions.push_back(
       {std::string(L::law_name), make_law<L>, "{ ... }", "law: for joint{ law = ... }", text_of(L::law_name), keys_of<L>()}),
   ...);
}

void read_points(Arguments& arguments, JointRule& rule) {
  if (!arguments.has("points")) return;
  if (arguments.is_number("points")) {
    int n = 0;
    arguments.read("points", n);
    const int side = static_cast<int>(std::lround(std::sqrt(std::max(n, 0))));
    rule.points_long = rule.points_short = side;
    if (side * side != n || n == 0)
      arguments.mistake(
          fmt::format("points = {} is no square number; write points = {{ along the longer side, along the shorter side }}", n));
    return;
  }
  std::vector<double> sides;
  arguments.read("points", sides);
  if (sides.size() != 2 || sides[0] != std::floor(sides[0]) || sides[1] != std::floor(sides[1])) {
    arguments.mistake("points must be two whole numbers { along the longer side, along the shorter side }, or one square number");
    return;
  }
  rule.points_long = static_cast<int>(sides[0]);
  rule.points_short = static_cast<int>(sides[1]);
}

int joint(Call& call) {
  Arguments arguments = call.arguments();
  JointRule rule;
  rule.place = call.place;
  arguments.read(rule);
  rule.has_thickness = arguments.has("thickness");
  read_points(arguments, rule);
  if (arguments.has("between")) {
    std::vector<std::string> groups;
    arguments.read("between", groups);
    if (groups.size() == 2) {
      rule.group_a = groups[0];
      rule.group_b = groups[1];
    } else {
      arguments.mistake(fmt::format("between must name two groups, such as {{ \"wall\", \"slab\" }}; it names {}", groups.size()));
    }
  }
  const auto law = arguments.law("law");
  if (law) rule.law = *law;
  else if (!arguments.has("law") && !rule.none)
    arguments.mistake("\"law\" is missing; give law = mortar{ ... } or dry{ ... }, or none = true");
  if (auto* mortar = std::get_if<Mortar>(&rule.law)) {
    if (!rule.has_thickness) rule.thickness = mortar->thickness;
    if (mortar->thickness == 0) mortar->thickness = rule.thickness;
    if (mortar->kn == 0 && mortar->E > 0 && mortar->thickness == 0)
      arguments.mistake("the mortar has E but no thickness; give thickness = 5*mm here or in mortar{}");
  }
  if (!arguments.has("points") && !arguments.has("rule")) call.context.plain_rules.push_back(call.context.scene.joint_rules.size());
  call.context.scene.joint_rules.push_back(std::move(rule));
  return 0;
}

}  // namespace

std::vector<Function> joint_functions() {
  std::vector<Function> functions;
  add_laws(functions, static_cast<const Law*>(nullptr));
  functions.push_back(
      {"joint", joint, "{ ... }", "",
       "Joins faces that face each other at rest by a law. The last rule that matches a pair of blocks applies.",
       joined({{{"law", "law", "", "a law value: mortar{ ... } or dry{ ... }"},
                {"between", "strings", "", "two groups, { \"wall\", \"slab\" }; \"\" is any group (default: any two groups)"}},
               keys_of<JointRule>(),
               {{"points", "points_per_face", "", "contact points: { along the longer side, along the shorter side }, or one square number",
                 1, 64, false, "", "{ 3, 3 }"}}})});
  return functions;
}

}  // namespace erbs
