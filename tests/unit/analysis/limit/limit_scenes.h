// Limit analysis of a scene given as text.
#pragma once
#include <string>

#include "engine/analysis/limit/limit.h"
#include "engine/model/build/build.h"
#include "lua/language/script.h"

namespace erbs::test {

inline Model limit_model(const std::string& text) {
  lua::Script script(lua::Script::Options{.quiet = true});
  return build(script.load_text(text + "\nanalysis { duration = 1 }", "limit.lua")).model;
}

inline analysis::LimitResult limit_of(const std::string& text, const Vec3& direction = Vec3::UnitX(), analysis::LimitOptions options = {}) {
  analysis::LimitLoad load;
  load.direction = direction;
  return analysis::limit_analysis(limit_model(text), load, options);
}

// One block on the ground, width x depth x height.
inline std::string single_block(const std::string& size, const std::string& law) {
  return "material { name = 'stone', density = 2000 }\n"
         "box { name = 'floor', size = { 8, 8, 1 }, at = { -4, -4, -1 }, fixed = true, material = 'stone' }\n"
         "joint { law = " +
         law +
         " }\n"
         "box { name = 'block', size = " +
         size + ", at = { 0, 0, 0 }, material = 'stone' }\n";
}

inline std::string dry(double mu) { return "dry { kn = 1e10, mu = " + std::to_string(mu) + " }"; }

// A running-bond wall of `wide` bricks and `courses`, with whole bricks at the ends of the lowest course or halves. `heads`: friction of
// the head joints, which the courses do not share; below 0: mu.
inline std::string bond_wall(const std::string& brick, int wide, int courses, bool halves, double mu, double heads = -1) {
  std::string text =
      "material { name = 'brick', density = 2000 }\n"
      "local brick = " +
      brick + "\n" +
      "box { name = 'floor', size = { 40, 2, 0.5 }, at = { -10, -1, -0.5 }, fixed = true, material = 'brick' }\n"
      "joint { law = " +
      dry(mu) +
      " }\n"
      "for c = 0, " +
      std::to_string(courses - 1) +
      " do\n"
      "  local x, whole = 0, (c % 2 == 0) ~= " +
      (halves ? "true" : "false") +
      "\n"
      "  while x < " +
      std::to_string(wide) +
      " * brick.length - 1e-6 do\n"
      "    local long = (whole or x > 0) and brick.length or brick.length / 2\n"
      "    long = math.min(long, " +
      std::to_string(wide) +
      " * brick.length - x)\n"
      "    box { group = 'course' .. c, size = { long, brick.width, brick.height }, at = { x, 0, c * brick.height }, material = 'brick' }\n"
      "    x = x + long\n"
      "  end\n";
  if (heads >= 0) text += "  joint { between = { 'course' .. c, 'course' .. c }, law = " + dry(heads) + " }\n";
  return text + "end\n";
}

}  // namespace erbs::test
