// Gathers the data of neighbours from lanes of other packs (`GatherTable` of joint_pack.h).
#pragma once
#include "engine/model/joint_pack.h"
#include "engine/simd/pack.h"

namespace erbs::ERBS_TARGET {

// out[i][lane l] = x[i] of the lane that lane l reads, zero where it reads none. The records are contiguous.
ERBS_INLINE void gather(const VectorPack<6>* records, const GatherTable& c, Pack out[6]) {
  const double* first = records->x[0];
#if defined(__AVX512F__)
  const auto record = [&](int i) { return first + (c.at[c.first[i]] & ~15); };
  const __m512i lane = _mm512_maskz_cvtepi32_epi64(0xff, _mm256_loadu_si256(reinterpret_cast<const __m256i*>(c.at)));
  const auto row = [](const double* r, int i) { return _mm512_load_pd(r + pack_size * i); };
  const double *one = record(0), *two = record(1);
  for (int i = 0; i < 6; ++i) out[i] = Pack::Register(_mm512_maskz_permutex2var_pd(c.who[0], row(one, i), lane, row(two, i)));
  for (int k = 2; k < c.records; ++k) {
    const double* more = record(k);
    for (int i = 0; i < 6; ++i) out[i] = Pack::Register(_mm512_mask_permutexvar_pd(__m512d(out[i].v), c.who[k], lane, row(more, i)));
  }
#else
  const double* from[pack_size];
  for (int l = 0; l < pack_size; ++l) from[l] = first + (c.at[l] & ~pack_size);
  for (int i = 0; i < 6; ++i) out[i] = Pack::gather(from, pack_size * i);
#endif
}

}  // namespace erbs::ERBS_TARGET
