// A quasi-static analysis: how a structure in equilibrium is pushed until it collapses.
#pragma once
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/field.h"

namespace erbs {

// A force of the pattern. It acts at the centroid of the block, or at the centroids of a group's blocks in proportion to their mass.
struct PatternForce {
  std::string block, group;   // one of them
  Vec3 force = Vec3::Zero();  // N, at the multiplier 1

  static Fields<PatternForce> fields() {
    return {
        {"block", &PatternForce::block, "", "name of the block"},
        {"group", &PatternForce::group, "", "all blocks of a group, in proportion to their mass"},
        {"force", &PatternForce::force, "N", "the force at the multiplier 1", -1e15, 1e15, true},
    };
  }
};

// A material point whose displacement is the abscissa of the curve.
struct Monitor {
  std::string block;          // empty: the highest block
  Vec3 point = Vec3::Zero();  // m at rest
  bool has_point = false;     // else the centroid

  static Fields<Monitor> fields() {
    return {
        {"block", &Monitor::block, "", "name of the block (default: the highest one)"},
        {"point", &Monitor::point, "m", "material point at rest (default: the centroid)", -1e6, 1e6},
    };
  }
};

struct PushSettings {
  std::string kind = "dynamic";         // dynamic: there is none | tilt | pushover
  Vec3 direction{1, 0, 0};              // unit vector: of the acceleration that acts on the masses, or towards the side that a tilt lowers
  std::vector<PatternForce> pattern;    // empty: an acceleration of the multiplier times g on every block
  std::vector<double> path;             // multipliers (tilt: rad) to visit in turn before the last push
  double step = 0;                      // first step of the multiplier (tilt: rad); 0: 0.01 and 0.5 degrees
  double up_to = 0;                     // largest multiplier (tilt: rad); 0: 2 and 60 degrees
  double bracket = 0.002;               // width of the bracket of the capacity, relative
  std::string control = "load";         // load | displacement: the multiplier follows from the displacement of the monitored point
  double displacement = 0;              // m, control by displacement: where the push ends
  double displacement_step = 0;         // m; 0: a fiftieth of `displacement`
  std::string relaxation = "critical";  // critical | kinetic | adaptive | local: damping on the way to equilibrium
  std::string inertia = "scaled";       // scaled | true
  double unbalanced = 1e-5;             // mean unbalanced force over mean applied force in equilibrium
  std::string limit = "auto";           // auto | always | never: limit analysis beside the capacity
  double fall = 4;                      // s, the longest time of the fall that is drawn
  Monitor monitor;
  Place place;

  bool quasi_static() const { return kind != "dynamic"; }
  bool tilts() const { return kind == "tilt"; }

  static Fields<PushSettings> fields() {
    return {
        {"kind", &PushSettings::kind, "", "time history, or a push through states of equilibrium until the structure collapses", 0, 0,
         false, "dynamic|tilt|pushover"},
        {"step", &PushSettings::step, "",
         "tilt, pushover: first step of the multiplier, a share of g or of the pattern; of a tilt in rad (0: 0.01; 0.5 deg)", 0, 1e6},
        {"up_to", &PushSettings::up_to, "", "tilt, pushover: largest multiplier; of a tilt in rad (0: 2; 60 deg)", 0, 1e6},
        {"bracket", &PushSettings::bracket, "", "tilt, pushover: width of the bracket of the capacity, relative", 1e-6, 0.5},
        {"control", &PushSettings::control, "",
         "pushover: steps of the multiplier, or of the displacement of the monitored point, past the peak", 0, 0, false,
         "load|displacement"},
        {"displacement", &PushSettings::displacement, "m", "control by displacement: where the push ends", 0, 1e6},
        {"displacement_step", &PushSettings::displacement_step, "m", "control by displacement: step (0: a fiftieth of displacement)", 0,
         1e6},
        {"relaxation", &PushSettings::relaxation, "", "tilt, pushover: damping on the way to equilibrium", 0, 0, false,
         "critical|kinetic|adaptive|local"},
        {"inertia", &PushSettings::inertia, "", "tilt, pushover: masses on the way to equilibrium, scaled to one time step or true", 0, 0,
         false, "scaled|true"},
        {"unbalanced", &PushSettings::unbalanced, "", "tilt, pushover: mean unbalanced force over mean applied force in equilibrium", 1e-9,
         1e-2},
        {"limit", &PushSettings::limit, "",
         "tilt, pushover: limit analysis beside the capacity; auto: up to 12000 contact points of the limit problem, where it takes "
         "seconds",
         0, 0, false, "auto|always|never"},
        {"fall", &PushSettings::fall, "s",
         "tilt, pushover: the longest time of the fall that is drawn after the capacity is known (0: none; the mechanism is named all the "
         "same)",
         0, 1e3},
    };
  }
};

struct Scene;
// Mistakes of the push of a scene, and of the spectrum that asks for its performance point.
std::vector<std::string> check_push(const Scene& scene);

}  // namespace erbs
