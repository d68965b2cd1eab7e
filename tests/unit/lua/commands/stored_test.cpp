// Pictures and values that are kept beside a scene: stored by erbs test --bless, compared by each run, and what a difference leaves.
#include <catch2/catch.hpp>

#include "lua/program/options.h"
#include "render/image/compare.h"
#include "tests/support/places.h"
#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;
namespace fs = std::filesystem;

namespace {

// A dry pier that is shaken across its plane; with `peak` = .8 g it leans visibly at .5 s.
std::string leaning_pier(double peak, const std::string& expected, const std::string& law = "dry { kn = 5e9, ks = 2e9, mu = 0.6 }") {
  return fmt::format(R"(material {{ name = "brick", density = 1800 }}
ground {{ z = 0, size = 3, material = "brick" }}
joint {{ law = {} }}
for i = 0, 4 do box {{ size = {{ .3, .125, .1 }}, at = {{ 0, 0, i * .1 }}, material = "brick" }} end
ground_motion {{ wave = sine {{ amplitude = {} * g, frequency = 2 }}, direction = "y" }}
camera {{ name = "near", eye = {{ 1, -1.4, .6 }}, target = {{ 0, 0, .25 }} }}
analysis {{ duration = .5, frame_dt = .05 }}
{})",
                     law, peak, expected);
}

struct StoredBench : Bench {
  // The table of erbs test for this scene; its exit code.
  int test(const std::string& text, std::vector<std::string> more = {}) {
    std::vector<std::string> words{"test", scene(text), "-o", (folder / "runs").string(), "-q"};
    words.insert(words.end(), more.begin(), more.end());
    return erbs(words);
  }
  std::string picture(const std::string& ending) const { return (folder / "runs/scene/pictures" / ("near_t0.500s" + ending)).string(); }
  std::string stored() const { return (folder / "expected/scene_near_t0.500s.png").string(); }
};

const std::string expectations =
    "expect_image(\"near\", .5, { width = 320, height = 180 })\nexpect_stored(\"energy.base_work_J\", { rel = 1e-9 })";

}  // namespace

TEST_CASE("a stored picture and value hold for the same run, and tell another run apart", "[stored][program]") {
  StoredBench bench;
  std::string text = leaning_pier(0.8, expectations);
  // what is not stored yet fails, and says how to store it
  REQUIRE(bench.test(text) == int(exit_expectation));
  CHECK(contains(bench.said, "no picture is stored yet; erbs test --bless stores this one"));
  CHECK(contains(bench.said, "none stored yet"));
  CHECK_FALSE(fs::exists(bench.folder / "expected"));
  // the table stands before what is stored
  REQUIRE(bench.test(text, {"--bless"}) == 0);
  CHECK(bench.said.find("FAILED") < bench.said.find("stored energy.base_work_J"));
  REQUIRE(fs::exists(bench.stored()));
  REQUIRE(bench.test(text) == 0);
  CHECK(contains(bench.said, "0 % of the pixels differ, SSIM 1.0000"));
  REQUIRE(bench.test(text, {"--bless"}) == 0);
  CHECK(contains(bench.said, "nothing to store"));
  // another run leaves actual, expected and difference, with one line of reason
  const std::string before = text_of(bench.stored());
  text = leaning_pier(0.6, expectations);
  REQUIRE(bench.test(text) == int(exit_expectation));
  CHECK(contains(bench.said, "of the pixels differ"));
  CHECK(contains(bench.said, "near_t0.500s_difference.png"));
  for (const char* ending : {"_actual.png", "_expected.png", "_difference.png"}) CHECK(fs::exists(bench.picture(ending)));
  CHECK(text_of(bench.picture("_expected.png")).size() > 1000);
  CHECK(text_of(bench.stored()) == before);  // only --bless writes
  const render::Image actual = render::read_png(bench.picture("_actual.png")), wanted = render::read_png(bench.stored());
  CHECK_FALSE(render::compare(actual, wanted).alike());
  // the difference is red where the pictures differ, and grey elsewhere
  const render::Image difference = render::read_png(bench.picture("_difference.png"));
  std::size_t red = 0;
  for (std::size_t i = 0; i < difference.rgb.size(); i += 3) red += difference.rgb[i] > difference.rgb[i + 1] + 20;
  const double share = double(red) / (double(difference.rgb.size()) / 3);
  CHECK(share == Approx(render::compare(actual, wanted).failed_fraction).margin(1e-3));
  REQUIRE(bench.test(text, {"--bless"}) == 0);
  CHECK(bench.test(text) == 0);
}

TEST_CASE("pictures of both sources of OpenGL hold", "[stored][render][program]") {
  StoredBench bench;
  REQUIRE(bench.test(leaning_pier(0.8, expectations), {"--bless"}) == 0);
  for (const char* context : {"osmesa", "egl"}) {
    const std::string dir = (bench.folder / "runs/scene").string(), log = (bench.folder / "render.log").string();
    const int code = wait_for(start({test::in_build("/erbs-render"), dir, "--stills", "0.5", "--camera", "near", "--size", "320x180",
                                     "--expect", bench.stored(), "--context", context, "--force", "--no-figures"},
                                    log));
    if (code != 0 && std::string(context) == "egl" && contains(text_of(log), "EGL")) {
      WARN("no EGL device is there: " << text_of(log));
      continue;
    }
    INFO(context << ": " << text_of(log));
    REQUIRE(code == 0);
    const Json found = Json::parse(text_of(bench.picture(".json")));
    CHECK(found.at("stored") == true);
    CHECK(found.at("failed_fraction").get<double>() <= 0.01);
    CHECK(found.at("ssim").get<double>() >= 0.98);
  }
}

