#include "render/movie.h"

#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <mutex>
#include <thread>

#include "engine/base/error.h"
#include "render/overlay.h"
#include "render/video.h"

namespace erbs::render {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::vector<Camera> chosen_cameras(const Run& run, const Show& show, const Movie& movie) {
  const Look& l = movie.look;
  const std::vector<Camera> all = run.cameras.empty() ? choose_cameras(show.stage, l.width / (l.height - l.top - l.bottom)) : run.cameras;
  if (movie.cameras.empty()) return {all.front()};
  std::vector<Camera> chosen;
  for (const std::string& name : movie.cameras) {
    const std::size_t before = chosen.size();
    for (const Camera& c : all)
      if (name == "all" || c.name == name) chosen.push_back(c);
    if (chosen.size() > before) continue;
    std::string known;
    for (const Camera& c : all) known += " " + c.name;
    throw Error("--camera " + name + " is none of this run's:" + known + " (or all)");
  }
  return chosen;
}

// Names in files: letters, digits and a few signs; anything else becomes a line.
std::string file_name(std::string name) {
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '-') c = '_';
  return name;
}

// Where everything of one camera goes.
struct Files {
  fs::path frames;
  std::string stem, video;
  bool stills;
  std::string picture(std::size_t index, double t) const {
    return (frames / (stills ? fmt::format("{}_t{:.3f}s.png", stem, t) : fmt::format("{}_{:05}.png", stem, index + 1))).string();
  }
};

// With --force the pictures of an earlier, perhaps longer, movie go; without it nothing is written over.
Files prepare_files(const Run& run, const Movie& movie, const Camera& camera, const Schedule& schedule) {
  const fs::path dir(run.dir);
  Files files{dir / "frames", file_name(camera.name), "", !movie.stills.empty()};
  if (movie.video && movie.stills.empty()) files.video = (dir / fmt::format("{}_{}.mp4", file_name(run.name), files.stem)).string();
  for (const std::string& path : {files.video, files.picture(0, schedule.times.front())})
    if (!movie.force && !path.empty() && fs::exists(path)) throw Error("it exists already; --force writes it anew", {path, 0});
  std::error_code failed;
  fs::create_directories(files.frames, failed);
  if (failed) throw Error("the folder cannot be made; may you write there?", {files.frames.string(), 0});
  if (!files.stills)
    for (std::size_t i = 0; fs::remove(files.picture(i, 0), failed); ++i) {}
  return files;
}

