#include "engine/solve/lanes.h"

#include "engine/base/isa.h"

namespace erbs {

const LaneKernels& lane_kernels() {
  switch (chosen_isa()) {
    case Isa::avx512: return avx512::kernels;
    case Isa::avx2: return avx2::kernels;
    case Isa::sse2: break;
  }
  return sse2::kernels;
}

}  // namespace erbs
