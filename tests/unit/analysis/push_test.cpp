// Pushes of small structures: capacity, bits of any thread count and of interrupted runs, and wrong input.
#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "engine/base/count.h"
#include "engine/base/units.h"
#include "engine/record/format/csv.h"
#include "tests/unit/analysis/push.h"
#include "tests/unit/record/two_bricks.h"

using namespace erbs;
using namespace erbs::analysis;
using namespace erbs::lua;

using test::push, test::PushOutcome, test::stone, test::text_of;

namespace {

// A dry wall of four courses, which cracks and slides on its way.
const std::string wall_text = stone + R"(
wall{ brick = { length = .4, width = .2, height = .2 }, length = 1.2, courses = 4, joint = 0, at = {-.6, -.1, 0}, material = "stone", quiet = true }
joint{ law = dry{ kn = 1e10, ks = 4e9, mu = .6 } }
)";

}  // namespace

TEST_CASE("a push gives the same bits with any number of threads", "[push]") {
  const std::string text = wall_text + "analysis{ kind = 'pushover', direction = 'y', step = .05, bracket = .05 }";
  const test::Scratch one("push_one"), two("push_two");
  const PushOutcome a = push(text, one.path), b = push(text, two.path, 2);
  CHECK(a.metrics.status == "completed");
  CHECK(a.metrics.capacity->peak.multiplier > 0.2);
  CHECK(a.metrics.state_hash == b.metrics.state_hash);
  CHECK(a.curve == b.curve);
}

TEST_CASE("a push tells once of each joint in which state it cracks, opens and slides", "[push]") {
  std::string mortar = wall_text;
  mortar.replace(mortar.find("mu = .6"), 7, "mu = .6, ft = .02*MPa, c = .03*MPa").replace(mortar.find("dry{"), 4, "mortar{");
  for (const auto& [text, events] : {std::pair{wall_text, std::set<std::string>{"open", "slide"}}, {mortar, {"crack"}}}) {
    const test::Scratch dir("push_events");
    push(text + "analysis{ kind = 'pushover', direction = 'x', step = .05, bracket = .01 }", dir.path);
    const CsvTable table = read_csv(dir.path + "/events.csv"), curve = read_csv(dir.path + "/curve.csv");
    const auto &what = table.text[z(table.find("event"))], &name = table.text[z(table.find("name"))];
    std::set<std::pair<std::string, std::string>> told;
    std::map<std::string, int> count;
    for (std::size_t row = 0; row < what.size(); ++row)
      if (what[row] != "collapse") {
        CHECK(told.emplace(what[row], name[row]).second);
        ++count[what[row]];
      }
    for (const std::string& event : events) CHECK(count[event] > 0);
    const std::vector<double>& opened = curve.columns[z(curve.find("joints_opened"))];
    CHECK(count["open"] >= *std::max_element(opened.begin(), opened.end()));
  }
}

TEST_CASE("an interrupted push that is resumed gives the same curve, to the bit", "[push][resume]") {
  for (const std::string kind :
       {"kind = 'pushover', step = .05, bracket = .05", "kind = 'tilt', step = 4*deg, bracket = .05, path = { -2*deg }",
        "kind = 'pushover', control = 'displacement', displacement = 20*mm, displacement_step = 2*mm"}) {
    CAPTURE(kind);
    const std::string text = wall_text + "analysis{ " + kind + ", direction = 'y' }";
    const test::Scratch whole("push_whole"), parts("push_parts");
    const PushOutcome expected = push(text, whole.path);
    CHECK(expected.metrics.status == "completed");
    Existing existing = Existing::refuse;
    for (const int calls : {3, 90, 200}) {
      const PushOutcome stopped = push(text, parts.path, 1, existing, calls);
      CHECK(stopped.metrics.status == "interrupted");
      existing = Existing::resume;
    }
    const PushOutcome got = push(text, parts.path, 1, Existing::resume);
    CHECK(got.metrics.status == "completed");
    CHECK(got.metrics.state_hash == expected.metrics.state_hash);
    CHECK(got.curve == expected.curve);
    CHECK(got.metrics.equilibrium.iterations == expected.metrics.equilibrium.iterations);
    CHECK(got.metrics.equilibrium.unbalanced == expected.metrics.equilibrium.unbalanced);
    CHECK(got.metrics.capacity->peak.multiplier == expected.metrics.capacity->peak.multiplier);
    for (const char* file : {"/histories.csv", "/events.csv"}) CHECK(text_of(parts.path + file) == text_of(whole.path + file));
  }
}

