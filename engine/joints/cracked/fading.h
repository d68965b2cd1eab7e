// Stiffness of a bed after its bond is gone. A cracked bed bears by its asperities, softer than bonded mortar (`kn_cracked`, `ks_cracked`
// of a mortar). Once no point of a joint has a bond left, its stiffness falls to that value by exponential decay over `fade_time`. It is a
// model of ours: no source gives the decay; only its end is a property of the bed.
//
// Work. At a fixed pose the force of the joint falls with its stiffness, by a few per cent a call, and so does its stored energy.
// The difference is lost as crushing. The force before the fall still acts in the half step to the next pose; the work of its lost part,
// half of it times the way, is booked once that pose is known. The identity of the energy ledger then holds as for constant stiffness.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/joints/cracked/cracked.h"

namespace erbs {

class Fading {
 public:
  static constexpr double fade_time = 0.01;  // s

  static double keeps(double dt) { return std::exp(-dt / fade_time); }  // share left after `dt` (s)
  // Steps of `dt` (s) between two calls: so many that 2 % of the stiffness go at once, if the step allows.
  static int every(double dt) { return int(std::clamp(0.02 * fade_time / dt, 1.0, 8.0)); }

  Fading(const Model& model, State& state);
  // Between two steps, before the forces of the next one. `dt`: s, since the last call.
  void fade(Cracked& cracked, double dt);
  // After those forces.
  void book(Cracked& cracked);

 private:
  struct Faded {
    int joint;
    double lost[6], gap[6];  // N, N m; m, rad
  };
  bool debonded(const Cracked& cracked, int j) const;
  void fade(int j, StiffnessShare to);

  const Model& model_;
  State& state_;
  const bool reference_;     // forces come from the State, not from packs
  std::vector<int> joints_;  // whose law fades
  std::vector<Faded> faded_;
};

}  // namespace erbs