TEST_CASE("a changed run is not compared with what is stored", "[stored][program]") {
  StoredBench bench;
  const std::string text = leaning_pier(0.8, expectations + "\nparam(\"x\", 1, \"\")\nexpect(\"blocks\", 6, { abs = 0 })");
  REQUIRE(bench.test(text, {"--bless"}) == 0);
  CHECK(bench.test(text, {"-D", "x=2"}) == 0);
  CHECK(contains(bench.said, "1 expectation of 1 case"));
  CHECK(bench.run(text, {"--dt-fraction", "0.5"}) == 0);
  CHECK(contains(bench.said, "expectations: 1 passed"));
}

TEST_CASE("the option --bless does not say that all holds where a scene did not run", "[stored][bad_input][program]") {
  StoredBench bench;
  CHECK(bench.test("nonsense{}\n" + leaning_pier(0.8, expectations), {"--bless"}) != 0);
  CHECK(contains(bench.said, "nothing to store of 1 case that did not run; see the table"));
  CHECK_FALSE(contains(bench.said, "all stored pictures and values hold"));
}

TEST_CASE("what was stored for another scene fails, and a changed script is named as the cause", "[stored][bad_input][program]") {
  StoredBench bench;
  REQUIRE(bench.test(leaning_pier(0.8, expectations), {"--bless"}) == 0);
  REQUIRE(bench.test("-- a comment\n" + leaning_pier(0.8, expectations)) == 0);  // the same run
  REQUIRE(bench.test(leaning_pier(0.6, expectations)) == int(exit_expectation));
  const std::size_t first = bench.said.find("the script, its files or params have changed since it was stored");
  REQUIRE(first != std::string::npos);
  CHECK(bench.said.find("the script, its files or params have changed", first + 1) != std::string::npos);  // picture and value
  // the files of another scene under the name of this one, which gives the same run
  bench.write("twin.lua", leaning_pier(0.8, expectations));
  fs::copy_file(bench.stored(), bench.folder / "expected/twin_near_t0.500s.png");
  fs::copy_file(bench.folder / "expected/scene.json", bench.folder / "expected/twin.json");
  const std::vector<std::string> test{"test", (bench.folder / "twin.lua").string(), "-o", (bench.folder / "runs").string(), "-q"};
  REQUIRE(bench.erbs(test) == int(exit_expectation));
  const std::size_t picture = bench.said.find("it is of another scene, scene");
  REQUIRE(picture != std::string::npos);
  CHECK(bench.said.find("it is of another scene, scene", picture + 1) != std::string::npos);
  std::vector<std::string> bless = test;
  bless.emplace_back("--bless");
  REQUIRE(bench.erbs(bless) == 0);
  CHECK(bench.erbs(test) == 0);
}

TEST_CASE("a damaged picture and one of another size are told", "[stored][bad_input][program]") {
  StoredBench bench;
  const std::string text = leaning_pier(0.8, expectations);
  REQUIRE(bench.test(text, {"--bless"}) == 0);
  std::ofstream(bench.stored()) << "no picture";
  REQUIRE(bench.test(text) == int(exit_expectation));
  CHECK(contains(bench.said, "is no readable PNG picture"));
  render::write_png(bench.stored(), render::Image(64, 64));
  REQUIRE(bench.test(text) == int(exit_expectation));
  CHECK(contains(bench.said, "the stored picture has another size"));
  bench.write("expected/scene.json", "{ broken");
  CHECK(bench.test(text) != 0);
  CHECK(contains(bench.said, "scene.json"));
}

TEST_CASE("mistakes of expect_image and expect_stored are reported with their remedy, all at once", "[stored][bad_input]") {
  StoredBench bench;
  const std::string text = leaning_pier(0.8, R"(expect_image("nea", .5)
expect_image("near", 2.6)
expect_image("near", "a")
expect_image("near", .1, { pixel = 3 })
expect_image("near", .2, { ssim = 2, width = 9 })
expect_image("near", .3, 3)
expect_image("near", .4)
expect_image("near", .4)
expect_stored("collapse.tim_s", { rel = 1e-6 })
expect_stored("collapse.time_s")
expect_stored("collapse.time_s", { rel = 1, abs = 1 }))");
  REQUIRE(bench.erbs({"check", bench.scene(text)}) == int(exit_usage));
  for (const char* said : {"there is no camera \"nea\"; did you mean \"near\"?", "t = 2.6 s is past the end of the run, 0.5 s",
                           "t must be a time in s, not the string", "unknown key \"pixel\"; did you mean \"pixels\"?", "ssim", "width",
                           "the tolerance must be a table", "was given before", "no key \"collapse.tim_s\"",
                           "add how near the value must remain", "give one of rel, abs"}) {
    INFO(said);
    CHECK(contains(bench.said, said));
  }
  REQUIRE(bench.erbs({"check", bench.scene("ground{} box{} material{ name = 'm', density = 2000 } expect_image('zz', .1)")}) ==
          int(exit_usage));
  CHECK(contains(bench.said, "there is no camera \"zz\""));
  CHECK(bench.test(leaning_pier(0.8, expectations), {"--bless", "--grid"}) == int(exit_usage));
  CHECK(contains(bench.said, "leave out --grid, --seeds and -D"));
}
