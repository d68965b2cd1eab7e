// What lies on a structure without a joint is at rest on it from the start; what does not stay there is named.
#include <catch2/catch.hpp>

#include "engine/analysis/start/at_rest.h"
#include "engine/solve/step.h"
#include "lua/language/script.h"

using namespace erbs;
using namespace erbs::analysis;

namespace {

// Two mortared piers; `more` follows.
Prepared started(const std::string& more) {
  lua::Script script(lua::Script::Options{.quiet = true});
  const Scene scene = script.load_text(
      "material{ name = 'stone', density = 2000 } ground{ size = 9 } joint{ law = mortar{ kn = 1e10, ft = .2*MPa, c = .3*MPa, mu = .6 } }"
      "for p, x in ipairs{ 0, 2 } do for i = 0, 2 do box{ name = 'p' .. p .. i, size = { .3, .3, .2 }, at = { x, 0, .2 * i } } end end "
      "analysis{ duration = .1 } joint{ between = { 'loose', '' }, none = true } joint{ between = { 'loose', 'loose' }, none = true } " +
          more,
      "piers.lua", {});
  Prepared run = prepare(scene, false);
  start_at_rest(scene, run, 1);
  return run;
}

std::string with(const std::vector<std::string>& lines, const std::string& words) {
  const auto found = std::ranges::find_if(lines, [&](const std::string& line) { return line.find(words) < line.size(); });
  return found == lines.end() ? "" : *found;
}
std::string at_rest(const Prepared& run) { return with(run.notes, "at rest on the structure"); }
std::string at_once(const Prepared& run) { return with(run.warnings, "its weight at once"); }
bool rests(const std::string& more) { return !at_rest(started(more)).empty(); }

// The longest way in the run over the longest to its start.
double moves(Prepared& run) {
  const BlockVec3 start = run.state.pose.u;
  Solver solver(run.model, run.state, run.range, 1);
  solver.advance_until([&] { return run.state.time.t >= 0.05; });
  double way = 0, size = 0;
  for (std::size_t b = 0; b < std::size_t(run.model.nblock); ++b)
    way = std::max(way, (run.state.pose.u[b] - start[b]).norm()), size = std::max(size, start[b].norm());
  return way / size;
}

std::string loose(const std::string& name, const std::string& size, const std::string& at) {
  return "box{ name = '" + name + "', size = { " + size + " }, at = { " + at + " }, group = 'loose', free = true } ";
}

}  // namespace

TEST_CASE("a free slab on two piers weighs upon them from the start", "[analysis]") {
  Prepared run = started(loose("slab", "2.3, .3, .2", "0, 0, .6") + loose("on_it", ".2, .2, .2", "1, 0, .8"));
  CHECK(at_rest(run) == "at rest on the structure without a joint: slab, on_it");
  CHECK(at_once(run) == "");
  CHECK(run.state.time.t == 0);
  CHECK(moves(run) < 1e-3);
}

TEST_CASE("what topples off a structure does so in the run, beside what stays", "[analysis]") {
  const Prepared run = started(loose("over", "1, .3, .1", "-.8, 0, .6") + loose("stays", ".3, .3, .1", "2, 0, .6"));
  CHECK(at_rest(run) == "at rest on the structure without a joint: stays");
  CHECK(at_once(run).find(": over") < at_once(run).size());
  CHECK(run.state.pose.u[std::size_t(run.model.nblock - 2)].norm() < 1e-5);  // where it was built
  CHECK(run.fallers.empty());
}

TEST_CASE("a structure that does not bear what lies on it falls in the run", "[analysis]") {
  // Its bed is pulled by 126 kPa without the weight, by 267 kPa with it, and bears 200 kPa.
  const std::string console = "box{ name = 'console', size = { 1.2, .3, .2 }, at = { 0, 0, .6 } } ";
  const Prepared run = started(console + loose("weight", ".2, .3, .6", "1, 0, .8") + loose("stays", ".3, .3, .1", "2, 0, .6"));
  CHECK(at_rest(run) == "at rest on the structure without a joint: stays");
  CHECK(at_once(run).find(": weight") < at_once(run).size());
}

TEST_CASE("a soft pier that leans carries what lies on it along", "[analysis]") {
  Prepared run = started(
      "joint{ between = { 'soft', '' }, law = mortar{ kn = 2e8, ft = 1e9, c = 1e9, mu = .6 } } "
      "transform{ at = { 0, 3, 1 }, rotation = { 0, .3, 0 }, function() box{ name = 'foot', size = { 1, 1, .2 }, at = { 0, 0, -.2 }, fixed "
      "= "
      "true } for i = 0, 9 do box{ name = 's' .. i, size = { 1, 1, .5 }, at = { 0, 0, .5 * i }, group = 'soft' } end "
      "box{ name = 'cap', size = { 1, 1, .02 }, at = { 0, 0, 5 }, group = 'loose', free = true } end } "
      "joint{ between = { 'loose', '' }, none = true } joint{ between = { 'loose', 'soft' }, none = true }");
  CHECK(at_rest(run) == "at rest on the structure without a joint: cap");
  const auto place = [&](int b) -> Vec3 { return run.model.rest[std::size_t(b)] + run.state.pose.u[std::size_t(b)]; };
  const int cap = run.model.nblock - 1;
  CHECK(run.state.pose.u[std::size_t(cap)].norm() > 0.02);  // as much as the thickness of the cap
  const Vec3 seen = Quat(run.state.pose.q[std::size_t(cap - 1)]).conjugate() * (place(cap) - place(cap - 1));
  const Vec3 built = run.model.rest[std::size_t(cap)] - run.model.rest[std::size_t(cap - 1)];
  CHECK((seen - built).norm() < 1e-3 * 0.02);
}

