#include "render/movie/movie.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <thread>

#include "engine/base/error.h"
#include "engine/base/system/affinity.h"
#include "engine/base/system/process.h"
#include "engine/base/text.h"
#include "render/draw/overlay.h"
#include "render/image/compare.h"
#include "render/movie/video.h"
#include "render/movie/workers.h"

namespace erbs::render {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

Camera own_camera(const Movie& movie, const Stage& stage, double aspect) {
  Camera camera;
  camera.name = "own";
  camera.eye = *movie.eye;
  camera.target = movie.target.value_or(stage.building.center());
  camera.fov = movie.fov * pi / 180;
  const Vec3 back = camera.eye - camera.target;
  if (!(back.norm() > 1e-9)) throw Error("--eye and --target are the same point, so that the camera looks nowhere; move one of them");
  if (back.cross(camera.up).norm() < 1e-6 * back.norm()) camera.up = Vec3(0, 1, 0);
  if (movie.fit) fit_camera(camera, back, stage, aspect);
  return camera;
}

// Output paths of one camera.
struct Files {
  fs::path frames;
  std::string stem, video;
  bool stills;
  std::string picture(std::size_t index, double t) const {
    return (frames / (stills ? fmt::format("{}_t{:.3f}s.png", stem, t) : fmt::format("{}_{:05}.png", stem, index + 1))).string();
  }
};

// With --force, removes the pictures of an earlier and perhaps longer movie. Without it, Error if an output exists.
Files prepare_files(const Run& run, const Movie& movie, const Camera& camera, const Schedule& schedule) {
  const fs::path dir(run.dir);
  Files files{dir / "frames", file_stem(camera.name), "", !movie.stills.empty()};
  if (movie.video && movie.stills.empty())
    files.video = (dir / fmt::format("{}_{}.{}", file_stem(run.name), files.stem, movie.webp ? "webp" : "mp4")).string();
  for (const std::string& path : {files.video, files.picture(0, schedule.times.front())})
    if (!movie.force && !path.empty() && fs::exists(path)) throw Error("it exists already; --force writes it anew", {path, 0});
  std::error_code failed;
  fs::create_directories(files.frames, failed);
  if (failed) throw Error("the folder cannot be made; may you write there?", {files.frames.string(), 0});
  if (!files.stills)
    for (std::size_t i = 0; fs::remove(files.picture(i, 0), failed); ++i) {}
  return files;
}

// Drawing of single frames in a process of its own: the picture, its overlay, and its file.
Workers::Draw drawer(const Run& run, const Show& show, const Movie& movie, const Camera& camera, const Files& files,
                     const Schedule& schedule) {
  const Look& l = movie.look;
  const View view = look(camera, show.stage, l.width, l.height, l.top, l.bottom);
  const auto painter = std::make_shared<Painter>(show, l, movie.context);
  const auto overlay = std::make_shared<Overlay>(run, show, l, camera, view, files.stills ? 1 : schedule.slow);
  return [=, &files, &run](std::size_t index, const MotionFrame& frame) {
    std::optional<Mat3> level;
    if (!run.gravity.empty() && l.table_turns) level = levelling(run.gravity, frame.t);
    Image image = painter->draw(frame, camera, level);
    if (l.overlay) overlay->draw(image, frame.t);
    write_png(files.picture(index, frame.t), image);
    return image;
  };
}

// Leaves DIR/pictures/NAME_{actual,expected,difference}.png and NAME.json, with `stored` false if there is no picture to compare with.
// The JSON is written last.
void compare_with(const std::string& expected, const Image& actual, const Run& run, const std::string& name) {
  const fs::path folder = fs::path(run.dir) / "pictures";
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) throw Error("the folder cannot be made; may you write there?", {folder.string(), 0});
  const auto file = [&](const std::string& ending) { return (folder / (name + ending)).string(); };
  for (const char* old : {"_expected.png", "_difference.png", ".json"}) fs::remove(file(old), failed);
  write_png(file("_actual.png"), actual);
  const bool stored = fs::exists(expected);
  Difference difference;
  if (stored) {
    const Image wanted = read_png(expected);
    difference = compare(actual, wanted);
    write_png(file("_expected.png"), wanted);
    if (difference.same_size) write_png(file("_difference.png"), difference_picture(actual, wanted));
  }
  std::ofstream out(file(".json"));
  out << fmt::format("{{\"stored\": {}, \"same_size\": {}, \"failed_fraction\": {}, \"ssim\": {}}}\n", stored, difference.same_size,
                     difference.failed_fraction, difference.ssim);
  if (!out.flush()) throw WriteError("the comparison cannot be written; is the disk full?", {file(".json"), 0});
}

