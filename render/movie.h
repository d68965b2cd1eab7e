// The frames of a run, as pictures and as a video, from one camera after the other.
#pragma once
#include <atomic>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/draw.h"

namespace erbs::render {

struct Movie {
  Look look;
  std::vector<std::string> cameras;                // names; empty: the first; "all": all
  double fps = 25;                                 // of the video
  double slow = 1;                                 // seconds of video for one of the run
  std::string frames;                              // "": as fps and slow ask for; "every": each recorded one; a number: so many
  std::optional<std::pair<double, double>> range;  // s
  std::vector<double> stills;                      // s; no video then
  bool video = true, force = false, quiet = false;
  int threads = 0;  // 0: one a processor
  std::string context = "auto";
};

// Times (s) of the pictures, and the factor by which the video is slower than the run.
struct Schedule {
  std::vector<double> times;
  double slow = 1;
};
Schedule schedule_of(const Movie& movie, const std::vector<double>& recorded);

// The state at time t: recorded, or between two recorded frames (positions linear, rotations along the shortest arc).
MotionFrame frame_at(const MotionReader& reader, double t);

// Draws and writes everything; prints to stdout what it wrote. false where `stop` was set on the way.
bool make_movie(const Run& run, const MotionReader& reader, const Movie& movie, const std::atomic<bool>& stop);

}  // namespace erbs::render
