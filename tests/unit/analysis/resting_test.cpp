// Blocks that lie on a structure without a joint are named: a start from equilibrium does not know their weight.
#include <catch2/catch.hpp>

#include "engine/analysis/prepare.h"
#include "engine/analysis/resting.h"
#include "lua/language/script.h"

using namespace erbs;
using namespace erbs::analysis;

namespace {

// Two mortared piers; `more` follows.
std::vector<std::string> warnings_of(const std::string& more) {
  lua::Script script(lua::Script::Options{.quiet = true});
  const Scene scene = script.load_text(
      "material{ name = 'stone', density = 2000 } ground{ size = 9 } joint{ law = mortar{ kn = 1e10, ft = .2*MPa, c = .3*MPa, mu = .6 } }"
      "for p, x in ipairs{ 0, 2 } do for i = 0, 2 do box{ name = 'p' .. p .. i, size = { .3, .3, .2 }, at = { x, 0, .2 * i } } end end "
      "analysis{ duration = .1 } joint{ between = { 'loose', '' }, none = true } " +
          more,
      "piers.lua", {});
  Prepared run = prepare(scene, false);
  start_at_rest(scene, run, 1);
  return run.warnings;
}

std::size_t named(const std::vector<std::string>& warnings) {
  return std::size_t(std::ranges::count_if(warnings, [](const std::string& w) { return w.find("rests on the structure") < w.size(); }));
}

}  // namespace

TEST_CASE("a free slab on two piers is named with the remedy", "[analysis]") {
  const auto warnings = warnings_of("box{ name = 'slab', size = { 2.3, .3, .2 }, at = { 0, 0, .6 }, group = 'loose', free = true }");
  REQUIRE(named(warnings) == 1);
  CHECK(warnings.back().find("slab") < warnings.back().size());
  CHECK(warnings.back().find("start = \"ramp\"") < warnings.back().size());
}

TEST_CASE("turned blocks, wedges and blocks that start elsewhere are judged where they are", "[analysis]") {
  const std::string cap = "box{ name = 'cap', size = { .2, .2, .1 }, at = { .05, .05, .6 }, group = 'loose', free = true";
  for (const char* turn : {"0", "30*deg", "77*deg"})
    CHECK(named(warnings_of("transform{ at = { 4, 0, 0 }, rotation = { 0, 0, " + std::string(turn) + " }, function() " +
                            "box{ name = 'foot', size = { .3, .3, .6 }, at = { 0, 0, 0 } } " + cap + " } end }")) == 1);
  CHECK(named(warnings_of(cap + ", initial = { rotation = { 0, 0, .7 } } }")) == 1);
  CHECK(named(warnings_of(cap + ", initial = { position = { 0, 0, .3 } } }")) == 0);
  CHECK(named(warnings_of(cap + ", initial = { position = { 1, 0, 0 } } }")) == 0);
}

TEST_CASE("blocks that do not rest on the structure are not named", "[analysis]") {
  CHECK(named(warnings_of("box{ name = 'slab', size = { 2.3, .3, .2 }, at = { 0, 0, .6 } } box{ name = 'l', size = { .1, .1, .1 }, at = { "
                          "5, 0, 0 }, group = 'loose', free = true }")) == 0);  // joined
  CHECK(named(warnings_of("box{ name = 'beside', size = { .3, .3, .2 }, at = { .3, 0, 0 }, group = 'loose', free = true }")) ==
        0);  // stands beside
  CHECK(named(warnings_of("box{ name = 'above', size = { .3, .3, .2 }, at = { 0, 0, .7 }, group = 'loose', free = true }")) ==
        0);  // falls from above
  CHECK(named(warnings_of("box{ name = 'apart', size = { .3, .3, .2 }, at = { 5, 0, 0 }, group = 'loose', free = true }")) ==
        0);  // on the ground
  CHECK(named(warnings_of("box{ name = 's', size = { .3, .3, .2 }, at = { 0, 0, .6 }, group = 'loose', free = true } gravity(0)")) == 0);
  CHECK(named(warnings_of(
            "box{ name = 's', size = { .3, .3, .2 }, at = { 0, 0, .6 }, group = 'loose', free = true } analysis{ start = 'ramp' }")) == 0);
}
