#include "engine/base/system/isa.h"

#include <cstdlib>
#include <string_view>

#include "engine/base/error.h"
#include "engine/base/text.h"

namespace erbs {
namespace {

Isa choose() {
  const char* asked = std::getenv("ERBS_ISA");
  const std::string_view name = asked != nullptr ? asked : "";
  if (!name.empty() && name != "sse2" && name != "avx2" && name != "avx512")
    throw Error(fmt::format("ERBS_ISA={}: unknown; write sse2, avx2 or avx512, or leave it out", shown(name, 40)));
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
