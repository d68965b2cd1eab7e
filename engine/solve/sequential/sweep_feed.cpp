#include "engine/solve/sequential/sweep_feed.h"

#include <algorithm>

#include "engine/solve/linear/eigenvalue.h"
#include "engine/solve/linear/stiffness.h"

namespace erbs {

double sweep_feed(const Model& m, const State& s) {
  const Freedom f = freedoms(m);
  if (f.count == 0) return 0;
  const RootMass root(m, s, f);
  Sparse off = -stiffness(m, s, f);
  off.prune([](Eigen::Index row, Eigen::Index column, double) { return row / 6 != column / 6; });
  return std::max(0.0, largest_eigenvalue(f.count, [&](const VecX& x, VecX& y) {
                    VecX scaled = x;
                    root.apply(scaled);
                    y = off * scaled;
                    root.apply(y);
                  }));
}

}  // namespace erbs