// Progress as one updated line on a terminal, otherwise as a new line every ten seconds.
class Progress {
 public:
  explicit Progress(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO)) {}
  void tell(const std::string& camera, std::size_t frame, std::size_t all) {
    if (quiet_ || since(last_) < (terminal_ ? 0.2 : 10)) return;
    last_ = Clock::now();
    const double rate = static_cast<double>(frame) / since(start_);
    fmt::print(stderr, "{}{}: frame {} of {}, {:.1f} a second, {:.0f} s left{}", terminal_ ? "\r" : "", camera, frame, all, rate,
               static_cast<double>(all - frame) / rate, terminal_ ? "  " : "\n");
    std::fflush(stderr);
    shown_ = terminal_;
  }
  ~Progress() {
    if (shown_) fmt::print(stderr, "\r{:70}\r", "");
  }

 private:
  bool quiet_, terminal_, shown_ = false;
  Clock::time_point start_ = Clock::now(), last_ = start_;
};

// bodies: of the whole scene, where energies are shown.
MotionFrame frame_to_draw(const MotionReader& reader, const Excerpt& excerpt, const std::vector<Body>& bodies, const Movie& movie,
                          double t) {
  MotionFrame frame = frame_at(reader, t);
  frame.t = t;
  if (movie.look.coloring == Coloring::speed) derive_speeds(reader, frame);
  if (movie.look.coloring == Coloring::energy) derive_energies(reader, bodies, frame);
  if (is_stress(movie.look.coloring)) derive_stresses(reader, movie.look.coloring == Coloring::shear_stress, frame);
  frame = excerpt_of(excerpt, std::move(frame));
  magnify(excerpt.scene, movie.look.magnify, frame);
  return frame;
}

bool film(const Run& run, const Show& show, const std::function<MotionFrame(double)>& frame_of, const Movie& movie, const Camera& camera,
          const Schedule& schedule, const std::atomic<bool>& stop) {
  const Files files = prepare_files(run, movie, camera, schedule);
  const std::size_t all = schedule.times.size();
  const auto wish = static_cast<std::size_t>(movie.threads > 0 ? movie.threads : usable_processors());
  const auto start = Clock::now();
  const auto ordered = [&](std::size_t i) { return frame_of(schedule.times[i]); };
  std::size_t made = 0;
  // Started before ffmpeg; otherwise these processes would hold its input open.
  const Image empty(movie.look.width, movie.look.height, movie.look.background == Background::transparent ? 4 : 3);
  Workers workers(std::clamp<std::size_t>(wish, 1, all), empty, ordered(0),
                  [&] { return drawer(run, show, movie, camera, files, schedule); });
  std::optional<Video> video;
  if (!files.video.empty()) video.emplace(files.video, movie.look.width, movie.look.height, movie.fps, empty.channels);
  {
    Progress progress(movie.quiet);
    for (std::size_t i = 0; i < workers.count(); ++i) workers.order(i, i, ordered(i));
    for (; made < all && !stop; ++made) {
      const std::size_t worker = made % workers.count(), next = made + workers.count();
      const Image image = workers.collect(worker);
      if (next < all) workers.order(worker, next, ordered(next));
      if (video) video->add(image);
      if (!movie.expected.empty())
        compare_with(movie.expected, image, run, fs::path(files.picture(made, schedule.times[made])).stem().string());
      progress.tell(camera.name, made + 1, all);
    }
  }
  if (video && made == all) video->finish();  // a video is complete or absent
  const double wall = since(start);
  if (!movie.quiet)
    fmt::print("{}{} {} ({} frames {}x{} in {:.1f} s, {:.3f} s each, {} at a time)\n", made == all ? "" : "interrupted; ",
               files.video.empty() || made < all ? "pictures:" : "video:",
               files.video.empty() || made < all ? shown(files.frames.string(), 400) : shown(files.video, 400), made, movie.look.width,
               movie.look.height, wall, made ? wall / static_cast<double>(made) : 0, workers.count());
  return made == all;
}

