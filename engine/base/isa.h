// Which instruction set the kernels run on.
#pragma once

namespace erbs {

enum class Isa { sse2, avx2, avx512 };

// The widest this processor has; ERBS_ISA=sse2|avx2|avx512 in the environment asks for a narrower one; another word is an Error.
Isa chosen_isa();

// What was compiled for it.
template <class Kernels>
const Kernels& by_isa(const Kernels& sse2, const Kernels& avx2, const Kernels& avx512) {
  const Isa isa = chosen_isa();
  return isa == Isa::avx512 ? avx512 : isa == Isa::avx2 ? avx2 : sse2;
}

}  // namespace erbs
