// The command erbs limit SCENE: the table on stdout, the files in a folder, what it refuses.
#include <catch2/catch.hpp>

#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;
namespace fs = std::filesystem;

namespace {

constexpr const char* tall_block = R"(
material { name = "stone", density = 2000 }
box { name = "floor", size = { 8, 8, 1 }, at = { -4, -4, -1 }, fixed = true, material = "stone" }
joint { law = dry { kn = 1e10, mu = 0.7 } }
box { name = "block", size = { 1, 2, param("h", 4, "") }, at = { 0, 0, 0 }, material = "stone" }
analysis { duration = 1 }
)";

}  // namespace

TEST_CASE("erbs limit says multiplier, tilting angle and mechanism", "[limit][program]") {
  Bench bench;
  bench.write("block.lua", tall_block);
  const std::string scene = (bench.folder / "block.lua").string();
  REQUIRE(bench.erbs({"limit", scene}) == 0);
  for (const char* part : {"associated          0.25000", "non-associated      0.25000", "tilting angle    14.036 deg",
                           "1 block, 1 joint, ", "overturning as one piece: 1 of 1 block moves; 1 joint opens: floor | block"}) {
    INFO(part);
    CHECK(contains(bench.said, part));
  }
  REQUIRE(bench.erbs({"limit", scene, "--direction", "-y"}) == 0);
  CHECK(contains(bench.said, "0.50000"));
  REQUIRE(bench.erbs({"limit", scene, "-D", "h=1", "--associated", "--facets", "8"}) == 0);
  CHECK(contains(bench.said, "0.70000"));
  CHECK(contains(bench.said, "sliding"));
  CHECK_FALSE(contains(bench.said, "non-associated"));
  REQUIRE(bench.erbs({"limit", scene, "-q"}) == 0);
  CHECK(bench.said.empty());
  const std::string text = tall_block;
  bench.write("block.lua", text.substr(0, text.find("analysis")) + "analysis { kind = 'tilt', direction = 'y' }\n");
  REQUIRE(bench.erbs({"limit", scene}) == 0);
  CHECK(contains(bench.said, "lambda is the tangent of the tilt towards (0, 1, 0)"));
}

TEST_CASE("erbs limit says no tilting angle where a tilt is another load", "[limit][program]") {
  Bench bench;
  std::string bonded = tall_block;
  bonded.replace(bonded.find("dry {"), 5, "mortar { ft = 1e3, c = 2e3,");
  for (const std::string& text : {bonded, tall_block + std::string("force{ block = 'block', direction = { 0, 0, -1 }, wave = 1e4 }\n")}) {
    bench.write("block.lua", text);
    REQUIRE(bench.erbs({"limit", (bench.folder / "block.lua").string(), "-o", bench.out(), "--force"}) == 0);
    INFO(bench.said);
    CHECK_FALSE(contains(bench.said, "tilting angle"));
    CHECK(read_json(bench.out() + "/limit.json")["tilt_deg"].is_null());
  }
}

TEST_CASE("erbs limit writes its numbers, its thrusts and a figure", "[limit][program]") {
  Bench bench;
  bench.write("block.lua", tall_block);
  const std::string scene = (bench.folder / "block.lua").string();
  REQUIRE(bench.erbs({"limit", scene, "-o", bench.out()}) == 0);
  const Json numbers = read_json(bench.out() + "/limit.json");
  CHECK(numbers["associated"]["lower"].get<double>() == Approx(0.25));
  CHECK(numbers["tilt_deg"].get<double>() == Approx(14.0362));
  CHECK(numbers["mechanism"]["hinges"] == 1);
  const CsvTable thrust = read_csv(bench.out() + "/thrust.csv");
  REQUIRE(thrust.rows() == 1);
  CHECK(thrust.column("compression_N").front() == Approx(2000 * 8 * 9.81));
  CHECK(thrust.column("x_m").front() == Approx(1));  // all of it at the toe
  CHECK(thrust.column("fx_N").front() == Approx(-0.25 * 2000 * 8 * 9.81));
  const CsvTable mechanism = read_csv(bench.out() + "/mechanism.csv");
  CHECK(mechanism.column("wy_rad_s").back() > 0);
  CHECK(text_of(bench.out() + "/limit.svg").find("</svg>") != std::string::npos);
  CHECK(fs::file_size(bench.out() + "/limit.png") > 5000);
  CHECK(bench.erbs({"limit", scene, "-o", bench.out()}) == 2);
  CHECK(contains(bench.said, "--force"));
  CHECK(bench.erbs({"limit", scene, "-o", bench.out(), "--force"}) == 0);
}

TEST_CASE("erbs limit refuses what has no answer, with the remedy", "[limit][program]") {
  Bench bench;
  bench.write("block.lua", tall_block);
  const std::string scene = (bench.folder / "block.lua").string();
  const std::pair<std::vector<std::string>, const char*> wrong[]{
      {{"--direction", "0,0,0"}, "no length"},   {{"--direction", "up"}, "it is no direction"},
      {{"--direction", "1,2"}, "three numbers"}, {{"--direction=-z"}, "push in another direction"},
      {{"--facets", "7"}, "even number"},        {{"-o", bench.folder.string()}, "no folder of erbs limit"}};
  for (const auto& [options, said] : wrong) {
    std::vector<std::string> words{"limit", scene};
    words.insert(words.end(), options.begin(), options.end());
    INFO(said);
    CHECK(bench.erbs(words) == 2);
    CHECK(contains(bench.said, said));
  }
}

TEST_CASE("erbs limit says why a load finds no mechanism", "[limit][program]") {
  Bench bench;
  const std::string scene = (bench.folder / "block.lua").string(), text = tall_block, alone = text.substr(0, text.find("analysis"));
  const std::string walls =
      "for _, x in ipairs { -1, 1 } do box { size = { 1, 2, 1 }, at = { x, 0, 0 }, fixed = true, material = 'stone' } end\n";
  const std::string roof = "box { size = { 1, 2, 1 }, at = { 0, 0, 4 }, fixed = true, material = 'stone' }\n";
  const std::string push = "analysis { kind = 'pushover', direction = 'y' }\n", tilt = "analysis { kind = 'tilt', direction = 'y' }\n";
  const std::pair<std::string, const char*> cases[]{
      {walls + push, "the structure carries 10000 times it, and more, held by friction of upright joints"},
      {walls + push, "without it lambda = 0.50000; a run with analysis{ kind = \"pushover\" }"},
      {walls + tilt, "the structure stands at any angle up to 90 degrees, held by"},
      {walls + tilt, "without it to 26.565 deg; a run with analysis{ kind = \"tilt\" }"},
      {roof + tilt, "90 degrees; tilt to another side with direction in analysis{}, or give"}};
  for (const auto& [more, said] : cases) {
    bench.write("block.lua", alone + more);
    INFO(said);
    CHECK(bench.erbs({"limit", scene}) == 2);
    CHECK(contains(bench.said, said));
    CHECK(contains(bench.said, "push") == (more == walls + push));
  }
}
