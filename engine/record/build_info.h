// What was compiled, from what. Filled by the build (build_info.cmake).
#pragma once

namespace erbs {

extern const char* const build_version;   // "0.1.0"
extern const char* const build_git_hash;  // "1a2b3c4d5e6f", "-dirty" behind it where the tree had changes; "unknown" outside git
extern const char* const build_compiler;  // "g++ 12.2.0 Release"

}  // namespace erbs
