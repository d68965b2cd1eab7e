// The order in which a push visits its loads: which multiplier comes next, and what is known of the capacity.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/scene/push.h"

namespace erbs::analysis {

// Steps of the multiplier through the targets of a path. After the first load without equilibrium the interval to the last one with
// equilibrium is halved until it is narrow enough. Each step sways the structure beyond where it comes to rest, the longer the step the
// further: a load that failed from afar is tried once more from nearby, and if it stands then, steps go on from there, each twice the last.
struct LoadPath {
  std::vector<double> targets;
  double step = 0, bracket = 0;
  double at = 0;                // the last multiplier in equilibrium
  std::optional<double> above;  // one without equilibrium, ...
  double tried_from = 0;        // ... that was tried from here
  double stride = 0;            // of the next step
  int target = 0;

  LoadPath() = default;
  explicit LoadPath(const PushSettings& push);
  bool done() const;
  double next() const;
  void found();
  void failed();
  bool bracketed() const;

 private:
  double width() const;
  bool narrow() const { return above && std::fabs(*above - at) <= width(); }
};

// Displacement control: the load grows with the extension of a loading machine, multiplier = stiffness (extension - displacement of the
// monitored point). The machine is stiffer than a rigid block on its edge is weak, so that each of its extensions has one state of
// equilibrium. Beds that soften may be weaker still: a step that leaps over their states is repeated in parts with a machine eight times as
// stiff, until the curve is flat again. All other freedoms are free. The machine is no stiffer than the intact structure: where it pushes
// one block and looks at another, it would drive waves between the two. A leap that is left then is told (`leaps`). The displacement itself
// follows within a step. Until the peak is passed, a step in which the curve bends down is repeated in eight parts, and one of these in
// eight again where it falls, as after a brittle crack, while the curve might have risen by more than the bracket before. A part of the
// structure that the monitored point has no share in may come apart all the same: the interval to the first extension without equilibrium
// is halved until the multiplier there is known as narrowly as asked.
struct MachinePath {
  double end = 0, step = 0;     // m
  double stiffness = 0;         // 1/m, now, ...
  double soft = 0, stiff = 0;   // ... at its least and at its most
  double bracket = 0;           // relative, of the multiplier at which the structure comes apart, and of a peak
  double extension = 0;         // m
  std::optional<double> above;  // m, an extension without equilibrium
  double multiplier = 0, displacement = 0, before = 0;
  double slope = 0;         // 1/m, of the multiplier over the displacement, in the last step
  int parts = 1, left = 0;  // parts of a step, and how many of them are left
  bool peaked = false;

  MachinePath() = default;
  // `elastic`: 1/m, slope of the curve of the intact structure.
  explicit MachinePath(const PushSettings& push, double height, double elastic = std::numeric_limits<double>::infinity());
  bool done() const { return displacement >= (1 - 1e-3) * end || bracketed(); }
  bool bracketed() const;
  double next() const;  // the last step ends where a curve that goes on with its slope reaches the end
  double load(double extended, double displaced) const { return stiffness * (extended - displaced); }
  // Whether this step is to be repeated in parts.
  bool goes_too_far(double displaced) const { return passes_peak(displaced) || (leaps(displaced) && !above && stiffness < stiff); }
  void repeat(double displaced);
  // Further than the machine moves by itself: past its last state the structure weakens faster than the machine is stiff, and no state
  // between is known.
  bool leaps(double displaced) const { return displaced - displacement > std::max(most_leap * step, least_leap * end); }
  std::string leap_text(double displaced) const;
  static constexpr double most_leap = 3, least_leap = 0.05;  // steps; of the displacement asked for
  void found(double displaced);
  void failed() { above = next(); }

 private:
  bool passes_peak(double displaced) const;
  int parts_of_fall() const;
  void take_stiffness(double to);
};

// In two words of a checkpoint.
template <class Optional, class F>
void each_optional(Optional& value, const char* has_name, const char* name, F&& f) {
  bool has = value.has_value();
  double number = has ? *value : 0;
  f(has_name, has);
  f(name, number);
  if constexpr (!std::is_const_v<Optional>) value = has ? std::optional(number) : std::nullopt;
}

template <class P, class F>
requires std::is_same_v<std::remove_const_t<P>, LoadPath>
void each(P& p, F&& f) {
  f("path_at", p.at);
  f("path_target", p.target);
  each_optional(p.above, "path_has_above", "path_above", f);
  f("path_tried_from", p.tried_from);
  f("path_stride", p.stride);
}

template <class P, class F>
requires std::is_same_v<std::remove_const_t<P>, MachinePath>
void each(P& p, F&& f) {
  f("machine_end", p.end);
  f("machine_step", p.step);
  f("machine_soft", p.soft);
  f("machine_stiff", p.stiff);
  f("machine_bracket", p.bracket);
  f("machine_stiffness", p.stiffness);
  f("machine_extension", p.extension);
  f("machine_multiplier", p.multiplier);
  f("machine_displacement", p.displacement);
  f("machine_before", p.before);
  f("machine_slope", p.slope);
  f("machine_parts", p.parts);
  f("machine_left", p.left);
  f("machine_peaked", p.peaked);
  each_optional(p.above, "machine_has_above", "machine_above", f);
}

}  // namespace erbs::analysis
