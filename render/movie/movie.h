// Frames of a run as pictures and as a video, one camera after another.
#pragma once
#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/draw/draw.h"
#include "render/run/marks.h"

namespace erbs::render {

struct Movie {
  Look look;
  std::vector<std::string> cameras;      // names; empty: the first camera; "all": all cameras
  std::optional<Vec3> eye, target;       // m, of a camera of one's own, which is then drawn alone
  std::optional<Camera> camera;          // such as one from marked points; drawn alone
  double fov = 31;                       // degrees, of that camera
  std::vector<std::string> hide, ghost;  // groups of blocks that are not drawn, or translucent
  std::optional<Section> section;
  bool fit = false;          // places each camera so that the blocks fill the pictures
  std::string path, follow;  // of a camera that moves (movie/scenery.h); "": none
  bool split = false;        // all cameras in one picture
  bool svg = false;          // line drawings in place of pictures
  MarkChoice marks;
  bool dust = false;                               // clouds where blocks hit something
  double fps = 25;                                 // of the video
  double slow = 1;                                 // seconds of video per second of the run
  std::string frames;                              // "": as fps and slow require; "every": each recorded frame; a number: that many frames
  std::optional<std::pair<double, double>> range;  // s
  std::vector<double> stills;                      // s; disables the video
  bool video = true, force = false, quiet = false;
  bool webp = false;  // an animated WebP in place of the MP4
  int threads = 0;    // 0: one per processor
  std::string context = "auto";
  std::string expected;  // path of a picture that the one still is compared with; "": none
};

// Times (s) of the pictures, and the slow-motion factor of the video.
struct Schedule {
  std::vector<double> times;
  double slow = 1;
};
Schedule schedule_of(const Movie& movie, const std::vector<double>& recorded);

// State at time t: a recorded frame, or an interpolation of two (positions linear, rotations along the shortest arc).
MotionFrame frame_at(const MotionReader& reader, double t);

// Velocities and spins at time t (s): the slope of the parabola through the recorded frame nearest to it and those beside that one, which
// is that of free flight. Zero if the run has one frame. `excerpt`: of the blocks that are drawn.
Rates rates_at(const MotionReader& reader, const Excerpt* excerpt, double t);

// Fills frame.derived with the speeds (m/s) of the centroids at its time.
void derive_speeds(const MotionReader& reader, MotionFrame& frame);

// Fills frame.derived with the largest mean compression, or shear stress, of the joints of each block (Pa). Error if the run kept none.
void derive_stresses(const MotionReader& reader, bool shear, MotionFrame& frame);

// Fills frame.derived with the largest slip of the joints of each block (m): how far the corners of a joint have moved along it. Joints
// whose faces have parted by more than a quarter of their width do not count.
void derive_slips(const MotionScene& scene, MotionFrame& frame);

// Mass (kg) and inertia (kg m2, about the centroid, axes at rest) of a block; zero for a fixed one.
struct Body {
  double mass = 0;
  Mat3 inertia = Mat3::Zero();
};
std::vector<Body> bodies_of(const MotionScene& scene, const Run& run);
// Fills frame.derived with the kinetic energies (J) relative to the ground, of translation and rotation.
void derive_energies(const MotionReader& reader, const std::vector<Body>& bodies, MotionFrame& frame);

// Multiplies displacements and rotations from rest by a factor; openings and damage stay.
void magnify(const MotionScene& scene, double factor, MotionFrame& frame);

// The constant data of the pictures, with the extents of the building over the whole run.
Show show_of(const Run& run, const MotionReader& reader, const Movie& movie, bool sharp = false);
// The cameras that the movie asks for; `aspect`: width over height of what they see. Error for an unknown name.
std::vector<Camera> chosen_cameras(const Run& run, const Stage& stage, const Movie& movie, double aspect);

// Keeps the direction and the fov of each camera, and places it so that the blocks of `drawn` fill the pictures at these times (s): what is
// visible at any of them is in the picture, and nothing is cut off. Blocks thrown far away do not count.
void fit_cameras(std::vector<Camera>& cameras, const Run& run, const Stage& stage, const MotionScene& drawn, double aspect,
                 const std::vector<double>& times, const std::function<MotionFrame(double)>& frame);

// How many of them there are.
std::size_t cameras_of(const Run& run, const Movie& movie);

// The stage of what is drawn, from frames spread over the run.
Stage stage_of(const Run& run, const MotionReader& reader, const Excerpt& excerpt, const Movie& movie);

// The levelling with which a picture at time t is drawn: that of a table which turns; none of a level one, where the ground has no end.
std::optional<Mat3> levelling_at(const Run& run, const Stage& stage, const Look& look, double t);

// Draws and writes everything, and prints the paths written. Calls `checked` once all that the movie asks for has been found good, before
// anything is written. False if `stop` was set meanwhile.
bool make_movie(const Run& run, const MotionReader& reader, const Movie& movie, const std::atomic<bool>& stop,
                const std::function<void()>& checked = {});

}  // namespace erbs::render
