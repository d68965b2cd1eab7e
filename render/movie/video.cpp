#include "render/movie/video.h"

#include <filesystem>
#include <utility>

#include "engine/base/error.h"

namespace erbs::render {
namespace {

// As H.264 keeps it: all brightness, then a fourth of both colour differences, each the mean of 2 x 2 pixels; BT.709, narrow range. Here it
// takes less than half of the time of ffmpeg's conversion, and half of the bytes go through the pipe.
void to_yuv420(const Image& image, std::vector<std::uint8_t>& out) {
  const int w = image.width, h = image.height;
  const auto pixels = static_cast<std::size_t>(w) * static_cast<std::size_t>(h);
  out.resize(pixels + pixels / 2);
  std::uint8_t *y = out.data(), *cb = y + pixels, *cr = cb + pixels / 4;
  for (int row = 0; row < h; row += 2) {
    for (int k = 0; k < 2; ++k) {
      const std::uint8_t* p = image.pixel(0, row + k);
      for (int x = 0; x < w; ++x, p += 3) *y++ = static_cast<std::uint8_t>((11966 * p[0] + 40254 * p[1] + 4064 * p[2] + (33 << 15)) >> 16);
    }
    const std::uint8_t *p = image.pixel(0, row), *q = image.pixel(0, row + 1);
    for (int x = 0; x < w; x += 2, p += 6, q += 6) {
      const int r = p[0] + p[3] + q[0] + q[3], g = p[1] + p[4] + q[1] + q[4], b = p[2] + p[5] + q[2] + q[5];
      *cb++ = static_cast<std::uint8_t>((-6596 * r - 22189 * g + 28785 * b + (257 << 17)) >> 18);
      *cr++ = static_cast<std::uint8_t>((28785 * r - 26145 * g - 2640 * b + (257 << 17)) >> 18);
    }
  }
}

}  // namespace

void check_video_size(int width, int height) {
  if (width % 2 || height % 2)
    throw Error(
        fmt::format("a video of {}x{} cannot be made; width and height must be even; ask for another --size, for --no-video or for --webp",
                    width, height));
}

Video::Video(std::string path, int width, int height, double fps, int channels) : path_(std::move(path)), unfinished_(path_ + ".part") {
  const bool webp = path_.ends_with(".webp");
  as_yuv_ = !webp && channels == 3;
  if (!webp) check_video_size(width, height);
  const std::string size = fmt::format("{}x{}", width, height), rate = fmt::format("{:g}", fps);
  std::vector<std::string> words{"ffmpeg",    "-y",       "-nostdin",
                                 "-loglevel", "error",    "-f",
                                 "rawvideo",  "-pix_fmt", as_yuv_ ? "yuv420p" : channels == 4 ? "rgba" : "rgb24",
                                 "-s",        size,       "-r",
                                 rate,        "-i",       "pipe:0",
                                 "-an"};
  // x264's veryfast at 18 gives the SSIM of medium at 20, .9937 over 75 frames of the METU house at 1280 x 720, in 19 ms of a core a frame
  // instead of 44, which the drawing processes lack; the file is a fifth larger.
  const std::vector<std::string> mp4{"-vf",
                                     as_yuv_ ? "null" : "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p",
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
  if (as_yuv_) to_yuv420(image, yuv_);
  if (const std::vector<std::uint8_t>& bytes = as_yuv_ ? yuv_ : image.rgb; !send(ffmpeg_.to, bytes.data(), bytes.size()))
    throw Error("ffmpeg has given up (see its message above); is the disk full? --no-video gives pictures alone", {path_, 0});
}

void Video::end() { end_input(ffmpeg_); }

void Video::finish() {
  if (const int code = erbs::finish(ffmpeg_); code != 0)
    throw Error(fmt::format("ffmpeg ended with code {}; --no-video gives pictures alone", code), {path_, 0});
  std::filesystem::rename(unfinished_, path_);
}

}  // namespace erbs::render
