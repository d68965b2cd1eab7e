#define ERBS_ISA avx2
#include "engine/joints/kernels.inc"
