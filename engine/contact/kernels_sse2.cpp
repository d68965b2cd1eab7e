#define ERBS_ISA sse2
#include "engine/contact/kernels.inc"
