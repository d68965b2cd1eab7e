// An MP4 made by the program ffmpeg from raw pictures.
#pragma once
#include <optional>
#include <string>

#include "render/image.h"
#include "render/process.h"

namespace erbs::render {

class Video {
 public:
  Video(std::string path, int width, int height, double fps);
  ~Video();  // without finish() nothing is left behind
  Video(const Video&) = delete;
  Video& operator=(const Video&) = delete;
  void add(const Image& image);
  void finish();  // the file appears under its name when it is whole

 private:
  std::string path_, unfinished_;
  std::optional<Process> ffmpeg_;
};

}  // namespace erbs::render
