// Who has fallen, and when it is a collapse. A block has fallen when its centre is lower than at the start by more than half its
// smallest edge (relative to the ground).
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#include "engine/model/model.h"
#include "engine/model/state.h"
#include "engine/record/mechanism.h"

namespace erbs {

struct Collapse {
  std::vector<double> start;         // m, height over rest of each centre at the start [nblock]
  std::vector<std::uint8_t> fallen;  // has ever fallen                                [nblock]
  double fallen_fraction = 0;        // share of the moving mass that is down now
  bool collapsed = false;            // the share has reached Analysis::collapse_fraction once
  double time = 0;                   // s, when it did
  bool under_gravity = false;        // it did not stand under its own weight to begin with: no shock did that, and at no time
  bool moved = false;                // a block has come Analysis::stop_when_moved away from rest
  Mechanism mechanism;               // as it was at the collapse
};

template <class C, class F>
requires std::is_same_v<std::remove_const_t<C>, Collapse>
void each(C& c, F&& f) {
  f("collapse_start", c.start);
  f("collapse_fallen", c.fallen);
  f("collapse_fraction", c.fallen_fraction);
  f("collapse_collapsed", c.collapsed);
  f("collapse_time", c.time);
  f("collapse_under_gravity", c.under_gravity);
  f("collapse_moved", c.moved);
  f("collapse_mechanism", c.mechanism);
}

Collapse watch_collapse(const Model& model, const State& start);

// Looks at the state at time t. Blocks down for the first time are appended to `newly` where given. Returns true when this is
// the moment of collapse.
bool update(Collapse& collapse, const Model& model, const State& state, double t, std::vector<int>* newly = nullptr);

// Unit mean horizontal displacement (x, y) of the blocks that are down now; none where no block is, or where the length of the
// mean is below a tenth of the mean length (they fell every way).
std::optional<std::array<double, 2>> collapse_direction(const Collapse& collapse, const Model& model, const State& state);

}  // namespace erbs
