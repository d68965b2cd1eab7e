#define ERBS_ISA sse2
#include "engine/joints/kernels.inc"
