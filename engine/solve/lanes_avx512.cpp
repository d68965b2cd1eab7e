#define ERBS_ISA avx512
#include "engine/solve/lanes.inc"
