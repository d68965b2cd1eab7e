// Faces of joints for the tests of crushing, and the points of a grid over them.
#pragma once
#include <array>
#include <vector>

namespace erbs::test {

using Gap = std::array<double, 3>;
inline double at(const Gap& g, double s, double t) { return g[0] + g[1] * s + g[2] * t; }

// Rectangle, triangle, and an irregular hexagon: s, t of each corner (m).
inline const std::vector<std::vector<double>> faces{{-.15, -.06, .15, -.06, .15, .06, -.15, .06},
                                                    {-.1, -.05, .2, -.05, -.1, .1},
                                                    {-.1, -.06, .08, -.07, .14, 0, .1, .06, -.05, .08, -.12, .02}};

// Points of equal area (m2) over a face: s, t and a zero for the state of the place.
struct Grid {
  std::vector<std::array<double, 3>> place;
  double area = 0;
  Grid(const std::vector<double>& corners, int n) {
    const double h = 0.5 / n;
    area = h * h;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const double s = -.25 + (i + .5) * h, t = -.25 + (j + .5) * h;
        bool inside = true;
        for (std::size_t k = 0; k < corners.size(); k += 2) {
          const std::size_t l = (k + 2) % corners.size();
          inside = inside && (corners[l] - corners[k]) * (t - corners[k + 1]) >= (corners[l + 1] - corners[k + 1]) * (s - corners[k]);
        }
        if (inside) place.push_back({s, t, 0});
      }
  }
};

}  // namespace erbs::test
