#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>

// Read by the leak sanitizer, if present: memory that OpenGL drivers keep is not our leak.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa\nleak:libEGL\nleak:libgallium\n"; }
