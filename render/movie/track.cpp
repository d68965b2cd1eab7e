// Cameras that move: along keyframes, or with some of the blocks.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/spelling.h"
#include "engine/base/text.h"
#include "render/movie/scenery.h"

namespace erbs::render {
namespace {

// "1, 2,3" as three numbers; false if it is anything else.
bool read_numbers(std::string_view text, double* values, int count) {
  for (int i = 0; i < count; ++i) {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), values[i]);
    if (error != std::errc() || !std::isfinite(values[i])) return false;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    if (i + 1 < count && (text.empty() || text.front() != ',')) return false;
    if (i + 1 < count) text.remove_prefix(1);
  }
  return text.empty();
}

// Blocks that are followed. Error for a name that is neither a group nor a block, and for debris where nothing has fallen.
std::vector<std::size_t> followed_blocks(const std::string& what, const MotionScene& scene, const MotionFrame& last) {
  std::vector<std::size_t> found;
  std::vector<std::string> names;
  for (std::size_t b = 0; b < scene.blocks.size(); ++b) {
    const MotionBlock& block = scene.blocks[b];
    names.push_back(block.name);
    if (!block.group.empty()) names.push_back(block.group);
    if (block.fixed) continue;
    if (what == "debris") {
      Eigen::AlignedBox3d box;
      for (const int part : block.parts) {
        const std::vector<float>& v = scene.shapes[static_cast<std::size_t>(part)].vertices;
        for (std::size_t i = 0; i + 2 < v.size(); i += 3) box.extend(Vec3(v[i], v[i + 1], v[i + 2]));
      }
      if (!box.isEmpty() && block.rest.z() - static_cast<double>(last.poses[7 * b + 2]) > 0.5 * box.sizes().minCoeff()) found.push_back(b);
    } else if (block.group == what || block.name == what) {
      found.push_back(b);
    }
  }
  if (!found.empty()) return found;
  if (what == "debris") throw Error("--follow debris: no block has fallen at the end of this run; name a group or a block");
  const std::string near = nearest(what, names);
  throw Error("--follow " + shown(what, 60) + " is no group and no block of this run that can move" +
              (near.empty() ? "; name one, or debris for what falls" : "; did you mean \"" + near + "\"?"));
}

}  // namespace

std::vector<CameraKey> camera_path(const std::string& text) {
  const Error wrong("--path " + shown(text, 80) + " is no path; write two or more keyframes \"t:x,y,z:x,y,z; ...\" (s; m, eye and target)");
  std::vector<CameraKey> keys;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(';', at), text.size());
    const std::string_view one = std::string_view(text).substr(at, end - at);
    at = end + 1;
    if (one.find_first_not_of(' ') == std::string_view::npos) continue;
    const std::size_t first = one.find(':'), second = one.find(':', std::min(first, one.size() - 1) + 1);
    CameraKey key;
    if (first == std::string_view::npos || second == std::string_view::npos || !read_numbers(one.substr(0, first), &key.t, 1) ||
        !read_numbers(one.substr(first + 1, second - first - 1), key.eye.data(), 3) ||
        !read_numbers(one.substr(second + 1), key.target.data(), 3))
      throw wrong;
    if (!((key.eye - key.target).norm() > 1e-9))
      throw Error(
          fmt::format("--path: at {:g} s eye and target are the same point, so that the camera looks nowhere; move one of them", key.t));
    if (!keys.empty() && !(key.t > keys.back().t))
      throw Error(fmt::format("--path: the keyframe at {:g} s comes after that at {:g} s; order them by time", key.t, keys.back().t));
    keys.push_back(key);
  }
  if (keys.size() < 2) throw wrong;
  return keys;
}

Camera along_path(const Camera& like, const std::vector<CameraKey>& keys, double t) {
  Camera camera = like;
  camera.up = Vec3::UnitZ();
  std::size_t i = 0;
  while (i + 2 < keys.size() && keys[i + 1].t <= t) ++i;
  const double span = keys[i + 1].t - keys[i].t, s = std::clamp((t - keys[i].t) / span, 0.0, 1.0), s2 = s * s, s3 = s2 * s;
  const auto between = [&](Vec3 CameraKey::*point) {
    const auto slope = [&](std::size_t k) -> Vec3 {  // 1/s, of the curve at a keyframe; it starts and ends at rest
      if (k == 0 || k + 1 == keys.size()) return Vec3::Zero();
      return (keys[k + 1].*point - keys[k - 1].*point) / (keys[k + 1].t - keys[k - 1].t);
    };
    return Vec3((2 * s3 - 3 * s2 + 1) * (keys[i].*point) + (s3 - 2 * s2 + s) * span * slope(i) + (3 * s2 - 2 * s3) * (keys[i + 1].*point) +
                (s3 - s2) * span * slope(i + 1));
  };
  camera.eye = between(&CameraKey::eye), camera.target = between(&CameraKey::target);
  const Vec3 back = camera.eye - camera.target;
  if (back.cross(camera.up).norm() < 1e-6 * back.norm()) camera.up = Vec3::UnitY();
  return camera;
}

Shot follow(const Camera& camera, const std::string& what, bool fit, const MotionReader& reader, const Excerpt& excerpt, const Stage& stage,
            double magnification) {
  const int count = static_cast<int>(reader.times().size());
  const auto frame = [&](int i) {
    MotionFrame f = excerpt_of(excerpt, reader.read(i));
    magnify(excerpt.scene, magnification, f);
    return f;
  };
  const std::vector<std::size_t> blocks = followed_blocks(what, excerpt.scene, frame(count - 1));
  std::vector<Vec3> mean;
  std::vector<double> reach;  // m, how far nine tenths of the blocks are from their mean
  for (int i = 0; i < count; ++i) {
    const MotionFrame f = frame(i);
    std::vector<Vec3> at;
    for (const std::size_t b : blocks)
      if (const Vec3 p = Eigen::Map<const Eigen::Vector3f>(&f.poses[7 * b]).cast<double>(); p.allFinite()) at.push_back(p);
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : at) sum += p;
    mean.push_back(at.empty() ? (mean.empty() ? stage.building.center() : mean.back()) : Vec3(sum / static_cast<double>(at.size())));
    std::vector<double> away;
    for (const Vec3& p : at) away.push_back((p - mean.back()).norm());
    std::sort(away.begin(), away.end());
    if (!away.empty()) reach.push_back(away[(9 * away.size()) / 10 < away.size() ? (9 * away.size()) / 10 : away.size() - 1]);
  }
  const Vec3 back = camera.eye - camera.target;
  double distance = back.norm();
  if (fit && !reach.empty())
    distance = (*std::max_element(reach.begin(), reach.end()) + 0.06 * stage.size()) * 1.25 / std::tan(0.5 * camera.fov);
  const double lowest = stage.ground_z + 0.04 * stage.size();
  const std::vector<double> times = reader.times();
  const auto at = [=](double t) {
    Vec3 sum = Vec3::Zero();
    double weight = 0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      const double w = std::exp(-0.5 * std::pow((times[i] - t) / 0.25, 2)) + 1e-300;
      sum += w * mean[i], weight += w;
    }
    Camera moved = camera;
    moved.target = sum / weight;
    moved.eye = moved.target + distance * back.normalized();
    if (moved.eye.z() < lowest && back.z() > -0.02 * back.norm()) moved.eye.z() = lowest;
    return moved;
  };
  return {at(times.front()), at};
}

}  // namespace erbs::render
