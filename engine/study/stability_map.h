// Stability map: for which time step, stiffness and damping a run stays bounded. It compares the theory of leapfrog and of the sequential
// sweep of Gu and Miao with runs. Plain data and closed forms; the caller makes the runs.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace erbs::study {

// Time integration of a run.
struct Scheme {
  bool sequential = false;        // the literal sweep in random order; else leapfrog
  bool explicit_damping = false;  // mass damping by the velocity before the step; else by the mean of both velocities
};

// Limits of the structure for a step, at the stiffness of the scene.
struct Stiffness {
  double critical = 0;  // s, 2 / omega_max
  double block = 0;     // s, 2 / omega_block of the stiffest block, its neighbours held
  double feed = 0;      // 1/s2, largest eigenvalue of M^-1 (D - K); see `sweep_feed`
};

Stiffness stiffer(Stiffness s, double factor);  // all stiffnesses times factor

// Smallest and largest mass damping c/m (1/s) for which steps of dt stay bounded; none if no damping is enough.
//   leapfrog            dt < 2 / omega_max; with explicit damping also (omega dt)^2 < 4 - 2 c dt
//   sequential sweep    the same with omega_block (neighbours held), and c > dt feed / 2, the rate at which the sweep feeds energy
struct Room {
  double least = 0, most = 0;  // 1/s; most may be infinite
};
std::optional<Room> room_of(const Scheme& scheme, const Stiffness& s, double dt);

struct MapRun {
  Scheme scheme;
  double factor = 1;   // on the stiffness
  std::string step;    // "T / 10, eq. (3)"
  double dt = 0;       // s
  double damping = 0;  // 1/s
  std::vector<std::string> words;
  enum class Verdict { waiting, converged, bounded, diverged, ledger, failed } verdict = Verdict::waiting;
  double until = 0;             // s, reached within the window
  std::optional<double> value;  // of the quantity, at the end
  struct Seen {
    double until = 0, value = 0;  // s, and the quantity at that time
  };
  std::vector<Seen> seen;       // samples along the run
  std::optional<double> ratio;  // of the quantity over that of leapfrog at this stiffness, at the last common sample
  double residual = 0, cpu = 0;
  int broken = 0;  // number of joints
  std::string reason;
};
const char* word(MapRun::Verdict verdict);

// The quantity over that of `reference`, at the last common sample.
std::optional<double> ratio_of(const MapRun& run, const MapRun& reference);

// Prediction of the theory: whether the run stays bounded.
bool foretold(const MapRun& run, const Stiffness& nominal);

}  // namespace erbs::study
