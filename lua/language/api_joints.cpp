// Functions of a script: joint laws, made from their field lists, the stiffness of joints from that of masonry, and the rules that assign
// laws to faces.
#include <algorithm>
#include <cmath>
#include <lua5.4/lua.hpp>

#include "lua/language/api.h"

namespace erbs::lua {
namespace {

const Keys& scatter_keys() {
  static const Keys keys = keys_of<Scatter>();
  return keys;
}

template <class L>
Keys law_keys() {
  if constexpr (requires(L law) { law.scatter; })
    return joined({keys_of<L>(),
                   {{"scatter", "table", "", "lognormal scatter of the bond from joint to joint (default: none)", -unbounded, unbounded,
                     false, "", "", scatter_keys()}}});
  return keys_of<L>();
}

// Of two keys that give the same property, one would be ignored; 0 stands for left out.
void refuse_both(const Mortar& law, Arguments& arguments) {
  struct Rival {
    double Mortar::*one, Mortar::*other;
    const char *names[2], *property;
  };
  constexpr Rival rivals[] = {
      {&Mortar::E, &Mortar::kn, {"E", "kn"}, "the normal stiffness, by E / thickness or as it is"},
      {&Mortar::G, &Mortar::ks, {"G", "ks"}, "the shear stiffness, by G / thickness or as it is"},
      {&Mortar::Gf1, &Mortar::un_ultimate, {"Gf1", "un_ultimate"}, "the opening at which tensile strength is lost"},
      {&Mortar::Gf2, &Mortar::us_ultimate, {"Gf2", "us_ultimate"}, "the slip at which cohesion is lost"},
  };
  for (const Rival& rival : rivals)
    if (law.*rival.one > 0 && law.*rival.other > 0)
      arguments.mistake(fmt::format("{} and {} both give {}; leave one out", rival.names[0], rival.names[1], rival.property));
}

template <class L>
int make_law(Call& call) {
  Arguments arguments = call.arguments();
  L law;
  arguments.read(law);
  if constexpr (requires { law.scatter; })
    if (auto table = arguments.table("scatter", scatter_keys())) table->read(law.scatter);
  if constexpr (std::is_same_v<L, Mortar>) refuse_both(law, arguments);
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
       {std::string(L::law_name), make_law<L>, "{ ... }", "law: for joint{ law = ... }", std::string(L::help), law_keys<L>()}),
   ...);
}

// Masonry of rigid blocks: all deformation of a course lies in its joint.
struct MasonryStiffness {
  double E = 0, nu = 0.2, spacing = 0;  // Pa, -, m

  static Fields<MasonryStiffness> fields() {
    return {
        {"E", &MasonryStiffness::E, "Pa", "Young's modulus of the masonry, units and mortar together", 1, 1e14, true},
        {"nu", &MasonryStiffness::nu, "", "Poisson's ratio of the masonry", -0.99, 0.5},
        {"spacing", &MasonryStiffness::spacing, "m", "distance h from joint to joint, across them", 1e-6, 1e3, true},
    };
  }
};

std::string gigapascals(double pa, const char* per) { return fmt::format("{:.4g} GPa{}", 1e-9 * pa, per); }

int masonry_stiffness(Call& call) {
  Arguments arguments = call.arguments();
  MasonryStiffness of;
  arguments.read(of);
  const double h = of.spacing > 0 ? of.spacing : 1;  // the mistake is told
  const double kn = of.E / h, ks = kn / (2 * (1 + of.nu));
  const std::string note = fmt::format("{}: kn = E/h = {} from E = {}, h = {:.4g} m; ks = kn/(2(1+nu)) = {} from nu = {:.4g}{}",
                                       call.place.text(), gigapascals(kn, "/m"), gigapascals(of.E, ""), of.spacing, gigapascals(ks, "/m"),
                                       of.nu, arguments.has("nu") ? "" : " (default)");
  std::vector<std::string>& notes = call.context.scene.notes;
  if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
  lua_createtable(call.lua, 0, 2);
  lua_pushnumber(call.lua, kn);
  lua_setfield(call.lua, -2, "kn");
  lua_pushnumber(call.lua, ks);
  lua_setfield(call.lua, -2, "ks");
  return 1;
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
  functions.push_back({"masonry_stiffness", masonry_stiffness, "{ ... }", "table: kn, ks (Pa/m), for mortar{ kn = k.kn, ks = k.ks, ... }",
                       "Stiffness of the joints of rigid blocks from that of masonry: kn = E / spacing, ks = kn / (2 (1 + nu)). Log and "
                       "manifest tell what it did.",
                       keys_of<MasonryStiffness>()});
  functions.push_back(
      {"joint", joint, "{ ... }", "",
       "Joins faces that face each other at rest by a law. The last rule that matches a pair of blocks applies.",
       joined(
           {{{"law", "law", "", "a law value: " + any_law(Laws{})},
             {"between", "strings", "", "two groups, { \"wall\", \"slab\" }; \"\" is any group (default: any two groups)"}},
            keys_of<JointRule>(),
            {{"points", "points_per_face", "",
              "contact points: { along the longer side, along the shorter side }, or one square number; with rule = \"simpson\", 2 along a "
              "side are those of gauss, .289 of the side from its middle: with pressure = \"points\" a block then hinges inside its edge",
              1, 64, false, "", "{ 3, 3 }"}}})});
  return functions;
}

}  // namespace erbs::lua
