// A short fingerprint of bytes, to tell whether an input is the one of another run (FNV-1a, 64 bits: Fowler, Noll, Vo 1991).
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "engine/base/error.h"

namespace erbs {

inline std::uint64_t fnv1a(std::string_view bytes, std::uint64_t hash = 14695981039346656037ull) {
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  return hash;
}

inline std::string hash_text(std::string_view bytes) { return fmt::format("{:016x}", fnv1a(bytes)); }

}  // namespace erbs
