// Collapse mechanism, derived from block poses: which joints opened about an edge (hinge), slid, or parted.
#pragma once
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

enum class Movement : std::uint8_t { hinge, slide, part };

struct MovedJoint {
  int joint = 0;
  Movement kind = Movement::hinge;
  double opening = 0;   // m, widest less narrowest gap over the corners
  double slip = 0;      // m, along the joint at its narrowest gap
  double gap = 0;       // m, narrowest gap; zero or negative while the joint still touches
  double rotation = 0;  // rad, of one block relative to the other
  double at[3] = {};    // m, at rest: centre of the edge or corner with the narrowest gap, the axis of a hinge
};

struct Mechanism {
  std::vector<MovedJoint> moved;  // in joint order
  double time = -1;               // s, time of evaluation; negative: never
};

template <class M, class F>
requires std::is_same_v<std::remove_const_t<M>, Mechanism>
void each(M& m, F&& f) {
  f("mechanism_moved", m.moved);
  f("mechanism_time", m.time);
}

// Selects joints that moved by at least a tenth of the largest movement, and by more than a thousandth of their own size. The largest of
// three movements gives the kind. Narrowest gap: the joint has parted. Opening: hinge. Otherwise: slide. Frictionless joints that slide,
// as on a plane of symmetry, count only where nothing else moves. Joints of the blocks `without` do not count [nblock]; empty: none.
Mechanism mechanism_of(const Model& model, const BlockPoses& pose, double t, const std::vector<std::uint8_t>& without = {});

int count(const Mechanism& mechanism, Movement kind);

// "3 joints opened as hinges: between a and b by 8.2 deg, ...; 59 joints slid, most of all between c and d by 2.2 m; metrics.json lists
// them all". If a kind has more than `names` joints, only the one that moved most is named. "" if nothing moved.
std::string summary(const Mechanism& mechanism, const Model& model, int names = 4);

const char* word(Movement kind);

}  // namespace erbs
