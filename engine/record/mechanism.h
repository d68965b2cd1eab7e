// The mechanism of a collapse: which joints opened about an edge (hinge), which slid, which parted, told from the poses of their blocks.
#pragma once
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
  double opening = 0;   // m, widest gap less the narrowest over the corners
  double slip = 0;      // m, along the joint where it is closed most
  double gap = 0;       // m, narrowest gap (zero or less where the joint still touches)
  double rotation = 0;  // rad, of one block against the other
  double at[3] = {};    // m, at rest: middle of the edge or corner that is closed most, where a hinge turns
};

struct Mechanism {
  std::vector<MovedJoint> moved;  // in the order of joints
  double time = -1;               // s, when it was looked at; negative: never
};

template <class M, class F>
requires std::is_same_v<std::remove_const_t<M>, Mechanism>
void each(M& m, F&& f) {
  f("mechanism_moved", m.moved);
  f("mechanism_time", m.time);
}

// Joints that have moved at least by a tenth of the one that has moved most, and by a thousandth of their own size. A joint has parted
// where its narrowest gap is the largest of the three movements, it is a hinge where its opening is, else it has slid.
Mechanism mechanism_of(const Model& model, const State& state, double t);

int count(const Mechanism& mechanism, Movement kind);

// "3 joints opened as hinges: between a and b by 8.2 deg, ...; 59 joints slid, most of all between c and d by 2.2 m; metrics.json lists
// them all". If a kind has more than `names` joints, only the one that moved most is named. "" if nothing moved.
std::string summary(const Mechanism& mechanism, const Model& model, int names = 4);

const char* word(Movement kind);

}  // namespace erbs
