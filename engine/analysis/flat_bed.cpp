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

BedToe toe_on_bed(double b, double h, double radius2, double settlement, double gravity) {
  BedToe toe;
  toe.width = std::min(2 * b, 2 * std::sqrt(b * settlement / std::atan2(b, h)));
  toe.inwards = toe.width / 3;
  const double arm = b - toe.inwards, R2 = arm * arm + h * h;
  toe.alpha = std::atan2(arm, h);
  toe.p = std::sqrt(gravity * std::sqrt(R2) / (radius2 + R2));
  toe.threshold = std::max(0.0, 1 - 3 * std::cbrt(h * settlement / (9 * b * b)));
  return toe;
}

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
        const double radius2 = about.dot(model.inertia[block] * about) / model.mass[block], c = radius2 + h * h;
        const auto restitution_of = [&](std::size_t i) { return model.materials[std::size_t(model.material[i])].restitution; };
        bed = {int(block), 2 * b, 2 * h, std::min(restitution_of(block), restitution_of(other))};
        bed.housner = spin_kept(c, b, b);
        bed.kept = spin_kept(c, b, b * impulse_share(bed.restitution));
        bed.least = spin_kept(c, b, b * impulse_share(0));
        bed.alpha = std::atan2(b, h);
        bed.p = std::sqrt(gravity * std::hypot(b, h) / (radius2 + b * b + h * h));
        bed.toe = toe_on_bed(b, h, radius2, model.mass[block] * gravity / (type.stiffness[2] / type.area * depth * 2 * b), gravity);
      }
      if (bed.width > 0) beds.push_back(bed);
    }
  }
  return beds;
}

std::string told(const BedToe& toe, double b, double alpha, double p) {
  return fmt::format(
      "On its edge it stands on a toe of {:.2g} mm and turns about a line {:.2g} mm, {:.2g} % of half the width, inside the edge: its "
      "static "
      "overturning angle is {:.4g} instead of {:.4g} rad, p {:.4g} instead of {:.4g} rad/s, and {:.3g} of g tan(alpha) overturns it; a "
      "stiffer kn narrows the toe",
      1000 * toe.width, 1000 * toe.inwards, 100 * toe.inwards / b, toe.alpha, alpha, toe.p, p, toe.threshold);
}

std::string told(const Model& model, const FlatBed& bed) {
  const double share = (1 - bed.kept * bed.kept) / (1 - bed.housner * bed.housner);
  return fmt::format(
      "block {} ({:.3g} m wide, {:.3g} m high) rocks on a flat bed: an impact keeps about {:.3f} of its spin where Housner's block keeps "
      "{:.3f}, and takes {:.0f} % of the energy that his takes; damping of the joint does not change that (an open bed is a contact, "
      "restitution {:g}; the least that a restitution gives is {:.3f}); feet at its edges make it Housner's: footed_block{{}}. {}",
      model.block_name[std::size_t(bed.block)], bed.width, bed.height, bed.kept, bed.housner, 100 * share, bed.restitution, bed.least,
      told(bed.toe, bed.width / 2, bed.alpha, bed.p));
}

}  // namespace erbs::analysis
