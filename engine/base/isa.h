// Which instruction set the kernels run on.
#pragma once

namespace erbs {

enum class Isa { sse2, avx2, avx512 };

// The widest this processor has; ERBS_ISA=sse2|avx2|avx512 in the environment asks for a narrower one.
Isa chosen_isa();

}  // namespace erbs