TEST_CASE("a push that is killed goes on from its last checkpoint, to the bit", "[push][resume]") {
  for (const std::string kind : {"kind = 'pushover', step = .05, bracket = .05",
                                 "kind = 'pushover', control = 'displacement', displacement = 20*mm, displacement_step = 2*mm"}) {
    CAPTURE(kind);
    const std::string text = wall_text + "analysis{ " + kind + ", direction = 'y' }";
    const test::Scratch whole("push_alive"), parts("push_killed");
    const PushOutcome expected = push(text, whole.path, 1, Existing::refuse, -1, parts.path);
    const PushOutcome got = push(text, parts.path, 1, Existing::resume);
    CHECK(got.metrics.state_hash == expected.metrics.state_hash);
    CHECK(got.curve == expected.curve);
  }
}

TEST_CASE("a structure that falls on the way of its path has its capacity there", "[push]") {
  for (const std::string kind :
       {"kind = 'pushover', path = { -1 }, step = .05", "kind = 'tilt', path = { 3*deg, -40*deg }, step = 3*deg"}) {
    CAPTURE(kind);
    const test::Scratch dir("push_back");
    const Capacity got = *push(wall_text + "analysis{ " + kind + ", bracket = .02, direction = 'y' }", dir.path).metrics.capacity;
    REQUIRE(got.above);
    CHECK(got.peak.multiplier < -0.2);
    CHECK(*got.above < got.peak.multiplier);
    CHECK(*got.above > 1.025 * got.peak.multiplier);
    CHECK(got.peak.base_shear < 0);
    // A tilting test is drawn tilting: its gravity is in the histories.
    const CsvTable histories = read_csv(dir.path + "/histories.csv");
    CHECK((histories.find("gravity_ay_m_s2") >= 0) == (kind.find("tilt") != std::string::npos));
  }
}

TEST_CASE("a structure that does not stand has that as its verdict", "[push]") {
  const test::Scratch dir("push_gravity");
  const PushOutcome got = push(stone + R"(
box{ name = "foot", size = {.4, .4, .4}, at = {0, 0, 0} }
box{ name = "overhang", size = {1, .4, .2}, at = {.15, 0, .4} }
joint{ law = dry{ kn = 1e10, ks = 4e9, mu = .6 } }
analysis{ kind = "pushover" })",
                               dir.path);
  CHECK(got.metrics.status == "completed");
  CHECK(got.metrics.capacity->gravity_alone);
  CHECK(got.metrics.collapse.under_gravity);
  CHECK(got.metrics.capacity->peak.multiplier == 0);
  CHECK_FALSE(got.metrics.capacity->mechanism.empty());
}

