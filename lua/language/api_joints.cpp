// Functions of a script: joint laws, made from their field lists, and the rules that assign them to faces.
#include <cmath>
#include <lua5.4/lua.hpp>

#include "lua/language/api.h"

namespace erbs::lua {
namespace {

template <class L>
int make_law(Call& call) {
  Arguments arguments = call.arguments();
  L law;
  arguments.read(law);
  if (const std::string mistake = law.complete(); !mistake.empty()) arguments.mistake(mistake);
  push_law(call.lua, call.context, law);
  return 1;
}

// "dry{ ... } or mortar{ ... }", of all laws.
template <class... L>
std::string any_law(LawList<L...>) {
  std::vector<std::string> names;
  (names.push_back(std::string(L::law_name) + "{ ... }"), ...);
  std::string all = names.front();
  for (std::size_t i = 1; i < names.size(); ++i) all += (i + 1 < names.size() ? ", " : " or ") + names[i];
  return all;
}

template <class... L>
void add_laws(std::vector<Function>& functions, LawList<L...>) {
  (functions.push_back(
       {std::string(L::law_name), make_law<L>, "{ ... }", "law: for joint{ law = ... }", std::string(L::help), keys_of<L>()}),
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
  else if (!arguments.has("law") && !rule.none) arguments.mistake("\"law\" is missing; give law = " + any_law(Laws{}) + ", or none = true");
  std::visit(
      [&](auto& one) {
        if constexpr (requires { one.share_thickness(rule.thickness, rule.has_thickness); })
          if (const std::string mistake = one.share_thickness(rule.thickness, rule.has_thickness); !mistake.empty())
            arguments.mistake(mistake);
      },
      rule.law);
  if (!arguments.has("points") && !arguments.has("rule")) call.context.plain_rules.push_back(call.context.scene.joint_rules.size());
  call.context.scene.joint_rules.push_back(std::move(rule));
  return 0;
}

}  // namespace

std::vector<Function> joint_functions() {
  std::vector<Function> functions;
  add_laws(functions, Laws{});
  functions.push_back(
      {"joint", joint, "{ ... }", "",
       "Joins faces that face each other at rest by a law. The last rule that matches a pair of blocks applies.",
       joined({{{"law", "law", "", "a law value: " + any_law(Laws{})},
                {"between", "strings", "", "two groups, { \"wall\", \"slab\" }; \"\" is any group (default: any two groups)"}},
               keys_of<JointRule>(),
               {{"points", "points_per_face", "", "contact points: { along the longer side, along the shorter side }, or one square number",
                 1, 64, false, "", "{ 3, 3 }"}}})});
  return functions;
}

}  // namespace erbs::lua
