#include "render/movie/film_reader.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "engine/record/format/json.h"
#include "render/image/measures.h"

namespace erbs::render {
namespace {

namespace fs = std::filesystem;

struct Shape {
  int width = 0, height = 0;
  double fps = 0;
  double duration = 0;  // s; 0: unknown
};

// "30000/1001"
double ratio_of(const std::string& text) {
  const std::size_t slash = text.find('/');
  const double above = std::atof(text.c_str()), below = slash == std::string::npos ? 1 : std::atof(text.c_str() + slash + 1);
  return below > 0 ? above / below : 0;
}

// What ffprobe, a part of ffmpeg, says of the film.
Shape shape_of(const std::string& path) {
  Child probe = start({"ffprobe", "-v", "error", "-select_streams", "v:0", "-show_entries", "stream=width,height,avg_frame_rate,duration",
                       "-of", "json", "file:" + fs::absolute(path).string()},
                      {.errors = "/dev/null", .remedy = "install ffmpeg", .heard = true});
  std::string said;
  for (char c = 0; receive(probe.from, &c, 1);) said += c;
  finish(probe);
  const Json answer = Json::parse(said, nullptr, false);
  const Json* stream = answer.is_discarded() ? nullptr : find_key(answer, "streams.0");
  Shape shape;
  if (stream != nullptr && stream->is_object())
    shape = {stream->value("width", 0), stream->value("height", 0), ratio_of(stream->value("avg_frame_rate", "0")),
             std::atof(stream->value("duration", "0").c_str())};
  if (shape.width < 16 || shape.height < 16 || shape.width > 8192 || shape.height > 8192 || !(shape.fps > 0) || shape.fps > 1e5)
    throw Error("ffmpeg finds no film in it; name a film, a folder of PNG files, a run folder or a CSV file", {path});
  return shape;
}

std::vector<std::string> pictures_in(const std::string& folder) {
  std::vector<std::string> pictures;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().extension() == ".png") pictures.push_back(entry.path().string());
  std::sort(pictures.begin(), pictures.end());
  if (pictures.size() < 2) throw Error("it holds no two PNG files; name a folder of frames, a film, a run folder or a CSV file", {folder});
  return pictures;
}

}  // namespace

FilmReader::FilmReader(std::string path, double fps) : path_(std::move(path)), fps_(fps) {
  if (fs::is_directory(path_)) {
    pictures_ = pictures_in(path_);
    const Image first = read_png(pictures_.front());
    width_ = first.width, height_ = first.height;
    return;
  }
  if (!fs::exists(path_)) throw Error("there is no such file; name a film, a folder of PNG files, a run folder or a CSV file", {path_});
  for (const char* program : {"ffmpeg", "ffprobe"})
    if (!can_start(program))
      throw Error(
          fmt::format("a film needs {}, which is not installed; install the package ffmpeg, or name a folder of PNG files", program),
          {path_});
  const Shape shape = shape_of(path_);
  width_ = shape.width, height_ = shape.height, fps_ = shape.fps;
  promised_ = static_cast<std::size_t>(std::lround(std::clamp(shape.duration * shape.fps, 0.0, 1e9)));
}

FilmReader::~FilmReader() { stop(); }

void FilmReader::stop() {
  if (ffmpeg_.pid <= 0) return;
  stop_hard(ffmpeg_);
  finish(ffmpeg_);
}

void FilmReader::rewind(int reduction) {
  stop();
  read_ = 0;
  reduction_ = reduction;
}

std::optional<Image> FilmReader::next() {
  if (pictures_.empty()) {
    // A film of uneven steps is read at even ones.
    if (read_ == 0 && ffmpeg_.pid <= 0)
      ffmpeg_ = start({"ffmpeg", "-nostdin", "-loglevel", "error", "-noautorotate", "-i", "file:" + fs::absolute(path_).string(), "-vf",
                       fmt::format("fps={:.9g},scale={}:{}:flags=area:in_color_matrix=auto:out_range=pc", fps_, width_ / reduction_,
                                   height_ / reduction_),
                       "-f", "rawvideo", "-pix_fmt", "rgb24", "pipe:1"},
                      {.errors = "/dev/null", .remedy = "install ffmpeg", .heard = true, .own_group = true});
    Image image(width_ / reduction_, height_ / reduction_);
    if (!receive(ffmpeg_.from, image.rgb.data(), image.rgb.size())) return std::nullopt;
    ++read_;
    return image;
  }
  if (read_ >= pictures_.size()) return std::nullopt;
  Image image = read_png(pictures_[read_]);
  if (image.width != width_ || image.height != height_)
    throw Error(fmt::format("it has {}x{} pixels, the first picture {}x{}; make all alike", image.width, image.height, width_, height_),
                {pictures_[read_]});
  ++read_;
  return reduced(image, reduction_);
}

}  // namespace erbs::render
