#include "lua/program/progress.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "engine/base/error.h"
#include "engine/record/format/json.h"

namespace erbs::lua {
namespace {

double seconds(std::chrono::steady_clock::duration d) { return std::chrono::duration<double>(d).count(); }

std::string left_text(double soonest, double latest) {
  constexpr double alike = 1.3;
  if (!(latest > alike * soonest)) return duration_text(latest);
  return duration_text(soonest) + " to " + duration_text(latest);
}

}  // namespace

std::string duration_text(double s) {
  if (!std::isfinite(s)) return "?";
  if (s < 100) return fmt::format("{:.1f} s", s);
  const long whole = std::lround(s);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

bool colors(int file) {
  const char* no = std::getenv("NO_COLOR");
  return isatty(file) != 0 && !(no && *no);
}

ProgressPrinter::ProgressPrinter(bool quiet, bool json)
    : quiet_(quiet), json_(json), terminal_(isatty(STDERR_FILENO) != 0 && !json), begin_(Clock::now()), last_(begin_) {
  due_ = begin_ + std::chrono::milliseconds(terminal_ ? 200 : 10000);
}

ProgressPrinter::~ProgressPrinter() { end(); }

void ProgressPrinter::show(const analysis::Progress& now) {
  if (first_time_ < 0 || (starting_ && !now.starting)) {  // the speed of a run is that after its start
    begin_ = Clock::now();
    first_time_ = last_time_ = now.t;
    first_steps_ = last_steps_ = now.steps;
    last_ = begin_;
  }
  starting_ = now.starting;
  const auto clock = Clock::now();
  if (quiet_ || clock < due_) return;
  due_ = clock + std::chrono::milliseconds(terminal_ ? 200 : 10000);
  if (now.starting) {
    if (json_) fmt::print(stderr, "{}\n", Json{{"start", now.line}, {"wall_s", now.wall}}.dump());
    else fmt::print(stderr, "{}{}{}", terminal_ ? "\r\033[K" : "", now.line, terminal_ ? "" : "\n");
    std::fflush(stderr);
    open_ = terminal_;
    return;
  }
  const double wall = seconds(clock - last_), all = seconds(clock - begin_);
  const double speed = wall > 0 ? (now.t - last_time_) / wall : 0;
  const double rate = wall > 0 ? static_cast<double>(now.steps - last_steps_) / wall : 0;
  // Time left, by the mean speed so far and by the speed of about the last ten seconds, because a collapse slows a run down. The line
  // shows both if they differ; JSON has the longer one.
  const double mean = all > 0 ? (now.t - first_time_) / all : 0, share = 1 - std::exp(-wall / 10);
  recent_ = recent_ < 0 ? speed : recent_ + share * (speed - recent_);
  const auto left_at = [&](double rate_of_time) { return rate_of_time > 0 ? (now.duration - now.t) / rate_of_time : INFINITY; };
  const double soonest = left_at(std::max(mean, recent_)), left = left_at(std::min(mean, recent_));
  if (!now.line.empty()) {
    if (json_) fmt::print(stderr, "{}\n", Json{{"push", now.line}, {"steps", now.steps}, {"steps_per_s", rate}}.dump());
    else fmt::print(stderr, "{}{}, {:.3g} steps/s{}", terminal_ ? "\r\033[K" : "", now.line, rate, terminal_ ? "" : "\n");
    open_ = terminal_ && !json_;
  } else if (json_) {
    const Json line = {{"time_s", now.t},
                       {"duration_s", now.duration},
                       {"steps", now.steps},
                       {"realtime_factor", speed},
                       {"steps_per_s", rate},
                       {"joints_broken", now.joints_broken},
                       {"residual_relative", now.residual},
                       {"dt_s", now.dt},
                       {"dt_limited_by", now.limited_by},
                       {"left_s", left}};
    fmt::print(stderr, "{}\n", line.dump());
  } else {
    const std::string line = fmt::format(
        "{:.2f} of {:g} s, {:.3g} x real time, {:.3g} steps/s, {} joints broken, energy residual {:.1e}, {} left, dt {:.3g} us: {}", now.t,
        now.duration, speed, rate, now.joints_broken, now.residual, left_text(soonest, left), 1e6 * now.dt, now.limited_by);
    fmt::print(stderr, "{}{}{}", terminal_ ? "\r\033[K" : "", line, terminal_ ? "" : "\n");
    open_ = terminal_;
  }
  std::fflush(stderr);
  last_ = clock;
  last_time_ = now.t;
  last_steps_ = now.steps;
}

void ProgressPrinter::end() {
  if (open_) fmt::print(stderr, "\r\033[K");
  open_ = false;
}

}  // namespace erbs::lua
