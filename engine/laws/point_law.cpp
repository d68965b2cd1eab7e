#include "engine/laws/point_law.h"

namespace erbs {
namespace {

PointLaw compile_law(const DryFriction& dry) {
  PointLaw p;
  p.kn = dry.kn;
  p.ks = dry.ks > 0 ? dry.ks : 0.4 * dry.kn;
  p.mu = p.mu_residual = dry.mu;
  p.damping = dry.damping;
  p.interlock = dry.interlock > 0;
  p.dry = true;
  return p;
}

PointLaw compile_law(const Mortar& m) {
  PointLaw p;
  const double G = m.G > 0 ? m.G : m.E / (2 * (1 + m.nu));
  p.kn = m.kn > 0 ? m.kn : m.E / m.thickness;
  p.ks = m.ks > 0 ? m.ks : (G > 0 ? G / m.thickness : p.kn / (2 * (1 + m.nu)));
  p.c = m.c;
  p.mu = m.mu;
  p.mu_residual = m.mu_residual >= 0 ? m.mu_residual : m.mu;
  p.coupling = m.coupling == "linear"    ? PointLaw::Coupling::linear
               : m.coupling == "ellipse" ? PointLaw::Coupling::ellipse
                                         : PointLaw::Coupling::coulomb;
  // The apex of the Coulomb cone caps the tension of a point. The check of the scene warns of it.
  p.ft = p.coupling == PointLaw::Coupling::coulomb && m.mu > 0 ? std::min(m.ft, m.c / m.mu) : m.ft;
  p.opening_peak = p.ft / p.kn;
  const double from_energy = p.ft > 0 ? 2 * m.Gf1 / p.ft : 0;
  p.opening_ultimate = std::max(p.opening_peak, m.un_ultimate > 0 ? m.un_ultimate : from_energy);
  // Plastic slip at zero cohesion: the elastic part c / ks does not count.
  p.slip_ultimate = m.us_ultimate > 0 ? std::max(0.0, m.us_ultimate - m.c / p.ks) : (m.c > 0 ? 2 * m.Gf2 / m.c : 0);
  p.fc = m.fc;
  p.closing_ultimate = m.uc_ultimate;
  p.damping = m.damping;
  p.dry = p.ft == 0 && p.c == 0;
  return p;
}

}  // namespace

PointLaw compile(const Law& law) {
  return std::visit([](const auto& l) { return compile_law(l); }, law);
}

}  // namespace erbs
