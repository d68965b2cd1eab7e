// A contact pair seen from its reference body.
#pragma once
#include "engine/contact/law/pair_lanes.h"
#include "engine/contact/overlap/general.h"
#include "engine/model/contact_pair.h"

namespace erbs {

inline const ContactShape& shape_of(const ContactShapes& shapes, int block, int part) {
  return shapes.part(static_cast<std::size_t>(shapes.first[static_cast<std::size_t>(block)] + part));
}

struct PairFrame {
  const ContactShape *reference, *other;
  const ContactBlock *reference_block, *other_block;
  PairPose pose;
};

inline PairFrame part_frame(const ContactShape& reference, const ContactShape& other, const ContactBlock& reference_block,
                            const ContactBlock& other_block) {
  PairFrame s{&reference, &other, &reference_block, &other_block, {}};
  // Relative positions first: a scene 1e4 m from the origin must not lose digits.
  const Vec3 apart = (other_block.rest - reference_block.rest) + (other_block.u - reference_block.u);
  s.pose.shift = reference_block.rotation.transpose() * apart;
  s.pose.rotation = reference_block.rotation.transpose() * other_block.rotation;
  return s;
}

inline PairFrame pair_frame(const ContactPair& pair, const ContactShapes& shapes, const ContactBlock& a, const ContactBlock& b) {
  const ContactShape &shape_a = shape_of(shapes, pair.a, pair.part_a), &shape_b = shape_of(shapes, pair.b, pair.part_b);
  return pair.b_is_reference ? part_frame(shape_b, shape_a, b, a) : part_frame(shape_a, shape_b, a, b);
}

// Makes a pair lane `l` of a pack.
template <int n>
void set_lane(PairPackOf<n>& w, int l, ContactPair& pair, const ContactBlock& reference, const ContactBlock& other, double contact_count) {
  w.pair[l] = &pair.law.kn;
  w.reference[l] = reference.u.data();
  w.other[l] = other.u.data();
  w.swapped[l] = pair.b_is_reference;
  w.contact_count[l] = contact_count;
  w.lag[l] = pair.lag, w.blow_age[l] = pair.blow_age;
}

}  // namespace erbs
