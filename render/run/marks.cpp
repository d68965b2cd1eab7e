#include "render/run/marks.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "engine/base/units.h"
#include "engine/record/folder/run_folder.h"
#include "render/run/mesh.h"

namespace erbs::render {
namespace {

const Vec3 force_color{0.02, 0.09, 0.32}, thrust_color{0.55, 0.0, 0.16}, motion_color{0.0, 0.22, 0.14};
constexpr double widest = 9, thinnest_share = 0.015;        // px; of the scale, below which a force is not drawn
constexpr double widest_thrust = 8, thinnest_thrust = 0.6;  // px

Vec3 vector_of(const std::vector<float>& values, std::size_t j) { return Eigen::Map<const Eigen::Vector3f>(&values[3 * j]).cast<double>(); }

// The compression that a joint carries.
struct Thrust {
  double force = 0;     // N, normal part, compression positive
  Vec3 at{0, 0, 0};     // m, as drawn
  Vec3 along{0, 0, 0};  // unit, the normal as drawn, from a to b
  Vec3 pull{0, 0, 0};   // N, the whole force on a, as drawn; that on b is its opposite
};

// Force 0 where the joint is not pressed.
Thrust thrust_of(const MotionScene& scene, std::size_t j, const MotionFrame& actual, const MotionFrame& drawn) {
  const MotionJoint& joint = scene.joints[j];
  const auto a = static_cast<std::size_t>(joint.a);
  const Vec3 n = joint_normal(scene, joint), pull = vector_of(actual.force, j);
  Thrust thrust;
  const Eigen::Quaterniond back = rotation_of(actual, a).conjugate();
  thrust.force = -n.dot(back * pull);
  if (!(thrust.force > 0)) return {};
  thrust.along = rotation_of(drawn, a) * n;
  thrust.pull = rotation_of(drawn, a) * (back * pull);
  thrust.at = position_of(drawn, a) + rotation_of(drawn, a) * (back * (vector_of(actual.force_at, j) - position_of(actual, a)));
  if (!thrust.at.allFinite() || !thrust.along.allFinite()) return {};
  return thrust;
}

std::vector<Thrust> thrusts_of(const MotionScene& scene, const MotionFrame& actual, const MotionFrame& drawn) {
  std::vector<Thrust> all(scene.joints.size());
  if (actual.force.size() != 3 * all.size())
    throw Error("the run has kept no forces of its joints; say analysis{ frame_stress = true } and run the scene again");
  for (std::size_t j = 0; j < all.size(); ++j) all[j] = thrust_of(scene, j, actual, drawn);
  return all;
}

std::string force_text(double newton) {
  return newton >= 1e6   ? fmt::format("{:.3g} MN", newton / 1e6)
         : newton >= 1e3 ? fmt::format("{:.3g} kN", newton / 1e3)
                         : fmt::format("{:.3g} N", newton);
}

// Each joint's normal force as a line through its centre of pressure, as long as the blocks are thick: their lines meet in the blocks.
void add_forces(const MotionScene& scene, const std::vector<Thrust>& thrusts, const MotionFrame& drawn, double scale, Marks& marks) {
  for (std::size_t j = 0; j < thrusts.size(); ++j) {
    const Thrust& t = thrusts[j];
    if (t.force < thinnest_share * scale) continue;
    const auto [a, b] = std::pair(static_cast<std::size_t>(scene.joints[j].a), static_cast<std::size_t>(scene.joints[j].b));
    double before = std::fabs((t.at - position_of(drawn, a)).dot(t.along)), after = std::fabs((position_of(drawn, b) - t.at).dot(t.along));
    if (scene.blocks[a].fixed) before = std::min(before, after);  // the ground is large
    if (scene.blocks[b].fixed) after = std::min(after, before);
    marks.strokes.push_back({t.at - before * t.along, t.at + after * t.along, widest * std::min(1.0, t.force / scale), force_color, false});
  }
}

// At rest, about its centroid (m).
Eigen::AlignedBox3d extent_of(const MotionScene& scene, const MotionBlock& block) {
  Eigen::AlignedBox3d box;
  for (const int part : block.parts) {
    const std::vector<float>& v = scene.shapes[static_cast<std::size_t>(part)].vertices;
    for (std::size_t i = 0; i + 2 < v.size(); i += 3) box.extend(Vec3(v[i], v[i + 1], v[i + 2]));
  }
  return box;
}

// Where the forces on a block meet: the point nearest to their lines of action, and to that of its weight and inertia, by the squares of
// the distances weighted with the forces. Where these lines are parallel, a small share of the distance to the points of attack decides. It
// lies within the block: thrust does not leave the masonry.
Vec3 meeting_of(const std::vector<Thrust>& thrusts, const std::vector<std::size_t>& joints, const MotionScene& scene, std::size_t b,
                const MotionFrame& drawn) {
  const Vec3 centroid = position_of(drawn, b);
  Mat3 sum = Mat3::Zero();
  Vec3 right = Vec3::Zero(), mean = Vec3::Zero(), rest = Vec3::Zero();
  double all = 0;
  const auto add_line = [&](const Vec3& at, const Vec3& force) {
    const double size = force.norm();
    if (!(size > 0)) return;
    const Mat3 across = size * (Mat3::Identity() - force * force.transpose() / (size * size));
    sum += across, right += across * at;
  };
  for (const std::size_t j : joints) {
    const Vec3 force = static_cast<std::size_t>(scene.joints[j].a) == b ? thrusts[j].pull : Vec3(-thrusts[j].pull);
    add_line(thrusts[j].at, force);
    rest -= force, mean += thrusts[j].force * thrusts[j].at, all += thrusts[j].force;
  }
  add_line(centroid, rest);
  const double share = 0.03 * all;
  sum += share * Mat3::Identity(), right += share * mean / all;
  const Eigen::AlignedBox3d box = extent_of(scene, scene.blocks[b]);
  const Eigen::Quaterniond turn = rotation_of(drawn, b);
  const Vec3 within = turn.conjugate() * (Vec3(sum.ldlt().solve(right)) - centroid);
  return centroid + turn * Vec3(within.cwiseMax(0.9 * box.min()).cwiseMin(0.9 * box.max()));
}

// Middle of a joint as drawn, and the distance of its farthest corner from it (m).
std::pair<Vec3, double> middle_of(const MotionScene& scene, std::size_t j, const MotionFrame& drawn) {
  const MotionJoint& joint = scene.joints[j];
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : joint.polygon) middle += p / static_cast<double>(joint.polygon.size());
  double reach = 0;
  for (const Vec3& p : joint.polygon) reach = std::max(reach, (p - middle).norm());
  const auto a = static_cast<std::size_t>(joint.a);
  return {position_of(drawn, a) + rotation_of(drawn, a) * middle, reach};
}

// Through the centres of pressure of a block that is pressed from two sides, as voussoirs and drums are. In other blocks it branches, from
// the point where the forces meet to each pressed joint.
void add_thrust_line(const MotionScene& scene, std::vector<Thrust> thrusts, const MotionFrame& drawn, const std::vector<bool>& hidden,
                     double scale, Marks& marks) {
  std::vector<double> largest(scene.blocks.size());
  const auto ends = [&](std::size_t j) {
    return std::array{static_cast<std::size_t>(scene.joints[j].a), static_cast<std::size_t>(scene.joints[j].b)};
  };
  for (std::size_t j = 0; j < thrusts.size(); ++j) {
    for (const std::size_t b : ends(j)) largest[b] = std::max(largest[b], thrusts[j].force);
    // Bond may put the resultant far outside of the joint. The line then passes just outside of it, which says as much.
    if (!(thrusts[j].force > 0)) continue;
    const auto [middle, reach] = middle_of(scene, j, drawn);
    if (const Vec3 away = thrusts[j].at - middle; away.norm() > 1.05 * reach) thrusts[j].at = middle + 1.05 * reach * away.normalized();
  }
  std::vector<std::vector<std::size_t>> loaded(scene.blocks.size());
  for (std::size_t j = 0; j < thrusts.size(); ++j) {
    const auto [a, b] = ends(j);
    if (!(thrusts[j].force > 0.03 * std::min(largest[a], largest[b]))) continue;  // next to nothing for both
    loaded[a].push_back(j), loaded[b].push_back(j);
  }
  const auto draw = [&](const Vec3& from, const Vec3& to, double force) {
    marks.strokes.push_back({from, to, std::max(thinnest_thrust, widest_thrust * std::min(1.0, force / scale)), thrust_color, false});
  };
  for (std::size_t b = 0; b < loaded.size(); ++b) {
    const std::vector<std::size_t>& joints = loaded[b];
    if (joints.size() < 2 || scene.blocks[b].fixed || hidden[b] || !position_of(drawn, b).allFinite()) continue;
    const auto outward = [&](std::size_t j) {
      return static_cast<std::size_t>(scene.joints[j].a) == b ? thrusts[j].along : Vec3(-thrusts[j].along);
    };
    if (joints.size() == 2 && outward(joints[0]).dot(outward(joints[1])) < -0.5) {
      draw(thrusts[joints[0]].at, thrusts[joints[1]].at, 0.5 * (thrusts[joints[0]].force + thrusts[joints[1]].force));
      continue;
    }
    const Vec3 node = meeting_of(thrusts, joints, scene, b, drawn);
    if (!node.allFinite()) continue;
    // A plate that only rests on others hands its weight down where each of them bears it.
    const bool on_one_side =
        std::all_of(joints.begin(), joints.end(), [&](std::size_t j) { return outward(j).dot(outward(joints[0])) > 0.5; });
    for (const std::size_t j : joints) {
      const Vec3 out = outward(j);
      draw(on_one_side ? Vec3(thrusts[j].at + (node - thrusts[j].at).dot(out) * out) : node, thrusts[j].at, thrusts[j].force);
    }
  }
}

double radius_of(const MotionScene& scene, const MotionBlock& block) {  // m, of the sphere with the mean half size
  const Eigen::AlignedBox3d box = extent_of(scene, block);
  return box.isEmpty() ? 0 : box.sizes().sum() / 6;
}

// One block a cell of a grid over the building, so that arrows do not cover each other: the one nearest to its middle.
std::vector<std::size_t> spread(const MotionScene& scene, const Stage& stage) {
  const double side = stage.size() / 13;
  std::map<std::array<long, 3>, std::pair<double, std::size_t>> nearest;
  for (std::size_t b = 0; b < scene.blocks.size(); ++b) {
    if (scene.blocks[b].fixed) continue;
    const Vec3 at = (scene.blocks[b].rest - stage.building.min()) / side;
    std::array<long, 3> cell{};
    Vec3 middle;
    for (int i = 0; i < 3; ++i) cell[static_cast<std::size_t>(i)] = std::lround(std::floor(at[i])), middle[i] = std::floor(at[i]) + 0.5;
    const double away = (at - middle).squaredNorm();
    const auto [found, fresh] = nearest.try_emplace(cell, away, b);
    if (!fresh && away < found->second.first) found->second = {away, b};
  }
  std::vector<std::size_t> chosen;
  for (const auto& [cell, at] : nearest) chosen.push_back(at.second);
  return chosen;
}

// Arrows of the velocities of centroids, and arcs of the rotations, both over one span of time.
void add_mechanism(const MotionScene& scene, const Stage& stage, const MotionFrame& drawn, const Rates& rates, double scale, Marks& marks) {
  const double longest = 0.16 * stage.size(), span = longest / scale;  // s
  for (const std::size_t b : spread(scene, stage)) {
    const Vec3 centre = position_of(drawn, b), way = span * rates.velocity[b];
    if (!centre.allFinite() || !way.allFinite()) continue;
    const double share = way.norm() / longest;
    if (share < 0.03) continue;
    const Vec3 tip = centre + std::min(1.0, 1.6 / share) * way;
    marks.strokes.push_back({centre, tip, 1.2 + 1.6 * std::min(1.0, share), motion_color, true});
    const Vec3 turn = span * rates.spin[b];
    const double angle = std::min(turn.norm(), 1.5 * pi), radius = radius_of(scene, scene.blocks[b]);
    if (!(angle > 0.15) || radius < stage.size() / 90) continue;
    const Vec3 axis = turn.normalized();
    Vec3 start = axis.cross(std::fabs(axis.z()) < 0.9 ? Vec3(Vec3::UnitZ()) : Vec3(Vec3::UnitX())).normalized() * radius;
    const int steps = 12;
    for (int i = 0; i < steps; ++i) {
      const auto at = [&](int k) { return Vec3(centre + Eigen::AngleAxisd(angle * k / steps, axis) * start); };
      marks.strokes.push_back({at(i), at(i + 1), 1.4, motion_color, i + 1 == steps});
    }
  }
}

}  // namespace

