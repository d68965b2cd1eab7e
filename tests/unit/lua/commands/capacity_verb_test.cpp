// The performance point of a pushover: of the spectrum of its scene, of another one by erbs capacity, and what is refused.
#include <catch2/catch.hpp>
#include <cmath>

#include "engine/base/units.h"
#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;
namespace fs = std::filesystem;

namespace {

// A block of 800 kg that slides on a bed of 4 m2 and 50 kPa/m: it yields at 0.3 g, and has a period of 0.397 s. Shear along y.
const std::string sliding_block = R"(
material { name = "stone", density = 2000, kn = 1e9, ks = 1e9, friction = 1 }
box { name = "floor", size = { 6, 6, 0.5 }, at = { -3, -3, -0.5 }, fixed = true }
box { name = "block", group = "top", size = { 2, 2, 0.1 }, at = { -1, -1, 0 } }
joint { law = dry { kn = 1e9, ks = 5e4, mu = 0.3 } }
)";
const std::string push =
    sliding_block + "analysis { kind = 'pushover', direction = 'y', control = 'displacement', displacement = 30*mm }\n";
const std::string load = sliding_block + "analysis { kind = 'pushover', direction = 'y', step = 0.07, bracket = 0.05 }\n";

const double mass = 800, period = 2 * pi * std::sqrt(mass / 2e5), yield = 0.3 * standard_g;

double number(const Json& json, const char* key) {
  const Json* value = find_key(json, key);
  return value && value->is_number() ? value->get<double>() : NAN;
}

}  // namespace

TEST_CASE("a pushover with a spectrum has its performance point", "[capacity][program]") {
  Bench bench;
  REQUIRE(bench.run(push + "spectrum { kind = 'EN 1998-1 type 1', ground = 'B', ag = 0.15*g }") == 0);
  CHECK(contains(bench.said, "performance point for EN 1998-1 type 1, ground B, ag = 0.15 g; Gamma 1"));
  CHECK(contains(bench.said, "within the curve"));
  const Json p = *find_key(read_json(bench.out() + "/metrics.json"), "capacity.performance");
  const double demand = 2.5 * 1.2 * 0.15 * standard_g, q = demand / yield, elastic = demand * std::pow(period / (2 * pi), 2);
  const double target = elastic / q * (1 + (q - 1) * 0.5 / period);
  for (const std::string variant : {"n2.", "mpp."}) {
    CHECK(number(p, (variant + "period_s").c_str()) == Approx(period).epsilon(5e-3));
    CHECK(number(p, (variant + "q").c_str()) == Approx(q).epsilon(2e-3));
    CHECK(number(p, (variant + "displacement_m").c_str()) == Approx(target).epsilon(5e-3));
    CHECK(number(p, (variant + "base_shear_N").c_str()) == Approx(mass * yield).epsilon(2e-3));
    CHECK(number(p, (variant + "mass_kg").c_str()) == Approx(mass));
    CHECK(number(p, (variant + "multiplier").c_str()) == Approx(0.3).epsilon(2e-3));
    CHECK(std::abs(number(p, (variant + "nearest_displacement_m").c_str()) - target) < 0.6e-3);
  }
  for (const char* file : {"shape.csv", "performance.json", "performance.svg"}) CHECK(fs::exists(bench.out() + "/" + file));
  CHECK(contains(text_of(bench.out() + "/performance.svg"), "T* = 0.39"));

  // Another spectrum, without another push: what the run has written stays.
  const std::string before = text_of(bench.out() + "/metrics.json"), own = text_of(bench.out() + "/performance.json");
  REQUIRE(bench.erbs({"capacity", bench.out(), "kind = 'TBSC 2018', SDS = 0.2, SD1 = 0.1"}) == 0);
  CHECK(contains(bench.said, "TBSC 2018, SDS = 0.2, SD1 = 0.1"));
  const double soft = 0.2 * standard_g * std::pow(period / (2 * pi), 2);  // q = 2/3
  const std::string other = bench.out() + "/performance_tbsc_2018_sds_0.2_sd1_0.1";
  CHECK(contains(bench.said, "results in " + other + ".json and " + other + ".svg"));
  CHECK(number(read_json(other + ".json"), "n2.target_m") == Approx(soft).epsilon(5e-3));
  CHECK(contains(text_of(other + ".svg"), "T* = 0.39"));
  CHECK(text_of(bench.out() + "/metrics.json") == before);
  CHECK(text_of(bench.out() + "/performance.json") == own);
  REQUIRE(bench.erbs({"capacity", bench.out()}) == 0);
  CHECK(contains(bench.said, "EN 1998-1 type 1"));
  REQUIRE(bench.erbs({"capacity", bench.out(), "table = { { T = 0, Sa = 9*g }, { T = 3, Sa = 9*g } }, TC = 0.3", "--no-figures"}) == 0);
  CHECK(contains(bench.said, "the demand exceeds the capacity"));
  CHECK(bench.erbs({"capacity", bench.out(), "kind = 'TBSC 2018', SDS = 0.2, SD1 = 0.1"}) == 2);
  CHECK(contains(bench.said, "exists already; --force"));
  const std::string named = (bench.folder / "named.json").string();
  REQUIRE(bench.erbs({"capacity", bench.out(), "kind = 'TBSC 2018', SDS = 0.2, SD1 = 0.1", "-q", "-o", named, "--no-figures"}) == 0);
  CHECK(bench.said.empty());
  CHECK(text_of(named) == text_of(other + ".json"));

  // The push to that displacement ends there.
  REQUIRE(bench.erbs({"run", bench.scene(push), "-o", bench.out() + "/there", "--push-to", fmt::format("{}", target), "--no-figures"}) ==
          0);
  const CsvTable there = read_csv(bench.out() + "/there/curve.csv");
  CHECK(there.column("displacement_m").back() == Approx(target).epsilon(1.1e-3));
}

