#include "engine/base/system/wide_pages.h"

#include <catch2/catch.hpp>
#include <cstdint>
#include <vector>

using namespace erbs;

namespace {

struct alignas(64) Line {
  double x[8];
};

}  // namespace

TEST_CASE("arrays with wide pages are arrays: aligned, copied and grown", "[base]") {
  using Lines = std::vector<Line, WidePages<Line>>;
  const std::size_t n = GENERATE(1, 100, 32768, 50001);  // up to 64 kB, just 2 MB, more
  Lines a(n);
  CHECK(reinterpret_cast<std::uintptr_t>(a.data()) % (n * sizeof(Line) < WidePages<Line>::page ? 64 : WidePages<Line>::page) == 0);
  for (std::size_t i = 0; i < n; ++i) a[i].x[7] = double(i);
  Lines b = a, c;
  for (int k = 0; k < 3; ++k) c.insert(c.end(), b.begin(), b.end());
  b = std::move(a);
  CHECK(b.size() == n);
  CHECK(b.back().x[7] == double(n - 1));
  CHECK(c.size() == 3 * n);
  CHECK(c[n].x[7] == 0);
  CHECK(c.back().x[7] == double(n - 1));
  CHECK(c[0].x[0] == 0);
}
