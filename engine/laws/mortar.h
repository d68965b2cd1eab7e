// Mortar joint: linear in compression, tension cut-off, Coulomb shear with cohesion and residual friction. Tension and shear are coupled;
// damage is irreversible. Optional are linear softening with fracture energies and ultimate deformations, and a compressive strength that
// is a plateau up to an ultimate deformation or softens with a fracture energy of its own (crushing.h).
// This is the ASSUMED reading of Fig. 5 of Gu and Miao, since its curves are lost. The joint is elastic to the peak, softens (or drops
// brittly) to the ultimate deformation, and is then a unilateral frictional contact.
#pragma once
#include "engine/laws/crushing.h"
#include "engine/laws/face.h"
#include "engine/laws/law.h"

namespace erbs {
struct Mortar;
}

namespace erbs::ERBS_TARGET {

struct MortarFace : ElasticFace {
  static constexpr bool has_bond = true, yields = true;
};
template <>
struct FaceOf<Mortar> {
  using type = MortarFace;
};

}  // namespace erbs::ERBS_TARGET

#ifdef ERBS_HOST
#include "engine/laws/scatter.h"

namespace erbs {

struct Mortar {
  double E = 0;                      // Pa, Young's modulus of the mortar
  double nu = 0.2;                   // Poisson's ratio; G = E / (2 (1 + nu))
  double G = 0;                      // Pa; 0: from nu
  double thickness = 0;              // m, of the bed: kn = E / thickness, ks = G / thickness
  double kn = 0;                     // Pa/m; 0: from E and thickness
  double ks = 0;                     // Pa/m; 0: from G and thickness
  double ft = 0;                     // Pa
  double c = 0;                      // Pa
  double mu = 0;                     // before failure
  double mu_residual = -1;           // after failure; -1: mu
  double Gf1 = 0;                    // J/m2, tension; 0: brittle
  double Gf2 = 0;                    // J/m2, shear; 0: brittle
  double un_ultimate = 0;            // m, opening at zero tensile strength; 0: from Gf1
  double us_ultimate = 0;            // m, slip at zero cohesion; 0: from Gf2
  double fc = 0;                     // Pa, compressive strength; 0: none (elastic, unlimited)
  double Gc = 0;                     // J/m2, compressive fracture energy; 0: a plateau
  double uc_ultimate = 0;            // m, closing at which the mortar is crushed and its bond lost; 0: never
  double kn_cracked = 0;             // Pa/m, once the bond is gone; 0: kn
  double ks_cracked = 0;             // Pa/m, likewise; 0: in the ratio of ks to kn
  double damping = 0;                // of critical, once the joint has cracked; before that damping{} applies
  std::string coupling = "coulomb";  // coulomb | linear | ellipse
  Scatter scatter;                   // of the strength, from joint to joint

