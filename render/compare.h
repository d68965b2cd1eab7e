// How alike two pictures are.
#pragma once
#include "render/image.h"

namespace erbs::render {

struct Difference {
  double failed_fraction = 1;  // of pixels that differ by more than 4/255 in a channel
  double ssim = 0;             // mean structural similarity of the brightness over windows of 8 x 8; 1 is equal
  bool same_size = false;
  // Another driver or processor rounds otherwise: up to 1 % of the pixels may differ visibly.
  bool alike() const { return same_size && failed_fraction <= 0.01 && ssim >= 0.98; }
};
Difference compare(const Image& a, const Image& b);

}  // namespace erbs::render
