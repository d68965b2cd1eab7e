// Packs answer as eight plain numbers do.
#include "engine/simd/pack.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "engine/base/random.h"
#include "engine/simd/transpose.h"
#include "engine/simd/vec3.h"

using namespace erbs::scalar;

namespace {

struct Eight {
  double x[8];
  Pack pack() const { return load(x); }
};
Eight eight(erbs::Random& random) {
  Eight e;
  for (double& x : e.x) x = random.within(1);
  return e;
}

}  // namespace

TEST_CASE("packs: each lane is computed as a number is", "[simd]") {
  erbs::Random random{1};
  const Eight a = eight(random), b = eight(random), c = eight(random);
  const auto same = [&](Pack pack, auto number) {
    for (int l = 0; l < 8; ++l) CHECK(pack[l] == number(a.x[l], b.x[l], c.x[l]));
  };
  const Pack p = a.pack(), q = b.pack(), r = c.pack();
  same(p * q + r / p - 2, [](double x, double y, double z) { return x * y + z / x - 2; });
  same(min(p, q), [](double x, double y, double) { return min(x, y); });
  same(max(p, q), [](double x, double y, double) { return max(x, y); });
  same(sqrt(abs(p)), [](double x, double, double) { return std::sqrt(std::fabs(x)); });
  same(select((p < q) | !(q <= r), p, -q), [](double x, double y, double z) { return x < y || !(y <= z) ? x : -y; });
  same(1 / nonzero(p), [](double x, double, double) { return x > 0 ? 1 / x : 1; });
  same(dot(Pack3{p, q, r}, cross(Pack3{q, p, r}, Pack3{r, r, p})), [](double x, double y, double z) {
    return dot(Vec3<double>{x, y, z}, cross(Vec3<double>{y, x, z}, Vec3<double>{z, z, x}));
  });
}

TEST_CASE("packs: masks as bits and back; what is no number is no less and no greater", "[simd]") {
  const double x[8] = {1, -1, 0, NAN, 2, -2, 3, -0.0};
  CHECK(bits(load(x) > 0) == 0b01010001u);
  CHECK(bits(!(load(x) <= 0)) == 0b01011001u);
  CHECK(bits(Mask::of_bits(0b10100110u)) == 0b10100110u);
  CHECK(any(Mask::of_bits(0x80u)));
  CHECK_FALSE(any(Mask{}));
  CHECK(max(load(x), 0)[3] == 0);
}

TEST_CASE("packs: rows become lanes and lanes rows", "[simd]") {
  double rows[9 * 8] = {}, back[9 * 8] = {};
  for (int i = 0; i < 64; ++i) rows[i] = i;
  const int offset[8] = {56, 0, 16, 8, 24, 48, 40, 32};
  Pack pack_size[8];
  rows_to_pack(rows, offset, pack_size);
  for (int i = 0; i < 8; ++i)
    for (int l = 0; l < 8; ++l) CHECK(pack_size[i][l] == offset[l] + i);
  pack_to_rows(pack_size, back, offset);
  for (int i = 0; i < 64; ++i) CHECK(back[i] == rows[i]);
}
