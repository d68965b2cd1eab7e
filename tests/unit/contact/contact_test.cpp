#include "engine/contact/contact.h"
#include <catch2/catch.hpp>
TEST_CASE("impact factor","[contact]"){
  const double e[] = {.9375, .7484, .5936, .4107, .1970}, x[] = {.1, .5, 1, 2, 5};
  for (int i = 0; i < 5; ++i) CHECK(erbs::impact_factor(e[i]) == Approx(x[i]).epsilon(2e-3));
}
