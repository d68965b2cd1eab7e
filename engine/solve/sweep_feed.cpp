#include "engine/solve/sweep_feed.h"

#include <algorithm>

#include "engine/solve/eigenvalue.h"
#include "engine/solve/stiffness.h"

namespace erbs {

double sweep_feed(const Model& m, const State& s) {
  const Freedom f = freedoms(m);
  if (f.count == 0) return 0;
  Triplets entries;
  for (int b = 0; b < m.nblock; ++b) {
    const int first = f.first[std::size_t(b)];
    if (first < 0) continue;
    const Mat6 root = inverse_root_mass(m, s, b);
    for (int r = 0; r < 6; ++r)
      for (int c = 0; c < 6; ++c)
        if (root(r, c) != 0) entries.emplace_back(first + r, first + c, root(r, c));
  }
  Sparse scale(f.count, f.count);
  scale.setFromTriplets(entries.begin(), entries.end());
  Sparse off = -stiffness(m, s, f);
  off.prune([](Eigen::Index row, Eigen::Index column, double) { return row / 6 != column / 6; });
  return std::max(0.0, largest_eigenvalue(Sparse(scale * off * scale)));
}

}  // namespace erbs