// Threads take frames in turn, each with a context of its own; pictures come out in order.
class Workshop {
 public:
  Workshop(const Show& show, const MotionReader& reader, const Movie& movie, const Overlay& overlay, const Camera& camera,
           const Files& files, const Schedule& schedule, const std::atomic<bool>& stop)
      : show_(show), reader_(reader), movie_(movie), overlay_(overlay), camera_(camera), files_(files), schedule_(schedule), stop_(stop) {
    const auto most = static_cast<unsigned>(schedule.times.size());
    const unsigned wish = movie.threads > 0 ? static_cast<unsigned>(movie.threads) : std::max(1U, std::thread::hardware_concurrency());
    const unsigned count = std::min(wish, most);
    ahead_ = 2 * count + 2;
    for (unsigned i = 0; i < count; ++i) threads_.emplace_back([this] { work(); });
  }
  ~Workshop() {
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
    }
    changed_.notify_all();
    for (std::thread& t : threads_) t.join();
  }
  // The picture of the next frame; nothing where the work was stopped.
  std::optional<Image> next() {
    std::unique_lock lock(mutex_);
    // Ctrl-C does not wake a waiting thread, so it looks up now and then.
    while (!done_.count(wanted_) && !trouble_ && !stop_) changed_.wait_for(lock, std::chrono::milliseconds(200));
    if (trouble_) std::rethrow_exception(trouble_);
    const auto found = done_.find(wanted_);
    if (found == done_.end()) return std::nullopt;
    std::optional<Image> image = std::move(found->second);
    done_.erase(found);
    ++wanted_;
    changed_.notify_all();
    return image;
  }
  std::size_t threads() const { return threads_.size(); }

 private:
  void work() {
    try {
      Painter painter(show_, movie_.look, movie_.context);
      const Look& l = movie_.look;
      const View view = look(camera_, show_.stage, l.width, l.height, l.top, l.bottom);
      for (std::size_t i = take(); i < schedule_.times.size(); i = take()) {
        MotionFrame frame;
        {
          const std::lock_guard lock(reading_);
          frame = frame_at(reader_, schedule_.times[i]);
        }
        Image image = painter.draw(frame, camera_);
        overlay_.draw(image, schedule_.times[i], camera_.name, static_cast<double>(view.pixel * view.target_distance));
        write_png(files_.picture(i, schedule_.times[i]), image);
        const std::lock_guard lock(mutex_);
        done_.emplace(i, std::move(image));
        changed_.notify_all();
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!trouble_) trouble_ = std::current_exception();
      changed_.notify_all();
    }
  }
  // The next frame to draw; past the end when there is none. Waits while the pictures drawn ahead fill the memory.
  std::size_t take() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return ended_ || stop_ || trouble_ || taken_ < wanted_ + ahead_; });
    return ended_ || stop_ || trouble_ ? schedule_.times.size() : taken_++;
  }

  const Show& show_;
  const MotionReader& reader_;
  const Movie& movie_;
  const Overlay& overlay_;
  const Camera& camera_;
  const Files& files_;
  const Schedule& schedule_;
  const std::atomic<bool>& stop_;
  std::mutex mutex_, reading_;
  std::condition_variable changed_;
  std::map<std::size_t, Image> done_;
  std::size_t wanted_ = 0, taken_ = 0, ahead_ = 0;
  bool ended_ = false;
  std::exception_ptr trouble_;
  std::vector<std::thread> threads_;
};

// One line on a terminal, a plain one every ten seconds elsewhere.
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

bool film(const Run& run, const Show& show, const MotionReader& reader, const Movie& movie, const Camera& camera, const Schedule& schedule,
          const std::atomic<bool>& stop) {
  const Files files = prepare_files(run, movie, camera, schedule);
  std::optional<Video> video;
  if (!files.video.empty()) video.emplace(files.video, movie.look.width, movie.look.height, movie.fps);
  const Overlay overlay(run, show, movie.look, files.stills ? 1 : schedule.slow);
  const auto start = Clock::now();
  std::size_t made = 0, threads = 0;
  {
    Workshop workshop(show, reader, movie, overlay, camera, files, schedule, stop);
    Progress progress(movie.quiet);
    threads = workshop.threads();
    for (; made < schedule.times.size(); ++made) {
      const std::optional<Image> image = workshop.next();
      if (!image) break;
      if (video) video->add(*image);
      progress.tell(camera.name, made + 1, schedule.times.size());
    }
  }
  if (video && made > 0) video->finish();
  const double wall = since(start);
  if (!movie.quiet)
    fmt::print("{}: {} frames {}x{} in {:.1f} s ({:.3f} s each, {} threads)\n", files.video.empty() ? files.frames.string() : files.video,
               made, movie.look.width, movie.look.height, wall, made ? wall / static_cast<double>(made) : 0, threads);
  return made == schedule.times.size();
}

}  // namespace

bool make_movie(const Run& run, const MotionReader& reader, const Movie& wish, const std::atomic<bool>& stop) {
  Movie movie = wish;
  movie.look.top = overlay_top(movie.look.height);
  movie.look.bottom = overlay_bottom(movie.look.height, !run.record.axis.empty());
  const Schedule schedule = schedule_of(movie, reader.times());
  std::vector<MotionFrame> some;
  const std::size_t step = std::max<std::size_t>(1, reader.times().size() / 24);
  for (std::size_t i = 0; i < reader.times().size(); i += step) some.push_back(reader.read(static_cast<int>(i)));
  some.push_back(reader.read(static_cast<int>(reader.times().size()) - 1));
  const Show show = prepare_show(reader.scene(), run, some);
  for (const Camera& camera : chosen_cameras(run, show, movie))
    if (!film(run, show, reader, movie, camera, schedule, stop)) return false;
  return true;
}

}  // namespace erbs::render
