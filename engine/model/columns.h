// Columns of blocks that lie on each other: the scale of interlock (laws/interlock.h).
#pragma once
#include <span>
#include <vector>

#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

// Whether blocks that meet across a face with this normal (unit, world) lie on each other, rather than side by side.
bool lie_on_each_other(const Model& model, const Vec3& normal);

// The longest ways up and down from each block through blocks that lie on each other. Supports belong to none, or all that stands on them
// would be one.
class Columns {
 public:
  // Starts with the joints that are left, at the present pose. No gravity, or no `Model::settles`: no columns.
  Columns(const Model& model, const State& state);
  void link(int a, int b);          // two blocks that lie on each other
  void find();                      // the ways, once all links are known
  Hop through(int a, int b) const;  // the column through the face between two blocks that lie on each other
  Hop beside(int a, int b) const;   // the shorter of the columns of two blocks side by side

 private:
  struct Link {
    int lower, upper;
  };
  struct Way {
    int courses = 0;     // the block itself included
    double settles = 0;  // m, sum of what each of its blocks settles on its own bed
  };
  Link ordered(int a, int b) const;
  Hop hop_of(int courses, double settles) const;

  const Model& model_;
  std::vector<double> height_;  // m, of the centroids
  std::vector<Link> links_;
  std::vector<Way> up_, down_;
};

// m, `Model::settles`: what each block settles on its own bed, from the time step (s) that its own springs allow [nblock].
std::vector<double> settlements(const Model& model, std::span<const double> bounds);
// `Joint::hop` of all joints at the present pose.
void set_hops(Model& model, const State& state);

}  // namespace erbs
