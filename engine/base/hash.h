// FNV-1a hash, 64 bits (Fowler, Noll and Vo 1991). It detects changed bytes, not forged ones.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "engine/base/error.h"

namespace erbs {

// `state`: the result of an earlier call, to add more bytes to it.
inline std::uint64_t fnv1a(std::string_view bytes, std::uint64_t state = 0xcbf29ce484222325u) {
  for (const char c : bytes) state = (state ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return state;
}

// The form in manifests: 16 hexadecimal digits.
inline std::string hash_text(std::uint64_t hash) { return fmt::format("{:016x}", hash); }
inline std::string hash_text(std::string_view bytes) { return hash_text(fnv1a(bytes)); }

}  // namespace erbs
