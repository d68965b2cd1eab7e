#include "engine/contact/overlap/clip.h"

#include "engine/base/system/isa.h"
#include "engine/contact/law/pair_lanes.h"

namespace erbs {

const ClipKernels& clip_kernels() { return by_isa(sse2::clip_kernels, avx2::clip_kernels, avx512::clip_kernels); }

const PairKernels& pair_kernels() { return by_isa(sse2::pair_kernels, avx2::pair_kernels, avx512::pair_kernels); }

}  // namespace erbs
