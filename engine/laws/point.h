// The numbers of a contact point's law and what a point remembers: plain data, read by code compiled for several instruction sets.
#pragma once

namespace erbs {

struct PointLaw {
  enum class Coupling { coulomb, linear, ellipse };
  double kn = 0, ks = 0;             // Pa/m
  double ft = 0, c = 0;              // Pa
  double mu = 0, mu_residual = 0;
  double opening_peak = 0;           // m, ft / kn
  double opening_ultimate = 0;       // m, tension spent; = opening_peak where brittle
  double slip_ultimate = 0;          // m, plastic slip at which cohesion is spent; 0: brittle
  double fc = 0;                     // Pa; 0: unlimited
  double closing_ultimate = 0;       // m; 0: never
  double damping = 0;                // viscous ratio once cracked, of the joint's own critical value
  bool interlock = true;             // interlock.h
  Coupling coupling = Coupling::coulomb;
  bool dry = false;                  // nothing to break: no bond from the start
};

// What a contact point remembers. damage p runs from 0 (sound) to 1 (tension and cohesion spent), once and for all.
struct PointHistory {
  double slip_s = 0, slip_t = 0;  // m, plastic
  double damage = 0;
  double secant = 0, reach = 0;   // Pa/m, m: of the opened point at this damage, kept since they cost divisions; meaningless at 0
  double bearing = 0;             // Pa, mean of what presses it (interlock.h)
};

}  // namespace erbs