TEST_CASE("a chip that falls off before the push leaves the rest to be pushed", "[push]") {
  const std::string column = "for i = 0, 4 do box{ name = 'c' .. i, group = 'column', size = {.4, .4, .2}, at = {-.2, -.2, .2 * i} } end ";
  const std::string chip = "box{ name = 'chip', size = {.05, .05, .05}, at = {.2, 0, .85} } ";
  const std::string bottomless =
      "material{ name = 'stone', density = 2000, kn = 1e10, ks = 4e9 } "
      "box{ name = 'floor', size = {.4, .4, .5}, at = {-.2, -.2, -.5}, fixed = true } ";
  for (const std::string kind : {"pushover", "tilt"}) {
    const std::string pushed = "joint{ law = dry{ kn = 1e10, ks = 4e9, mu = .7 } } analysis{ kind = '" + kind + "', fall = 0 }";
    const auto capacity = [&](const std::string& text) {
      const test::Scratch dir("push_chip");
      const PushOutcome got = push(text + pushed, dir.path);
      CHECK(got.metrics.status == "completed");
      CHECK_FALSE(got.metrics.capacity->gravity_alone);
      REQUIRE(got.metrics.capacity->limit);
      CHECK(got.metrics.capacity->limit->dry.stands);
      CHECK_THAT(got.metrics.capacity->mechanism, Catch::StartsWith("overturning"));
      return got.metrics.capacity->peak.multiplier;
    };
    const double alone = capacity(stone + column);
    CHECK(alone == Approx(.4).epsilon(.05));
    CHECK(capacity(stone + column + chip) == Approx(alone).epsilon(1e-3));
    CHECK(capacity(bottomless + column + chip) == Approx(alone).epsilon(1e-3));  // it falls for ever
    const std::string plate = "box{ name = 'plate', size = {.01, .2, .1}, at = {.2, -.1, .02} } ";
    CHECK(capacity(stone + column + plate) == Approx(alone).epsilon(1e-3));  // it stands on edge where it lands
    const std::string high = "box{ name = 'high', size = {.05, .05, .05}, at = {.2, .1, .93} } ";
    CHECK(capacity(stone + column + high) == Approx(alone).epsilon(1e-3));  // the highest block, but not to be monitored
  }
}

TEST_CASE("a push draws no fall where none is wanted, and names the mechanism all the same", "[push]") {
  const auto rows = [&](const std::string& fall) {
    const test::Scratch out("push_fall" + fall);
    const PushOutcome run =
        push(wall_text + "analysis{ kind = 'pushover', direction = 'y', step = .05, bracket = .05, fall = " + fall + " }", out.path);
    CHECK(run.metrics.status == "completed");
    CHECK(run.metrics.capacity->mechanism.find("overturning") != std::string::npos);
    const std::string energy = text_of(out.path + "/energy.csv");
    return std::count(energy.begin(), energy.end(), '\n');
  };
  const auto none = rows("0"), brief = rows(".2"), whole = rows("4");
  CHECK(none < brief);
  CHECK(brief < whole);
}

TEST_CASE("a push beside a fallen chip goes on after a stop, and any relaxation finds its capacity", "[push]") {
  const std::string pier =
      stone +
      "for i = 0, 4 do box{ name = 'c' .. i, group = 'column', size = {.4, .4, .2}, at = {-.2, -.2, .2 * i} } end "
      "box{ name = 'chip', size = {.05, .05, .05}, at = {.2, 0, .85} } joint{ law = dry{ kn = 1e10, ks = 4e9, mu = .7 } } ";
  std::vector<double> capacities;
  for (const std::string how : {"critical", "kinetic", "adaptive", "local"}) {
    const test::Scratch dir("push_chip_" + how);
    capacities.push_back(
        push(pier + "analysis{ kind = 'pushover', fall = 0, relaxation = '" + how + "' }", dir.path).metrics.capacity->peak.multiplier);
    CHECK(capacities.back() == Approx(capacities.front()).epsilon(2e-3));
  }
  for (const std::string control : {"control = 'load'", "control = 'displacement', displacement = 10*mm"}) {
    CAPTURE(control);
    const std::string text = pier + "analysis{ kind = 'pushover', fall = 0, " + control + " }";
    const test::Scratch whole("push_chip_whole"), parts("push_chip_parts");
    const PushOutcome at_once = push(text, whole.path);
    REQUIRE(push(text, parts.path, 1, Existing::refuse, 150).metrics.status == "interrupted");
    const PushOutcome resumed = push(text, parts.path, 1, Existing::resume);
    CHECK(resumed.metrics.status == "completed");
    CHECK(resumed.metrics.state_hash == at_once.metrics.state_hash);
    CHECK(resumed.curve == at_once.curve);
  }
}