  static constexpr std::string_view law_name = "mortar";
  static constexpr std::string_view help =
      "A mortar joint: linear, with tension cut-off, Coulomb shear with cohesion, and optional softening.";
  static Fields<Mortar> fields() {
    return {
        {"E", &Mortar::E, "Pa", "Young's modulus of the mortar", 0, 1e14},
        {"nu", &Mortar::nu, "", "Poisson's ratio, G = E / (2 (1 + nu))", -0.99, 0.5},
        {"G", &Mortar::G, "Pa", "shear modulus of the mortar (default from E and nu)", 0, 1e14},
        {"thickness", &Mortar::thickness, "m", "thickness of the bed; kn = E / thickness, ks = G / thickness", 0, 1},
        {"kn", &Mortar::kn, "Pa/m", "normal stiffness of the joint, instead of E / thickness", 0, 1e16},
        {"ks", &Mortar::ks, "Pa/m", "shear stiffness of the joint, instead of G / thickness (default with neither G nor E: 0.4 kn)", 0,
         1e16},
        {"ft", &Mortar::ft, "Pa", "tensile strength", 0, 1e9, true},
        {"c", &Mortar::c, "Pa", "cohesion", 0, 1e9, true},
        {"mu", &Mortar::mu, "", "coefficient of friction", 0, 10, true},
        {"mu_residual", &Mortar::mu_residual, "", "coefficient of friction after failure (default mu)", -1, 10},
        {"Gf1", &Mortar::Gf1, "J/m2", "fracture energy in tension (0: brittle)", 0, 1e7},
        {"Gf2", &Mortar::Gf2, "J/m2", "fracture energy in shear (0: brittle)", 0, 1e7},
        {"un_ultimate", &Mortar::un_ultimate, "m", "opening at which tensile strength is lost (default from Gf1)", 0, 1},
        {"us_ultimate", &Mortar::us_ultimate, "m", "slip at which cohesion is lost (default from Gf2)", 0, 1},
        {"fc", &Mortar::fc, "Pa", "compressive strength, a plateau without Gc (0: unlimited)", 0, 1e10},
        {"Gc", &Mortar::Gc, "J/m2",
         "compressive fracture energy: the strength falls linearly to zero over a crushed depth of 2 Gc / fc, where the bond is lost too "
         "(usual: Gc = 1.6 mm fc; 0: a plateau)",
         0, 1e9},
        {"uc_ultimate", &Mortar::uc_ultimate, "m",
         "closing at which the mortar is crushed and its bond lost (0: never; with Gc: 2 Gc / fc)", 0, 1},
        {"kn_cracked", &Mortar::kn_cracked, "Pa/m",
         "normal stiffness once no bond is left and the bed bears by its asperities; it fades to this value within some 0.03 s (default "
         "kn)",
         0, 1e16},
        {"ks_cracked", &Mortar::ks_cracked, "Pa/m", "shear stiffness once no bond is left (default kn_cracked ks / kn)", 0, 1e16},
        {"damping", &Mortar::damping, "", "viscous ratio of the cracked joint, relative to its critical value", 0, 1},
        {"coupling", &Mortar::coupling, "", "tension-shear coupling: coulomb, linear or ellipse", 0, 0, false, "coulomb|linear|ellipse"},
    };
  }
  // The bond of a joint that is `factor` times as strong; the openings and slips at which it is lost stay.
  Mortar scaled(double factor) const {
    Mortar out = *this;
    for (double Mortar::*part : {&Mortar::ft, &Mortar::c, &Mortar::Gf1, &Mortar::Gf2}) out.*part *= factor;
    return out;
  }
  std::string complete() {
    if (kn == 0 && E == 0) return "there is no stiffness; give E (with the thickness of the bed) or kn";
    if (kn > 0 && ks == 0 && G == 0 && E == 0) ks = 0.4 * kn;
    return "";
  }
  std::string share_thickness(double& of_joint, bool given) {
    if (!given) of_joint = thickness;
    if (thickness == 0) thickness = of_joint;
    if (kn > 0 || E == 0 || thickness > 0) return "";
    return "the mortar has E but no thickness; give thickness = 5*mm here or in mortar{}";
  }
  std::vector<std::string> mistakes() const {
    std::vector<std::string> out;
    if (kn == 0 && (E == 0 || thickness == 0))
      out.push_back("the mortar has no normal stiffness; give kn, or E and the thickness of the bed");
    if (ks == 0 && (thickness == 0 || (G == 0 && E == 0)) && (kn == 0 || E == 0))
      out.push_back("the mortar has no shear stiffness; give ks, or G or E and the thickness of the bed");
    if (out.empty()) {
      const PointLaw p = compile();
      const auto too_stiff = [&](const char* name, double of, double intact) {
        if (of > intact * (1 + 1e-12))
          out.push_back(
              fmt::format("{}_cracked = {:g} Pa/m lies above {} = {:g} Pa/m: a bed is no stiffer without its bond; lower it, "
                          "or leave it out",
                          name, of, name, intact));
      };
      too_stiff("kn", kn_cracked, p.kn), too_stiff("ks", ks_cracked, p.ks);
      const double softest = p.fades() ? std::min(p.kn, p.kn_debonded) : p.kn, stored = fc * fc / (2 * softest);
      if (Gc > 0 && fc > 0 && !(0.999 * Gc > stored))
        out.push_back(
            fmt::format("Gc = {:g} J/m2 is not above the elastic energy at the peak, fc^2 / (2 {}) = {:g} J/m2; the joint would snap back; "
                        "give Gc more than that (usual: 1.6 mm fc = {:g} J/m2), or a stiffer joint",
                        Gc, softest < p.kn ? "kn_cracked" : "kn", stored, 1.6e-3 * fc));
    }
    if (Gc > 0 && fc == 0) out.push_back("Gc is the energy of crushing, but there is no strength to lose; give fc, or leave Gc out");
    if (mu_residual != -1 && mu_residual < 0) out.push_back("mu_residual is negative; leave it out for mu, or give 0 and more");
    return out;
  }
  PointLaw compile() const {
    PointLaw p;
    const double shear = G > 0 ? G : E / (2 * (1 + nu));
    p.kn = kn > 0 ? kn : E / thickness;
    p.modulus = E;
    p.ks = ks > 0 ? ks : (shear > 0 ? shear / thickness : p.kn / (2 * (1 + nu)));
    p.c = c;
    p.mu = mu;
    p.mu_residual = mu_residual >= 0 ? mu_residual : mu;
    p.coupling = coupling == "linear"    ? PointLaw::Coupling::linear
                 : coupling == "ellipse" ? PointLaw::Coupling::ellipse
                                         : PointLaw::Coupling::coulomb;
    // The apex of the Coulomb cone caps the tension of a point; `warnings()` says so.
    p.ft = p.coupling == PointLaw::Coupling::coulomb && mu > 0 ? std::min(ft, c / mu) : ft;
    p.opening_peak = p.ft / p.kn;
    const double from_energy = p.ft > 0 ? 2 * Gf1 / p.ft : 0;
    p.opening_ultimate = std::max(p.opening_peak, un_ultimate > 0 ? un_ultimate : from_energy);
    // Plastic slip at zero cohesion: the elastic part c / ks does not count.
    p.slip_ultimate = us_ultimate > 0 ? std::max(0.0, us_ultimate - c / p.ks) : (c > 0 ? 2 * Gf2 / c : 0);
    p.fc = fc;
    p.crush_depth = fc > 0 ? 2 * Gc / fc : 0;
    p.closing_ultimate = uc_ultimate > 0 ? uc_ultimate : p.crush_depth;
    p.damping = damping;
    if (kn_cracked > 0 || ks_cracked > 0) {
      p.kn_debonded = kn_cracked > 0 ? kn_cracked : p.kn;
      p.ks_debonded = ks_cracked > 0 ? ks_cracked : p.ks * p.kn_debonded / p.kn;
    }
    p.dry = p.ft == 0 && p.c == 0;
    return p;
  }
  static LawEffects<Mortar> effects() {
    return {{"softening in tension", [](const Mortar& m) { return m.Gf1 > 0 || m.un_ultimate > 0; },
             [](Mortar& m) { m.Gf1 = m.un_ultimate = 0; }},
            {"softening in shear", [](const Mortar& m) { return m.Gf2 > 0 || m.us_ultimate > 0; },
             [](Mortar& m) { m.Gf2 = m.us_ultimate = 0; }},
            {"compression plateau", [](const Mortar& m) { return m.fc > 0; }, [](Mortar& m) { m.fc = m.Gc = m.uc_ultimate = 0; }},
            {"softening in compression", [](const Mortar& m) { return m.Gc > 0; }, [](Mortar& m) { m.Gc = 0; }},
            {"softer beds without bond", [](const Mortar& m) { return m.kn_cracked > 0 || m.ks_cracked > 0; },
             [](Mortar& m) { m.kn_cracked = m.ks_cracked = 0; }},
            {"scatter of strength", [](const Mortar& m) { return m.scatter.cv > 0; }, [](Mortar& m) { m.scatter.cv = 0; }}};
  }
  std::vector<std::pair<const char*, double>> strengths() const { return {{"ft", ft}, {"c", c}, {"fc", fc}}; }  // Pa
  std::vector<std::string> warnings() const {
    std::vector<std::string> out;
    if (coupling == "coulomb" && mu > 0 && ft > c / mu)
      out.push_back(fmt::format("ft = {:g} Pa lies above the tip of the Coulomb cone, c / mu = {:g} Pa; it is capped there", ft, c / mu));
    if (kn <= 0 && thickness <= 0) return out;
    const PointLaw p = compile();
    if (Gf1 > 0 && Gf1 < ft * ft / (2 * p.kn))
      out.push_back(
          fmt::format("Gf1 = {:g} J/m2 is less than the elastic energy at the peak, ft^2 / (2 kn) = {:g} J/m2; the joint snaps "
                      "back (breaks at once)",
                      Gf1, ft * ft / (2 * p.kn)));
    if (Gf2 > 0 && p.ks > 0 && Gf2 < c * c / (2 * p.ks))
      out.push_back(
          fmt::format("Gf2 = {:g} J/m2 is less than the elastic energy at the peak, c^2 / (2 ks) = {:g} J/m2; the joint snaps "
                      "back in shear (its bond goes at once)",
                      Gf2, c * c / (2 * p.ks)));
    return out;
  }
};

}  // namespace erbs
#endif