// The stage of what is drawn, from frames spread over the run.
Stage stage_of(const Run& run, const MotionReader& reader, const Excerpt& excerpt, const Movie& movie) {
  std::vector<MotionFrame> some;
  const std::size_t count = reader.times().size(), step = std::max<std::size_t>(1, count / 24);
  const auto add = [&](std::size_t i) {
    some.push_back(excerpt_of(excerpt, reader.read(static_cast<int>(i))));
    magnify(excerpt.scene, movie.look.magnify, some.back());
  };
  for (std::size_t i = 0; i < count; i += step) add(i);
  add(count - 1);
  Stage stage = set_stage(excerpt.scene, some);
  if (!run.gravity.empty() && movie.look.table_turns)
    for (const MotionFrame& frame : some) stage.positions.push_back(table_position(stage, levelling(run.gravity, frame.t)));
  return stage;
}

// What lies behind the section for this camera.
double side_behind(const Section& section, const Camera& camera) { return camera.eye[section.axis] < section.at ? 1 : -1; }

}  // namespace

std::vector<Camera> chosen_cameras(const Run& run, const Stage& stage, const Movie& movie) {
  const Look& l = movie.look;
  const double aspect = l.width / (l.height - l.top - l.bottom);
  if (movie.camera) return {*movie.camera};
  if (movie.eye) return {own_camera(movie, stage, aspect)};
  std::vector<Camera> all = run.cameras.empty() ? choose_cameras(stage, aspect) : run.cameras;
  if (movie.cameras.empty()) return {all.front()};
  const std::size_t own = all.size();
  for (const Camera& one : elevations(stage, aspect)) all.push_back(one);
  std::vector<Camera> chosen;
  for (const std::string& name : movie.cameras) {
    const std::size_t before = chosen.size();
    for (std::size_t i = 0; i < all.size(); ++i)
      if ((name == "all" && i < own) || all[i].name == name) chosen.push_back(all[i]);
    if (chosen.size() > before) continue;
    std::string known;
    for (const Camera& c : all) known += " " + c.name;
    throw Error("--camera " + shown(name, 60) + " is none of this run's:" + known + " (or all)");
  }
  return chosen;
}

Show show_of(const Run& run, const MotionReader& reader, const Movie& movie) {
  const Excerpt excerpt = without_groups(reader.scene(), {});
  return prepare_show(reader.scene(), run, stage_of(run, reader, excerpt, movie), {}, std::nullopt);  // it keeps the scene's address
}

bool make_movie(const Run& run, const MotionReader& reader, const Movie& wish, const std::atomic<bool>& stop) {
  Movie movie = wish;
  if (movie.video && movie.stills.empty() && !can_start("ffmpeg")) {
    tell(stderr, "warning: a video needs ffmpeg, which is not there: its frames are written without it; install the package ffmpeg");
    movie.video = false;
  }
  movie.look.top = movie.look.overlay ? overlay_top(movie.look.height) : 0;
  movie.look.bottom = movie.look.overlay ? overlay_bottom(movie.look.height, !run.strip().axis.empty()) : 0;
  const Schedule schedule = schedule_of(movie, reader.times());
  const Excerpt excerpt = without_groups(reader.scene(), movie.hide);
  const Coloring coloring = movie.look.coloring;
  const std::vector<Body> bodies = coloring == Coloring::energy ? bodies_of(reader.scene(), run) : std::vector<Body>();
  const auto frame_of = [&](double t) { return frame_to_draw(reader, excerpt, bodies, movie, t); };
  const Stage stage = stage_of(run, reader, excerpt, movie);
  const std::vector<Camera> cameras = chosen_cameras(run, stage, movie);
  if (movie.section && movie.section->keep == 0) movie.section->keep = side_behind(*movie.section, cameras.front());
  Show show = prepare_show(excerpt.scene, run, stage, in_groups(excerpt.scene, movie.ghost, "--ghost"), movie.section);
  std::vector<MotionFrame> some;  // the scale is that of what is shown
  const std::size_t stride = std::max<std::size_t>(1, schedule.times.size() / 24);
  if (is_quantity(coloring))
    for (std::size_t i = 0; i < schedule.times.size(); i += stride) some.push_back(frame_of(schedule.times[i]));
  show.scale = color_scale(excerpt.scene, some, coloring);
  for (const Camera& camera : cameras)
    if (!film(run, show, frame_of, movie, camera, schedule, stop)) return false;
  return true;
}

}  // namespace erbs::render
