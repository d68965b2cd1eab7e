#include "render/compare/compare_film.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>

#include "engine/base/error.h"
#include "engine/base/system/affinity.h"
#include "render/compare/films.h"
#include "render/image/compare.h"
#include "render/movie/film_reader.h"
#include "render/movie/scenery.h"
#include "render/movie/workers.h"

namespace erbs::render {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int signal_width = 320, measured_width = 640;  // px

int reduction_to(int width, int most) { return std::max(1, (width + most - 1) / most); }

// Draws the run from one camera at given times, in order, by several processes.
struct RunDrawer {
  const Run& run;
  const MotionReader& reader;
  Movie movie;
  Show show;
  Camera camera;
  int width = 0, height = 0;

  // The picture without the blocks that move: they lie far below the ground.
  MotionFrame frame_of(double t, bool empty = false) const {
    MotionFrame frame = frame_at(reader, t);
    frame.t = t;
    magnify(reader.scene(), movie.look.magnify, frame);
    if (empty)
      for (std::size_t b = 0; b < reader.scene().blocks.size(); ++b)
        if (!reader.scene().blocks[b].fixed) frame.poses[7 * b + 2] -= 1e4f;
    return frame;
  }

  Workers start(std::size_t most) const {
    Look sized = movie.look;
    sized.width = width, sized.height = height;
    const auto prepare = [this, sized]() -> Workers::Draw {
      const auto painter = std::make_shared<Painter>(show, sized, movie.context);
      return [this, painter](std::size_t, const MotionFrame& frame) {
        return painter->draw(frame, camera, levelling_at(run, show.stage, movie.look, frame.t));
      };
    };
    const auto wish = std::size_t(movie.threads > 0 ? movie.threads : usable_processors());
    return Workers(std::clamp<std::size_t>(wish, 1, most), Image(width, height), frame_of(reader.times().front()), prepare);
  }

  // Calls take(index, picture); false from it ends the work.
  void draw(Workers& workers, const std::vector<double>& times, const std::function<bool(std::size_t, Image)>& take) const {
    workers.draw_in_order(
        times.size(), [&](std::size_t i) { return frame_of(times[i]); }, take);
  }
};

// Adds the change from the last picture to this one, over `step` s that end at t.
struct SignalMeter {
  MotionSignal signal;
  Gray last;
  void add(const Image& image, double t, double step) {
    Gray now = gray_of(image);
    if (!last.v.empty()) {
      signal.t.push_back(t - 0.5 * step), signal.y.push_back(mean_difference(last, now) / step);
      signal.where.push_back(changes_of_squares(last, now));
    }
    last = std::move(now);
  }
};

// The pictures of a film, which is read once as far as they fit into this memory; the rest of a longer one is read again.
class FilmPictures {
 public:
  FilmPictures(FilmReader& film, int reduction) : film_(film), reduction_(reduction) { film.rewind(reduction); }
  std::optional<Image> at(std::size_t index) {  // none after the last one
    if (index < kept_.size()) return kept_[index];
    if (index < film_.read()) film_.rewind(reduction_);
    while (film_.read() < index)
      if (!film_.next()) return std::nullopt;
    std::optional<Image> image = film_.next();
    if (image && index == kept_.size() && (index + 1) * image->rgb.size() <= most_bytes) kept_.push_back(*image);
    return image;
  }
  int width() const { return film_.width() / reduction_; }  // px

