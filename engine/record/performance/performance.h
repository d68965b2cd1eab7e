// The performance point of a pushover: the structure as an oscillator of one degree of freedom, and the displacement to which a spectrum
// drives it. Two variants share all but the scale of the acceleration:
//   n2   EN 1998-1:2004 annex B (Fajfar 2000): A = F* / m* = V_b / (Gamma m*),  m* = Sum m phi
//   mpp  mass-proportional pushover: A = V_b / M,  M the whole moving mass
// with D = u / Gamma in both, phi the displaced shape, 1 at the monitored point, and Gamma = Sum m phi / Sum m phi^2.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "engine/record/format/json.h"
#include "engine/scene/performance.h"

namespace erbs {

// The curve of a push from the state under gravity alone, as far as each state is displaced further than all before.
struct BaseShearCurve {
  std::vector<double> displacement;  // m, of the monitored point, from the first state        [states]
  std::vector<double> shear;         // N, likewise                                            [states]
  std::vector<double> multiplier;    //                                                        [states]
  std::vector<double> time;          // s, of the state in the run folder                      [states]
  int peak = 0;                      // the state with the largest shear
};

// A block that moves, with its displacement along the push since the state under gravity alone.
struct ShapeBlock {
  std::string name, group;
  double mass = 0, height = 0;   // kg; m, of the centroid at rest
  double elastic = 0, peak = 0;  // m, in the first state under load; in the state with the largest load
};

struct PushShape {
  std::vector<ShapeBlock> blocks;
  double elastic = 0, peak = 0;  // m, of the monitored point in the same states
};

struct Participation {
  int nodes = 0;              // with mass
  double gamma = 0;           // Sum m phi / Sum m phi^2
  double phi_top = 0;         // of the highest node
  double mass = 0;            // kg, Sum m: all that moves
  double mass_star = 0;       // kg, Sum m phi
  double effective_mass = 0;  // kg, (Sum m phi)^2 / Sum m phi^2
};

// Nodes of a group stand for the whole mass, as a pier stands for a row of piers. Error without a shape.
Participation participation(const PushShape& shape, const PerformanceDemand& demand);

// Elastic up to the yield point, then level up to `end`: the same force and, up to `end`, the same energy as the curve (annex B.3).
struct BilinearCurve {
  double yield_displacement = 0, yield_acceleration = 0;  // m, m/s2
  double end = 0;                                         // m: d_m*
  double energy = 0;                                      // J/kg: E_m* / m*
  double period() const;                                  // s: T*
};
// Of the points up to `end`. A curve that is straight or stiffens yields at `end`.
BilinearCurve bilinear_curve(const std::vector<double>& D, const std::vector<double>& A, double end);

// The displacement to which a spectrum drives a bilinear oscillator (annex B.5).
struct TargetDisplacement {
  double period = 0;     // s: T*
  double demand = 0;     // m/s2: S_e(T*)
  double elastic = 0;    // m: d_et*
  double target = 0;     // m: d_t*
  double q = 0;          // S_e over the yield acceleration; below 1: elastic
  double ductility = 0;  // d_t* / d_y*
};
TargetDisplacement target_displacement(const BilinearCurve& curve, const DesignSpectrum& spectrum);

// One variant, with what the target means for the structure.
struct PerformancePoint {
  double mass = 0;        // kg, of the oscillator: M, or m*
  std::vector<double> A;  // m/s2, of the oscillator                  [states]
  BilinearCurve bilinear;
  TargetDisplacement oscillator;
  int rounds = 1;                                 // bilinear curves that were drawn, by halved steps, beyond a hundred by bisection
  bool within_curve = false;                      // else the demand exceeds the capacity
  double displacement = 0, top = 0;               // m, of the monitored point and of the highest mass node
  std::optional<double> multiplier, shear, time;  // [-], N, s: on the curve at the target, between two states
  std::optional<double> nearest, nearest_time;    // m, s: of the nearest state
};

struct Performance {
  std::string spectrum, shape;
  std::string trouble;  // why there is no performance point; "" if there is one
  Participation nodes;
  std::vector<double> D;  // m, of the oscillator                           [states]
  PerformancePoint mpp, n2;
};

// Error if the curve has no states under load, the shape has no displacement, or the spectrum ends too early.
Performance performance_of(const BaseShearCurve& curve, const PushShape& shape, const PerformanceDemand& demand);

Json to_json(const Performance& performance);           // numbers, for metrics.json
std::string performance_text(const Json& performance);  // of such numbers: the sentences for a terminal

}  // namespace erbs
