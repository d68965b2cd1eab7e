// Limit analysis of a block structure: the multiplier of a load at which it becomes a mechanism, without any time history.
//
//   standing        does it carry its constant loads at all?
//   associated      Coulomb friction with dilatancy tan(psi) = mu: both bound theorems hold, the two multipliers agree
//   non-associated  zero dilatancy, by the iteration of Gilbert, Casapulla and Ahmed (2006, Comput. Struct. 84, 873)
//
// The associated multiplier is an upper bound of the non-associated one (Drucker 1954; Radenkovic 1961). The latter is not unique in
// theory; the iteration finds one solution of it.
//
// A tilt turns gravity by atan(lambda), while other loads and bonds stay. Divided by the cosine, it is a push by lambda beside these times
// sqrt(1 + lambda^2): an outer iteration looks for the lambda at which factor and answer agree. Forces are those of the push.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "engine/analysis/limit/problem.h"

namespace erbs::analysis {

struct LimitOptions {
  bool no_tension = false;       // without the bond of mortar
  bool associated_only = false;  // skips the iteration
  // Without friction in joints that stand upright, within 30 degrees: their faces may press each other as hard as friction needs.
  bool smooth_uprights = false;
  // Facets of the friction cones, an even number from 4 on: two linear programs. 0: round cones by the interior point method; in a plane
  // problem of moderate size one linear program.
  int facets = 0;
  enum class Solver { automatic, simplex, interior } solver = Solver::automatic;
  double most = 1e4;  // largest multiplier that counts as one
};

struct Multiplier {
  double lower = 0, upper = 0;  // what forces in equilibrium prove, what the mechanism proves
  bool converged = false;
  int iterations = 0;  // of the solver, all rounds together
  double seconds = 0;  // wall clock
  double middle() const { return 0.5 * (lower + upper); }
};

struct LimitResult {
  LimitProblem problem;
  std::string method;
  bool stands = false;        // under its constant loads
  double standing_share = 0;  // of the constant loads that it carries, at most 1
  bool unbounded = false;     // the load never makes a mechanism: above `most`
  Multiplier associated;
  bool has_nonassociated = false;
  Multiplier nonassociated;
  int rounds = 0;              // of the non-associated iteration
  double friction_excess = 0;  // share of its shear forces that lies above cohesion + mu n
  double seconds = 0;
  // Of the last solution: non-associated, associated, or of standing where it does not stand.
  std::vector<Vec3> force;      // N: n, s, t on block b                [contact points]
  std::vector<Twist> velocity;  // scaled so that the fastest block moves by 1 m/s; spin in rad/s   [nblock]
  const Multiplier& last() const { return has_nonassociated ? nonassociated : associated; }
};

// The multiplier without friction in upright joints, beside the answer `with` it. None: no such joint rubs, the structure does not stand
// without, as an arch, or still bears any load.
//
// Statics lets faces that nothing presses at rest, such as heads of bricks between fixed blocks, press each other as hard as friction needs
// (self-stress). A push begins without such forces: on stiff beds its capacity lies between both numbers.
std::optional<double> smooth_multiplier(const Model& model, const LimitLoad& load, const LimitOptions& options, const LimitResult& with);

// Throws Error as limit_problem() does, and NumbersError where a solver fails.
LimitResult limit_analysis(const Model& model, const LimitLoad& load, const LimitOptions& options);

}  // namespace erbs::analysis
