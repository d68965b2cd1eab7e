// What all pictures of a movie share: the part of the scene that is drawn, the stage, the cameras in time, and frames at any time.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "render/movie/movie.h"

namespace erbs::render {

// A camera that may move with time.
struct Shot {
  Camera camera;                     // at the first instant; its name is that of the shot
  std::function<Camera(double)> at;  // t: s
};

class Scenery {
 public:
  // `movie` has its overlay's heights; `aspect`: width over height of what a camera sees; `times`: s, of the pictures.
  Scenery(const Run& run, const MotionReader& reader, const Movie& movie, double aspect, const std::vector<double>& times);
  Scenery(const Scenery&) = delete;
  Scenery& operator=(const Scenery&) = delete;

  const Excerpt& excerpt() const { return excerpt_; }
  const Stage& stage() const { return stage_; }
  const std::vector<Shot>& shots() const { return shots_; }
  const std::optional<Section>& section() const { return section_; }
  MotionFrame drawn(double t) const;    // magnified, with the quantity that is coloured
  Marks marks(double t) const;          // empty unless the movie asks for some
  std::vector<Impact> impacts() const;  // of all recorded frames
  // Error for a camera that stands inside a block at the first of these times; a warning where it does so later, or below the ground.
  void check_eyes(const std::vector<double>& times) const;
  // Sets the scales of colours and marks to what these times need.
  Show show(const std::vector<double>& times);

 private:
  std::vector<Camera> cameras(double aspect, const std::vector<double>& times);
  MotionFrame moved(double t) const;
  MotionFrame actual(double t) const;
  Rates rates(double t) const;
  const Run& run_;
  const MotionReader& reader_;
  Movie movie_;
  Excerpt excerpt_;
  std::vector<Body> bodies_;
  Stage stage_;
  std::optional<Section> section_;
  std::vector<Shot> shots_;
  std::optional<Rates> mechanism_;  // of a limit analysis
  MarkScale mark_scale_;
};

// The block in which a point (m, of the scene) lies in this frame; null in none of those that are not left out [blocks].
const MotionBlock* block_around(const Vec3& point, const MotionScene& scene, const MotionFrame& frame, const std::vector<bool>& left_out);
// What is wrong with an eye inside this block.
std::string inside_text(const Camera& camera, const MotionBlock& block, double t);

// Keyframes of a camera path: "t:x,y,z:x,y,z; ...", each a time (s), the eye and the target (m). Error if the text is none, with fewer than
// two keyframes, or where times do not grow.
struct CameraKey {
  double t = 0;                        // s
  Vec3 eye{0, 0, 0}, target{0, 0, 0};  // m
};
std::vector<CameraKey> camera_path(const std::string& text);
// Cubic through the keyframes, at rest before the first and after the last (Catmull and Rom 1974).
Camera along_path(const Camera& like, const std::vector<CameraKey>& keys, double t);

// The shot that keeps its direction and follows the mean of some blocks: a group, a block, or "debris", all blocks that have fallen at the
// end. Their motion is smoothed over a quarter of a second. With `fit` it stands where these blocks fill the picture.
Shot follow(const Camera& camera, const std::string& what, bool fit, const MotionReader& reader, const Excerpt& excerpt, const Stage& stage,
            double magnification);

}  // namespace erbs::render
