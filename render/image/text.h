// Text and simple shapes on a picture. The CPU draws them, so that their pixels do not depend on OpenGL.
#pragma once
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "render/image/image.h"

namespace erbs::render {

struct Ink {
  std::uint8_t r = 0, g = 0, b = 0;
  double opacity = 1;  // 0..1
};

void fill_box(Image& image, double x0, double y0, double x1, double y1, Ink ink);  // edges antialiased
// A box whose opacity changes from that of `ink` at its top edge (y0) to `end` at its bottom edge.
void fill_fade(Image& image, int y0, int y1, Ink ink, double end);

// A straight stroke with round ends, `width` pixels wide.
void draw_line(Image& image, double x0, double y0, double x1, double y1, double width, Ink ink);

class Font {
 public:
  enum class Face { regular, bold };
  explicit Font(Face face);  // DejaVu Sans; Error if it is not installed
  ~Font();
  enum class Align { left, right, middle };
  // y is the base line; size is the height of an em in pixels. Text is UTF-8.
  void draw(Image& image, const std::string& text, double x, double y, double size, Ink ink, Align align = Align::left) const;
  double width(const std::string& text, double size) const;

 private:
  struct Loaded;
  std::unique_ptr<Loaded> loaded_;
};

}  // namespace erbs::render
