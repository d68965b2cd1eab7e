// The largest eigenvalue of a symmetric matrix, made once: the compiler takes half a minute for the decomposition.
#pragma once
#include "engine/base/vec.h"

namespace erbs {

double largest_eigenvalue(const Mat6& symmetric);

}  // namespace erbs
