#include "engine/model/batches.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace erbs {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
std::size_t z(int i) { return std::size_t(i); }

struct Keeping {
  Model& m;
  std::vector<int> kept, rounds;            // joints owned by each block; rounds of each group of eight blocks
  std::vector<std::vector<int>> joints_of;  // blocks
  std::vector<int> moved;

  int other(int j) const { return m.joint[z(j)].kept_by_b ? m.joint[z(j)].a : m.joint[z(j)].b; }
  bool has_room(int b) const { return kept[z(b)] < rounds[z(b / lanes)]; }
  void turn_over(int j) {
    --kept[z(m.keeper(j))], ++kept[z(other(j))];
    m.joint[z(j)].kept_by_b = !m.joint[z(j)].kept_by_b;
    moved.push_back(j);
  }
  // Passes one joint of owner b to a neighbour with room, or to a neighbour that can make room in the same way.
  bool pass_on(int b, bool through_others) {
    for (const int j : joints_of[z(b)])
      if (m.keeper(j) == b && has_room(other(j))) {
        turn_over(j);
        return true;
      }
    if (!through_others) return false;
    for (const int j : joints_of[z(b)])
      if (m.keeper(j) == b && pass_on(other(j), false)) {
        turn_over(j);
        return true;
      }
    return false;
  }
  // Saves one round of group g, if possible.
  bool shorten(int g) {
    if (rounds[z(g)] == 0) return false;
    --rounds[z(g)];
    moved.clear();
    for (int b = g * lanes; b < std::min((g + 1) * lanes, m.nblock); ++b)
      while (kept[z(b)] > rounds[z(g)])
        if (!pass_on(b, true)) {
          const std::vector<int> back = moved;
          std::for_each(back.rbegin(), back.rend(), [&](int j) { turn_over(j); });
          ++rounds[z(g)];
          return false;
        }
    return true;
  }
};

}  // namespace

void choose_keepers(Model& m) {
  Keeping all{m, std::vector<int>(z(m.nblock), 0), std::vector<int>(block_groups(m.nblock), 0), {}, {}};
  all.joints_of.resize(z(m.nblock));
  for (int j = 0; j < int(m.joint.size()); ++j) {
    Joint& joint = m.joint[z(j)];
    const bool a_has_room = all.has_room(joint.a), b_has_room = all.has_room(joint.b);
    joint.kept_by_b = a_has_room != b_has_room ? b_has_room : all.kept[z(joint.b)] < all.kept[z(joint.a)];
    int& rounds = all.rounds[z(m.keeper(j) / lanes)];
    rounds = std::max(rounds, ++all.kept[z(m.keeper(j))]);
    for (const int b : {joint.a, joint.b}) all.joints_of[z(b)].push_back(j);
  }
  for (int g = 0; g < int(all.rounds.size()); ++g)
    while (all.shorten(g)) {}
}

// An empty lane gives no force: zero stiffness, infinite limits, the block at rest, the spare wrench row.
void clear_lane(const Model& m, JointBatch& batch, int l) {
  for (auto& k : batch.stiffness) k[l] = 0;
  for (auto* field : {batch.arm_a, batch.arm_b, batch.gap, batch.turn})
    for (int i = 0; i < 3; ++i) field[i][l] = 0;
  batch.open_limit[l] = batch.slip_limit[l] = batch.close_limit[l] = infinite;
  batch.slip_slope[l] = 0;
  batch.a[l] = batch.b[l] = m.nblock;
  batch.row_a[l] = batch.row_b[l] = m.spare_row();
}

void set_constants(const Model& m, int j, JointBatch& batch, int l) {
  const Joint& joint = m.joint[z(j)];
  const PointLaw& law = m.laws[z(joint.type->law)];
  for (int i = 0; i < 6; ++i) batch.stiffness[i][l] = joint.type->stiffness[i];
  // Couplings with zero shear at ft have no linear bound: in any tension the joint is checked point by point.
  batch.open_limit[l] = law.coupling == PointLaw::Coupling::coulomb ? law.ft / law.kn : 0;
  batch.slip_limit[l] = law.ks > 0 ? law.c / law.ks : infinite;
  batch.slip_slope[l] = law.ks > 0 ? law.mu * law.kn / law.ks : 0;
  batch.close_limit[l] = law.fc > 0 ? law.fc / law.kn : infinite;
  batch.half_s[l] = joint.type->half_s;
  batch.half_t[l] = joint.type->half_t;
  batch.radius[l] = joint.type->radius;
  batch.a[l] = joint.a;
  batch.b[l] = joint.b;
  batch.row_a[l] = m.row_a[z(j)];
  batch.row_b[l] = m.row_b[z(j)];
}

int add_empty_batch(const Model& m, State& s) {
  s.batch.push_back(JointBatch{});
  for (int l = 0; l < lanes; ++l) clear_lane(m, s.batch.back(), l);
  return int(s.batch.size()) - 1;
}

void set_places(const Model& m, State& s) {
  s.batch.clear();
  s.place.resize(z(m.njoint));
  std::iota(s.place.begin(), s.place.end(), 0);
}

}  // namespace erbs
