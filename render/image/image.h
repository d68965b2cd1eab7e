// A picture in memory, and its PNG file. Only image.cpp includes libpng.
#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace erbs::render {

struct Image {
  int width = 0, height = 0, channels = 3;  // channels: red, green, blue, and perhaps opacity
  std::vector<std::uint8_t> rgb;            // rows from the top [height*width*channels]
  Image() = default;
  Image(int w, int h, int c = 3)
      : width(w), height(h), channels(c), rgb(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * static_cast<std::size_t>(c)) {}
  std::uint8_t* pixel(int x, int y) {
    return &rgb[static_cast<std::size_t>(channels) *
                (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x))];
  }
  const std::uint8_t* pixel(int x, int y) const { return const_cast<Image*>(this)->pixel(x, y); }
};

using Texts = std::vector<std::pair<std::string, std::string>>;  // keyword (ASCII, at most 79 letters) and UTF-8 text
void write_png(const std::string& path, const Image& image, const Texts& texts = {});
Image read_png(const std::string& path);
std::string png_text(const std::string& path, const std::string& keyword);  // "" where the picture has none

}  // namespace erbs::render
