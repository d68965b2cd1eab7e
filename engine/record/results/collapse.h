// Criterion of collapse. A block has fallen if its centroid is lower than at the start, relative to the ground and along the gravity of the
// scene, by more than half its thinnest extent; what a driven support that bears it has been lowered by is no fall. The structure has
// collapsed if the fallen share of the moving mass reaches `Analysis::collapse_fraction`. What is thrown at the structure is no part of it,
// and counts in neither mass.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/model/model.h"
#include "engine/model/state.h"
#include "engine/record/results/lowered_supports.h"
#include "engine/record/results/mechanism.h"
#include "engine/scene/scene.h"

namespace erbs {

struct Collapse {
  std::vector<double> start;  // m, height of each centroid above rest, at the start [nblock]
  LoweredSupports supports;
  std::vector<std::uint8_t> thrown;  // the block flies by itself from the start (thrown_blocks) [nblock]
  std::vector<std::uint8_t> fallen;  // the block has fallen at some time [nblock], ...
  std::vector<double> fall_time;     // s, ... for the first time at this one [nblock]
  double fallen_fraction = 0;        // fallen share of the moving mass, now
  bool collapsed = false;            // the share has once reached Analysis::collapse_fraction
  double time = 0;                   // s, at which the share reached it
  bool under_gravity = false;        // the structure cannot stand under its own weight: a collapse without a cause in time
  bool moved = false;                // a block has moved by Analysis::stop_when_moved from rest
  Mechanism mechanism;               // at the collapse
};

template <class C, class F>
requires std::is_same_v<std::remove_const_t<C>, Collapse>
void each(C& c, F&& f) {
  f("collapse_start", c.start);
  f("collapse_supports_left", c.supports.left);
  f("collapse_thrown", c.thrown);
  f("collapse_fallen", c.fallen);
  f("collapse_fall_time", c.fall_time);
  f("collapse_fraction", c.fallen_fraction);
  f("collapse_collapsed", c.collapsed);
  f("collapse_time", c.time);
  f("collapse_under_gravity", c.under_gravity);
  f("collapse_moved", c.moved);
  f("collapse_mechanism", c.mechanism);
}

Collapse watch_collapse(const Model& model, const BlockPoses& start);
// Blocks that start with a velocity and that no joint leads to the ground, where there are others that joints do lead there: projectiles.
std::vector<std::uint8_t> thrown_blocks(const Scene& scene, const Model& model, const State& start);

// Updates the criterion with the poses at time t. Appends blocks that have fallen for the first time to `newly`, if given. Returns true at
// the moment of collapse.
bool update(Collapse& collapse, const Model& model, const BlockPoses& pose, double t, std::vector<int>* newly = nullptr);

// Share of the moving mass that has not fallen, but moves relative to the ground, with a speed that would lift it by a fiftieth of its
// thinnest extent. Above zero at the end of a run without a collapse, that run may have ended too early. Zero without gravity.
double moving_fraction(const Collapse& collapse, const Model& model, const State& state);

// "between 3.36 and 3.37 s": what is looked at when rows and frames are due, and found at the time t, came after the look before.
std::string span_of_event(double output_dt, double frame_dt, double t);
inline std::string span_of_event(const Analysis& how, double t) { return span_of_event(how.output_dt, how.frame_dt, t); }

// Mean horizontal displacement (x, y) of the blocks that are down now, as a unit vector. Empty if no block is down. Empty also if the mean
// vector is shorter than a tenth of the mean length, since the blocks fell in all directions, or if they fell straight down.
std::optional<std::array<double, 2>> collapse_direction(const Collapse& collapse, const Model& model, const BlockPoses& pose);

}  // namespace erbs