TEST_CASE("a push without gravity says its base shear in newtons", "[capacity][program]") {
  Bench bench;
  REQUIRE(bench.run(four_bricks() + "gravity(0) joint{ law = mortar{ kn = 1e10, ft = 1e5, c = 2e5, mu = .6 } }\n"
                                    "analysis{ kind = 'pushover', up_to = .1, step = .1, limit = 'never' }",
                    {"--no-figures"}) == 0);
  INFO(bench.said);
  CHECK(contains(bench.said, " kN, 0 joints opened"));
  CHECK_FALSE(contains(bench.said, "of the weight"));
  CHECK(read_json(bench.out() + "/metrics.json")["capacity"]["base_shear_over_weight"].is_null());
}

TEST_CASE("a push by load ends at its peak, and so does its curve", "[capacity][program]") {
  Bench bench;
  REQUIRE(bench.run(load + "spectrum { kind = 'EN 1998-1 type 1', ground = 'B', ag = 0.05*g }", {"--no-figures"}) == 0);
  const Json within = *find_key(read_json(bench.out() + "/metrics.json"), "capacity.performance.n2");
  CHECK(within["within_curve"] == true);
  CHECK(number(within, "displacement_m") == Approx(2.5 * 1.2 * 0.05 * standard_g * std::pow(period / (2 * pi), 2)).epsilon(5e-3));
  CHECK_FALSE(fs::exists(bench.out() + "/performance.svg"));
  REQUIRE(bench.erbs({"capacity", bench.out(), "kind = 'EN 1998-1 type 1', ground = 'B', ag = 0.2*g", "--no-figures"}) == 0);
  CHECK(contains(bench.said, "the demand exceeds the capacity"));
}

TEST_CASE("a spectrum that ends too early is no failure of the run", "[capacity][program]") {
  Bench bench;
  REQUIRE(bench.run(load + "spectrum { table = { { T = 0, Sa = 1 }, { T = 0.2, Sa = 1 } }, TC = 0.1 }") == 0);
  CHECK(contains(bench.said, "no performance point"));
  CHECK(contains(bench.said, "add rows"));
  const Json p = *find_key(read_json(bench.out() + "/metrics.json"), "capacity.performance");
  CHECK(contains(p["trouble"].get<std::string>(), "beyond the last row"));
  CHECK(p["n2"]["target_m"].is_null());
}

