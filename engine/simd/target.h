// The instruction set that a file is compiled for. Kernels are compiled once for each (CMakeLists.txt) and chosen when the program
// starts; all inline code they share lives in `namespace erbs::ERBS_TARGET`, so that no function compiled with wider instructions is
// ever linked into code meant for any machine. A kernel therefore reads plain data and headers of that namespace, nothing of Eigen.
#pragma once

#ifndef ERBS_TARGET
#define ERBS_TARGET scalar  // ordinary files: the same templates on plain numbers
#define ERBS_HOST           // parts of a header that kernels must not see
#endif

#define ERBS_INLINE inline __attribute__((always_inline))

#define ERBS_TEXT_OF(x) #x
#define ERBS_TEXT(x) ERBS_TEXT_OF(x)
#define ERBS_TARGET_NAME ERBS_TEXT(ERBS_TARGET)
