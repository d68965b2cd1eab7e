// Where time step, stiffness and damping let a run converge: what theory says of leapfrog and of the sequential sweep of Gu and Miao,
// and what was run. Plain data and closed forms; the runs are made by the caller.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace erbs {

// How a run goes on in time.
struct Scheme {
  bool sequential = false;        // the literal sweep, random order; else leapfrog
  bool explicit_damping = false;  // mass damping at the velocity before the step; else at the mean of both
};

// What the structure says to a step, at the stiffness of the scene.
struct Stiffness {
  double critical = 0;  // s, 2 / omega_max
  double block = 0;     // s, 2 / omega_block: of the stiffest block, its neighbours held
  double feed = 0;      // 1/s2, largest eigenvalue of M^-1 (D - K), see sweep_feed
};

Stiffness stiffer(Stiffness s, double factor);  // all stiffnesses times factor

// The smallest and the largest mass damping c/m (1/s) with which a step dt is bounded; none: it is with no damping at all.
//   leapfrog            dt < 2 / omega_max; explicit damping (omega dt)^2 < 4 - 2 c dt as well
//   sequential sweep    the same with omega_block, its neighbours being held, and c > dt feed / 2, what the sweep feeds
struct Room {
  double least = 0, most = 0;  // 1/s; most may be infinite
};
std::optional<Room> room_of(const Scheme& scheme, const Stiffness& s, double dt);

struct MapRun {
  Scheme scheme;
  double factor = 1;   // of stiffness
  std::string step;    // "T / 10, eq. (3)"
  double dt = 0;       // s
  double damping = 0;  // 1/s
  std::vector<std::string> words;
  enum class Verdict { waiting, converged, bounded, diverged, ledger, failed } verdict = Verdict::waiting;
  double until = 0;             // s of the window
  std::optional<double> value;  // of the quantity
  struct Seen {
    double until = 0, value = 0;  // s, and the quantity then
  };
  std::vector<Seen> seen;       // where the run was looked at on its way
  std::optional<double> ratio;  // of the quantity over that of leapfrog at this stiffness, the last time both were looked at
  double residual = 0, cpu = 0;
  int broken = 0;  // joints
  std::string reason;
};
const char* word(MapRun::Verdict verdict);

// The quantity over that of `reference` at the latest time at which both were looked at.
std::optional<double> ratio_of(const MapRun& run, const MapRun& reference);

// Theory's answer: bounded or not.
bool foretold(const MapRun& run, const Stiffness& nominal);

}  // namespace erbs