Rates rates_between(const MotionFrame& before, const MotionFrame& after) {
  Rates rates;
  const std::size_t blocks = before.poses.size() / 7;
  rates.velocity.assign(blocks, Vec3::Zero()), rates.spin.assign(blocks, Vec3::Zero());
  const double seconds = after.t - before.t;
  if (!(seconds > 0)) return rates;
  for (std::size_t b = 0; b < blocks; ++b) {
    rates.velocity[b] = (position_of(after, b) - position_of(before, b)) / seconds;
    Eigen::Quaterniond turn = rotation_of(after, b) * rotation_of(before, b).conjugate();
    if (turn.w() < 0) turn.coeffs() *= -1;
    const Eigen::AngleAxisd rotation(turn);
    rates.spin[b] = rotation.angle() / seconds * rotation.axis();
  }
  return rates;
}

Rates rates_of_mechanism(const std::string& given, const MotionScene& scene) {
  namespace fs = std::filesystem;
  const std::string path = fs::is_directory(given) ? (fs::path(given) / "mechanism.csv").string() : given;
  if (!fs::exists(path))
    throw Error(
        "there is no such file; erbs limit SCENE.lua -o FOLDER writes FOLDER/mechanism.csv, and --mechanism motion shows the motion of "
        "this "
        "run",
        {path});
  const CsvTable table = read_csv(path);
  const int name = table.find("block");
  std::array<int, 6> columns{};
  const std::array<const char*, 6> names{"vx_m_s", "vy_m_s", "vz_m_s", "wx_rad_s", "wy_rad_s", "wz_rad_s"};
  bool good = name >= 0;
  for (std::size_t i = 0; i < 6; ++i) good = (columns[i] = table.find(names[i])) >= 0 && good;
  if (!good) throw Error("it is no mechanism: erbs limit SCENE -o FOLDER writes one as FOLDER/mechanism.csv", {path});
  std::map<std::string, std::size_t> block;
  for (std::size_t b = 0; b < scene.blocks.size(); ++b) block[scene.blocks[b].name] = b;
  Rates rates;
  rates.velocity.assign(scene.blocks.size(), Vec3::Zero()), rates.spin.assign(scene.blocks.size(), Vec3::Zero());
  const auto cell = [&](int column, std::size_t row) { return table.columns[static_cast<std::size_t>(column)][row]; };
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto c = static_cast<std::size_t>(name);
    const std::string own = table.text[c].empty() ? fmt::format("{}", table.columns[c][row]) : table.text[c][row];
    const auto found = block.find(own);
    if (found == block.end())
      throw Error(
          fmt::format("it is of another scene: the run has no block {}; repeat erbs limit with the scene of this run", shown(own, 60)),
          {path});
    for (int i = 0; i < 3; ++i) {
      rates.velocity[found->second][i] = cell(columns[static_cast<std::size_t>(i)], row);
      rates.spin[found->second][i] = cell(columns[static_cast<std::size_t>(i) + 3], row);
    }
  }
  return rates;
}

