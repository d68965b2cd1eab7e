#include "render/image/text.h"

#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#include <stb/stb_truetype.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "engine/base/error.h"

namespace erbs::render {
namespace {

std::uint8_t rounded(double level) { return static_cast<std::uint8_t>(level + 0.5); }  // of 0 to 255

void blend(Image& image, int x, int y, Ink ink, double cover) {
  std::uint8_t* pixel = image.pixel(x, y);
  double a = ink.opacity * cover;
  if (image.channels == 4 && a > 0) {  // over what is itself translucent: the share of the ink in the sum of both
    const double below = pixel[3] / 255.0, sum = a + (1 - a) * below;
    a /= sum;
    pixel[3] = rounded(255 * sum);
  }
  const std::uint8_t to[3] = {ink.r, ink.g, ink.b};
  for (int c = 0; c < 3; ++c) pixel[c] = rounded(pixel[c] + a * (to[c] - pixel[c]));
}

double covered(double low, double high, int cell) { return std::clamp(std::min(high, cell + 1.0) - std::max(low, 1.0 * cell), 0.0, 1.0); }

// Code points of UTF-8 text; an invalid byte becomes '?'.
std::vector<int> code_points(const std::string& text) {
  std::vector<int> points;
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const int more = lead < 0x80 ? 0 : lead >= 0xF0 ? 3 : lead >= 0xE0 ? 2 : lead >= 0xC0 ? 1 : -1;
    if (more < 0 || i + static_cast<std::size_t>(more) >= text.size() + (more == 0 ? 1 : 0)) {
      points.push_back('?');
      ++i;
      continue;
    }
    int point = more == 0 ? lead : lead & (0x3F >> more);
    for (int k = 1; k <= more; ++k) point = point << 6 | (static_cast<unsigned char>(text[i + static_cast<std::size_t>(k)]) & 0x3F);
    points.push_back(point);
    i += static_cast<std::size_t>(more) + 1;
  }
  return points;
}

std::vector<unsigned char> load_font(const std::string& name) {
  for (const std::string folder : {"/usr/share/fonts/truetype/dejavu/", "/usr/share/fonts/dejavu/", "/usr/share/fonts/TTF/"}) {
    std::ifstream in(folder + name, std::ios::binary);
    if (in) return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
  throw Error("the font " + name + " is not there; install fonts-dejavu-core");
}

}  // namespace

void fill_box(Image& image, double x0, double y0, double x1, double y1, Ink ink) {
  const int top = std::max(0, static_cast<int>(std::floor(y0))), bottom = std::min(image.height, static_cast<int>(std::ceil(y1)));
  const int left = std::max(0, static_cast<int>(std::floor(x0))), right = std::min(image.width, static_cast<int>(std::ceil(x1)));
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) blend(image, x, y, ink, covered(x0, x1, x) * covered(y0, y1, y));
}

void draw_line(Image& image, double x0, double y0, double x1, double y1, double width, Ink ink) {
  const double half = 0.5 * width, dx = x1 - x0, dy = y1 - y0, squared = std::max(1e-12, dx * dx + dy * dy);
  const int top = std::max(0, static_cast<int>(std::floor(std::min(y0, y1) - half - 1)));
  const int bottom = std::min(image.height, static_cast<int>(std::ceil(std::max(y0, y1) + half + 1)));
  const int left = std::max(0, static_cast<int>(std::floor(std::min(x0, x1) - half - 1)));
  const int right = std::min(image.width, static_cast<int>(std::ceil(std::max(x0, x1) + half + 1)));
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) {
      const double px = x + 0.5 - x0, py = y + 0.5 - y0, along = std::clamp((px * dx + py * dy) / squared, 0.0, 1.0);
      const double away = std::hypot(px - along * dx, py - along * dy);
      if (away < half + 0.5) blend(image, x, y, ink, std::clamp(half + 0.5 - away, 0.0, 1.0));
    }
}

void fill_fade(Image& image, int y0, int y1, Ink ink, double end) {
  for (int y = std::max(0, y0); y < std::min(image.height, y1); ++y) {
    Ink here = ink;
    here.opacity += (end - ink.opacity) * (y + 0.5 - y0) / (y1 - y0);
    for (int x = 0; x < image.width; ++x) blend(image, x, y, here, 1);
  }
}

struct Font::Loaded {
  std::vector<unsigned char> file;
  stbtt_fontinfo info{};
};

Font::Font(Face face) : loaded_(new Loaded) {
  loaded_->file = load_font(face == Face::bold ? "DejaVuSans-Bold.ttf" : "DejaVuSans.ttf");
  if (!stbtt_InitFont(&loaded_->info, loaded_->file.data(), 0)) throw Error("the font DejaVu Sans is damaged; reinstall fonts-dejavu-core");
}
Font::~Font() = default;

double Font::width(const std::string& text, double size) const {
  const float scale = stbtt_ScaleForMappingEmToPixels(&loaded_->info, static_cast<float>(size));
  double sum = 0;
  for (int point : code_points(text)) {
    int advance = 0, bearing = 0;
    stbtt_GetCodepointHMetrics(&loaded_->info, point, &advance, &bearing);
    sum += static_cast<double>(scale) * advance;
  }
  return sum;
}

void Font::draw(Image& image, const std::string& text, double x, double y, double size, Ink ink, Align align) const {
  if (align != Align::left) x -= width(text, size) * (align == Align::middle ? 0.5 : 1.0);
  const float scale = stbtt_ScaleForMappingEmToPixels(&loaded_->info, static_cast<float>(size));
  const int base = static_cast<int>(std::lround(y));
  for (int point : code_points(text)) {
    const double cell = std::floor(x);
    int advance = 0, bearing = 0, w = 0, h = 0, left = 0, top = 0;
    unsigned char* glyph =
        stbtt_GetCodepointBitmapSubpixel(&loaded_->info, scale, scale, static_cast<float>(x - cell), 0, point, &w, &h, &left, &top);
    for (int row = 0; row < h; ++row)
      for (int column = 0; column < w; ++column) {
        const int px = static_cast<int>(cell) + left + column, py = base + top + row;
        if (px >= 0 && py >= 0 && px < image.width && py < image.height) blend(image, px, py, ink, glyph[row * w + column] / 255.0);
      }
    stbtt_FreeBitmap(glyph, nullptr);
    stbtt_GetCodepointHMetrics(&loaded_->info, point, &advance, &bearing);
    x += static_cast<double>(scale) * advance;
  }
}

}  // namespace erbs::render
