// What stands around the model: sky and ground.
#pragma once
#include <algorithm>
#include <cmath>

#include "render/draw/draw.h"

namespace erbs::render {

// Linear colours around the model.
struct Backdrop {
  Eigen::Vector3f horizon, high, ground, floor;  // high: of the sky
};
inline Backdrop backdrop(Background background) {
  const Eigen::Vector3f paper = Eigen::Vector3f::Ones();
  if (background != Background::sky) return {paper, paper, {0.84F, 0.84F, 0.85F}, paper};
  return {{0.80F, 0.83F, 0.86F}, {0.46F, 0.60F, 0.76F}, {0.54F, 0.535F, 0.52F}, {0.56F, 0.57F, 0.58F}};
}

// All that sky and open ground depend on.
struct Standpoint {
  Eigen::Matrix4f camera;
  Eigen::Vector3f eye, sun;
  float target_distance;
  Eigen::Matrix4d table;  // its position; zero: it stays
  bool operator==(const Standpoint&) const = default;
};

// Of a linear colour, as the shaders encode it.
inline float encoded(float linear) { return std::pow(std::clamp(linear, 0.0F, 1.0F), 1 / 2.2F); }

}  // namespace erbs::render
