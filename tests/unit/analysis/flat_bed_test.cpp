// What `erbs check` says of a block that rocks with its whole face on a bed.
#include "engine/analysis/flat_bed.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "engine/analysis/rocking.h"
#include "engine/analysis/start/prepare.h"
#include "engine/base/units.h"
#include "tests/unit/lua/load.h"

using namespace erbs;
using namespace erbs::analysis;
using namespace erbs::lua;

TEST_CASE("an impulse at the edge keeps what Housner's block keeps", "[flat_bed]") {
  for (const double width : {0.15, 0.3, 0.6}) {
    const double b = width / 2, height = 1.0, c = (width * width + 4 * height * height) / 12;
    CHECK(spin_kept(c, b, b) == Approx(homogeneous_block(width, height, standard_g).mu).epsilon(1e-12));
    CHECK(spin_kept(c, b, 0) == 1);
  }
}

TEST_CASE("blocks that stand alone on a dry bed are told of, and no others", "[flat_bed]") {
  const auto beds_of = [](const std::string& pieces) {
    const Prepared run = prepare(scene_of("ground{ size = 9 }\n" + pieces + "\nanalysis{ duration = .1 }"), false);
    std::vector<std::string> told_of;
    for (const FlatBed& bed : flat_beds(run.model)) told_of.push_back(told(run.model, bed));
    return told_of;
  };
  const std::string dry = "\njoint{ law = dry{ kn = 5e9, mu = .6 } }",
                    column = "box{ name = 'column', material = 'brick', size = { .3, 1, 1 }, at = { 1, 0, 0 } }";
  const std::vector<std::string> one = beds_of(column + dry);
  REQUIRE(one.size() == 1);
  for (const char* part : {"column", "0.876", "0.945", "feet", "kn", "toe", "overturning angle", "0.2915 rad", "tan(alpha) overturns"})
    CHECK(one[0].find(part) != std::string::npos);
  CHECK(beds_of(column + "\nbox{ name = 'top', material = 'brick', size = { .3, 1, .2 }, at = { 1, 0, 1 } }" + dry)
            .empty());  // it bears another
  CHECK(beds_of("box{ name = 'cube', material = 'brick', size = { 1, 1, 1 }, at = { 1, 0, 0 } }" + dry).empty());
  CHECK(beds_of(column + "\ngravity(0)" + dry).empty());
}

TEST_CASE("the toe of a block on a bed: balance of moments, and the static threshold", "[flat_bed]") {
  for (const double width : {0.12, 0.25, 0.6, 1.0})
    for (const double slender : {3.0, 5.0, 8.0})
      for (const double settlement : {1e-8, 1e-7, 1e-6}) {  // over half the width
        const double b = width / 2, h = slender * b, d0 = settlement * b, radius2 = (b * b + h * h) / 3;
        const BedToe toe = toe_on_bed(b, h, radius2, d0, standard_g);
        const auto length = [&](double theta) { return 2 * std::sqrt(b * d0 / theta); };
        // The pressure kn theta x over the toe bears the weight kn d0 2 b.
        const double alpha = std::atan(b / h);
        CHECK(0.5 * alpha * toe.width * toe.width == Approx(d0 * 2 * b).epsilon(1e-12));
        double most = 0;  // of the restoring moment over the weight times h, small angles
        for (double theta = 1e-5; theta < alpha; theta *= 1.0005) most = std::max(most, (b - length(theta) / 3 - h * theta) / h);
        CHECK(toe.threshold * b / h == Approx(most).epsilon(1e-5));
        CHECK(toe.alpha < alpha);
        CHECK(toe.alpha == Approx(std::atan((b - toe.width / 3) / h)));
        CHECK(toe.p > homogeneous_block(width, slender * width, standard_g).p);  // R shrinks
      }
  const double b = 0.125, h = 0.5;
  const BedToe rigid = toe_on_bed(b, h, (b * b + h * h) / 3, 0, standard_g);
  CHECK(rigid.p == Approx(homogeneous_block(0.25, 1, standard_g).p).epsilon(1e-12));
  CHECK(rigid.alpha == Approx(std::atan(0.25)).epsilon(1e-12));
  CHECK(rigid.threshold == 1);
  const double v30[] = {0.8640, 0.9369, 0.9707, 0.9864}, ratios[] = {2e-4, 2e-5, 2e-6, 2e-7};
  for (int i = 0; i < 4; ++i)
    CHECK(toe_on_bed(b, h, (b * b + h * h) / 3, ratios[i] * b, standard_g).threshold == Approx(v30[i]).margin(3e-3));
}

TEST_CASE("rocking{} tells what a bed does to the block, in its result and in the notes of the scene", "[flat_bed]") {
  const auto scene_with = [](const std::string& keys) {
    return scene_of("joint{ law = dry{ kn = 1e10, mu = 0.6 } }\nlocal it = rocking{ width = .25, height = 1, duration = 1, " + keys +
                    " }\nif it.bed then metric('threshold', '', it.bed.threshold / it.threshold) end");
  };
  const Scene rigid = scene_with("theta = .1"), bed = scene_with("kn = 1e10, density = 2670");
  CHECK(rigid.notes.empty());
  REQUIRE(bed.notes.size() == 1);
  for (const char* words : {"scene.lua:", "toe of", "inside the edge", "0.93", "Housner", "footed_block"})
    CHECK_THAT(bed.notes[0], Catch::Contains(words));
  CHECK_THROWS_WITH(scene_with("kn = 1e10"), Catch::Contains("density of the block"));
  CHECK_THROWS_WITH(scene_with("density = 2000"), Catch::Contains("give kn"));
  CHECK_THROWS_WITH(scene_with("kn = 10, density = 2000"), Catch::Contains("out of range"));
}