TEST_CASE("what does not stand without the push is told after a stop in its fall", "[push][resume]") {
  const std::string late = "box{ name = 'late', size = {.4, .2, .2}, at = {.45, -.1, .8} } ";
  const std::string text = wall_text + late + "analysis{ kind = 'pushover', fall = .3, collapse_fraction = .01 }";
  const test::Scratch whole("push_weight"), parts("push_weight_parts");
  const PushOutcome at_once = push(text, whole.path);
  REQUIRE(push(text, parts.path, 1, Existing::refuse, 20).metrics.status == "interrupted");
  const PushOutcome resumed = push(text, parts.path, 1, Existing::resume);
  CHECK(resumed.metrics.capacity->gravity_alone);
  CHECK(resumed.metrics.collapse.under_gravity);
  CHECK(resumed.metrics.state_hash == at_once.metrics.state_hash);
}

TEST_CASE("a block slides off a tilted table in any direction, at any stiffness", "[push]") {
  for (const std::string direction : {"x", "-x", "y", "-y"})
    for (const std::string kn : {"1e8", "1e9", "1e11"})
      for (const double mu : {.3, .7}) {
        CAPTURE(direction, kn, mu);
        const test::Scratch dir("push_slides");
        const PushOutcome got =
            push(fmt::format("material{{ name = 'm', density = 2000 }} ground{{}} joint{{ law = dry{{ kn = {}, mu = {} }} }} "
                             "box{{ size = {{.3, .2, .1}}, name = 'a' }} analysis{{ kind = 'tilt', direction = '{}' }}",
                             kn, mu, direction),
                 dir.path);
        CHECK(got.metrics.status == "completed");
        CHECK(got.metrics.capacity->peak.multiplier == Approx(mu).epsilon(.01));
      }
}

TEST_CASE("a push keeps its ledger", "[push]") {
  for (const std::string how : {"adaptive", "local", "kinetic"}) {
    const test::Scratch dir("push_ledger");
    const PushOutcome got =
        push(wall_text + "analysis{ kind = 'pushover', direction = 'y', step = .05, bracket = .05, relaxation = '" + how + "' }", dir.path);
    CAPTURE(how);
    CHECK(got.metrics.residual_relative < 5e-3);
    CHECK(got.metrics.diagnostics.energy_residual == got.metrics.residual_relative);
    CHECK(got.metrics.diagnostics.penetration == got.metrics.max_penetration_relative);
    CHECK(std::isnan(got.metrics.diagnostics.warned_share));  // of the steps of a time history
    CHECK(got.metrics.capacity->worst_unbalanced <= 1e-5);
  }
}

