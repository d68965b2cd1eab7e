// What `erbs check` says of a block that rocks with its whole face on a bed.
#include "engine/analysis/flat_bed.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "engine/analysis/prepare.h"
#include "engine/analysis/rocking.h"
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
  for (const char* part : {"column", "0.876", "0.945", "feet", "kn"}) CHECK(one[0].find(part) != std::string::npos);
  CHECK(beds_of(column + "\nbox{ name = 'top', material = 'brick', size = { .3, 1, .2 }, at = { 1, 0, 1 } }" + dry)
            .empty());  // it bears another
  CHECK(beds_of("box{ name = 'cube', material = 'brick', size = { 1, 1, 1 }, at = { 1, 0, 0 } }" + dry).empty());
  CHECK(beds_of(column + "\ngravity(0)" + dry).empty());
}
