#include "engine/contact/clip.h"

#include "engine/base/isa.h"
#include "engine/contact/pair_lanes.h"

namespace erbs {

const ClipKernels& clip_kernels() {
  switch (chosen_isa()) {
    case Isa::avx512:
      return avx512::clip_kernels;
    case Isa::avx2:
      return avx2::clip_kernels;
    case Isa::sse2:
      break;
  }
  return sse2::clip_kernels;
}

const PairKernels& pair_kernels() {
  switch (chosen_isa()) {
    case Isa::avx512:
      return avx512::pair_kernels;
    case Isa::avx2:
      return avx2::pair_kernels;
    case Isa::sse2:
      break;
  }
  return sse2::pair_kernels;
}

}  // namespace erbs
