// A run against a film of the test: the run is drawn at the times, in the size and from the camera of the film, and both are measured.
#pragma once
#include <atomic>
#include <string>
#include <vector>

#include "render/image/measures.h"
#include "render/movie/movie.h"

namespace erbs::render {

struct FilmComparison {
  std::string film;        // a film, or a folder of PNG files
  std::string background;  // of the film: "rows", "drawn", or a PNG
  std::string align;       // none, first-motion, correlation
  std::string place;       // folder of the results
  double reach = 5;        // s, largest lag
  int width = 640;         // px, of the pictures of the run and of the films at most
  double residual = NAN;   // px, of a camera from marked points
};

inline constexpr double doubtful = 0.9;      // a lower correlation of motions
inline constexpr double known_share = 0.25;  // of the time between two pictures: noise of H.264 lets no lag be known better

// Errors of one picture of the film; time is that of the film (s).
struct FrameErrors {
  double time = 0, overlap = 0, ssim = 0;
  Flow flow_run, flow_film;
  double angle = NAN;  // deg between the two
};

// Signals of motion: mean absolute change of brightness a second between two pictures, at their mean time. They are measured on pictures
// of at most 320 pixels in width.
struct MotionSignal {
  std::vector<double> t, y;               // s, 1/s of brightness 0..255
  std::vector<std::vector<float>> where;  // change of each square of the picture, 0..255 [pictures][squares]
};

struct FilmErrors {
  double lag = 0, correlation = NAN;  // s, by which the run is later than the film
  bool at_edge = false;
  double correlated_lag = NAN;                         // s, by correlation, where first motions say something else
  double better_slow = NAN, better_correlation = NAN;  // slow motion at which the film correlates better than as given
  double fps = 0;                                      // of the film, in time of the test
  MotionSignal run, film;                              // each in its own time
  std::vector<FrameErrors> frames;
  std::size_t outside = 0;  // pictures of the film outside the run
  std::size_t missing = 0;  // pictures that the head of the film names and that cannot be read
  // Share of the silhouette of the film that is there in every picture, where the run never shows a block.
  double standing = 0;
  int reduction = 1;  // pixels of a picture for one of the measures, along each side
  std::string camera;
  double wall = 0;  // s
};

// Writes compare_side.mp4, compare_blend.mp4, compare_difference.mp4, frames.json and frames.svg. False if `stop` was set meanwhile.
bool compare_film(const Run& run, const MotionReader& reader, Movie movie, const FilmComparison& wish, const std::atomic<bool>& stop);

// Sets the lag of the signals of run and film. `slow`: as given; `recorded`: times of the frames of the run (s).
void align_film(FilmErrors& errors, const FilmComparison& wish, double slow, const std::vector<double>& recorded);

void draw_film_errors(const FilmErrors& errors, const FilmComparison& wish);  // frames.svg
// frames.json, and what is printed.
void write_film_errors(const FilmErrors& errors, const FilmComparison& wish, bool quiet);

}  // namespace erbs::render
