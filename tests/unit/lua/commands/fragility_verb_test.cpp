// The fragility of a study as a user calls it: the same tables for any number of runs at once, after an interruption and by bisection.
#include <catch2/catch.hpp>
#include <cmath>

#include "engine/record/format/csv.h"
#include "tests/unit/lua/commands/study_bench.h"

using namespace erbs;
using namespace erbs::lua;

namespace {

// Twelve cases with capacities 1.5 e^(.4 z), z the quantiles of the normal law at (seed - .5) / 12.
const std::string fragile_block = R"(
local z = { -1.732, -1.150, -.812, -.549, -.319, -.105, .105, .319, .549, .812, 1.150, 1.732 }
local pga, seed = param("pga", 1, "[m/s2]"), param("seed", 1)
local capacity = 1.5 * math.exp(.4 * z[seed])
material{ name = "stone", density = 2000 }
box{ name = "b", size = { .3, .3, 1 }, at = { 0, 0, 5 }, free = true, material = "stone" }
analysis{ duration = .002, start = "rest", stop_after_collapse = 1e6 }
metric("fell", "", function() return pga > capacity and 1 or 0 end)
metric("drift", "", function() return .1 * pga / capacity end)
)";

struct FragilityStudy : test::StudyBench {
  FragilityStudy() : StudyBench(fragile_block) {}
  std::string tables(const std::string& directory = "") const {
    std::string all;
    for (const char* file : {"fragility.csv", "stripes.csv", "fractiles.csv"})
      all += text_of((directory.empty() ? out() : directory) + "/" + file);
    return all;
  }
};

const std::string stripes = R"(study{ scene = "tiny.lua", keep = "none", collect = { "metrics.drift" },
  vary = { grid{ seed = { 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12 }, pga = { .6, 1, 1.4, 1.9, 2.5 } } },
  fragility = { im = "pga", collapse = "metrics.fell", damage = { "metrics.drift" } } })";

}  // namespace

TEST_CASE("a study gives its fragility, the same for any number of runs at once and after a stop", "[sweep][fragility]") {
  FragilityStudy study;
  REQUIRE(study.sweep(stripes, {"-j", "3"}) == 0);
  const std::string first = study.tables();
  const CsvTable table = read_csv(study.out() + "/fragility.csv");
  REQUIRE(table.rows() == 2);
  CHECK(table.column("theta_pga_m_s2")[0] == Approx(1.5).epsilon(0.1));
  CHECK(table.column("beta")[0] == Approx(0.4).epsilon(0.25));
  CHECK(table.column("observations")[0] == 12);
  CHECK(table.column("observations")[1] == 60);
  CHECK(std::filesystem::exists(study.out() + "/fragility.svg"));
  CHECK(std::filesystem::exists(study.out() + "/ida.png"));
  const std::string other = (study.folder / "other").string();
  REQUIRE(study.sweep(stripes, {"-j", "1"}, other) == 0);
  CHECK(study.tables(other) == first);
  // Rows of an unfinished study: the second half is missing, and comes by --resume.
  for (const char* file : {"/results.csv", "/runs.csv"}) {
    const std::string text = text_of(other + file);
    std::ofstream(other + file) << text.substr(0, text.find('\n', text.size() / 2) + 1);
  }
  std::filesystem::remove(other + "/fragility.csv");
  REQUIRE(study.sweep(stripes, {"-j", "2", "--resume"}, other) == 0);
  CHECK(study.tables(other) == first);
}

TEST_CASE("capacities by bisection give the moments of their logarithms", "[sweep][fragility]") {
  FragilityStudy study;
  REQUIRE(study.sweep(R"(study{ scene = "tiny.lua", keep = "none", vary = { grid{ seed = { 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12 } } },
    bisect = { param = "pga", lo = .1, hi = 2.2, rel = .01, key = "metrics.fell" }, fragility = { im = "pga" } })") == 0);
  const CsvTable table = read_csv(study.out() + "/fragility.csv");
  REQUIRE(table.rows() == 1);
  // 1.5 e^(.4 1.15) = 2.38 and 1.5 e^(.4 1.732) never fall below 2.2: ten of twelve are seen.
  CHECK(table.column("collapsed")[0] == 10);
  CHECK(table.column("theta_pga_m_s2")[0] == Approx(1.5).epsilon(0.05));
  CHECK(table.column("beta")[0] == Approx(0.4).epsilon(0.1));
}

