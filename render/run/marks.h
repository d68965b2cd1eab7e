// Lines laid over a picture: forces of joints, thrust line and mechanism. Pictures and line drawings draw the same.
#pragma once
#include <string>
#include <vector>

#include "render/run/stage.h"

namespace erbs::render {

// A straight line in space. Widths are in px of a picture of 720 rows.
struct Stroke {
  Vec3 from{0, 0, 0}, to{0, 0, 0};  // m
  double width = 1;
  Vec3 color{0, 0, 0};  // linear
  bool head = false;    // an arrow's, at `to`
};
struct MarkRow {
  std::string name;
  double width = 1;  // 0: a remark, without a sample
  Vec3 color{0, 0, 0};
  bool head = false;
};
struct Marks {
  std::vector<Stroke> strokes;
  std::vector<MarkRow> legend;  // the same at all times of a film
};

struct MarkChoice {
  bool forces = false, thrust = false;
  std::string mechanism;  // "motion": velocities of the run; else the mechanism.csv of a limit analysis; "": none
  bool any() const { return forces || thrust || !mechanism.empty(); }
  int most_rows() const { return 2 * forces + thrust + (forces || thrust) + !mechanism.empty(); }  // of the legend
};

// Velocity (m/s) and spin (rad/s) of the blocks [blocks].
struct Rates {
  std::vector<Vec3> velocity, spin;
};
// Between two frames of a run; zero where they are one.
Rates rates_between(const MotionFrame& before, const MotionFrame& after);
// From the mechanism.csv of erbs limit, or from its folder; blocks that it does not name stay. Error for a foreign file, or for one of
// another scene.
Rates rates_of_mechanism(const std::string& given, const MotionScene& scene);

// Values that have the greatest width, and the length of the longest arrow; common to all frames of a film.
struct MarkScale {
  double force = 1;       // N; 0 where no joint has one in any picture
  double speed = 1;       // m/s
  bool replaced = false;  // contact has taken the place of joints, whose forces are then not drawn
};
// Of the normal forces of all joints in a frame, the largest (N); of the speeds of the blocks that move, the largest (m/s).
double largest_force(const MotionScene& scene, const MotionFrame& frame);
double largest_speed(const MotionScene& scene, const Rates& rates);

// `actual`: the frame as computed, with the forces of its joints; `drawn`: the same with its displacements magnified.
Marks marks_of(const MarkChoice& choice, const MotionScene& scene, const Stage& stage, const MotionFrame& actual, const MotionFrame& drawn,
               const Rates& rates, const MarkScale& scale);

}  // namespace erbs::render