TEST_CASE("a plank that stands on one island and leans on another presses both from the start", "[analysis]") {
  Prepared run = started(
      "box{ name = 'base', size = { 1.95, 1, .3 }, at = { 0, 2, 0 } } box{ name = 'wall', size = { .3, 1, 2 }, at = { 2, 2, 0 } } "
      "prism{ name = 'plank', group = 'loose', free = true, axis = 'y', at = { 0, 2.2, 0 }, height = .6, polygon = { { .3, 1.36607260739 "
      "}, { "
      "1.65946168055, 2 }, { 1.72285441982, 1.86405383194 }, { .363392739261, 1.23012643933 } } } ");
  CHECK(at_rest(run) == "at rest on the structure without a joint: plank");
  CHECK(moves(run) < 1e-3);
}

TEST_CASE("a structure that only a loose prop bears stands on it from the start", "[analysis]") {
  Prepared run = started(
      "box{ name = 'beam', size = { 1.6, .3, .2 }, at = { 0, 0, .6 }, group = 'beam' } joint{ between = { 'beam', '' }, law = dry{ kn = "
      "1e10, mu = .6 } } " +
      loose("prop", ".2, .3, .6", "1.4, 0, 0") +
      "joint{ between = { 'loose', '' }, none = true } joint{ between = { 'loose', 'beam' }, none = true }");
  CHECK(with(run.warnings, "not at rest") == "");
  CHECK(at_once(run) == "");
  CHECK(moves(run) < 0.01);
}

TEST_CASE("nobody is asleep when a run begins", "[analysis][sleep]") {
  // The ramp waits for a block that slides, while the cap lies still.
  const std::string slide =
      "transform{ at = { 0, 3, 1 }, rotation = { 0, 35*deg, 0 }, function() box{ name = 'slope', size = { 3, 1, .2 }, "
      "at = { 0, 0, -.2 }, fixed = true } " +
      loose("slides", ".3, .3, .3", "0, .3, 0") + "end } joint{ between = { 'loose', '' }, none = true } ";
  const Prepared run = started(slide + loose("cap", ".3, .3, .1", "2, 0, .6") + "analysis{ start = 'ramp', sleep = true }");
  CHECK(with(run.warnings, "not at rest under its own weight: slides") != "");
  CHECK(run.state.sleep.count == 0);
}

TEST_CASE("what topples before the run is named, wherever it comes to lie", "[analysis]") {
  const Prepared run = started(
      "box{ name = 'tips', size = { 1, .3, .2 }, at = { 0, 0, .6 }, group = 'tips' } joint{ between = { 'tips', '' }, law = dry{ kn = "
      "1e10, mu "
      "= .9 } } ");
  CHECK(with(run.warnings, "not at rest under its own weight").find("tips") != std::string::npos);
}

TEST_CASE("turned blocks, wedges and blocks that start elsewhere are judged where they are", "[analysis]") {
  const std::string cap = "box{ name = 'cap', size = { .2, .2, .1 }, at = { .05, .05, .6 }, group = 'loose', free = true";
  for (const char* turn : {"0", "30*deg", "77*deg"})
    CHECK(rests("transform{ at = { 4, 0, 0 }, rotation = { 0, 0, " + std::string(turn) + " }, function() " +
                "box{ name = 'foot', size = { .3, .3, .6 }, at = { 0, 0, 0 } } " + cap + " } end }"));
  CHECK(rests(cap + ", initial = { rotation = { 0, 0, .7 } } }"));
  CHECK_FALSE(rests(cap + ", initial = { position = { 0, 0, .3 } } }"));
  CHECK_FALSE(rests(cap + ", initial = { position = { 1, 0, 0 } } }"));
  CHECK_FALSE(rests(cap + ", initial = { velocity = { 0, 0, 1 } } }"));
}

TEST_CASE("blocks that do not lie on the structure start as they are", "[analysis]") {
  const std::string slab = loose("slab", ".3, .3, .2", "0, 0, .6");
  CHECK(rests(slab));
  CHECK_FALSE(rests("box{ name = 'slab', size = { 2.3, .3, .2 }, at = { 0, 0, .6 } } " + loose("l", ".1, .1, .1", "5, 0, 0")));  // joined
  CHECK_FALSE(rests(loose("beside", ".3, .3, .2", ".3, 0, 0")));
  CHECK_FALSE(rests(loose("above", ".3, .3, .2", "0, 0, .7")));
  CHECK_FALSE(rests(loose("on_the_ground", ".3, .3, .2", "5, 0, 0")));
  CHECK_FALSE(rests(slab + "gravity(0)"));
  for (const char* analysis : {"start = 'ramp'", "start = 'rest'"}) CHECK_FALSE(rests(slab + "analysis{ " + analysis + " }"));
}
