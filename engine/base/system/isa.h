// The instruction set of the kernels, chosen when the program starts.
#pragma once

namespace erbs {

enum class Isa { sse2, avx2, avx512 };

// The widest set of this processor. The environment variable ERBS_ISA=sse2|avx2|avx512 caps it; any other word is an Error.
Isa chosen_isa();

// The kernels compiled for the chosen set.
template <class Kernels>
const Kernels& by_isa(const Kernels& sse2, const Kernels& avx2, const Kernels& avx512) {
  const Isa isa = chosen_isa();
  return isa == Isa::avx512 ? avx512 : isa == Isa::avx2 ? avx2 : sse2;
}

}  // namespace erbs