TEST_CASE("wrong input of a push is met with its remedy", "[push][bad-input]") {
  const auto says = [](const std::string& analysis, const std::string& part, const std::string& more = "") {
    CAPTURE(analysis, part);
    CHECK(mentions(mistakes_of(wall_text + more + "\nanalysis{ " + analysis + " }"), part));
  };
  says("kind = 'pushover', direction = {0, 0, 0}", "direction");
  says("kind = 'push'", "dynamic");
  says("kind = 'pushover', monitor = { block = 'wal.c04.b01' }", "there is no block \"wal.c04.b01\"; did you mean");
  says("kind = 'pushover', monitor = { block = 'floor' }", "never moves");
  says("kind = 'pushover', monitor = { point = {0, 0, 1} }", "belongs to a block");
  says("kind = 'pushover', monitor = { block = 'wall.c04.b01', point = {5, 0, .7} }",
       "m outside block \"wall.c04.b01\"; give a point of it");
  CHECK(mistakes_of(wall_text + "analysis{ kind = 'pushover', monitor = { block = 'wall.c04.b01', point = {-.6, -.1, .8} } }").empty());
  says("kind = 'pushover', control = 'displacement', displacement = 10*mm, displacement_step = 20*mm", "take a smaller step");
  says("kind = 'pushover', pattern = { { group = 'wall', force = {1, 0, 0} }, { group = 'wall', force = {-1, 0, 0} } }", "cancel");
  says("kind = 'pushover', control = 'displacement'", "displacement = 50*mm");
  says("kind = 'pushover', displacement = .1", "control = \"displacement\"");
  says("kind = 'pushover', pattern = { { block = 'nobody', force = {1, 0, 0} } }", "there is no block \"nobody\"");
  says("kind = 'pushover', pattern = { { group = 'walls', force = {1, 0, 0} } }", "no free blocks; did you mean \"wall\"");
  says("kind = 'pushover', pattern = { { force = {1, 0, 0} } }", "one block, or one group");
  says("kind = 'pushover', pattern = { { group = 'wall', force = {0, 0, 0} } }", "no length");
  says("kind = 'pushover', duration = 3", "leave duration out");
  says("kind = 'pushover', levels = 2", "one time level");
  says("kind = 'pushover', path = { 3 }", "beyond up_to");
  says("kind = 'tilt', direction = 'z'", "horizontal");
  says("kind = 'tilt', up_to = 91*deg", "89*deg at most");
  says("kind = 'tilt', pattern = { { group = 'wall', force = {1, 0, 0} } }", "takes no pattern");
  says("kind = 'tilt'", "there is none; add gravity", "gravity(0)");
  says("kind = 'pushover'", "remove this load", "ground_motion{ wave = sine{ amplitude = 1, frequency = 1 } }");
  says("duration = 1, direction = 'y'", "belongs to a push");
}

TEST_CASE("a push of blocks that are all fixed says so", "[push][bad-input]") {
  const test::Scratch dir("push_fixed");
  CHECK_THROWS_WITH(push(stone + "analysis{ kind = 'pushover' }", dir.path), Catch::Contains("every block is fixed"));
}

TEST_CASE("a part that rests on nothing is named before the push", "[push][bad-input]") {
  const test::Scratch dir("push_floating");
  CHECK_THROWS_WITH(push(stone + "box{ name = 'moon', size = {.2, .2, .2}, at = {0, 0, 1} } analysis{ kind = 'pushover' }", dir.path),
                    Catch::Contains("moon"));
}

TEST_CASE("limit analysis stands beside the capacity of a push", "[push][limit]") {
  // A block 0.4 x 0.4 x 1 m overturns about its toe at 0.4, or slides at mu.
  for (const double mu : {0.3, 0.7})
    for (const std::string bond : {"dry{", "mortar{ ft = 1e5, c = 1e5,"}) {
      const std::string text = stone + "box{ name = 'pier', size = {.4, .4, 1}, at = {-.2, -.2, 0} }" +
                               fmt::format("joint{{ law = {} kn = 1e11, ks = 4e10, mu = {} }} }}", bond, mu) +
                               "analysis{ kind = 'pushover', step = .1, bracket = .01, up_to = 4 }";
      CAPTURE(text);
      const test::Scratch folder("push_limit");
      const Capacity c = *push(text, folder.path).metrics.capacity;
      REQUIRE(c.limit.has_value());
      const double dry = std::min(0.4, mu);
      CHECK(c.limit->dry.stands);
      CHECK(c.limit->dry.lower <= Approx(dry).epsilon(1e-3));
      CHECK(c.limit->dry.upper == Approx(dry).epsilon(1e-3));
      CHECK(c.limit->bonded.has_value() == (bond != "dry{"));
      if (c.limit->bonded) CHECK(c.limit->bonded->lower > dry);
      else CHECK(c.peak.multiplier == Approx(dry).epsilon(0.03));
    }
  const test::Scratch folder("push_limit");
  CHECK_FALSE(push(wall_text + "analysis{ kind = 'pushover', up_to = .02, limit = 'never' }", folder.path).metrics.capacity->limit);
}