TEST_CASE("a study without a collapse says so in words", "[sweep][fragility]") {
  FragilityStudy study;
  REQUIRE(study.sweep(R"(study{ scene = "tiny.lua", keep = "none", vary = { grid{ seed = { 1, 2 }, pga = { .1, .2 } } },
    fragility = { im = "pga", collapse = "metrics.fell" } })") == 0);
  const std::string text = study.tables();
  CHECK_THAT(text, Catch::Contains("no collapse") && Catch::Contains("raise the intensities") && !Catch::Contains("nan"));
}

TEST_CASE("fragility tells runs that stand, but end in the middle of a fall", "[sweep][fragility]") {
  FragilityStudy study;
  const auto words = [&](double duration) {
    study.write("rock.lua", R"(
      local v = param('v', 1*m/s)
      param('seed', 1)
      material{ name = 'stone', density = 2000 }
      ground{ z = 0 }
      box{ name = 'rock', at = { 0, 0, 0 }, size = { .2, 1, 1 }, initial = { velocity = { v, 0, 0 } }, free = true, material = 'stone' }
      analysis{ duration = )" + fmt::format("{} }}", duration));
    REQUIRE(study.sweep("study{ scene = 'rock.lua', keep = 'none', vary = { grid{ seed = { 1, 2 }, v = { .1, 3, 4 } } },"
                        "fragility = { im = 'v', collapse = 'collapse.collapsed' } }",
                        {"--force"}) == 0);
    return text_of(study.out() + "/fragility.csv");
  };
  CHECK_THAT(words(0.1), Catch::Contains("4 runs counted as standing still moved at the end, and may fall later"));
  CHECK_THAT(words(4), !Catch::Contains("still moved"));
}

TEST_CASE("runs at intensity zero are no runs without an answer", "[sweep][fragility]") {
  FragilityStudy study;
  REQUIRE(study.sweep(R"(study{ scene = "tiny.lua", keep = "none", vary = { grid{ seed = { 1, 6, 12 }, pga = { 0, 1, 1.9 } } },
    fragility = { im = "pga", collapse = "metrics.fell" } })") == 0);
  CHECK_THAT(study.tables(), Catch::Contains("3 runs left out: at intensity 0") && !Catch::Contains("no answer"));
}

TEST_CASE("a run whose intensity or collapse is none is left out by its reason", "[sweep][fragility]") {
  FragilityStudy study;
  const auto words = [&](const std::string& pga, const std::string& fragility) {
    REQUIRE(study.sweep("study{ scene = 'tiny.lua', keep = 'none', vary = { grid{ seed = { 1, 6, 12 }, pga = { " + pga +
                            " } } }, fragility = { " + fragility + " } }",
                        {"--force"}) == 0);
    return text_of(study.out() + "/fragility.csv");
  };
  CHECK_THAT(words("-1, 1, 1.9", "im = 'pga', collapse = 'metrics.fell'"),
             Catch::Contains("3 runs left out: pga is below 0") && !Catch::Contains("no answer"));
  CHECK_THAT(words("1, 1.9", "im = 'pga', collapse = 'metrics.drift'"),
             Catch::Contains("6 runs left out: metrics.drift is neither 1 nor 0") && Catch::Contains("above"));
  CHECK_THAT(study.said, !Catch::Contains("could not be drawn"));  // nothing is left to draw
  CHECK_THAT(words("1, 1.9", "im = 'pga', collapse = 'metrics.drift', above = .1"), !Catch::Contains("left out"));
}

TEST_CASE("cases of a bisection with one answered end each have a row, and words", "[sweep][fragility]") {
  FragilityStudy study;
  study.write("tiny.lua", fragile_block + "if pga < 1 then error('no answer down here') end\n");
  study.sweep(R"(study{ scene = "tiny.lua", keep = "none", vary = { grid{ seed = { 1, 2 } } },
    bisect = { param = "pga", lo = .1, hi = 2.2, key = "metrics.fell" }, fragility = { im = "pga" } })");
  CHECK_THAT(study.tables(),
             Catch::Contains("capacities") && Catch::Contains("all of 2 collapse") && Catch::Contains("2 runs left out: no answer"));
}

