#define ERBS_ISA avx2
#include "engine/solve/lanes.inc"
