// The part of a run folder that pictures need.
#pragma once
#include <string>
#include <vector>

#include "engine/record/folder/identity.h"
#include "engine/record/folder/motion_file.h"
#include "engine/scene/scene.h"

namespace erbs::render {

struct Paint {
  std::string name;
  Vec3 color{0.70, 0.35, 0.25};  // linear 0..1
  double density = 0;            // kg/m3
};

// The ground motion along its principal direction, over the whole run.
struct GroundRecord {
  std::string axis;  // of that direction: "x", "y", "z", or its components; empty without ground motion
  Vec3 direction = Vec3::Zero();
  std::vector<double> t;  // s
  std::vector<double> a;  // m/s2
  double peak = 0;        // m/s2, largest absolute value; of a tilt by states with its sign
};

// Gravity of a test that tilts; empty where it keeps its direction.
struct GravityRecord {
  std::vector<double> t;  // s
  std::vector<Vec3> g;    // m/s2
  bool empty() const { return t.empty(); }
};
Vec3 gravity_at(const GravityRecord& gravity, double t);  // linear between rows, constant outside
// Rotation from the scene to a level world, in which gravity points down.
Mat3 levelling(const GravityRecord& gravity, double t);  // the identity without a record

// First event of a kind, for figures and the strip below pictures.
struct Mark {
  double t = 0;      // s, of the row or frame that shows it
  std::string name;  // "first crack", "collapse"
  std::string when;  // "between 3.36 and 3.37 s", which is what is known of it; of a push "at state 7: 0.12 g"
};

struct Run {
  std::string dir, name, title;
  SceneIdentity identity;
  std::vector<Camera> cameras;   // from the scene; may be empty
  std::vector<Paint> materials;  // by material index
  GroundRecord record;           // the strongest component
  GravityRecord gravity;
  GroundRecord tilt;        // the same as angle about a horizontal axis; a and peak in degrees
  std::vector<Mark> marks;  // in order of time
  // Of a push, which has states of equilibrium in place of times: the i-th stands at i * state_dt, and then the structure may fall.
  std::vector<double> multipliers;  // [states]
  std::string multiplier_unit;      // "g", "tan" of a tilt, or ""
  double state_dt = 0;              // s
  double frame_dt = 0, end = 0;     // s, between recorded frames, and of the whole run
  bool dry = false;                 // no joint has a bond
  double energy_tolerance = 0;      // relative; 0: unknown
  std::string verdict;              // one sentence on a collapse; "" without one
  std::string status;               // status of an unreliable run; "" if completed or still running

  const GroundRecord& strip() const { return record.axis.empty() ? tilt : record; }  // what the strip below pictures shows
};

// The clock of a picture: "1.25 s", or of a push "state 7: 0.12 g", "fall + 0.40 s".
std::string clock_text(const Run& run, double t);
// The widest that it becomes.
std::string widest_clock(const Run& run);

// Error if DIR is no run folder.
Run read_run(const std::string& dir);

}  // namespace erbs::render
