#include "engine/analysis/flat_bed.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"

namespace erbs::analysis {

namespace {

constexpr double slender = 1.2;   // stouter blocks slide or stand
constexpr double centred = 0.05;  // of the half width: how far the centroid may be from above the middle of the base

}  // namespace

double spin_kept(double c, double b, double x) { return (c - b * x) / (c + b * x); }

double impulse_share(double restitution) { return 0.49 - 0.13 * restitution - 0.24 * restitution * restitution; }

std::vector<FlatBed> flat_beds(const Model& model) {
  std::vector<FlatBed> beds;
  const double gravity = model.gravity.norm();
  if (!(gravity > 0)) return beds;
  const Vec3 up = -model.gravity / gravity;
  std::vector<int> joints(std::size_t(model.nblock), 0);
  for (const Joint& joint : model.joint) ++joints[std::size_t(joint.a)], ++joints[std::size_t(joint.b)];
  for (const Joint& joint : model.joint) {
    for (const bool first : {false, true}) {
      const std::size_t block = std::size_t(first ? joint.a : joint.b), other = std::size_t(first ? joint.b : joint.a);
      const JointType& type = *joint.type;
      if (model.kind[block] != Kind::moving || model.kind[other] == Kind::moving || joints[block] != 1 ||
          model.laws[std::size_t(type.law)].has_bond())
        continue;
      const Vec3 arm = first ? joint.arm_a : joint.arm_b;  // from the centroid to the middle of the bed
      const double h = -arm.dot(up);
      if (!(h > 0) || std::fabs(type.frame.col(2).dot(up)) < 0.99) continue;
      FlatBed bed;
      for (const int axis : {0, 1}) {
        const double b = axis == 0 ? type.half_s : type.half_t, depth = 2 * (axis == 0 ? type.half_t : type.half_s);
        if (!(h > slender * b) || std::fabs(arm.dot(type.frame.col(axis))) > centred * b || (bed.width > 0 && 2 * b > bed.width)) continue;
        const Vec3 about = type.frame.col(1 - axis);
        const double c = about.dot(model.inertia[block] * about) / model.mass[block] + h * h;
        const auto restitution_of = [&](std::size_t i) { return model.materials[std::size_t(model.material[i])].restitution; };
        bed = {int(block), 2 * b, 2 * h, std::min(restitution_of(block), restitution_of(other))};
        bed.housner = spin_kept(c, b, b);
        bed.kept = spin_kept(c, b, b * impulse_share(bed.restitution));
        bed.least = spin_kept(c, b, b * impulse_share(0));
        bed.toe = std::sqrt(2 * model.mass[block] * gravity * h / (type.stiffness[2] / type.area * depth * b));
      }
      if (bed.width > 0) beds.push_back(bed);
    }
  }
  return beds;
}

std::string told(const Model& model, const FlatBed& bed) {
  const double share = (1 - bed.kept * bed.kept) / (1 - bed.housner * bed.housner), inwards = bed.toe / 3 / (bed.width / 2);
  return fmt::format(
      "block {} ({:.3g} m wide, {:.3g} m high) rocks on a flat bed: an impact keeps about {:.3f} of its spin where Housner's block keeps "
      "{:.3f}, "
      "and takes {:.0f} % of the energy that his takes; damping of the joint does not change that (an open bed is a contact, restitution "
      "{:g}; the "
      "least that a restitution gives is {:.3f}); feet at its edges make it Housner's. On its edge it stands on a toe of {:.2g} mm, which "
      "brings the "
      "edge in by {:.2g} % of half the width; a stiffer kn narrows it",
      model.block_name[std::size_t(bed.block)], bed.width, bed.height, bed.kept, bed.housner, 100 * share, bed.restitution, bed.least,
      1000 * bed.toe, 100 * inwards);
}

}  // namespace erbs::analysis
