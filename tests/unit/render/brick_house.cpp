#include "tests/unit/render/brick_house.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "engine/base/error.h"
#include "engine/base/units.h"
#include "engine/record/folder/run_folder.h"

namespace erbs {
namespace {

constexpr double joint = 0.005, pitch = 0.105, wall = 0.125;  // m
constexpr double first_fall = 2.0;                            // s

// Evenly distributed in -1..1, from an index and a stream.
double noise(std::size_t i, unsigned stream) {
  auto x = static_cast<std::uint32_t>(i * 2654435761U + stream * 40503U);
  x ^= x >> 15U;
  x *= 2246822519U;
  x ^= x >> 13U;
  x *= 3266489917U;
  x ^= x >> 16U;
  return static_cast<double>(x) / 2147483647.5 - 1.0;
}

struct Maker {
  MotionScene scene;
  std::vector<Eigen::AlignedBox3d> boxes;
  void box(const Vec3& low, const Vec3& high, const char* group, int material, bool fixed = false) {
    const Vec3 h = 0.5 * (high - low), c = 0.5 * (high + low);
    MotionShape shape;
    for (int i = 0; i < 8; ++i)
      for (int k = 0; k < 3; ++k) shape.vertices.push_back(static_cast<float>((i >> k & 1) ? h[k] : -h[k]));
    shape.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    scene.blocks.push_back({fmt::format("{}{}", group, scene.blocks.size()), group, material, fixed, c, {share_shape(scene, shape)}});
    boxes.emplace_back(low, high);
  }
  // One course of a wall along x or y from `from` to `to`, cut by openings [a, b].
  void course(int axis, double from, double to, double across, double z, bool shifted,
              const std::vector<std::pair<double, double>>& holes) {
    double at = from;
    bool first = true;
    while (at < to - 0.04) {
      double end = std::min(to, at + (first && shifted ? 0.15 : 0.30));
      if (to - end < 0.05) end = to;
      first = false;
      double a = at, b = end;
      for (const auto& [low, high] : holes) {
        if (a < high && b > low) {
          if (a >= low) a = std::max(a, high);
          else b = std::min(b, low);
        }
      }
      if (b - a > 0.035) {
        Vec3 lo, hi;
        lo[axis] = a, hi[axis] = b, lo[1 - axis] = across, hi[1 - axis] = across + wall, lo.z() = z, hi.z() = z + 0.1;
        box(lo, hi, "wall", 0);
      }
      at = end + joint;
    }
  }
};

// Boxes that face each other across a mortar joint.
void find_joints(Maker& m) {
  for (std::size_t i = 0; i < m.boxes.size(); ++i) {
    for (std::size_t j = i + 1; j < m.boxes.size(); ++j) {
      const Eigen::AlignedBox3d &a = m.boxes[i], &b = m.boxes[j];
      for (int k = 0; k < 3; ++k) {
        const double up = b.min()[k] - a.max()[k], down = a.min()[k] - b.max()[k];
        if (std::abs(up - joint) > 1e-4 && std::abs(down - joint) > 1e-4) continue;
        const int u = (k + 1) % 3, v = (k + 2) % 3;
        const double u0 = std::max(a.min()[u], b.min()[u]), u1 = std::min(a.max()[u], b.max()[u]);
        const double v0 = std::max(a.min()[v], b.min()[v]), v1 = std::min(a.max()[v], b.max()[v]);
        if (u1 - u0 < 0.01 || v1 - v0 < 0.01) continue;
        const bool above = std::abs(up - joint) <= 1e-4;
        MotionJoint found{static_cast<int>(i), static_cast<int>(j), {}, Vec3::Zero(), joint};
        found.normal[k] = above ? 1 : -1;
        for (const auto& [pu, pv] : {std::pair{u0, v0}, {u1, v0}, {u1, v1}, {u0, v1}}) {
          Vec3 p;
          p[k] = above ? a.max()[k] + 0.5 * joint : a.min()[k] - 0.5 * joint;
          p[u] = pu, p[v] = pv;
          found.polygon.push_back(p - m.scene.blocks[i].rest);
        }
        m.scene.joints.push_back(found);
      }
    }
  }
}

// Time (s) at which a block comes loose: the upper storeys fall towards +x, starting from a diagonal crack.
double release(const MotionScene& scene, std::size_t b) {
  const MotionBlock& block = scene.blocks[b];
  if (block.fixed) return 1e9;
  const double crack = 0.9 + 0.55 * (block.rest.x() + 0.76) / 1.5 + 0.25 * noise(b, 1);
  if (block.rest.z() < crack) return 1e9;
  return first_fall + 0.20 * (block.rest.z() - crack) + 0.12 * noise(b, 2);
}

double ground(double t) {
  return 0.4 * standard_g * std::sin(9 * t) * std::exp(-0.15 * t) * (0.6 + 0.4 * std::sin(31 * t)) * std::min(1.0, 3 * t);
}

}  // namespace

MotionScene brick_house(const BrickHouse& house) {
  Maker m;
  const double x = 0.5 * house.length_x, y = 0.5 * house.length_y;
  m.box({-10, -10, -1}, {10, 10, -joint}, "ground", 2, true);
  for (int c = 0, storey = 0; c < house.courses; ++c) {
    const int in_storey = c % 13;
    if (c > 0 && in_storey == 0 && house.courses >= 39) ++storey;
    const double z = c * pitch + storey * (0.02 + joint);
    using Holes = std::vector<std::pair<double, double>>;
    Holes front, side;
    if (storey == 0 && in_storey < 10) front = {{-0.3, 0.3}};
    if (storey > 0 && in_storey >= 4 && in_storey < 10) front = {{-0.35, 0.35}};
    if (in_storey >= 4 && in_storey < 10) side = {{-0.45, 0.45}};
    const bool odd = c % 2 == 1;
    // Corners interlock: walls along x run through in even courses, walls along y in odd ones.
    const double cut = wall + joint;
    m.course(0, odd ? -x + cut : -x, odd ? x - cut : x, -y, z, odd, front);
    m.course(0, odd ? -x + cut : -x, odd ? x - cut : x, y - wall, z, odd, {});
    m.course(1, odd ? -y : -y + cut, odd ? y : y - cut, -x, z, odd, side);
    m.course(1, odd ? -y : -y + cut, odd ? y : y - cut, x - wall, z, odd, side);
    if (in_storey == 12 && house.courses >= 39) m.box({-x, -y, z + pitch}, {x, y, z + pitch + 0.02}, "slab", 1);
  }
  find_joints(m);
  return m.scene;
}

MotionFrame brick_house_frame(const MotionScene& scene, double t) {
  MotionFrame f{t, {}, std::vector<std::uint8_t>(scene.joints.size()), std::vector<float>(scene.joints.size())};
  for (std::size_t b = 0; b < scene.blocks.size(); ++b) {
    const MotionBlock& block = scene.blocks[b];
    Vec3 p = block.rest;
    if (!block.fixed) p.x() += 0.002 * p.z() * p.z() * std::sin(12 * t);
    const double fall = std::max(0.0, t - release(scene, b));
    const double resting = 0.05 + 0.12 * std::abs(noise(b, 3));
    // It stops on reaching the heap.
    const double up = -0.4, stop = (up + std::sqrt(up * up + 2 * standard_g * std::max(0.0, p.z() - resting))) / standard_g;
    const double s = std::min(fall, std::max(0.0, stop));
    p += s * Vec3(0.9 + 0.35 * noise(b, 4), 0.45 * noise(b, 5), up) - Vec3(0, 0, 0.5 * standard_g * s * s);
    const Quat q = rotation(s * 1.6 * Vec3(noise(b, 6), 1.5 + noise(b, 7), noise(b, 8)));
    for (double v : {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()}) f.poses.push_back(static_cast<float>(v));
  }
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    const MotionJoint& joint_ = scene.joints[j];
    const double ra = release(scene, static_cast<std::size_t>(joint_.a)), rb = release(scene, static_cast<std::size_t>(joint_.b));
    const bool apart = std::min(ra, rb) < t + 0.5 && std::abs(ra - rb) > 0.02;
    const double damage = apart ? std::clamp(1 - 2 * (std::min(ra, rb) - t), 0.0, 1.0) : 0;
    f.damage[j] = static_cast<std::uint8_t>(std::lround(255 * damage));
    f.opening[j] = static_cast<float>(std::max(0.0, t - std::min(ra, rb)) * 0.1);
  }
  return f;
}