TEST_CASE("perturbations give each run its own noise, the same in every study", "[sweep][fragility]") {
  FragilityStudy study;
  study.write("tiny.lua", R"(material{ name = "stone", density = 2000 }
box{ name = "b", size = { .3, .3, 1 }, at = { 0, 0, 5 }, free = true, material = "stone" }
recorder{ name = "b", quantity = "displacement", block = "b", axis = "x" }
analysis{ duration = .01, start = "rest", stop_after_collapse = 1e6, output_dt = .001 }
metric("x", "m", function(run) return run.last("b_ux_rel_m") end))");
  const std::string text = R"(study{ scene = "tiny.lua", vary = { perturbations{ n = 4, size = 1e-6 } }, collect = { "metrics.x" } })";
  REQUIRE(study.sweep(text) == 0);
  const std::vector<double> first = read_csv(study.out() + "/results.csv").column("x_m");
  REQUIRE(first.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(std::fabs(first[i]) < 1.1e-6);
    for (std::size_t k = 0; k < i; ++k) CHECK(first[i] != first[k]);
  }
  REQUIRE(study.sweep(text, {"--force"}) == 0);
  CHECK(read_csv(study.out() + "/results.csv").column("x_m") == first);
}

TEST_CASE("mistakes in a fragility name the key and the remedy", "[sweep][fragility]") {
  FragilityStudy study;
  const auto says = [&](const std::string& fragility, const std::string& what) {
    INFO(fragility);
    CHECK(study.sweep("study{ scene = 'tiny.lua', vary = { grid{ pga = { 1, 2 } } }, fragility = { " + fragility + " } }", {"--force"}) ==
          2);
    CHECK_THAT(study.said, Catch::Contains("study.lua:1") && Catch::Contains(what));
  };
  says("im = 'pga'", "collapse = \"verdict\" is that of a bisection");
  says("collapse = 'metrics.fell'", "im");
  says("im = 'pgs', collapse = 'metrics.fell'", "im = \"pgs\" is no param of vary or bisect");
  says("im = 'pgs', collapse = 'metrics.fell'", "did you mean \"pga\"");
  says("im = 'metrics.pgs', collapse = 'metrics.fell'", "no key \"metrics.pgs\"");
  says("im = 'pga', collapse = 'metrics.fel'", "metrics.fell");
  says("im = 'pga', collapse = 'metrics.fell', by = { 'seed' }", "by = \"seed\" is no param of vary");
  says("im = 'pga', collapse = 'metrics.fell', along = 'pgg'", "along = \"pgg\"");
  says("im = 'pga', collapse = 'metrics.fell', demage = {}", "demage");
  says("im = 'pga', collapse = 'metrics.fell', by = 'pga'", "by = \"pga\" is what grows within a case");
  CHECK(study.sweep(
            "study{ scene = 'tiny.lua', vary = { grid{ pga = { 1, 2 }, seed = { 1, 2 } } }, fragility = { im = 'pga', along = 'seed', "
            "collapse = 'metrics.fell' } }",
            {"--force"}) == 2);
  CHECK_THAT(study.said, Catch::Contains("along = \"seed\"") && Catch::Contains("leave along out"));
  CHECK(study.sweep(
            "study{ scene = 'tiny.lua', vary = { grid{ seed = { 'a', 'b' } } }, fragility = { im = 'seed', collapse = 'metrics.fell' } }",
            {"--force"}) == 2);
  CHECK_THAT(study.said, Catch::Contains("study.lua:1") && Catch::Contains("im = \"seed\" takes words"));
}

TEST_CASE("twins of several cases are told in the words of the capacities, those of one case are its cases", "[sweep][fragility]") {
  FragilityStudy study;
  const auto words = [&](const std::string& seeds) {
    const std::string vary = "grid{ seed = { " + seeds + " }, pga = { .6, 1, 1.4, 1.9, 2.5, 4 } }, perturbations{ n = 3, size = 0 }";
    REQUIRE(study.sweep("study{ scene = 'tiny.lua', keep = 'none', vary = { " + vary +
                            " }, fragility = { im = 'pga', collapse = 'metrics.fell' } }",
                        {"--force"}) == 0);
    return text_of(study.out() + "/fragility.csv");
  };
  CHECK(contains(words("3, 6, 9"), "3 perturbations of each case are not independent of each other, so that the bands are too narrow"));
  CHECK_FALSE(contains(words("3"), "not independent of each other"));
}
