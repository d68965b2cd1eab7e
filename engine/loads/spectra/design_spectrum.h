// The elastic response spectrum that a structure is asked to withstand: of EN 1998-1:2004, of TBSC 2018, or a table.
#pragma once
#include <string>
#include <vector>

#include "engine/base/field.h"

namespace erbs {

struct DesignSpectrum {
  std::string kind;                      // a word of fields(); "": none is given
  std::string ground;                    // EN 1998-1: A to E, table 3.1
  double ag = 0;                         // m/s2, EN 1998-1: design acceleration on ground A, importance included
  double damping = 0.05;                 // EN 1998-1: viscous damping ratio
  double S = 0, TB = 0, TC = 0, TD = 0;  // of a national annex; 0: of the ground type. TC also of a table. [-], s
  double SDS = 0, SD1 = 0;               // TBSC 2018: design coefficients of short periods and of 1 s, shares of g
  std::vector<double> period;            // s, of a table, growing from 0      [rows]
  std::vector<double> acceleration;      // m/s2                               [rows]

  static Fields<DesignSpectrum> fields() {
    return {
        {"kind", &DesignSpectrum::kind, "", "code of the elastic spectrum (default with `table`: table)", 0, 0, false,
         "EN 1998-1 type 1|EN 1998-1 type 2|TBSC 2018|table"},
        {"ground", &DesignSpectrum::ground, "", "EN 1998-1: ground type, which gives S, TB, TC and TD", 0, 0, false, "A|B|C|D|E"},
        {"ag", &DesignSpectrum::ag, "m/s2", "EN 1998-1: design ground acceleration on ground A", 0, 50},
        {"damping", &DesignSpectrum::damping, "", "EN 1998-1: viscous damping ratio", 0.001, 0.5},
        {"S", &DesignSpectrum::S, "", "EN 1998-1: soil factor of a national annex (0: of the ground type)", 0, 5},
        {"TB", &DesignSpectrum::TB, "s", "EN 1998-1: where the plateau begins (0: of the ground type)", 0, 10},
        {"TC", &DesignSpectrum::TC, "s", "where the plateau ends; needed with `table` (0: of the ground type)", 0, 10},
        {"TD", &DesignSpectrum::TD, "s", "EN 1998-1: where the displacement becomes constant (0: of the ground type)", 0, 20},
        {"SDS", &DesignSpectrum::SDS, "", "TBSC 2018: design coefficient of short periods, a share of g: 0.9, not 0.9*g", 0, 4},
        {"SD1", &DesignSpectrum::SD1, "", "TBSC 2018: design coefficient of the period of 1 s, a share of g", 0, 4},
    };
  }
};

// Mistakes with their remedies: values that are missing, that belong to another kind, or corner periods that do not grow.
std::vector<std::string> check_spectrum(const DesignSpectrum& spectrum);

// Constant acceleration from `begin` to `end`, constant velocity to `last`, constant displacement beyond (s). Of a table: `end` alone.
struct CornerPeriods {
  double begin = 0, end = 0, last = 0;
};
CornerPeriods corner_periods(const DesignSpectrum& spectrum);

double damping_correction(double damping);  // eta of EN 1998-1:2004 (3.6), 1 at 5 %

// Elastic pseudo-acceleration (m/s2) and displacement (m) at the period (s). The displacement stays constant beyond the last corner, on
// the safe side of EN 1998-1 annex A. Error beyond the end of a table.
double spectral_acceleration(const DesignSpectrum& spectrum, double period);
double spectral_displacement(const DesignSpectrum& spectrum, double period);

// The longest period (s) with a value: the end of a table, otherwise infinite.
double last_period(const DesignSpectrum& spectrum);

std::string spectrum_name(const DesignSpectrum& spectrum);  // "EN 1998-1 type 1, ground B, ag = 0.2 g"

}  // namespace erbs
