// Three films of two pictures each: side by side, blended, and their difference, with one clock.
#pragma once
#include <string>

#include "render/image/text.h"
#include "render/movie/video.h"

namespace erbs::render {

class ComparisonFilms {
 public:
  ComparisonFilms(const std::string& folder, int width, int height, double fps);
  // Of the films, each may be written by a thread of its own. t: s, of the film.
  void add(std::size_t which, const Image& run, const Image& film, double t);
  void end();  // after the last pair: the three are finished at the same time
  void finish();
  static constexpr std::size_t count = 3;

 private:
  void label(Image& image, const std::string& left, const std::string& right, double t) const;
  Video side_, blend_, difference_;
  Font font_;
};

Image side_by_side(const Image& left, const Image& right);
Image blended(const Image& a, const Image& b);
// Grey where both agree, orange where the first is brighter, blue where the second one is.
Image difference_of(const Image& a, const Image& b);

}  // namespace erbs::render
