// The time step that joints and contacts bear together, while contacts come and go.
//
// omega^2 of all is bounded in one of two ways, the lower counts:
//   by joints   that of the sound structure at rest (4 / dt_critical^2; a cracked joint, or the contact on its bed, is no stiffer), plus
//               twice the largest eigenvalue of what other contacts resist with on a block (Weyl's inequality);
//   by blocks   twice the largest eigenvalue over the blocks of all that resists on one, joints that are left included: since
//               (x - y) K (x - y) <= 2 (x K x + y K y), 2 / omega is the block bound of the structure as it stands.
// The matrices are built now and then ("counted"); between two counts, what contacts have beyond what was counted is added block by block,
// by scalars that a step has at hand (PairResult::rate_a, _b), and what a face would have that may land next. The block that then asks for
// most decides. So the step grows past the limit of the sound structure once stiff joints are gone.
#pragma once
#include <span>
#include <vector>

#include "engine/contact/contact.h"
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

class ContactLimit {
 public:
  ContactLimit(const Model& model, State& state) : model_(model), state_(state) {}

  // 1/s2, what block b adds to 1 / dt^2: its contacts have `rate` (1/s2) beyond what was counted, and a face of `landing` may come to it.
  double on_block(int b, double rate, double landing) const;
  // The most of it on `blocks` that move; rate and landing of each block of the model.
  double on_most(std::span<const int> blocks, std::span<const double> rate, std::span<const double> landing) const;
  // The step allowed where the block that adds most adds `most`.
  double allowed(double most) const;
  // Whether another count is due, `allowed` being the step as it was last counted.
  bool due(double allowed) const;
  // Counts joints, and contacts as they lie. Beds count as the joints they were. `scalars` (1/s2): the sum over each block of the
  // rates of all other contacts, a bound that may turn out the better one.
  void count(const ContactShapes& shapes, std::span<const ContactBlock> blocks, const std::vector<double>& scalars, OverlapRoom& room);

 private:
  double sound() const;
  std::vector<double> by_matrices(std::span<const ContactBlock> blocks, std::span<const Mat6> stiffness) const;
  void add_joints(std::span<Mat6> to) const;

  const Model& model_;
  State& state_;
};

}  // namespace erbs
