#include "render/draw/dust.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "engine/base/units.h"
#include "render/draw/scatter.h"

namespace erbs::render {
namespace {

constexpr double life = 2.2;  // s, after which a cloud is gone

Vec3 extent_of(const MotionScene& scene, const MotionBlock& block) {
  Eigen::AlignedBox3d box;
  for (const int part : block.parts) {
    const std::vector<float>& v = scene.shapes[static_cast<std::size_t>(part)].vertices;
    for (std::size_t i = 0; i + 2 < v.size(); i += 3) box.extend(Vec3(v[i], v[i + 1], v[i + 2]));
  }
  return box.isEmpty() ? Vec3(Vec3::Zero()) : Vec3(box.sizes());
}

// Blocks that have lost a neighbour, or never had one: inside a piece that moves as one there is no dust.
std::vector<bool> exposed_blocks(const MotionScene& scene, const MotionFrame& frame) {
  std::vector<bool> exposed(scene.blocks.size(), true);
  for (const MotionJoint& joint : scene.joints)
    exposed[static_cast<std::size_t>(joint.a)] = exposed[static_cast<std::size_t>(joint.b)] = false;
  for (std::size_t j = 0; j < scene.joints.size(); ++j)
    for (const int block : {scene.joints[j].a, scene.joints[j].b}) {
      const auto b = static_cast<std::size_t>(block);
      if (static_cast<double>(frame.opening[j]) > 0.1 * extent_of(scene, scene.blocks[b]).minCoeff()) exposed[b] = true;
    }
  return exposed;
}

}  // namespace

void ImpactFinder::add(MotionFrame frame) {
  last_.push_back(std::move(frame));
  if (last_.size() < 3) return;
  const MotionFrame &a = last_[0], &b = last_[1], &c = last_[2];
  const double first = b.t - a.t, second = c.t - b.t;
  const std::vector<bool> exposed = exposed_blocks(scene_, b);
  std::map<std::array<long, 3>, Impact> here;
  for (std::size_t i = 0; i < scene_.blocks.size() && first > 0 && second > 0; ++i) {
    if (scene_.blocks[i].fixed || !exposed[i]) continue;
    const Vec3 before = (position_of(b, i) - position_of(a, i)) / first, after = (position_of(c, i) - position_of(b, i)) / second;
    if (!before.allFinite() || !after.allFinite() || !(after.norm() < before.norm())) continue;
    const Vec3 lost = before - after - 0.5 * (first + second) * Vec3(0, 0, standard_g);  // beyond a free fall
    if (!(lost.norm() > least_blow)) continue;
    const Vec3 extent = extent_of(scene_, scene_.blocks[i]);
    Impact blow{b.t, position_of(b, i) - Vec3(0, 0, 0.5 * extent.minCoeff()), lost.norm(), std::cbrt(extent.prod()),
                static_cast<unsigned>(7919 * i + impacts.size())};
    std::array<long, 3> cell{};
    for (int k = 0; k < 3; ++k) cell[static_cast<std::size_t>(k)] = std::lround(std::floor(blow.at[k] / std::max(1e-3, 1.5 * blow.size)));
    const auto [same, fresh] = here.try_emplace(cell, blow);
    if (!fresh) same->second.speed = std::max(same->second.speed, blow.speed), same->second.size = std::max(same->second.size, blow.size);
  }
  for (const auto& [cell, blow] : here) impacts.push_back(blow);
  last_.erase(last_.begin());
}

std::vector<Puff> dust_at(const std::vector<Impact>& impacts, double t) {
  std::vector<Puff> puffs;
  for (const Impact& blow : impacts) {
    const double age = t - blow.t;
    if (!(age >= 0 && age < life)) continue;
    const double angle = 2 * pi * scatter(blow.seed), grown = 1 - std::exp(-age / 0.45);
    const double spread = std::min(0.5, 0.16 * blow.speed) * grown;
    Puff puff;
    puff.at = blow.at + Vec3(spread * std::cos(angle), spread * std::sin(angle), 0.10 * grown + 0.12 * age);
    puff.radius = blow.size * (0.7 + 1.1 * scatter(blow.seed + 17U)) + 0.30 * grown * std::min(1.5, blow.speed / 2);
    const double fade = 1 - age / life;
    puff.opacity = std::min(0.30, 0.07 * blow.speed) * (1 - std::exp(-age / 0.04)) * std::exp(-age / 0.8) * fade;
    puff.seed = scatter(blow.seed + 4711U);
    if (puff.opacity > 0.004) puffs.push_back(puff);
  }
  if (puffs.size() > most_puffs) {
    std::stable_sort(puffs.begin(), puffs.end(), [](const Puff& a, const Puff& b) { return a.opacity > b.opacity; });
    puffs.resize(most_puffs);
  }
  return puffs;
}

}  // namespace erbs::render