 private:
  static constexpr std::size_t most_bytes = 300'000'000;
  FilmReader& film_;
  int reduction_;
  std::vector<Image> kept_;  // the first ones
};

MotionSignal signal_of_film(FilmPictures& film, const std::string& path, double step, const std::atomic<bool>& stop) {
  SignalMeter meter;
  const int factor = reduction_to(film.width(), signal_width);
  std::optional<Image> image;
  for (std::size_t i = 0; !stop && (image = film.at(i)); ++i) meter.add(reduced(*image, factor), double(i) * step, step);
  if (stop) return meter.signal;
  if (meter.signal.t.size() < 2) throw Error("it has fewer than three pictures that can be read; name a longer film", {path});
  return meter.signal;
}

MotionSignal signal_of_run(const RunDrawer& drawer, Workers& workers, int factor, double step, const std::atomic<bool>& stop) {
  const std::vector<double>& recorded = drawer.reader.times();
  std::vector<double> times;
  for (double t = recorded.front(); t <= recorded.back() + 1e-9; t += step) times.push_back(t);
  SignalMeter meter;
  drawer.draw(workers, times, [&](std::size_t i, const Image& image) {
    meter.add(reduced(image, factor), times[i], step);
    return !stop;
  });
  return meter.signal;
}

// In the size of the first picture.
Image background_of(const FilmComparison& wish, const FilmReader& film, const Image& first, const Image& drawn) {
  if (wish.background == "rows") return row_medians(first);
  if (wish.background == "drawn") return drawn;
  Image image = read_png(wish.background);
  if (image.width != film.width() || image.height != film.height())
    throw Error(fmt::format("it has {}x{} pixels, the film {}x{}; make both alike", image.width, image.height, film.width(), film.height()),
                {wish.background});
  return reduced(image, film.width() / first.width);
}

// Measures pairs of pictures one after another.
struct Meter {
  int factor;
  Image run_background, film_background;  // reduced
  Gray run_last, film_last;
  Mask run_ever, film_always;
  double film_area = 0;  // px, sum over the pictures
  std::size_t pictures = 0;
  FrameErrors errors(const Image& run, const Image& film, double time) {
    const Image a = reduced(run, factor), b = reduced(film, factor);
    FrameErrors e;
    e.time = time;
    const Mask of_run = silhouette(a, run_background), of_film = silhouette(b, film_background);
    e.overlap = overlap(of_run, of_film);
    add(of_run, of_film);
    e.ssim = ssim(a, b);
    const int further = reduction_to(a.width, signal_width);
    Gray run_now = gray_of(reduced(a, further)), film_now = gray_of(reduced(b, further));
    if (!run_last.v.empty()) {
      e.flow_run = flow_between(run_last, run_now), e.flow_film = flow_between(film_last, film_now);
      e.angle = angle_between(e.flow_run, e.flow_film);
    }
    run_last = std::move(run_now), film_last = std::move(film_now);
    return e;
  }
  void add(const Mask& of_run, const Mask& of_film) {
    if (++pictures == 1) run_ever.assign(of_run.size(), 0), film_always.assign(of_film.size(), 1);
    for (std::size_t i = 0; i < of_run.size(); ++i) run_ever[i] |= of_run[i], film_always[i] &= of_film[i], film_area += of_film[i];
  }
  double standing() const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < film_always.size(); ++i) count += film_always[i] != 0 && run_ever[i] == 0 ? 1 : 0;
    return film_area > 0 ? double(count) * double(pictures) / film_area : 0;
  }
};

// What is done with a pair of pictures, by a thread each, while the next pair is drawn and read: it is measured, and added to each film.
class PairWork {
 public:
  PairWork(Meter& meter, std::vector<FrameErrors>& found, ComparisonFilms& films) : meter_(meter), found_(found), films_(films) {}
  // The last pair must be finished.
  void begin(Image run, Image film, double t) {
    run_ = std::move(run), film_ = std::move(film);
    tasks_.push_back(std::async(std::launch::async, [this, t] { found_.push_back(meter_.errors(run_, film_, t)); }));
    for (std::size_t which = 0; which < ComparisonFilms::count; ++which)
      tasks_.push_back(std::async(std::launch::async, [this, which, t] { films_.add(which, run_, film_, t); }));
  }
  void finish() {
    for (std::future<void>& task : tasks_) task.get();
    tasks_.clear();
  }

 private:
  Meter& meter_;
  std::vector<FrameErrors>& found_;
  ComparisonFilms& films_;
  Image run_, film_;
  std::vector<std::future<void>> tasks_;  // destroyed first, which waits for them
};

// The pictures of the film that lie within the run: index of the first one, and their times in the run.
std::vector<double> times_in_run(const FilmErrors& e, const std::vector<double>& recorded, std::size_t& first) {
  std::vector<double> times;
  for (std::size_t i = 0; i <= e.film.t.size(); ++i) {
    const double t = double(i) / e.fps + e.lag;
    const double slack = known_share / e.fps;
    if (t < recorded.front() - slack || t > recorded.back() + slack) continue;
    if (times.empty()) first = i;
    times.push_back(std::clamp(t, recorded.front(), recorded.back()));
  }
  return times;
}

