// Mortar joint: linear in compression, tension cut-off, Coulomb shear with cohesion and residual friction. Tension and shear are coupled;
// damage is irreversible. Optional are linear softening with fracture energies and ultimate deformations, and a compression plateau up to
// an ultimate deformation (crushing.h).
// This is the ASSUMED reading of Fig. 5 of Gu and Miao, since its curves are lost. The joint is elastic to the peak, softens (or drops
// brittly) to the ultimate deformation, and is then a unilateral frictional contact.
#pragma once
#include "engine/base/field.h"

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
  double fc = 0;                     // Pa, compression plateau; 0: none (elastic, unlimited)
  double uc_ultimate = 0;            // m, closing at which the mortar is crushed and its bond lost; 0: never
  double damping = 0;                // of critical, once the joint has cracked; before that damping{} applies
  std::string coupling = "coulomb";  // coulomb | linear | ellipse

  static constexpr std::string_view law_name = "mortar";
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
        {"fc", &Mortar::fc, "Pa", "compressive strength, a plateau (0: unlimited)", 0, 1e10},
        {"uc_ultimate", &Mortar::uc_ultimate, "m", "closing at which the mortar is crushed and its bond lost (0: never)", 0, 1},
        {"damping", &Mortar::damping, "", "viscous ratio of the cracked joint, relative to its critical value", 0, 1},
        {"coupling", &Mortar::coupling, "", "tension-shear coupling: coulomb, linear or ellipse", 0, 0, false, "coulomb|linear|ellipse"},
    };
  }
};

}  // namespace erbs
