#include "render/movie/movie.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <thread>

#include "engine/base/error.h"
#include "engine/base/system/affinity.h"
#include "engine/base/system/process.h"
#include "engine/base/text.h"
#include "engine/record/format/json.h"
#include "render/draw/marks_picture.h"
#include "render/draw/overlay.h"
#include "render/image/compare.h"
#include "render/movie/scenery.h"
#include "render/movie/video.h"
#include "render/movie/workers.h"

namespace erbs::render {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Output paths of one camera.
struct Files {
  fs::path frames;
  std::string stem, video;
  bool stills;
  int decimals = 3;  // of the times of stills in their names
  std::string picture(std::size_t index, double t) const {
    return (frames / (stills ? fmt::format("{}_t{:.{}f}s.png", stem, t, decimals) : fmt::format("{}_{:05}.png", stem, index + 1))).string();
  }
};

// Decimals that tell different times apart.
int decimals_of(std::vector<double> times) {
  std::ranges::sort(times);
  int decimals = 3;
  for (std::size_t i = 1; i < times.size(); ++i)
    while (decimals < 9 && fmt::format("{:.{}f}", times[i], decimals) == fmt::format("{:.{}f}", times[i - 1], decimals)) ++decimals;
  return decimals;
}

// Error if an output exists, unless --force allows it.
Files files_of(const Run& run, const Movie& movie, const std::string& camera, const Schedule& schedule) {
  const fs::path dir(run.dir);
  Files files{dir / "frames", file_stem(camera), "", !movie.stills.empty()};
  if (files.stills) files.decimals = decimals_of(schedule.times);
  if (movie.video && movie.stills.empty())
    files.video = (dir / fmt::format("{}_{}.{}", file_stem(run.name), files.stem, movie.webp ? "webp" : "mp4")).string();
  for (const std::string& path : {files.video, files.picture(0, schedule.times.front())})
    if (!movie.force && !path.empty() && fs::exists(path)) throw Error("it exists already; --force writes it anew", {path, 0});
  return files;
}

// Removes the pictures of an earlier and perhaps longer movie.
void prepare_folder(const Files& files) {
  std::error_code failed;
  fs::create_directories(files.frames, failed);
  if (failed) throw Error("the folder cannot be made; may you write there?", {files.frames.string(), 0});
  if (!files.stills)
    for (std::size_t i = 0; fs::remove(files.picture(i, 0), failed); ++i) {}
}

// The cameras of a film side by side, each in a tile of the picture; one tile where there is one camera.
struct Tiles {
  std::vector<Shot> shots;
  int columns = 1, rows = 1;
  Look look;                    // of a tile
  std::vector<Marks> marks;     // of each picture; empty: none
  std::vector<Impact> impacts;  // that raise dust
  double top = 0;               // px above the tiles
  bool split() const { return columns * rows > 1; }
  std::pair<int, int> corner(std::size_t k) const {  // px, of a tile: left, top
    const int column = static_cast<int>(k) % columns, row = static_cast<int>(k) / columns;
    return {column * look.width, static_cast<int>(top) + row * look.height};
  }
  // px, row below which the legend has room: in the tile that no camera fills; below the title where there is none.
  double legend_top(double unit) const {
    const auto all = static_cast<std::size_t>(columns * rows);
    return shots.size() < all ? corner(all - 1).second + 8 * unit : below_title * unit;
  }
};

Tiles tiles_of(const Look& whole, std::size_t cameras) {
  Tiles tiles;
  tiles.look = whole;
  if (cameras < 2) return tiles;
  tiles.columns =
      cameras == 2 && whole.height > whole.width ? 1 : static_cast<int>(std::ceil(std::sqrt(static_cast<double>(cameras)) - 1e-9));
  tiles.rows = (static_cast<int>(cameras) + tiles.columns - 1) / tiles.columns;
  tiles.top = std::ceil(whole.top);
  tiles.look.width = whole.width / tiles.columns;
  tiles.look.height = static_cast<int>(whole.height - tiles.top - whole.bottom) / tiles.rows;
  tiles.look.top = tiles.look.bottom = 0;
  tiles.look.unit = overlay_unit(whole.width, whole.height);
  if (tiles.look.width < 64 || tiles.look.height < 64)
    throw Error(fmt::format("--split: {} cameras in {}x{} leave each less than 64 pixels; ask for a larger --size, or fewer cameras",
                            cameras, whole.width, whole.height));
  return tiles;
}

void put(Image& image, const Image& tile, int left, int top) {
  for (int y = 0; y < tile.height; ++y) std::copy_n(tile.pixel(0, y), tile.width * tile.channels, image.pixel(left, top + y));
}

// Tells, in each picture, which run it shows.
constexpr const char* scene_keyword = "Scene";
Texts texts_of(const Run& run) { return {{"Software", "erbs " + run.identity.program}, {scene_keyword, run.identity.text()}}; }

// Drawing of single frames in a process of its own: the picture, its overlay, and its file.
Workers::Draw drawer(const Run& run, const Show& show, const Movie& movie, const Tiles& tiles, const Files& files,
                     const Schedule& schedule) {
  const Look& l = movie.look;
  const double slow = files.stills ? 1 : schedule.slow;
  const auto painter = std::make_shared<Painter>(show, tiles.look, movie.context);
  const auto frame_of_tiles = std::make_shared<Overlay>(run, show, l, "", slow);
  std::vector<std::shared_ptr<Overlay>> overlays;
  for (const Shot& shot : tiles.shots) overlays.push_back(std::make_shared<Overlay>(run, show, tiles.look, shot.camera.name, slow));
  return [=, &files, &run, &show, &tiles](std::size_t index, const MotionFrame& frame) {
    const std::optional<Mat3> level = levelling_at(run, show.stage, l, frame.t);
    const Marks none, &marks = tiles.marks.empty() ? none : tiles.marks[index];
    const Look& of = tiles.look;
    Image image;
    if (tiles.split()) {
      image = Image(l.width, l.height, l.background == Background::transparent ? 4 : 3);
      std::fill(image.rgb.begin(), image.rgb.end(), std::uint8_t{252});
    }
    for (std::size_t k = 0; k < tiles.shots.size(); ++k) {
      const Camera camera = tiles.shots[k].at(frame.t);
      Image tile = painter->draw(frame, camera, level, dust_at(tiles.impacts, frame.t));
      const Camera in_the_scene = level ? in_scene(camera, table_position(show.stage, *level)) : camera;
      draw_marks(tile, marks, look(in_the_scene, show.stage, of.width, of.height, of.top, of.bottom), overlay_unit(l.width, l.height));
      const View view = look(camera, show.stage, of.width, of.height, of.top, of.bottom);
      if (!tiles.split()) {
        if (l.overlay) overlays[k]->draw(tile, frame.t, view, marks.legend);
        image = std::move(tile);
        break;
      }
      if (l.overlay) overlays[k]->draw_in_tile(tile, frame.t, view);
      const auto [left, top] = tiles.corner(k);
      put(image, tile, left, top);
      const double thin = 1.5 * l.height / 720;
      fill_box(image, left - thin, top, left + thin, top + tile.height, {252, 252, 252, 1});
      if (k >= static_cast<std::size_t>(tiles.columns))
        fill_box(image, left, top - thin, left + tile.width, top + thin, {252, 252, 252, 1});
    }
    if (tiles.split() && l.overlay)
      frame_of_tiles->draw_around_tiles(image, frame.t, marks.legend, tiles.legend_top(overlay_unit(l.width, l.height)));
    write_png(files.picture(index, frame.t), image, texts_of(run));
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
  write_png(file("_actual.png"), actual, texts_of(run));
  const bool stored = fs::exists(expected);
  Difference difference;
  std::string stored_scene;
  if (stored) {
    const Image wanted = read_png(expected);
    stored_scene = png_text(expected, scene_keyword);
    difference = compare(actual, wanted);
    write_png(file("_expected.png"), wanted);
    if (difference.same_size) write_png(file("_difference.png"), difference_picture(actual, wanted));
  }
  write_json(file(".json"), {{"stored", stored},
                             {"same_size", difference.same_size},
                             {"failed_fraction", difference.failed_fraction},
                             {"ssim", difference.ssim},
                             {"scene", run.identity.text()},
                             {"stored_scene", stored_scene}});
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

// Of the pictures of the tiles that begin with this shot.
std::string name_of(const Shot& first, bool split) { return split ? "split" : first.camera.name; }

bool film(const Run& run, const Show& show, const Scenery& scenery, const Movie& movie, const Tiles& tiles, const Schedule& schedule,
          const std::atomic<bool>& stop) {
  const std::string name = name_of(tiles.shots.front(), tiles.split());
  const Files files = files_of(run, movie, name, schedule);
  prepare_folder(files);
  const std::size_t all = schedule.times.size();
  const auto wish = static_cast<std::size_t>(movie.threads > 0 ? movie.threads : usable_processors());
  const auto start = Clock::now();
  const auto ordered = [&](std::size_t i) { return scenery.drawn(schedule.times[i]); };
  std::size_t made = 0;
  // Started before ffmpeg; otherwise these processes would hold its input open.
  const Image empty(movie.look.width, movie.look.height, movie.look.background == Background::transparent ? 4 : 3);
  Workers workers(std::clamp<std::size_t>(wish, 1, all), empty, ordered(0),
                  [&] { return drawer(run, show, movie, tiles, files, schedule); });
  std::optional<Video> video;
  if (!files.video.empty()) video.emplace(files.video, movie.look.width, movie.look.height, movie.fps, empty.channels);
  {
    Progress progress(movie.quiet);
    workers.draw_in_order(stop ? 0 : all, ordered, [&](std::size_t i, const Image& image) {
      if (video) video->add(image);
      if (!movie.expected.empty()) compare_with(movie.expected, image, run, fs::path(files.picture(i, schedule.times[i])).stem().string());
      made = i + 1;
      progress.tell(name, made, all);
      return !stop;
    });
  }
  if (video && made == all) video->finish();  // a video is complete or absent
  const double wall = since(start);
  if (!movie.quiet)
    fmt::print("{}{} {} ({} {}x{} in {:.1f} s, {:.3f} s each, {} at a time)\n", made == all ? "" : "interrupted; ",
               files.video.empty() || made < all ? "pictures:" : "video:",
               files.video.empty() || made < all ? shown(files.frames.string(), 400) : shown(files.video, 400), counted(made, "frame"),
               movie.look.width, movie.look.height, wall, made ? wall / static_cast<double>(made) : 0, workers.count());
  return made == all;
}

void tell_of_missing_times(const std::pair<double, double>& wish, const std::vector<double>& recorded) {
  const double slack = 1e-6 + (recorded.back() - recorded.front()) / static_cast<double>(recorded.size());
  if (wish.first < recorded.front() - slack || wish.second > recorded.back() + slack)
    tell(stderr,
         fmt::format("warning: --time {:g}:{:g} reaches beyond the run, which has frames from {:g} s to {:g} s; only these are shown",
                     wish.first, wish.second, recorded.front(), recorded.back()));
}

// A run of some milliseconds has one picture in a film of its own speed.
void tell_of_few_pictures(const Movie& movie, const Schedule& schedule, const std::vector<double>& recorded) {
  if (movie.quiet || !movie.stills.empty() || !movie.frames.empty() || schedule.times.size() > 4 || recorded.size() <= 4) return;
  tell(stderr,
       fmt::format("note: {} at {:g} a second are all that {:.3g} s hold; --frames every draws the {} recorded ones, in slow motion",
                   counted(schedule.times.size(), "picture"), movie.fps, recorded.back() - recorded.front(), recorded.size()));
}

}  // namespace

Show show_of(const Run& run, const MotionReader& reader, const Movie& movie, bool sharp) {
  const Excerpt excerpt = without_groups(reader.scene(), {});
  return prepare_show(reader.scene(), run, stage_of(run, reader, excerpt, movie), {}, std::nullopt, sharp);  // it keeps the scene's address
}

bool make_movie(const Run& run, const MotionReader& reader, const Movie& wish, const std::atomic<bool>& stop,
                const std::function<void()>& checked) {
  Movie movie = wish;
  if (movie.video && movie.stills.empty() && !can_start("ffmpeg")) {
    tell(stderr, "warning: a video needs ffmpeg, which is not there: its frames are written without it; install the package ffmpeg");
    movie.video = false;
  }
  if (movie.video && movie.stills.empty() && !movie.webp) check_video_size(movie.look.width, movie.look.height);
  movie.look.top = movie.look.overlay ? overlay_top(movie.look.width, movie.look.height) : 0;
  movie.look.bottom = movie.look.overlay ? overlay_bottom(movie.look.width, movie.look.height, !run.strip().axis.empty()) : 0;
  const Schedule schedule = schedule_of(movie, reader.times());
  tell_of_few_pictures(movie, schedule, reader.times());
  if (movie.range && movie.stills.empty()) tell_of_missing_times(*movie.range, reader.times());
  const std::size_t together = movie.split ? cameras_of(run, movie) : 1;
  Tiles tiles = tiles_of(movie.look, together);
  const Look& l = tiles.look;
  Scenery scenery(run, reader, movie, l.width / (l.height - l.top - l.bottom), schedule.times);
  scenery.check_eyes(schedule.times);
  for (std::size_t k = 0; k < scenery.shots().size(); k += together)
    files_of(run, movie, name_of(scenery.shots()[k], tiles.split()), schedule);
  if (checked) checked();
  const Show show = scenery.show(schedule.times);
  if (movie.marks.any())
    for (const double t : schedule.times) tiles.marks.push_back(scenery.marks(t));
  if (movie.dust) tiles.impacts = scenery.impacts();
  for (std::size_t k = 0; k < scenery.shots().size(); k += together) {
    const auto first = scenery.shots().begin() + static_cast<std::ptrdiff_t>(k);
    tiles.shots.assign(first, first + static_cast<std::ptrdiff_t>(together));
    if (!film(run, show, scenery, movie, tiles, schedule, stop)) return false;
  }
  return true;
}

}  // namespace erbs::render
