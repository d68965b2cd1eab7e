// What a pushover is asked: where on its curve a spectrum leaves the structure (the performance point).
#pragma once
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/field.h"
#include "engine/loads/spectra/design_spectrum.h"

namespace erbs {

struct PerformanceDemand {
  DesignSpectrum spectrum;
  std::string shape = "peak";       // peak | elastic: the state whose displacements are the shape of the equivalent oscillator
  int nodes = 0;                    // levels over the height into which the mass is gathered; 0: every block is a mass node
  std::string group;                // blocks of the shape; "": those of `blocks`
  std::vector<std::string> blocks;  // names; empty: all that move
  bool iterate = false;             // repeat the bilinear curve up to the target displacement
  Place place;

  bool given() const { return !spectrum.kind.empty(); }

  static Fields<PerformanceDemand> fields() {
    return {
        {"shape", &PerformanceDemand::shape, "",
         "displaced shape of the mass nodes: of the state with the largest load, or of the first state under load", 0, 0, false,
         "peak|elastic"},
        {"nodes", &PerformanceDemand::nodes, "", "mass nodes, levels of equal height (0: each block is one)", 0, 10000},
        {"group", &PerformanceDemand::group, "", "blocks that give the displaced shape, such as a pier (default: all)"},
        {"iterate", &PerformanceDemand::iterate, "",
         "repeat the bilinear curve up to the target displacement until both agree, instead of up to the largest load"},
    };
  }
};

}  // namespace erbs