double largest_force(const MotionScene& scene, const MotionFrame& frame) {
  double largest = 0;
  for (const Thrust& t : thrusts_of(scene, frame, frame)) largest = std::max(largest, t.force);
  return largest;
}

double largest_speed(const MotionScene& scene, const Rates& rates) {
  double largest = 0;
  for (std::size_t b = 0; b < scene.blocks.size(); ++b)
    if (!scene.blocks[b].fixed && rates.velocity[b].allFinite()) largest = std::max(largest, rates.velocity[b].norm());
  return largest;
}

namespace {

void add_force_legend(const MarkChoice& choice, const MarkScale& scale, Marks& marks) {
  if (!(scale.force > 0)) {  // a width would stand for nothing
    marks.legend.push_back({"no joint has a normal force", 0, force_color, false});
    if (scale.replaced) marks.legend.push_back({"contact has replaced joints", 0, force_color, false});
    return;
  }
  if (choice.forces) {
    marks.legend.push_back({"normal force " + force_text(scale.force), widest, force_color, false});
    marks.legend.push_back({force_text(0.2 * scale.force), 0.2 * widest, force_color, false});
  }
  if (choice.thrust) marks.legend.push_back({"line of thrust, " + force_text(scale.force), widest_thrust, thrust_color, false});
  if (scale.replaced) marks.legend.push_back({"none at released joints", 0, force_color, false});
}

}  // namespace

Marks marks_of(const MarkChoice& choice, const MotionScene& scene, const Stage& stage, const MotionFrame& actual, const MotionFrame& drawn,
               const Rates& rates, const MarkScale& scale) {
  Marks marks;
  if (choice.forces || choice.thrust) {
    const std::vector<Thrust> thrusts = scale.force > 0 ? thrusts_of(scene, actual, drawn) : std::vector<Thrust>{};
    if (choice.forces) add_forces(scene, thrusts, drawn, scale.force, marks);
    if (choice.thrust) add_thrust_line(scene, thrusts, drawn, stage.hidden, scale.force, marks);
    add_force_legend(choice, scale, marks);
  }
  if (!choice.mechanism.empty()) add_mechanism(scene, stage, drawn, rates, scale.speed, marks);
  if (choice.mechanism == "motion")
    marks.legend.push_back({fmt::format("velocity, longest {:.3g} m/s; arcs: rotation", scale.speed), 2.4, motion_color, true});
  else if (!choice.mechanism.empty()) marks.legend.push_back({"mechanism; arcs: rotation", 2.4, motion_color, true});
  return marks;
}

}  // namespace erbs::render
