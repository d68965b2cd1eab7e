# Writes build_info.cpp at every build, and only if its content changes. A new commit thus shows without a new configure.
# -D source= root of the tree  -D output= file to write  -D version= -D compiler=
set(hash unknown)
find_program(GIT git)
if(GIT AND EXISTS ${source}/.git)
  execute_process(COMMAND ${GIT} -C ${source} describe --always --abbrev=12 --exclude=* --dirty
                  OUTPUT_VARIABLE described RESULT_VARIABLE failed OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT failed)
    set(hash ${described})
  endif()
endif()
file(CONFIGURE OUTPUT ${output} @ONLY CONTENT [[#include "engine/record/folder/build_info.h"

namespace erbs {
const char* const build_version = "@version@";
const char* const build_git_hash = "@hash@";
const char* const build_compiler = "@compiler@";
}  // namespace erbs
]])
