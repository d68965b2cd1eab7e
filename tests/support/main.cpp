#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>

// Read by the sanitizer of leaks, where there is one: what the drivers of OpenGL keep for themselves is theirs.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa\nleak:libEGL\nleak:libgallium\n"; }
