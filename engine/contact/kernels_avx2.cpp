#define ERBS_ISA avx2
#include "engine/contact/kernels.inc"
