#include "render/movie/scenery.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "render/draw/overlay.h"
#include "render/run/mesh.h"

namespace erbs::render {
namespace {

// What lies behind the section for this camera. One that is fitted stands outside, where it looks from.
double side_behind(const Section& section, const Camera& camera, bool fitted) {
  const double towards = (camera.eye - camera.target)[section.axis];
  return (fitted && towards != 0 ? towards < 0 : camera.eye[section.axis] < section.at) ? 1 : -1;
}

}  // namespace

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
  if (run.gravity.empty() || !movie.look.table_turns) {
    // Of a transparent picture only shadows on the ground are seen, which may lie beyond it.
    if (movie.look.background != Background::transparent) bound_ground(stage, excerpt.scene, some);
    return stage;
  }
  std::vector<Mat3> level;
  for (const MotionFrame& frame : some) level.push_back(levelling(run.gravity, frame.t));
  turn_table(stage, excerpt.scene, some, level);
  return stage;
}

std::optional<Mat3> levelling_at(const Run& run, const Stage& stage, const Look& look, double t) {
  if (!run.gravity.empty() && look.table_turns) return levelling(run.gravity, t);
  return stage.bounded ? std::optional<Mat3>(Mat3::Identity()) : std::nullopt;
}

Scenery::Scenery(const Run& run, const MotionReader& reader, const Movie& movie, double aspect, const std::vector<double>& times)
    : run_(run), reader_(reader), movie_(movie), excerpt_(without_groups(reader.scene(), movie.hide)), section_(movie.section) {
  if (movie.look.coloring == Coloring::energy) bodies_ = bodies_of(reader.scene(), run);
  stage_ = stage_of(run, reader, excerpt_, movie);
  if (movie.look.overlay && !movie.split && !movie.svg) {
    const double unit = overlay_unit(movie.look.width, movie.look.height);
    stage_.legend_width = legend_width * unit / movie.look.width;
    stage_.legend_height = (legend_height + 20 * movie.marks.most_rows()) * unit / (movie.look.height - movie.look.top - movie.look.bottom);
  }
  for (const Camera& camera : cameras(aspect, times)) {
    Shot shot{camera, [camera](double) { return camera; }};
    if (!movie.path.empty()) shot.at = [camera, keys = camera_path(movie.path)](double t) { return along_path(camera, keys, t); };
    if (!movie.follow.empty()) shot = follow(camera, movie.follow, movie.fit, reader, excerpt_, stage_, movie.look.magnify);
    shots_.push_back(shot);
  }
  if (section_ && section_->keep == 0) section_->keep = side_behind(*section_, shots_.front().camera, false);
  const std::string& mechanism = movie.marks.mechanism;
  if (!mechanism.empty() && mechanism != "motion") mechanism_ = rates_of_mechanism(mechanism, excerpt_.scene);
}

std::vector<Camera> Scenery::cameras(double aspect, const std::vector<double>& times) {
  std::vector<Camera> chosen = chosen_cameras(run_, stage_, movie_, aspect);
  if (!movie_.fit || !movie_.path.empty() || !movie_.follow.empty()) return chosen;
  if (section_ && section_->keep == 0) section_->keep = side_behind(*section_, chosen.front(), true);
  const MotionScene cut = section_ ? cut_scene(excerpt_.scene, *section_, stage_.hidden) : excerpt_.scene;
  fit_cameras(chosen, run_, stage_, cut, aspect, times, [&](double t) { return moved(t); });
  return chosen;
}

// Without a quantity.
MotionFrame Scenery::moved(double t) const {
  MotionFrame frame = excerpt_of(excerpt_, frame_at(reader_, t));
  magnify(excerpt_.scene, movie_.look.magnify, frame);
  return frame;
}

MotionFrame Scenery::actual(double t) const {
  MotionFrame frame = frame_at(reader_, t);
  frame.t = t;
  const Coloring coloring = movie_.look.coloring;
  if (coloring == Coloring::speed) derive_speeds(reader_, frame);
  if (coloring == Coloring::slip) derive_slips(reader_.scene(), frame);
  if (coloring == Coloring::energy) derive_energies(reader_, bodies_, frame);
  if (is_stress(coloring)) derive_stresses(reader_, coloring == Coloring::shear_stress, frame);
  return excerpt_of(excerpt_, std::move(frame));
}

MotionFrame Scenery::drawn(double t) const {
  MotionFrame frame = actual(t);
  magnify(excerpt_.scene, movie_.look.magnify, frame);
  return frame;
}

Rates Scenery::rates(double t) const {
  if (mechanism_) return *mechanism_;
  if (movie_.marks.mechanism.empty()) return {};
  return rates_at(reader_, &excerpt_, t);
}

