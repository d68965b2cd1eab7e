// The step's kernels (kernels.h), compiled once for each instruction set.
#include "engine/joints/cracked/cracked_kernel.h"
#include "engine/joints/cracked/joint_friction.h"
#include "engine/joints/elastic_kernel.h"
#include "engine/joints/intact/intact_kernel.h"
#include "engine/joints/kernels.h"
#include "engine/joints/relative_pose.h"
#include "engine/solve/blocks/block_kernel.h"

namespace erbs::ERBS_TARGET {
namespace {

// Twelve independent chains of a x + b: enough to hide the latency of either operation.
double work_registers(long rounds) {
  using Register = PackOf<register_size>;
  constexpr int chains = 12;
  Register x[chains];
  for (int i = 0; i < chains; ++i) x[i] = 1 + 0.01 * i;
  const Register a = 0.999, b = 0.001;
  for (long r = 0; r < rounds; ++r)
    for (int i = 0; i < chains; ++i) {
#if defined(__AVX512F__)
      x[i] = Register::Register(_mm512_fmadd_pd(__m512d(x[i].v), __m512d(a.v), __m512d(b.v)));
#else
      x[i] = x[i] * a + b;
#endif
    }
  Register sum = 0;
  for (int i = 0; i < chains; ++i) sum += x[i];
  double zero = 0;
  for (int i = 0; i < register_size; ++i) zero += sum[i] > 0 ? 0 : 1;
  return 2.0 * chains * register_size * double(rounds) + zero;
}

}  // namespace

template <class... L>
constexpr StepKernels table(LawList<L...>) {
  StepKernels out{ERBS_TARGET_NAME, elastic, {}, {}, wrenches, intact, intact_ends, advance, forces, pose, intact_geometry, work_registers};
  int type = 0;
  ((FaceOf<L>::type::has_bond ? void(out.respond[type++] = respond<typename FaceOf<L>::type>) : void(++type)), ...);
  type = 0;
  ((out.friction[type++] = friction<typename FaceOf<L>::type>), ...);
  return out;
}

const StepKernels kernels = table(Laws{});

}  // namespace erbs::ERBS_TARGET
