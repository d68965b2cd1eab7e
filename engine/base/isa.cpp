#include "engine/base/isa.h"

#include <cstdlib>
#include <string_view>

namespace erbs {
namespace {

Isa choose() {
  const char* asked = std::getenv("ERBS_ISA");
  const std::string_view name = asked != nullptr ? asked : "";
#if defined(__x86_64__)
  const bool has512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  const bool has2 = __builtin_cpu_supports("avx2");
  if (has512 && (name.empty() || name == "avx512")) return Isa::avx512;
  if (has2 && (name.empty() || name == "avx2" || name == "avx512")) return Isa::avx2;
#endif
  return Isa::sse2;
}

}  // namespace

Isa chosen_isa() {
  static const Isa chosen = choose();
  return chosen;
}

}  // namespace erbs
