// A picture in memory, and its PNG file. Only image.cpp includes libpng.
#pragma once
#include <cstdint>
#include <string>
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

void write_png(const std::string& path, const Image& image);
Image read_png(const std::string& path);

}  // namespace erbs::render