void write_brick_house(const std::string& dir, const BrickHouse& house) {
  std::filesystem::create_directories(dir);
  Manifest manifest;
  manifest.scene_name = "brick_house";
  manifest.title = "Brick house on a shaking table";
  for (const auto& [name, color] :
       {std::pair{"brick", Vec3(0.74, 0.43, 0.32)}, {"concrete", Vec3(0.62, 0.61, 0.58)}, {"ground", Vec3(0.4, 0.4, 0.4)}}) {
    manifest.materials.emplace_back();
    manifest.materials.back().name = name;
    manifest.materials.back().color = color;
  }
  manifest.settings = Json::object();
  write_manifest(dir, manifest);
  std::ofstream rows(dir + "/histories.csv"), energy(dir + "/energy.csv");
  rows << "time_s,ground_ax_m_s2,ground_ay_m_s2,ground_az_m_s2,floor1_ux_rel_m,floor2_ux_rel_m,floor3_ux_rel_m,floor3_ax_abs_m_s2,base_fx_"
          "N\n";
  energy << "time_s,base_work_J,kinetic_J,gravity_J,elastic_J,friction_J,fracture_J,damping_J,residual_relative\n";
  for (int i = 0; i <= std::lround(house.duration / 0.01); ++i) {
    const double t = 0.01 * i, u = 0.002 * std::sin(12 * t);
    rows << fmt::format("{},{},0,0,{},{},{},{},{}\n", t, ground(t), 2 * u, 8 * u, 18 * u, -18 * 144 * u, -5e4 * u * 144);
    energy << fmt::format("{},{},{},{},{},{},{},{},{}\n", t, 40 * t, 15 * std::abs(std::sin(12 * t)), t > 2 ? -300 * (t - 2) : 0,
                          8 * std::abs(std::cos(12 * t)), 9 * t, t, 12 * t, 1e-6 * (1 + t) * std::abs(std::sin(t)));
  }
  const MotionScene scene = brick_house(house);
  MotionWriter writer(dir, scene);
  for (int i = 0; i <= std::lround(house.duration / house.frame_dt); ++i) writer.write(brick_house_frame(scene, house.frame_dt * i));
}

}  // namespace erbs
