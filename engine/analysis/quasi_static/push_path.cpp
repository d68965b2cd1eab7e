#include "engine/analysis/quasi_static/push_path.h"

#include <algorithm>
#include <cmath>

#include "engine/base/units.h"

namespace erbs::analysis {
namespace {

constexpr double default_step = 0.01, default_end = 2;                           // share of g, or of the pattern
constexpr double default_tilt_step = 0.5 * pi / 180, default_tilt_end = pi / 3;  // rad
constexpr double displacement_steps = 50;
constexpr int parts_at_peak = 8, most_parts = 4096;
constexpr double nearby = 2;  // widths of the bracket
constexpr double stiffer = 8;
constexpr double fall_of_step = 0.02;  // of the multiplier, in a step along a curve that falls, if that is more than a whole step rises
constexpr double flat = 0.5;           // slope of a curve that falls, over the stiffness of a machine that follows it

}  // namespace

LoadPath::LoadPath(const PushSettings& push)
    : targets(push.path),
      step(push.step > 0  ? push.step
           : push.tilts() ? default_tilt_step
                          : default_step),
      bracket(push.bracket),
      stride(step) {
  targets.push_back(push.up_to > 0 ? push.up_to : push.tilts() ? default_tilt_end : default_end);
}

double LoadPath::width() const { return std::max(bracket * std::fabs(*above), 1e-3 * bracket * step); }

bool LoadPath::bracketed() const { return narrow() && std::fabs(*above - tried_from) <= nearby * width(); }

bool LoadPath::done() const { return bracketed() || target == int(targets.size()); }

double LoadPath::next() const {
  if (above) return narrow() ? *above : 0.5 * (at + *above);
  const double to = targets[std::size_t(target)], way = to - at;
  return std::fabs(way) <= 1.000001 * stride ? to : at + std::copysign(stride, way);
}

void LoadPath::found() {
  const double to = next(), last = std::fabs(to - at);
  if (above && to == *above) above.reset(), stride = last;
  else if (!above) stride = std::min(step, 2 * stride);
  at = to;
  if (!above && at == targets[std::size_t(target)]) ++target;
}

void LoadPath::failed() {
  above = next();
  tried_from = at;
}

MachinePath::MachinePath(const PushSettings& push, double height, double elastic)
    : end(push.displacement),
      step(push.displacement_step > 0 ? push.displacement_step : push.displacement / displacement_steps),
      bracket(push.bracket) {
  // A rigid block of height h on its edge loses less than 2 / h of its weight per displacement of its top.
  stiffness = soft = std::max(std::min(2 * (push.step > 0 ? push.step : default_step) / step, elastic), 10 / height);
  stiff = std::isfinite(elastic) ? std::max(elastic, soft) : soft;
}

bool MachinePath::passes_peak(double displaced) const {
  if (peaked) return false;
  const double rises = load(next(), displaced) - multiplier, longer = next() - extension;
  // A whole step: the curve rises by less than half as much as in the step before.
  if (parts == 1) return rises < 0.5 * (multiplier - before) * longer / step;
  // It may have risen no further than with its slope, nor than the machine pushes a structure that stands still.
  const double at_most = std::min(slope * (displaced - displacement), stiffness * longer);
  return rises < 0 && parts < most_parts && at_most > bracket * std::fabs(multiplier);
}

std::string MachinePath::leap_text(double displaced) const {
  return fmt::format(
      "the push leaps from {:.4g} to {:.4g} mm, no state between is known: the structure weakens faster than the loading machine "
      "is stiff, and stiffer than the intact structure it cannot be",
      1e3 * displacement, 1e3 * displaced);
}

void MachinePath::repeat(double displaced) {
  if (passes_peak(displaced)) {
    parts *= parts_at_peak;
  } else {
    take_stiffness(std::min(stiffer * stiffness, stiff));
    parts = parts_of_fall();
  }
  left = 2 * parts_at_peak;
}

int MachinePath::parts_of_fall() const {
  return int(std::ceil(stiffness * step / std::max(soft * step, fall_of_step * std::fabs(multiplier))));
}

// Under the same load.
void MachinePath::take_stiffness(double to) { stiffness = to, extension = displacement + multiplier / stiffness; }

bool MachinePath::bracketed() const { return above && stiffness * (*above - extension) <= std::max(bracket * std::fabs(multiplier), 1e-9); }

double MachinePath::next() const {
  if (above) return 0.5 * (extension + *above);
  return extension + std::min(step / parts, (end - displacement) * std::max(0.3, 1 + slope / stiffness));
}

void MachinePath::found(double displaced) {
  const double to = next(), now = load(to, displaced);
  if (displaced != displacement) slope = (now - multiplier) / (displaced - displacement);
  peaked = peaked || (parts > 1 && now < multiplier);
  extension = to, before = multiplier, multiplier = now, displacement = displaced;
  if (parts == 1 || --left > 0) return;
  if (stiffness > soft && slope < -flat * soft) {  // it would leap once more
    parts = parts_of_fall(), left = 1;
  } else {
    take_stiffness(soft);
    parts = 1, before = multiplier - stiffness * step;  // a step ahead of the next bend
  }
}

}  // namespace erbs::analysis
