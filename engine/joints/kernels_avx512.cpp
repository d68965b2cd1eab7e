#define ERBS_ISA avx512
#include "engine/joints/kernels.inc"
