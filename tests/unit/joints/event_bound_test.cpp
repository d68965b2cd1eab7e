// Opening and closing of joints: impacts at the default step conserve energy, and shaken structures come to rest.
#include <catch2/catch.hpp>

#include "engine/analysis/start/at_rest.h"
#include "engine/joints/event_bound.h"
#include "engine/solve/energy.h"
#include "engine/solve/step.h"
#include "lua/language/script.h"

using namespace erbs;
using namespace erbs::analysis;
using namespace erbs::lua;

namespace {

struct Ran {
  Prepared run;
  double highest = -1e300;  // m, highest position of the last block above rest
};

Ran ran(const std::string& text, double until) {
  Script script(Script::Options{.quiet = true});
  const Scene scene = script.load_text(text, "event.lua");
  Ran out{prepare(scene, false)};
  start_at_rest(scene, out.run, 1);
  State& s = out.run.state;
  const std::size_t last = std::size_t(out.run.model.nblock - 1);
  Solver solver(out.run.model, out.run.state, out.run.range, 1);
  solver.advance_until([&] {
    out.highest = std::max(out.highest, s.pose.u[last].z());
    return s.time.t >= until;
  });
  return out;
}

std::string with(std::string text, const std::string& key, double value) {
  for (std::size_t at; (at = text.find(key)) != std::string::npos;) text.replace(at, key.size(), std::to_string(value));
  return text;
}

const char* const hop = R"(
  material{name="stone", density=2000}
  box{name="base", size={2,2,.2}, at={0,0,-.2}, fixed=true}
  box{name="b", size={.4,.2,.05}, at={0,0,0}}
  joint{law=dry{kn=KN, mu=.6}}
  ground_motion{wave=half_sine{amplitude=-1.2*g, frequency=10}, direction="z"}
  analysis{duration=1, dt_fraction=FRACTION}
)";

}  // namespace

TEST_CASE("a block that hops on its bed keeps its energy at any step and stiffness", "[solve][event]") {
  const double kn = GENERATE(1e9, 1e11), fraction = GENERATE(0.9, 0.3);
  const Ran one = ran(with(with(hop, "KN", kn), "FRACTION", fraction), 0.3);
  const Energy& e = one.run.state.energy;
  CHECK(e.residual_worst < 1e-3);
  CHECK(e.damping > 0);
  CHECK(one.highest > 2e-4);  // it hops ...
  CHECK(one.highest < 8e-4);  // ... no higher than the base throws it
}

TEST_CASE("dry beds that open in their first swing under a sudden weight keep its energy", "[solve][event]") {
  const double kn = GENERATE(1e9, 1e11), height = GENERATE(0.15, 0.64);
  const int courses = GENERATE(1, 2);
  const std::string scene = R"(
    material{name="stone", density=2000}
    box{name="base", size={4,4,.2}, at={0,0,-.2}, fixed=true}
    for i = 1, COURSES do box{name="b" .. i, size={1,2,HEIGHT}, at={0,0,(i - 1) * HEIGHT}} end
    joint{law=dry{kn=KN, mu=.7}}
    gravity{-.53*g, -.02*g, -.84*g}
    analysis{duration=1, start="rest"})";
  const Ran one = ran(with(with(with(scene, "COURSES", courses), "HEIGHT", height), "KN", kn), 0.5);
  CHECK(one.run.state.energy.residual_worst < 1e-4);  // 3.6e-3 at the step of the whole bed
}

TEST_CASE("a bond that nears its strength in a swing, and holds, leaves the ledger elastic", "[solve][event]") {
  const Ran one = ran(R"(
    material{name="stone", density=2000}
    box{name="base", size={4,4,.2}, at={-2,-2,-.2}, fixed=true}
    box{name="b0", size={.4,.32,.2}, at={-.0185,-.0142,0}}
    box{name="b1", size={.4,.32,.2}, at={.0035,.0186,.2}}
    box{name="b2", size={.4,.32,.2}, at={.0094,-.0072,.4}}
    joint{law=mortar{kn=1e9, ks=4e8, ft=50000, c=75000, mu=.6}}
    ground_motion{wave=half_sine{amplitude=.7374*g, frequency=3.157}, direction={.83,.558,0}}
    analysis{duration=1})",
                      0.5);
  CHECK(one.run.state.observed.joints_broken == 0);
  CHECK(one.run.state.energy.residual_worst < 1e-7);  // 1.1e-6 where the step shrank for a break
}

TEST_CASE("a block that topples falls flat and lies there", "[solve][event]") {
  const std::string bearing = GENERATE("", "pressure=\"points\"", "rule=\"trapezoid\", points=4, pressure=\"points\"");
  CAPTURE(bearing);
  const Ran one = ran(R"(
    material{name="stone", density=2200, friction=.6}
    ground{}
    box{name="b", size={.3,1,1}, at={0,0,0}}
    joint{law=dry{kn=5e9, mu=.6}, )" +
                          bearing +
                          R"(}
    ground_motion{wave=half_sine{amplitude=.6*g, frequency=1}, direction="x"}
    analysis{duration=4}
  )",
                      4);
  const State& s = one.run.state;
  CHECK(s.energy.residual_worst < 1e-3);
  CHECK(s.pose.u[1].z() == Approx(-.35).margin(2e-3));
  CHECK(s.motion.v[1].norm() < 1e-3);
  CHECK(one.highest < 0.03);  // rise over its edge: sqrt(.15^2 + .5^2) - .5
  CHECK(s.energy.contact_damping > 0);
  CHECK(std::fabs(s.energy.reset) < 2e-3 * s.energy.reference);
}

