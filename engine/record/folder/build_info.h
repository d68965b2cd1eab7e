// Version, commit and compiler of this program. The build writes the values (build_info.cmake).
#pragma once

namespace erbs {

extern const char* const build_version;   // "0.1.0"
extern const char* const build_git_hash;  // "1a2b3c4d5e6f"; ends in "-dirty" if the tree had changes; "unknown" outside git
extern const char* const build_compiler;  // "g++ 12.2.0 Release"

}  // namespace erbs