Marks Scenery::marks(double t) const {
  if (!movie_.marks.any()) return {};
  return marks_of(movie_.marks, excerpt_.scene, stage_, actual(t), drawn(t), rates(t), mark_scale_);
}

std::vector<Impact> Scenery::impacts() const {
  ImpactFinder finder(excerpt_.scene);
  for (std::size_t i = 0; i < reader_.times().size(); ++i) finder.add(excerpt_of(excerpt_, reader_.read(static_cast<int>(i))));
  return finder.impacts;
}

namespace {

std::string words_of(const Camera& camera) { return camera.name == "own" ? "the camera of --eye" : "the camera " + shown(camera.name, 60); }

}  // namespace

const MotionBlock* block_around(const Vec3& point, const MotionScene& scene, const MotionFrame& frame, const std::vector<bool>& left_out) {
  for (std::size_t b = 0; b < scene.blocks.size(); ++b) {
    const float* p = &frame.poses[7 * b];
    const Vec3 from = point - Vec3(p[0], p[1], p[2]);
    if (left_out[b] || !from.allFinite()) continue;
    const Vec3 at_rest = Eigen::Quaterniond(p[3], p[4], p[5], p[6]).normalized().conjugate() * from + scene.blocks[b].rest;
    if (is_inside(scene, b, at_rest)) return &scene.blocks[b];
  }
  return nullptr;
}

std::string inside_text(const Camera& camera, const MotionBlock& block, double t) {
  return fmt::format("{} stands inside block {} at {:g} s, so that it sees nothing else", words_of(camera), shown(block.name, 60), t);
}

void Scenery::check_eyes(const std::vector<double>& times) const {
  const MotionScene scene = section_ ? cut_scene(excerpt_.scene, *section_, stage_.hidden) : excerpt_.scene;
  std::vector<bool> unseen = in_groups(scene, movie_.ghost, "--ghost");
  for (std::size_t b = 0; b < unseen.size(); ++b) unseen[b] = unseen[b] || stage_.hidden[b];
  const std::size_t stride = std::max<std::size_t>(1, times.size() / 24);
  for (const Shot& shot : shots_) {
    bool warned = false;
    for (std::size_t i = 0; i < times.size() && !warned; i += stride) {
      const double t = times[i];
      Vec3 eye = shot.at(t).eye;
      if (!stage_.positions.empty()) eye = in_scene(shot.at(t), table_position(stage_, levelling(run_.gravity, t))).eye;
      if (const MotionBlock* block = block_around(eye, scene, drawn(t), unseen)) {
        const std::string what = inside_text(shot.camera, *block, t);
        if (i == 0) throw Error(what + "; move it out, with --eye x,y,z or --fit");
        tell(stderr, "warning: " + what);
        warned = true;
      }
      if (!warned && stage_.on_ground && eye.z() < stage_.ground_z) {
        const std::string what = stage_.positions.empty()
                                     ? " stands below the ground and looks at the building from there; raise it with --eye x,y,z"
                                     : fmt::format(
                                           " sees the tilted table from below at {:g} s; --tilt camera keeps it level with the table, "
                                           "--eye x,y,z shows another side",
                                           t);
        tell(stderr, "warning: " + words_of(shot.camera) + what);
        warned = true;
      }
    }
  }
}

Show Scenery::show(const std::vector<double>& times) {
  Show show = prepare_show(excerpt_.scene, run_, stage_, in_groups(excerpt_.scene, movie_.ghost, "--ghost"), section_);
  std::vector<MotionFrame> some;  // the scale is that of what is shown
  const std::size_t stride = std::max<std::size_t>(1, times.size() / 24);
  if (is_quantity(movie_.look.coloring))
    for (std::size_t i = 0; i < times.size(); i += stride) some.push_back(drawn(times[i]));
  show.scale = color_scale(excerpt_.scene, some, movie_.look.coloring, stage_.reach);
  // The broken joints of mortar are soon among them, and those of dry masonry at once.
  const auto is_broken = [](std::uint8_t damage) { return damage == 255; };
  for (std::size_t i = 0; i < times.size() && !show.replaced && (movie_.marks.any() || is_stress(movie_.look.coloring)); ++i)
    if (i % stride == 0 || i + 1 == times.size()) show.replaced = std::ranges::any_of(actual(times[i]).damage, is_broken);
  if (!movie_.marks.any()) return show;
  double force = 0, speed = 0;
  for (std::size_t i = 0; i < times.size(); i += stride) {
    if (movie_.marks.forces || movie_.marks.thrust) force = std::max(force, largest_force(excerpt_.scene, actual(times[i])));
    if (!movie_.marks.mechanism.empty()) speed = std::max(speed, largest_speed(excerpt_.scene, rates(times[i])));
  }
  mark_scale_ = {force > 0 ? round_up(force) : 0, speed > 0 ? speed : 1, show.replaced};
  return show;
}

}  // namespace erbs::render
