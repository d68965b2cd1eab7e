#define ERBS_ISA sse2
#include "engine/solve/lanes.inc"
