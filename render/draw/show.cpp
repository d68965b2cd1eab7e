// The part of drawing without OpenGL: colours, and the input of the shaders.
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/error.h"
#include "render/draw/scatter.h"
#include "render/draw/visible.h"

namespace erbs::render {
namespace {

// Distance (m) between the two sides of a joint, slip included; largest over its corners.
float parted(const MotionScene& scene, const MotionJoint& joint, const MotionFrame& f) {
  const auto a = static_cast<std::size_t>(joint.a), b = static_cast<std::size_t>(joint.b);
  const Vec3 to_b = scene.blocks[b].rest - scene.blocks[a].rest;
  const Eigen::Quaternionf qa = turn_of(f, a), qb = turn_of(f, b);
  float most = 0;
  for (const Vec3& p : joint.polygon) {
    const Eigen::Vector3f pa = place_of(f, a) + qa * p.cast<float>(), pb = place_of(f, b) + qb * Vec3(p - to_b).cast<float>();
    most = std::max(most, (pa - pb).norm());
  }
  return most;
}

// As joints of a push are told to be open, in events.csv and curve.csv.
constexpr double opened = 1e-4;  // of the distance from the middle of a joint to its farthest corner

float opened_from(const MotionJoint& joint) {
  if (joint.polygon.empty()) return HUGE_VALF;
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : joint.polygon) middle += p / static_cast<double>(joint.polygon.size());
  double farthest = 0;
  for (const Vec3& p : joint.polygon) farthest = std::max(farthest, (p - middle).norm());
  return static_cast<float>(opened * farthest);
}

}  // namespace

double damage_drawn(const Show& show, const MotionFrame& frame, std::size_t joint) {
  return frame.opening[joint] > show.opened_from[joint] ? 1 : frame.damage[joint] / 255.0;
}

double round_length(double size) {
  const double ten = std::pow(10.0, std::floor(std::log10(size)));
  const double rest = size / ten;
  return ten * (rest < 1.5 ? 1 : rest < 3.5 ? 2 : rest < 7.5 ? 5 : 10);
}

Vec3 damage_color(double damage) {
  // From grey over straw and orange to dark red: rising intensity, readable in grey print and with colour-vision deficiency.
  static const std::array<Vec3, 4> stops{Vec3(0.62, 0.62, 0.60), Vec3(0.80, 0.62, 0.22), Vec3(0.78, 0.25, 0.06), Vec3(0.42, 0.02, 0.03)};
  const double x = std::clamp(damage, 0.0, 1.0) * 3;
  const auto k = std::min<std::size_t>(2, static_cast<std::size_t>(x));
  const double t = x - static_cast<double>(k);
  return (1 - t) * stops[k] + t * stops[k + 1];
}

Show prepare_show(const MotionScene& scene, const Run& run, const std::vector<MotionFrame>& some_frames) {
  return prepare_show(scene, run, set_stage(scene, some_frames), {}, std::nullopt);
}

