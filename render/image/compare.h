// Similarity of two pictures.
#pragma once
#include "render/image/image.h"

namespace erbs::render {

struct Difference {
  double failed_fraction = 1;  // share of pixels that differ by more than 4/255 in a channel
  double ssim = 0;             // mean structural similarity of brightness over windows of 8 x 8 pixels; 1 means equal
  bool same_size = false;
  // Drivers and processors round differently: up to 1 % of the pixels may differ visibly.
  bool alike() const { return same_size && failed_fraction <= 0.01 && ssim >= 0.98; }
};
Difference compare(const Image& a, const Image& b);
double ssim(const Image& a, const Image& b);  // of pictures of one size; 0 below 8 x 8 pixels

// The first picture in pale grey; pixels that differ by more than 4/255 in red, the deeper the more. Both of one size.
Image difference_picture(const Image& a, const Image& b);

}  // namespace erbs::render
