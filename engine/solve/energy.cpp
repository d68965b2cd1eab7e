#include "engine/solve/energy.h"

#include <cmath>

namespace erbs {

double dissipated(const Energy& e) { return e.friction + e.fracture + e.crushing + e.damping + e.contact_damping + e.reset + e.sleep; }

double worked(const Energy& e) { return e.base_work + e.external_work + e.tilt_work; }

void settle(Energy& e, double floor, double t, int worst_joint) {
  const double stored = e.kinetic + e.gravity + e.elastic;
  if (!e.started) {
    e.started = true;
    e.start = stored - worked(e) + dissipated(e);
    e.elastic_at_start = e.elastic;
  }
  const double before = e.residual;
  e.residual = stored - e.start + dissipated(e) - worked(e);
  e.largest_moving = std::max(e.largest_moving, std::fabs(e.kinetic) + std::fabs(e.elastic - e.elastic_at_start));
  const double loss = std::fabs(e.friction) + std::fabs(e.fracture) + std::fabs(e.crushing) + std::fabs(e.damping) +
                      std::fabs(e.contact_damping) + std::fabs(e.reset) + std::fabs(e.sleep);
  // Elastic energy at the start is the only scale of a stressed structure at rest without gravity. Its round-off is some 1e-16 of it, a few
  // times that in sums over many joints; a floor of 1e-8 puts this below the elastic tolerance of 1e-6. Kinetic energy at the start is
  // already part of `largest_moving`.
  floor = std::max(floor, 1e-8 * std::fabs(e.elastic_at_start));
  const double scale = std::max(floor, e.largest_moving + e.absolute_work + loss + 0.5 * e.height_flux);
  e.residual_relative = std::fabs(e.residual) / scale;
  e.residual_worst = std::max(e.residual_worst, e.residual_relative);
  const double jump = std::fabs(e.residual - before);
  if (jump > e.largest_jump) {
    e.largest_jump = jump;
    e.largest_jump_time = t;
    e.largest_jump_joint = worst_joint;
  }
}

}  // namespace erbs
