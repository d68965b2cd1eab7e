// Measures of pictures of a moving structure: motion between two, silhouettes, and the direction of motion.
#pragma once
#include <cstdint>
#include <vector>

#include "render/image/image.h"

namespace erbs::render {

struct Gray {
  int width = 0, height = 0;
  std::vector<float> v;  // brightness 0..255, rows from the top [height*width]
};
Gray gray_of(const Image& image);

// Means over squares of `factor` pixels a side; what does not fill a square at the right and at the bottom is cut.
Image reduced(const Image& image, int factor);

double mean_difference(const Gray& a, const Gray& b);  // of brightness, 0..255

// By how much the same of each square of 8 pixels a side exceeds that of most squares, which is noise; rows from the top. What does not
// fill a square is left out.
std::vector<float> changes_of_squares(const Gray& a, const Gray& b);

// A picture whose rows each have the median colour of that row: the background of a frame in which the structure fills less than half of
// every row.
Image row_medians(const Image& image);

using Mask = std::vector<std::uint8_t>;  // 1: structure [height*width]
// Pixels that differ from the background by more than `threshold` in a channel.
Mask silhouette(const Image& image, const Image& background, int threshold = 30);
double overlap(const Mask& a, const Mask& b);  // intersection over union; 1 if both are empty

// Motion between two pictures: the mean over the squares that move, in pixels. `moving`: their share.
struct Flow {
  double x = 0, y = 0;  // px, to the right and upwards
  double moving = 0;
};
// Block matching: squares of 16 pixels, whole pixels up to 8 away, least sum of absolute differences. A square that changed by less than
// 3/255 is at rest, and so is one whose best match betters its own place by less than a tenth: texture alone decides there.
Flow flow_between(const Gray& before, const Gray& after);

// deg between two motions; NaN where one of them moves less than a tenth of a pixel.
double angle_between(const Flow& a, const Flow& b);

}  // namespace erbs::render
