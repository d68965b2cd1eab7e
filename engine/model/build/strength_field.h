// Strengths of joints whose law has scatter (laws/scatter.h). The logarithm of the strength is a Gaussian field at the centres of the
// joints: independent values, or a sum of waves with random phases (spectral representation, Shinozuka and Deodatis 1996) whose correlation
// is exp(-(r / length)^2). Cracked joints are computed in packs of one law, so the field is rounded to quarters of its standard deviation:
// the strength errs by an eighth of it at most, 4 % for cv = .3.
#pragma once
#include <map>
#include <utility>
#include <vector>

#include "engine/base/random.h"
#include "engine/model/model.h"
#include "engine/scene/scene.h"

namespace erbs {

double normal(Random& random);  // standard normal deviate (Box and Muller 1958)

class StrengthField {
 public:
  StrengthField(const Scene& scene, Model& model) : scene_(scene), model_(model) {}
  // Index in Model::laws for joint number `joint` of a rule; adds the law where it is new.
  int law_of(int rule, int joint, const Vec3& centre);

  static constexpr double classes = 4;   // of strength, per standard deviation
  static constexpr double farthest = 4;  // standard deviations

 private:
  struct Wave {
    Vec3 k;        // rad/m
    double phase;  // rad
  };
  double field(const Scatter& scatter, int rule, int joint, const Vec3& x);  // standard normal
  const Scene& scene_;
  Model& model_;
  std::map<int, std::vector<Wave>> waves_;   // by rule
  std::map<std::pair<int, int>, int> laws_;  // by rule and class
};

}  // namespace erbs
