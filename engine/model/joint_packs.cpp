#include "engine/model/joint_packs.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "engine/base/count.h"
#include "engine/base/units.h"
#include "engine/laws/yield.h"

namespace erbs {
namespace {

struct OwnerBalance {
  Model& m;
  std::vector<int> owned, rounds;           // joints owned by each block; rounds of each group of eight blocks
  std::vector<std::vector<int>> joints_of;  // blocks
  std::vector<int> moved;

  int other(int j) const { return m.joint[z(j)].owned_by_b ? m.joint[z(j)].a : m.joint[z(j)].b; }
  bool has_room(int b) const { return owned[z(b)] < rounds[z(b / pack_size)]; }
  void swap_owner(int j) {
    --owned[z(m.owner(j))], ++owned[z(other(j))];
    m.joint[z(j)].owned_by_b = !m.joint[z(j)].owned_by_b;
    moved.push_back(j);
  }
  // Passes one joint of owner b to a neighbour with room, or to a neighbour that can make room in the same way.
  bool pass_on(int b, bool through_others) {
    for (const int j : joints_of[z(b)])
      if (m.owner(j) == b && has_room(other(j))) {
        swap_owner(j);
        return true;
      }
    if (!through_others) return false;
    for (const int j : joints_of[z(b)])
      if (m.owner(j) == b && pass_on(other(j), false)) {
        swap_owner(j);
        return true;
      }
    return false;
  }
  // Saves one round of group g, if possible.
  bool shorten(int g) {
    if (rounds[z(g)] == 0) return false;
    --rounds[z(g)];
    moved.clear();
    for (int b = g * pack_size; b < std::min((g + 1) * pack_size, m.nblock); ++b)
      while (owned[z(b)] > rounds[z(g)])
        if (!pass_on(b, true)) {
          const std::vector<int> back = moved;
          std::for_each(back.rbegin(), back.rend(), [&](int j) { swap_owner(j); });
          ++rounds[z(g)];
          return false;
        }
    return true;
  }
};

}  // namespace

void choose_owners(Model& m) {
  OwnerBalance all{m, std::vector<int>(z(m.nblock), 0), std::vector<int>(block_groups(m.nblock), 0), {}, {}};
  all.joints_of.resize(z(m.nblock));
  for (int j = 0; j < int(m.joint.size()); ++j) {
    Joint& joint = m.joint[z(j)];
    const bool a_has_room = all.has_room(joint.a), b_has_room = all.has_room(joint.b);
    joint.owned_by_b = a_has_room != b_has_room ? b_has_room : all.owned[z(joint.b)] < all.owned[z(joint.a)];
    int& rounds = all.rounds[z(m.owner(j) / pack_size)];
    rounds = std::max(rounds, ++all.owned[z(m.owner(j))]);
    for (const int b : {joint.a, joint.b}) all.joints_of[z(b)].push_back(j);
  }
  for (int g = 0; g < int(all.rounds.size()); ++g)
    while (all.shorten(g)) {}
}

// An empty lane gives no force: zero stiffness, infinite limits, the block at rest, the spare wrench row.
void clear_lane(const Model& m, JointPack& pack, int l) {
  for (auto& k : pack.stiffness) k[l] = 0;
  for (auto* field : {pack.arm_a, pack.arm_b, pack.gap, pack.rotation})
    for (int i = 0; i < 3; ++i) field[i][l] = 0;
  pack.open_limit[l] = pack.slip_limit[l] = pack.close_limit[l] = infinite;
  pack.slip_slope[l] = 0;
  pack.a[l] = pack.b[l] = m.nblock;
  pack.wrench_row_a[l] = pack.wrench_row_b[l] = m.spare_wrench_row();
}

void set_constants(const Model& m, int j, JointPack& pack, int l) {
  const Joint& joint = m.joint[z(j)];
  const PointLaw& law = m.laws[z(joint.type->law)];
  for (int i = 0; i < 6; ++i) pack.stiffness[i][l] = joint.type->stiffness[i];
  const auto limits = scalar::yield_limits(law);
  pack.open_limit[l] = limits.open, pack.close_limit[l] = limits.close;
  pack.slip_limit[l] = limits.slip, pack.slip_slope[l] = limits.slope;
  pack.half_s[l] = joint.type->half_s;
  pack.half_t[l] = joint.type->half_t;
  pack.radius[l] = joint.type->radius;
  pack.a[l] = joint.a;
  pack.b[l] = joint.b;
  pack.wrench_row_a[l] = m.wrench_row_a[z(j)];
  pack.wrench_row_b[l] = m.wrench_row_b[z(j)];
}

int add_empty_pack(const Model& m, State& s) {
  s.joints.pack.push_back(JointPack{});
  for (int l = 0; l < pack_size; ++l) clear_lane(m, s.joints.pack.back(), l);
  return int(s.joints.pack.size()) - 1;
}

void set_slots(const Model& m, State& s) {
  s.joints.pack.clear();
  s.joints.slot.resize(z(m.njoint));
  std::iota(s.joints.slot.begin(), s.joints.slot.end(), 0);
}

}  // namespace erbs
