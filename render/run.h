// A run folder as the pictures need it.
#pragma once
#include <string>
#include <vector>

#include "engine/record/motion_file.h"
#include "engine/scene/scene.h"

namespace erbs::render {

struct Paint {
  std::string name;
  Vec3 color{0.70, 0.35, 0.25};  // linear 0..1
};

// One component of the ground motion over the whole run.
struct GroundRecord {
  std::string axis;       // "x", "y", "z"; empty without ground motion
  std::vector<double> t;  // s
  std::vector<double> a;  // m/s2
  double peak = 0;        // m/s2, largest absolute value
};

// What happened first of its kind, for figures and the strip below pictures.
struct Mark {
  double t = 0;      // s
  std::string name;  // "first crack", "collapse"
};

struct Run {
  std::string dir, name, title;
  std::vector<Camera> cameras;   // as the scene gives them; may be empty
  std::vector<Paint> materials;  // by material index
  GroundRecord record;           // the strongest component
  std::vector<Mark> marks;       // in the order of time
  double energy_gate = 0;        // relative; 0: not known
  std::string status;            // of a run that is not to be relied on as it stands; "" where it was completed, or still goes
};

// Error where DIR is no run folder.
Run read_run(const std::string& dir);

}  // namespace erbs::render