TEST_CASE("plates on a slope come to rest after a bump", "[solve][interlock]") {
  const std::string contact = GENERATE(std::string(""), std::string("free = true, "));
  const Ran one = ran(R"(
    material{name="stone", density=2000, friction=.6, kn=1e11, ks=4e10}
    transform{at={0,0,0}, rotation={0, math.atan(.36), 0}, function()
      box{name="base", size={2,2,.2}, at={0,0,-.2}, fixed=true}
      for i = 1, 8 do box{name="p"..i, )" +
                          contact + R"(size={.4,.2,.05}, at={0,0,(i-1)*.05}} end
    end}
    joint{law=dry{kn=1e11, mu=.6, damping=.1}}
    ground_motion{wave=half_sine{amplitude=-1.2*g, frequency=10, start=.1}, direction="z"}
    analysis{duration=2.2}
  )",
                      1.7);
  Prepared run = one.run;
  const Vec3 before = run.state.pose.u[8];
  const double from = run.state.time.t;
  Solver solver(run.model, run.state, run.range, 1);
  solver.advance_until([&] { return run.state.time.t >= from + 0.5; });
  CHECK((run.state.pose.u[8] - before).norm() / 0.5 < 1e-6 * 0.4);
  CHECK(run.state.energy.residual_worst < 1e-3);
}

TEST_CASE("what comes near is met with as many steps to go, and by as short a step as its energy asks for", "[solve][event]") {
  Script script(Script::Options{.quiet = true});
  const Scene scene = script.load_text(with(with(hop, "KN", 1e10), "FRACTION", 0.9), "event.lua");
  const Prepared run = prepare(scene, false);
  const Joint& joint = run.model.joint.front();
  const double area = 0.08, k = 1e10 * area, rate = 1e-5;
  const double far[6] = {0, 0, 100 * rate, 0, 0, 0}, before[6] = {0, 0, 101 * rate, 0, 0, 0};
  const double errs = std::sqrt(event_share * k * rate * rate / 1e-9);
  REQUIRE(errs > event_steps / 100);
  CHECK(foresee(run.model, joint, before, far, 1e-9) == Approx(event_steps / 100).epsilon(1e-6));
  CHECK(foresee(run.model, joint, before, far, 1e3) == Approx(std::sqrt(event_share * k * rate * rate / 1e3)).epsilon(1e-6));
  CHECK(foresee(run.model, joint, far, before, 1e-9) == 0);  // it moves away
}

namespace {

// A fixed block with so many others on it, one joint each.
Scene pile_of(int blocks) {
  Script script(Script::Options{.quiet = true});
  return script.load_text(fmt::format(R"(
    material{{ name = "stone", density = 2000 }}
    for i = 0, {} do box{{ name = "b" .. i, size = {{.4, .2, .05}}, at = {{0, 0, .05 * i}}, fixed = i == 0 }} end
    joint{{ law = dry{{ kn = 1e9, mu = .6 }} }}
    analysis{{ duration = 1 }})",
                                      blocks),
                          "event.lua");
}

}  // namespace

TEST_CASE("events of a blow may add up to less in a structure of many joints", "[event]") {
  for (const int blocks : {1, 5, 16, 17, 40}) {
    const Scene scene = pile_of(blocks);
    Prepared run = prepare(scene, false);
    INFO(blocks << " joints");
    REQUIRE(run.model.njoint == blocks);
    Energy& e = run.state.energy;
    e.reference = 100;
    const double sum = blocks > few_joints ? blow_sum : event_sum, whole = event_tolerance * e.reference;
    CHECK(event_allowance(run.model, run.state) == Approx(whole));
    for (const double sign : {-1.0, 1.0}) {
      e.event_residual = sign * 0.25 * sum * e.reference;
      CHECK(event_allowance(run.model, run.state) == Approx(0.75 * whole));
      e.event_residual = sign * 2 * sum * e.reference;
      CHECK(event_allowance(run.model, run.state) == Approx(least_allowance * whole));
    }
  }
}

TEST_CASE("a blow of a few blocks may err by a small share of its own energy, one of many by any", "[event]") {
  const auto share = [](int blocks) {
    const Scene scene = pile_of(blocks);
    return blow_share(prepare(scene, false).model);
  };
  CHECK(share(1) == own_share);
  CHECK(share(few_blows) == own_share);
  CHECK(share(few_loose) == Approx(few_loose / few_blows * own_share));
  CHECK(std::isinf(share(few_loose + 1)));
}

// Its budget is back once the blow has passed: what the ledger lost in it fades within some of its steps, however much that was.
TEST_CASE("the residual of a blow fades in a structure of many joints, and stays in one of few", "[solve][event]") {
  for (const int blocks : {4, 20}) {
    const Scene scene = pile_of(blocks);
    Prepared run = prepare(scene, false);
    start_at_rest(scene, run, 1);
    Solver solver(run.model, run.state, run.range, 1);
    solver.advance();
    Energy& e = run.state.energy;
    e.residual += 1, e.start -= 1, e.event_residual = 1;  // J, an error of the past
    const double t = run.state.time.t;
    solver.advance_until([&] { return run.state.time.t > t + 4096 * run.state.time.dt; });
    INFO(blocks << " joints, " << e.event_residual << " J of " << e.residual);
    CHECK(e.residual == Approx(1));
    if (blocks > few_joints) CHECK(e.event_residual < 1e-3);
    else CHECK(e.event_residual == Approx(1));
  }
}
