#include "engine/joints/kernels.h"

#include "engine/base/system/isa.h"

namespace erbs {

const StepKernels& step_kernels() { return by_isa(sse2::kernels, avx2::kernels, avx512::kernels); }

}  // namespace erbs