// `workers` have been ordered the picture without blocks. The films wait for their end.
bool measure(const RunDrawer& drawer, Workers& workers, const FilmReader& film, FilmPictures& pictures, FilmErrors& errors,
             const FilmComparison& wish, std::optional<ComparisonFilms>& films, const std::atomic<bool>& stop) {
  std::size_t first = 0;
  const std::vector<double> times = times_in_run(errors, drawer.reader.times(), first);
  errors.outside = errors.film.t.size() + 1 - times.size();
  if (times.size() < 2)
    throw Error(
        fmt::format("none of its pictures lies within the run, {:g} s to {:g} s, with a lag of {:g} s; give --fps, --slow or --align",
                    drawer.reader.times().front(), drawer.reader.times().back(), errors.lag),
        {wish.film});
  Image empty;
  for (std::size_t w = 0; w < workers.count(); ++w) empty = workers.collect(w);
  const Image background = background_of(wish, film, *pictures.at(0), empty);
  const int factor = reduction_to(drawer.width, measured_width);
  errors.reduction = factor * (film.width() / drawer.width);
  Meter meter{factor, reduced(empty, factor), reduced(background, factor), {}, {}, {}, {}};
  fs::create_directories(wish.place);
  films.emplace(wish.place, drawer.width, drawer.height, drawer.movie.fps);
  PairWork work(meter, errors.frames, *films);
  drawer.draw(workers, times, [&](std::size_t i, Image image) {
    std::optional<Image> picture = pictures.at(first + i);
    work.finish();
    if (!picture || stop) return false;
    work.begin(std::move(image), std::move(*picture), double(first + i) / errors.fps);
    return true;
  });
  work.finish();
  errors.standing = meter.standing();
  return !stop;
}

}  // namespace

bool compare_film(const Run& run, const MotionReader& reader, Movie movie, const FilmComparison& wish, const std::atomic<bool>& stop) {
  const auto start = Clock::now();
  FilmErrors errors;
  FilmReader film(wish.film, movie.fps);
  const int reduction = reduction_to(film.width(), wish.width);
  movie.look.width = film.width() / reduction, movie.look.height = film.height() / reduction, movie.fps = film.fps();
  movie.look.overlay = false;
  errors.fps = movie.fps * movie.slow;
  const double step = 1 / errors.fps;
  Show show = show_of(run, reader, movie);
  const double aspect = static_cast<double>(film.width()) / film.height();
  std::vector<Camera> cameras = chosen_cameras(run, show.stage, movie, aspect);
  if (movie.fit)
    fit_cameras(cameras, run, show.stage, reader.scene(), aspect, reader.times(), [&](double t) {
      MotionFrame frame = frame_at(reader, t);
      magnify(reader.scene(), movie.look.magnify, frame);
      return frame;
    });
  const Camera camera = cameras.front();
  errors.camera = camera.name;
  if (const MotionBlock* block = block_around(camera.eye, reader.scene(), reader.read(0), show.stage.hidden))
    throw Error(inside_text(camera, *block, reader.times().front()) + "; move it out, with --eye x,y,z");
  const RunDrawer drawer{run, reader, movie, std::move(show), camera, movie.look.width, movie.look.height};
  // These processes prepare themselves, and draw the picture without blocks, while the film is read.
  Workers workers = drawer.start(reader.times().size());
  for (std::size_t w = 0; w < workers.count(); ++w) workers.order(w, 0, drawer.frame_of(reader.times().front(), true));
  // Where and when something moves shows in small pictures of sharp blocks without shadows, for a third of the cost. Of a film that erbs
  // render has drawn the same shadows, mortar and cracks move as well; where the sun of another film stood is not known.
  const int factor = reduction * reduction_to(movie.look.width, signal_width);
  FilmPictures pictures(film, reduction);
  const bool alike = wish.background == "drawn";
  RunDrawer coarse{run, reader, movie, show_of(run, reader, movie, !alike), camera, film.width() / factor, film.height() / factor};
  coarse.movie.look.shadow = alike;
  {
    Workers small = coarse.start(reader.times().size());  // before the thread: a copy of a process has one thread only
    auto of_film = std::async(std::launch::async, [&] { return signal_of_film(pictures, wish.film, step, stop); });
    errors.run = signal_of_run(coarse, small, reduction_to(coarse.width, signal_width), step, stop);
    errors.film = of_film.get();
  }
  if (stop) return false;
  // The last picture or two of a whole film may be counted otherwise.
  if (const std::size_t read = errors.film.t.size() + 1; read + 2 < film.promised()) errors.missing = film.promised() - read;
  align_film(errors, wish, movie.slow, reader.times());
  std::optional<ComparisonFilms> films;
  if (!measure(drawer, workers, film, pictures, errors, wish, films, stop)) return false;
  films->end();
  draw_film_errors(errors, wish);  // while ffmpeg ends the films
  films->finish();
  errors.wall = std::chrono::duration<double>(Clock::now() - start).count();
  write_film_errors(errors, wish, movie.quiet);
  return true;
}

}  // namespace erbs::render
