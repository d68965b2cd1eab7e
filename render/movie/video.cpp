#include "render/movie/video.h"

#include <filesystem>
#include <utility>

#include "engine/base/error.h"

namespace erbs::render {

Video::Video(std::string path, int width, int height, double fps, int channels) : path_(std::move(path)), unfinished_(path_ + ".part") {
  const bool webp = path_.ends_with(".webp");
  if (!webp && (width % 2 || height % 2))
    throw Error(fmt::format("a video of {}x{} cannot be made; width and height must be even", width, height));
  const std::string size = fmt::format("{}x{}", width, height), rate = fmt::format("{:g}", fps);
  std::vector<std::string> words{
      "ffmpeg", "-y", "-nostdin", "-loglevel", "error", "-f",     "rawvideo", "-pix_fmt", channels == 4 ? "rgba" : "rgb24",
      "-s",     size, "-r",       rate,        "-i",    "pipe:0", "-an"};
  // x264's veryfast at 18 gives the SSIM of medium at 20, .9937 over 75 frames of the METU house at 1280 x 720, in 19 ms of a core a frame
  // instead of 44, which the drawing processes lack; the file is a fifth larger.
  const std::vector<std::string> mp4{"-vf",
                                     "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p",
                                     "-c:v",
                                     "libx264",
                                     "-crf",
                                     "18",
                                     "-preset",
                                     "veryfast",
                                     "-color_primaries",
                                     "bt709",
                                     "-color_trc",
                                     "bt709",
                                     "-colorspace",
                                     "bt709",
                                     "-color_range",
                                     "tv",
                                     "-movflags",
                                     "+faststart",
                                     "-f",
                                     "mp4"};
  const std::vector<std::string> repeated{"-c:v", "libwebp_anim", "-quality", "60", "-compression_level", "5", "-loop", "0", "-f", "webp"};
  for (const std::string& word : webp ? repeated : mp4) words.push_back(word);
  // This name can be neither an option nor a protocol of ffmpeg.
  words.push_back("file:" + std::filesystem::absolute(unfinished_).string());
  ffmpeg_ =
      start(words,
            {.output = "/dev/null", .remedy = "install ffmpeg, or ask for pictures alone with --no-video", .fed = true, .own_group = true});
}

Video::~Video() {
  if (ffmpeg_.pid > 0) erbs::finish(ffmpeg_);
  std::error_code ignored;
  std::filesystem::remove(unfinished_, ignored);
}

void Video::add(const Image& image) {
  if (!send(ffmpeg_.to, image.rgb.data(), image.rgb.size()))
    throw Error("ffmpeg has given up (see its message above); is the disk full? --no-video gives pictures alone", {path_, 0});
}

void Video::end() { end_input(ffmpeg_); }

void Video::finish() {
  if (const int code = erbs::finish(ffmpeg_); code != 0)
    throw Error(fmt::format("ffmpeg ended with code {}; --no-video gives pictures alone", code), {path_, 0});
  std::filesystem::rename(unfinished_, path_);
}

}  // namespace erbs::render
