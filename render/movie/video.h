// An MP4 file, or an animated WebP that repeats itself, which ffmpeg makes from raw pictures. The extension of the path decides.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/system/process.h"
#include "render/image/image.h"

namespace erbs::render {

void check_video_size(int width, int height);  // Error if an MP4 cannot have it

class Video {
 public:
  Video(std::string path, int width, int height, double fps, int channels = 3);
  ~Video();  // without finish(), no file remains
  Video(const Video&) = delete;
  Video& operator=(const Video&) = delete;
  void add(const Image& image);
  void end();     // after the last picture: lets ffmpeg finish while other work goes on
  void finish();  // gives the complete file its name

 private:
  std::string path_, unfinished_;
  Child ffmpeg_;
  bool as_yuv_ = false;
  std::vector<std::uint8_t> yuv_;  // of the last picture
};

}  // namespace erbs::render
