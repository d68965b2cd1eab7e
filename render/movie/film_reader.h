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

  int width() const { return width_; }  // px, of the film
  int height() const { return height_; }
  double fps() const { return fps_; }
  std::optional<Image> next();     // none after the last frame; a film that breaks off ends there
  void rewind(int reduction = 1);  // to the first frame; frames are then means over squares of `reduction` pixels a side
  std::size_t read() const { return read_; }
  std::size_t promised() const { return promised_; }  // how many the head of a film names; 0: unknown

 private:
  void stop();
  std::string path_;
  std::vector<std::string> pictures_;  // of a folder, in the order of their names
  int width_ = 0, height_ = 0, reduction_ = 1;
  double fps_ = 0;
  std::size_t read_ = 0, promised_ = 0;
  Child ffmpeg_;
};

}  // namespace erbs::render
