// Quantities of blocks that pictures show as colours.
#include <algorithm>
#include <array>
#include <cmath>

#include "render/draw/draw.h"

namespace erbs::render {

Vec3 map_color(double share) {
  // Nine samples of viridis (van der Walt and Smith 2015), display values.
  static const std::array<Vec3, 9> stops{Vec3(0.267, 0.005, 0.329), Vec3(0.279, 0.175, 0.483), Vec3(0.230, 0.322, 0.546),
                                         Vec3(0.173, 0.449, 0.558), Vec3(0.128, 0.567, 0.551), Vec3(0.158, 0.684, 0.502),
                                         Vec3(0.369, 0.789, 0.383), Vec3(0.678, 0.864, 0.190), Vec3(0.993, 0.906, 0.144)};
  const double x = (std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 1.0) * (stops.size() - 1);
  const auto k = std::min(stops.size() - 2, static_cast<std::size_t>(x));
  const double t = x - static_cast<double>(k);
  return ((1 - t) * stops[k] + t * stops[k + 1]).array().pow(2.2);
}

double map_share(double value, double scale, Coloring coloring) {
  const double share = value / scale;
  return coloring == Coloring::energy ? 1 + std::log10(std::max(share, 1e-12)) / energy_decades : share;
}

Vec3 state_color(JointState state) {
  static const std::array<Vec3, 3> colors{Vec3(0.36, 0.44, 0.52), Vec3(0.85, 0.33, 0.02), Vec3(0.33, 0.0, 0.02)};
  return colors[static_cast<std::size_t>(state)];
}

std::vector<double> block_values(const MotionScene& scene, const MotionFrame& frame, Coloring coloring) {
  std::vector<double> value(scene.blocks.size());
  if (coloring == Coloring::displacement)
    for (std::size_t b = 0; b < value.size(); ++b)
      value[b] = (Eigen::Map<const Eigen::Vector3f>(&frame.poses[7 * b]).cast<double>() - scene.blocks[b].rest).norm();
  if (coloring == Coloring::speed || coloring == Coloring::slip || coloring == Coloring::energy || is_stress(coloring))
    std::copy_n(frame.derived.begin(), std::min(frame.derived.size(), value.size()), value.begin());
  if (coloring == Coloring::opening)
    for (std::size_t j = 0; j < scene.joints.size(); ++j)
      for (int block : {scene.joints[j].a, scene.joints[j].b}) {
        double& largest = value[static_cast<std::size_t>(block)];
        largest = std::max(largest, static_cast<double>(frame.opening[j]));
      }
  return value;
}

double round_up(double value) {
  const double ten = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0})
    if (value <= step * ten * (1 + 1e-9)) return step * ten;
  return 10 * ten;
}

double color_scale(const MotionScene& scene, const std::vector<MotionFrame>& frames, Coloring coloring, const Eigen::AlignedBox3d& seen) {
  std::vector<double> largest;
  for (std::size_t b = 0; b < scene.blocks.size(); ++b)
    if (!scene.blocks[b].fixed) largest.push_back(0);
  for (const MotionFrame& frame : frames) {
    const std::vector<double> value = block_values(scene, frame, coloring);
    for (std::size_t b = 0, free = 0; b < value.size(); ++b)
      if (!scene.blocks[b].fixed) {
        const Vec3 at = Eigen::Map<const Eigen::Vector3f>(&frame.poses[7 * b]).cast<double>();
        if (std::isfinite(value[b]) && (seen.isEmpty() || seen.contains(at))) largest[free] = std::max(largest[free], value[b]);
        ++free;
      }
  }
  if (largest.empty()) return 1;
  std::sort(largest.begin(), largest.end());
  const double top = largest[std::min(largest.size() - 1, static_cast<std::size_t>(0.98 * static_cast<double>(largest.size())))];
  if (!(top > 1e-9)) return 1e-6;  // nothing moved by more than rounding
  return round_up(top);
}

}  // namespace erbs::render