TEST_CASE("mistakes of a spectrum are met with place and remedy", "[capacity][bad_input]") {
  const auto says = [&](const std::string& piece, const std::string& part) {
    INFO(piece << " -> " << part);
    const auto all = mistakes_of(sliding_block + piece);
    for (const std::string& one : all) INFO(one);
    CHECK(mentions(all, part));
    CHECK(mentions(all, "scene.lua:"));
  };
  const std::string pushes = "analysis { kind = 'pushover' }\n";
  says(pushes + "spectrum { kind = 'EN 1998-1 type 1', ground = 'B', ag = 2, TB = 0.7 }", "TB = 0.7 s, TC = 0.5 s");
  says(pushes + "spectrum { kind = 'EN 1998-1 type 1', ground = 'F', ag = 2 }", "\"F\" is not one of A, B, C, D, E");
  says(pushes + "spectrum { kind = 'EN 1998-1', ground = 'B', ag = 2 }", "is not one of EN 1998-1 type 1");
  says(pushes + "spectrum { ground = 'B', ag = 2 }", "there is no spectrum");
  says(pushes + "spectrum { kind = 'TBSC 2018', SDS = 0.9*g, SD1 = 0.3 }", "SDS = 8.8");
  says(pushes + "spectrum { kind = 'TBSC 2018', SDS = 0.9, SD1 = 0.3, group = 'tip' }", "group \"tip\" has no free blocks");
  says(pushes + "spectrum { kind = 'TBSC 2018', SDS = 0.9, SD1 = 0.3, blocks = { 'blok' } }",
       "there is no block \"blok\"; did you mean \"block\"?");
  says(pushes + "spectrum { kind = 'TBSC 2018', SDS = 0.9, SD1 = 0.3, blocks = { 'floor' } }", "none of its blocks moves");
  says(pushes + "spectrum { kind = 'TBSC 2018', SDS = 0.9, SD1 = 0.3, blocks = { 'block' }, group = 'tip' }", "not both");
  says(pushes + "spectrum { table = { { T = 0, Sa = 1 }, { T = 0.5, Sa = 2 }, { T = 0.4, Sa = 1 } }, TC = 0.2 }", "growing order");
  says(pushes + "spectrum { table = { { 0, 1 } } }", "\"T\" is missing");
  says(pushes + "spectrum { table = { { T = 0, Sa = 1 }, { T = 2, Sa = 1 } } }", "add TC");
  says(pushes + "spectrum { kind = 'TBSC 2018', SDS = 0.9, SD1 = 0.3 } spectrum { kind = 'TBSC 2018', SDS = 0.9, SD1 = 0.3 }", "keep one");
  says("analysis { duration = 1 } spectrum { kind = 'TBSC 2018', SDS = 0.9, SD1 = 0.3 }", "take analysis{ kind = \"pushover\" }");
  says("analysis { kind = 'tilt' } spectrum { kind = 'TBSC 2018', SDS = 0.9, SD1 = 0.3 }", "curve of a pushover");
  says("analysis { kind = 'pushover', direction = { 0, 0, 0 } }", "has no length");
  says("analysis { kind = 'pushover', monitor = { block = 'blok' } }", "there is no block \"blok\"; did you mean \"block\"?");
}

TEST_CASE("erbs capacity refuses what it cannot evaluate", "[capacity][program][bad_input]") {
  Bench bench;
  const std::string keys = "kind = 'TBSC 2018', SDS = 0.9, SD1 = 0.3";
  CHECK(bench.erbs({"capacity"}) == 2);
  CHECK(bench.erbs({"capacity", bench.out(), keys}) == 2);
  CHECK(contains(bench.said, "is no run folder"));
  REQUIRE(bench.run(sliding_block + "analysis { duration = 0.01 }", {"--no-figures"}) == 0);
  for (const auto& words : {std::vector<std::string>{"capacity", bench.out()}, {"capacity", bench.out(), keys}}) {
    CHECK(bench.erbs(words) == 2);
    CHECK(contains(bench.said, "this run is a time history; run its scene with analysis{ kind = \"pushover\" }"));
  }
  REQUIRE(bench.run(load, {"--no-figures", "--force"}) == 0);
  CHECK(bench.erbs({"capacity", bench.out()}) == 2);
  CHECK(contains(bench.said, "this run has no performance point of its own"));
  CHECK(bench.erbs({"capacity", bench.out(), keys + ", TD = 2"}) == 2);
  CHECK(contains(bench.said, "TD belongs to kind"));
  CHECK(bench.erbs({"capacity", bench.out(), "kind = 'TBSC 2018' SDS"}) == 2);
  CHECK(contains(bench.said, "spectrum:1"));
  CHECK(bench.erbs({"capacity", bench.out(), keys + ", group = 'tip'"}) == 2);
  CHECK(contains(bench.said, "group \"tip\" has no blocks"));
  CHECK(bench.erbs({"capacity", bench.out(), "kind = 'TBSC 2018', SDS = 0.9, SD2 = 0.3"}) == 2);
  CHECK(contains(bench.said, "unknown key \"SD2\"; did you mean \"SD"));
  CHECK(bench.erbs({"run", bench.scene(sliding_block + "analysis { duration = 0.01 }"), "-o", bench.out() + "2", "--push-to", "0.01"}) ==
        2);
  CHECK(contains(bench.said, "--push-to is a displacement of a pushover"));
}

TEST_CASE("the summary of a push speaks of the kind that --set says", "[capacity][program]") {
  Bench bench;
  CHECK(bench.run(load, {"--set", "kind=tilt"}) == 0);
  INFO(bench.said);
  CHECK(contains(bench.said, "tilts to 16."));  // atan .3 = 16.7 degrees
  CHECK_FALSE(contains(bench.said, "capacity 0."));
}
