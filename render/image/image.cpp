#include "render/image/image.h"

#include <png.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "engine/base/error.h"

namespace erbs::render {

// libpng's simplified interface cannot select the filter. No filter and level 3 take a third of its time, and give smaller files for our
// pictures; level 4 takes 1.4 times as long for 6 % less.
void write_png(const std::string& path, const Image& image, const Texts& texts) {
  const std::string beside = path + ".tmp";  // renamed once complete
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(beside.c_str(), "wb"), std::fclose);
  if (!file)
    throw WriteError(fmt::format("the picture cannot be created: {}; does the folder exist and may you write there?", std::strerror(errno)),
                     {path, 0});
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  std::vector<png_bytep> rows(static_cast<std::size_t>(image.height));
  for (int y = 0; y < image.height; ++y) rows[static_cast<std::size_t>(y)] = const_cast<png_bytep>(image.pixel(0, y));
  std::vector<png_text_struct> chunks;
  for (const auto& [keyword, text] : texts) {
    png_text_struct& chunk = chunks.emplace_back();
    chunk.compression = PNG_ITXT_COMPRESSION_NONE;
    chunk.key = const_cast<char*>(keyword.c_str()), chunk.text = const_cast<char*>(text.c_str());
  }
  if (setjmp(png_jmpbuf(png))) {
    png_destroy_write_struct(&png, &info);
    std::remove(beside.c_str());
    throw WriteError("the picture cannot be written; is the disk full?", {path, 0});
  }
  png_init_io(png, file.get());
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8,
               image.channels == 4 ? PNG_COLOR_TYPE_RGBA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
  png_set_compression_level(png, 3);
  png_set_text(png, info, chunks.data(), static_cast<int>(chunks.size()));
  png_set_rows(png, info, rows.data());
  png_write_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
  png_destroy_write_struct(&png, &info);
  if (std::fclose(file.release()) != 0 || std::rename(beside.c_str(), path.c_str()) != 0) {
    std::remove(beside.c_str());
    throw WriteError("the picture cannot be written; is the disk full?", {path, 0});
  }
}

Image read_png(const std::string& path) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_file(&header, path.c_str())) throw Error("is no readable PNG picture", {path, 0});
  const bool alpha = header.format & PNG_FORMAT_FLAG_ALPHA;
  header.format = alpha ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
  Image image(static_cast<int>(header.width), static_cast<int>(header.height), alpha ? 4 : 3);
  if (!png_image_finish_read(&header, nullptr, image.rgb.data(), 0, nullptr)) throw Error("is a damaged PNG picture", {path, 0});
  return image;
}

std::string png_text(const std::string& path, const std::string& keyword) {
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) throw Error("is no readable PNG picture", {path, 0});
  png_structp png = png_create_read_struct(
      PNG_LIBPNG_VER_STRING, nullptr, [](png_structp p, png_const_charp) { png_longjmp(p, 1); }, [](png_structp, png_const_charp) {});
  png_infop info = png_create_info_struct(png);
  std::string found;
  if (setjmp(png_jmpbuf(png))) {
    png_destroy_read_struct(&png, &info, nullptr);
    throw Error("is a damaged PNG picture", {path, 0});
  }
  png_init_io(png, file.get());
  png_read_info(png, info);  // up to the pixels; texts stand before them
  png_textp texts = nullptr;
  const int count = png_get_text(png, info, &texts, nullptr);
  for (int i = 0; i < count; ++i)
    if (keyword == texts[i].key) found = texts[i].text;
  png_destroy_read_struct(&png, &info, nullptr);
  return found;
}

}  // namespace erbs::render