Show prepare_show(const MotionScene& scene, const Run& run, Stage stage, std::vector<bool> ghost, const std::optional<Section>& section,
                  bool sharp) {
  Show show;
  show.scene = &scene;
  show.stage = std::move(stage);
  show.ghost = std::move(ghost);
  show.ghost.resize(scene.blocks.size());
  double thinnest = 0.024 * show.stage.size();
  for (const MotionShape& shape : scene.shapes) {  // large plates do not count
    Eigen::AlignedBox3f box;
    for (std::size_t i = 0; i + 2 < shape.vertices.size(); i += 3)
      box.extend(Eigen::Vector3f(shape.vertices[i], shape.vertices[i + 1], shape.vertices[i + 2]));
    const Eigen::Vector3f s = box.sizes();
    if (s.maxCoeff() < 6 * s.minCoeff()) thinnest = std::min(thinnest, static_cast<double>(s.minCoeff()));
  }
  show.open_crack = round_length(0.01 * thinnest);
  show.chamfer = 0.05 * thinnest;
  double gap = 0;
  for (const MotionJoint& joint : scene.joints) {
    if (joint.thickness <= 0) continue;
    show.mortared = true;
    show.chamfer = std::min(show.chamfer, 0.3 * joint.thickness);
    gap = std::max(gap, joint.thickness);
  }
  show.fine_width = std::max(1.5 * show.chamfer, gap);
  if (section) show.cut = fmt::format("cut at {} = {:.4g} m", std::string("xyz").substr(std::size_t(section->axis), 1), section->at);
  const MotionScene solid = section ? cut_scene(scene, *section, show.stage.hidden) : scene;
  if (sharp) show.chamfer = 0;
  show.mesh = build_mesh(solid, show.stage.hidden, show.chamfer);
  if (sharp) {
    show.mesh.beds.assign(show.mesh.beds.size(), {});
    show.mesh.sides.assign(show.mesh.sides.size(), {});
    show.mesh.crack.assign(show.mesh.crack.size(), {});
  }
  std::vector<bool> no_shade = show.stage.hidden;
  for (std::size_t b = 0; b < no_shade.size(); ++b) no_shade[b] = no_shade[b] || show.ghost[b];
  add_shades(show.mesh, solid, no_shade, 0.55 * gap + 0.1 * show.open_crack, 1.5 * gap + 0.002 * show.stage.size());
  for (const MotionJoint& joint : scene.joints) {
    show.joint_area.push_back(static_cast<float>(0.5 * area_normal(joint.polygon).norm()));
    show.opened_from.push_back(run.dry ? opened_from(joint) : HUGE_VALF);
  }
  for (std::size_t b = 0; b < scene.blocks.size(); ++b) {
    float square = 0;
    for (int part : scene.blocks[b].parts) {
      const std::vector<float>& v = scene.shapes[static_cast<std::size_t>(part)].vertices;
      for (std::size_t i = 0; i + 2 < v.size(); i += 3) square = std::max(square, Eigen::Vector3f(v[i], v[i + 1], v[i + 2]).squaredNorm());
    }
    show.radius.push_back(show.stage.hidden[b] ? 0 : 1.001F * std::sqrt(square) + static_cast<float>(gap));
  }
  show.grid = round_length(show.stage.size() / 5);
  std::vector<int> uses(run.materials.size() + 1);
  const auto paint = [&](const MotionBlock& b) {
    return b.material >= 0 && b.material < static_cast<int>(run.materials.size()) ? static_cast<std::size_t>(b.material) : uses.size() - 1;
  };
  for (const MotionBlock& b : scene.blocks) ++uses[paint(b)];
  for (std::size_t i = 0; i < scene.blocks.size(); ++i) {
    const std::size_t m = paint(scene.blocks[i]);
    const Vec3 color = m < run.materials.size() ? run.materials[m].color : Vec3(0.45, 0.43, 0.40);
    const auto seed = static_cast<std::uint32_t>(i);
    const double amount = uses[m] > 20 ? 1.0 : 0.0, tone = 2 * scatter(seed) - 1, hue = 2 * scatter(seed + 7919U) - 1;
    show.block_color.push_back(color.cwiseProduct(Vec3::Constant(1 + 0.17 * amount * tone) + amount * hue * Vec3(0.0, 0.06, 0.09)));
  }
  return show;
}

Fineness fineness_of(double pixel, int height) { return {pixel, 2.2 * height / 720.0 * pixel}; }

FrameTexels texels_of(const Show& show, const MotionFrame& frame, Coloring coloring, const Vec3& eye, const Fineness& fineness) {
  const MotionScene& scene = *show.scene;
  const std::size_t nb = scene.blocks.size(), nj = scene.joints.size();
  FrameTexels t;
  t.blocks.resize(12 * std::max<std::size_t>(1, nb));
  t.joints.resize(4 * std::max<std::size_t>(1, nj));
  std::vector<float> broken(nb), area(nb);
  const std::vector<double> value = block_values(scene, frame, coloring);
  const auto step_of_parting = static_cast<float>(0.02 * show.open_crack);  // m
  MotionFrame drawn;
  drawn.poses = rounded_poses(show, frame, eye, fineness.pixel);
  for (std::size_t j = 0; j < nj; ++j) {
    const MotionJoint& joint = scene.joints[j];
    const auto a = static_cast<std::size_t>(joint.a), b = static_cast<std::size_t>(joint.b);
    const auto damage = static_cast<float>(damage_drawn(show, frame, j));
    for (std::size_t block : {a, b}) {
      broken[block] += static_cast<float>(frame.damage[j]) / 255.0F * show.joint_area[j];
      area[block] += show.joint_area[j];
    }
    t.joints[4 * j] = damage;
    t.joints[4 * j + 1] = step_of_parting * std::round(parted(scene, joint, frame) / step_of_parting);
    const bool open = static_cast<double>(frame.opening[j]) >= show.open_crack;
    t.joints[4 * j + 2] = static_cast<float>(open ? JointState::open : damage > 0 ? JointState::cracked : JointState::intact);
  }
  for (std::size_t b = 0; b < nb; ++b) {
    const float share = area[b] > 0 ? broken[b] / area[b] : 0;
    const Vec3 color = coloring == Coloring::material      ? show.block_color[b]
                       : coloring == Coloring::damage      ? damage_color(static_cast<double>(share))
                       : coloring == Coloring::joint_state ? Vec3(0.66, 0.65, 0.63)
                                                           : map_color(map_share(value[b], show.scale, coloring));
    const float* p = &drawn.poses[7 * b];
    const Eigen::Vector3f c = color.cast<float>();
    const float values[12] = {p[0], p[1], p[2], share, p[4], p[5], p[6], p[3], c.x(), c.y(), c.z(), 0};
    std::copy_n(values, 12, &t.blocks[12 * b]);
  }
  choose_triangles(show, drawn, coloring, eye, fineness, t);
  return t;
}

}  // namespace erbs::render
