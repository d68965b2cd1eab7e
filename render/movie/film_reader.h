// Frames of a film, by ffmpeg through a pipe of raw pictures, or of a folder of PNG files.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "engine/base/system/process.h"
#include "render/image/image.h"

namespace erbs::render {

class FilmReader {
 public:
  // `fps`: pictures a second of a folder; a film knows its own. Error if ffmpeg is missing or cannot read the film, or the folder holds no
  // two PNG files.
  FilmReader(std::string path, double fps);
  ~FilmReader();
  FilmReader(const FilmReader&) = delete;
  FilmReader& operator=(const FilmReader&) = delete;

  int width() const { return width_; }
  int height() const { return height_; }
  double fps() const { return fps_; }
  std::optional<Image> next();  // none after the last frame; a film that breaks off ends there
  void rewind();                // to the first frame
  std::size_t read() const { return read_; }

 private:
  void stop();
  std::string path_;
  std::vector<std::string> pictures_;  // of a folder, in the order of their names
  int width_ = 0, height_ = 0;
  double fps_ = 0;
  std::size_t read_ = 0;
  Child ffmpeg_;
};

}  // namespace erbs::render
