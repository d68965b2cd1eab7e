#define ERBS_ISA avx512
#include "engine/contact/kernels.inc"
