// Parameters of a contact point's law, and the history of a point. Plain data: files compiled for several instruction sets include it.
#pragma once

namespace erbs {

struct PointLaw {
  enum class Coupling { coulomb, linear, ellipse };
  double kn = 0, ks = 0;  // Pa/m
  double ft = 0, c = 0;   // Pa
  double mu = 0, mu_residual = 0;
  double opening_peak = 0;                  // m, ft / kn
  double opening_ultimate = 0;              // m, opening at zero tensile strength; = opening_peak if brittle
  double slip_ultimate = 0;                 // m, plastic slip at zero cohesion; 0: brittle
  double fc = 0;                            // Pa; 0: unlimited
  double crush_depth = 0;                   // m, crushed depth at zero compressive strength, 2 Gc / fc; 0: a plateau
  double closing_ultimate = 0;              // m, closing at which the bond is lost; 0: never
  double kn_debonded = 0, ks_debonded = 0;  // Pa/m, once no bond is left; 0: as before (joints/cracked/fading.h)
  double damping = 0;                       // viscous ratio of a cracked joint, of its own critical value
  bool interlock = true;                    // interlock.h
  Coupling coupling = Coupling::coulomb;
  bool dry = false;        // no bond from the start
  int type = 0;            // of `Laws` (laws.h)
  double modulus = 0;      // Pa, Young's modulus of the layer; 0: unknown
  double own[2] = {0, 0};  // numbers that only this type of law knows

  bool has_bond() const { return !dry; }
  double mu_debonded() const { return dry ? mu : mu_residual; }
  bool fades() const { return kn_debonded > 0; }
  bool crushes() const { return fc > 0; }                  // yields in compression
  bool crushes_softly() const { return crush_depth > 0; }  // and loses its strength by it
};

// History of a contact point. Damage p grows from 0 (intact) to 1 (no tensile strength, no cohesion) and never falls.
struct PointHistory {
  double slip_s = 0, slip_t = 0;  // m, plastic
  double damage = 0;
  double secant = 0, kappa = 0;  // Pa/m, m: secant stiffness and largest opening at this damage, stored to save divisions; unset at 0
  double mean_pressure = 0;      // Pa, mean pressure (interlock.h)
  double lent = 0;               // Pa s, of friction beyond the current pressure, over its coefficient (interlock.h)
};

}  // namespace erbs
