// erbs-render DIR: pictures, videos and figures of a run.
#include <CLI/CLI.hpp>
#include <atomic>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <map>

#include "engine/base/error.h"
#include "engine/base/system/interrupt.h"
#include "engine/base/system/process.h"
#include "engine/base/system/streams.h"
#include "engine/base/text.h"
#include "engine/base/units.h"
#include "render/compare/compare_film.h"
#include "render/draw/figures.h"
#include "render/movie/film_reader.h"
#include "render/movie/movie.h"
#include "render/movie/scenery.h"
#include "render/run/camera_points.h"
#include "render/vector/drawing.h"

namespace {

using erbs::Error;
namespace render = erbs::render;

struct Arguments {
  std::string dir, size = "1280x720", time, stills, eye, target, color = "material", section, tilt = "table", shaking = "camera",
                   background = "sky", points;
  bool known_fov = false;
  std::vector<std::string> cameras;
  bool figures_only = false, no_figures = false;
  render::Movie movie;
  render::FilmComparison comparison{"", "rows", "correlation", "", 5, 640, NAN};
};

const std::map<std::string, render::Coloring> colorings{{"material", render::Coloring::material},
                                                        {"damage", render::Coloring::damage},
                                                        {"displacement", render::Coloring::displacement},
                                                        {"speed", render::Coloring::speed},
                                                        {"opening", render::Coloring::opening},
                                                        {"slip", render::Coloring::slip},
                                                        {"energy", render::Coloring::energy},
                                                        {"joint_state", render::Coloring::joint_state},
                                                        {"normal_stress", render::Coloring::normal_stress},
                                                        {"shear_stress", render::Coloring::shear_stress}};

const std::map<std::string, render::Background> backgrounds{
    {"sky", render::Background::sky}, {"white", render::Background::white}, {"transparent", render::Background::transparent}};

// Reads a finite number; false if the text holds anything else.
bool read_number(std::string_view text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

void read_size(const std::string& text, render::Look& look) {
  const std::size_t cross = text.find('x');
  double w = 0, h = 0;
  const bool good = cross != std::string::npos && read_number(text.substr(0, cross), w) && read_number(text.substr(cross + 1), h);
  if (!good || w < 64 || h < 64 || w > 8192 || h > 8192 || w != std::floor(w) || h != std::floor(h))
    throw Error("--size " + text + " is not a width and height of 64 to 8192 pixels; try 1280x720");
  look.width = static_cast<int>(w);
  look.height = static_cast<int>(h);
}

void read_times(const Arguments& a, render::Movie& movie) {
  if (!a.time.empty()) {
    const std::size_t colon = a.time.find(':');
    double from = 0, to = 0;
    const bool good = colon != std::string::npos && read_number(a.time.substr(0, colon), from) && read_number(a.time.substr(colon + 1), to);
    if (!good || to < from) throw Error("--time " + a.time + " is not a span of seconds; try 2:4.5");
    movie.range = {from, to};
  }
  for (std::size_t at = 0; at < a.stills.size();) {
    const std::size_t comma = std::min(a.stills.find(',', at), a.stills.size());
    double t = 0;
    if (!read_number(a.stills.substr(at, comma - at), t)) throw Error("--stills " + a.stills + " is not a list of seconds; try 0,2.5,4");
    movie.stills.push_back(t);
    at = comma + 1;
  }
}

// A point "x,y,z" (m).
std::optional<erbs::Vec3> read_point(const std::string& option, const std::string& text) {
  if (text.empty()) return std::nullopt;
  erbs::Vec3 point;
  std::size_t at = 0;
  for (int i = 0; i < 3; ++i) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    if (at > text.size() || !read_number(text.substr(at, comma - at), point[i]) || (i == 2 && comma != text.size()))
      throw Error(option + " " + text + " is not a point in m; try " + option + " 6,-7,4");
    at = comma + 1;
  }
  return point;
}

void read_camera(const Arguments& a, render::Movie& movie) {
  movie.eye = read_point("--eye", a.eye), movie.target = read_point("--target", a.target);
  if (movie.eye && !movie.cameras.empty()) throw Error("--eye is a camera of its own; leave out --camera");
  if (!movie.eye && movie.target) throw Error("--target belongs to a camera of your own; give --eye x,y,z as well");
  if (!movie.path.empty() && (movie.eye || !movie.cameras.empty() || !movie.follow.empty()))
    throw Error("--path is a camera of its own; leave out --eye, --camera and --follow");
  if (!movie.path.empty()) render::camera_path(movie.path);
  if (movie.split && (movie.eye || !movie.path.empty()))
    throw Error("--split needs several cameras; name them with --camera, and leave out --eye and --path");
  if (movie.svg && movie.split) throw Error("--svg draws each camera by itself; leave out --split");
}

// Curves that cannot be drawn keep neither pictures nor videos from being made.
void write_figures(const render::Run& folder, const Arguments& a) {
  try {
    for (const std::string& path : render::write_figures(folder))
      if (!a.movie.quiet) erbs::tell(stdout, "figure: " + path);
  } catch (const Error& e) {
    if (a.figures_only) throw;
    erbs::tell(stderr, fmt::format("warning: the curves could not be drawn: {}; --no-figures leaves them out", e.what()));
  }
}

// From marked points, in the size of the film.
void find_camera(Arguments& a) {
  if (a.movie.eye || !a.movie.cameras.empty()) throw Error("--points is a camera of its own; leave out --eye and --camera");
  const std::vector<render::MarkedPoint> points = render::marked_points(a.points);
  const render::FilmReader film(a.comparison.film, a.movie.fps);
  const auto fov = a.known_fov ? std::optional<double>(a.movie.fov * erbs::pi / 180) : std::nullopt;
  const render::FoundCamera found = render::camera_from(points, film.width(), film.height(), fov);
  a.movie.camera = found.camera, a.comparison.residual = found.residual;
  if (a.movie.quiet) return;
  const erbs::Camera& c = found.camera;
  erbs::tell(
      stdout,
      fmt::format("camera      eye {:.3f},{:.3f},{:.3f} m, target {:.3f},{:.3f},{:.3f} m, fov {:.2f} deg; residual {:.2f} px", c.eye.x(),
                  c.eye.y(), c.eye.z(), c.target.x(), c.target.y(), c.target.z(), c.fov * 180 / erbs::pi, found.residual));
}

erbs::MotionReader motion_of(const Arguments& a) {
  erbs::MotionReader reader(a.dir);
  if (a.shaking == "table") reader.stand_beside_the_ground();
  return reader;
}

// Against a film: 0, or 130 if interrupted.
int compare(const render::Run& folder, Arguments& a) {
  if (a.comparison.place.empty()) a.comparison.place = a.dir + "/compare";
  if (!a.movie.force && std::filesystem::exists(a.comparison.place + "/frames.json"))
    throw Error("it exists already; --force writes it anew", {a.comparison.place + "/frames.json"});
  if (!erbs::can_start("ffmpeg")) throw Error("films of a comparison need ffmpeg, which is not installed; install the package ffmpeg");
  const erbs::MotionReader reader = motion_of(a);
  if (!a.points.empty()) find_camera(a);
  render::prepare_contexts();
  return render::compare_film(folder, reader, a.movie, a.comparison, erbs::catch_interrupts()) ? 0 : 130;
}

// Of two options one would otherwise be ignored.
void refuse_contradictions(const Arguments& a) {
  const bool stills = !a.movie.stills.empty();
  if (stills && a.movie.range) throw Error("--stills and --time exclude each other: instants and a span; keep one");
  if (stills && !a.movie.frames.empty()) throw Error("--stills and --frames exclude each other: instants and a film; keep one");
  if (stills && a.movie.webp) throw Error("--stills makes single pictures, --webp a film; keep one");
  if (a.figures_only && a.no_figures) throw Error("--figures and --no-figures exclude each other; keep one");
}

int run(Arguments& a) {
  render::Movie& movie = a.movie;
  read_size(a.size, movie.look);
  read_times(a, movie);
  refuse_contradictions(a);
  movie.cameras = a.cameras;
  read_camera(a, movie);
  constexpr const char* one_picture = "--expect compares one picture; give one time with --stills and one camera with --camera";
  if (!movie.expected.empty() && (movie.stills.size() != 1 || (movie.cameras.empty() && !movie.eye))) throw Error(one_picture);
  if (movie.svg && (!movie.expected.empty() || movie.webp || a.color != "material" || !a.comparison.film.empty()))
    throw Error("--svg makes line drawings alone; leave out --color, --webp, --expect and --compare");
  if (movie.dust && (movie.look.magnify != 1 || movie.svg || !a.comparison.film.empty()))
    throw Error("--dust illustrates true motion in pictures; leave out --magnify, --svg and --compare");
  if (movie.svg && movie.stills.empty() && (movie.range || !movie.frames.empty()))
    throw Error("--svg draws instants; give them with --stills t1,t2 in place of --time and --frames");
  if (!movie.expected.empty() && a.background == "transparent")
    throw Error("--expect compares opaque pictures; choose --background sky or white");
  if (!a.section.empty()) movie.section = render::read_section(a.section);
  movie.look.coloring = colorings.at(a.color);
  movie.look.background = backgrounds.at(a.background);
  if (movie.look.background == render::Background::transparent && movie.video && movie.stills.empty() && !movie.webp)
    throw Error("--background transparent: an MP4 has no transparent pixels; add --webp, --no-video or --stills t1,t2");
  movie.look.table_turns = a.tilt == "table";
  const render::Run folder = render::read_run(a.dir);
  if (!movie.expected.empty() && render::cameras_of(folder, movie) != 1) throw Error(one_picture);
  if (!a.comparison.film.empty()) return compare(folder, a);
  const auto figures = [&] {
    if (!a.no_figures) write_figures(folder, a);
    std::fflush(stdout);  // before copies of this process are made
  };
  if (a.figures_only) return figures(), 0;
  const erbs::MotionReader reader = motion_of(a);
  if (movie.svg) return render::make_drawings(folder, reader, movie, erbs::catch_interrupts(), figures) ? 0 : 130;
  render::prepare_contexts();
  if (!render::make_movie(folder, reader, movie, erbs::catch_interrupts(), figures)) return 130;
  if (!movie.quiet && !folder.verdict.empty()) erbs::tell(stdout, folder.verdict);
  return 0;
}

}  // namespace

// A number in a closed range; NaN is in none.
CLI::Validator within(double low, double high) {
  return CLI::Validator(
      [=](std::string& text) {
        double value = 0;
        if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high) return std::string();
        return fmt::format("{} is not in range {} to {}", erbs::shown(text), low, high);
      },
      fmt::format("{} to {}", low, high));
}

// Options of a comparison with a film.
void add_comparison(CLI::App& app, Arguments& a) {
  app.add_option("--compare", a.comparison.film, "a film, or a folder of PNG files: compare the run with it");
  app.add_option("--compare-to", a.comparison.place, "folder of the comparison (default DIR/compare)");
  app.add_option("--film-background", a.comparison.background,
                 "what that film shows without the structure: rows (the median of each row of its first picture), drawn (the run without "
                 "blocks; for films made with --no-overlay), or a PNG")
      ->capture_default_str();
  app.add_option("--film-width", a.comparison.width,
                 "of the pictures of the run and of the films that show both, at most (px; measured are at most 640)")
      ->check(within(64, 8192))
      ->capture_default_str();
  app.add_option("--points", a.points, "x,y,z:u,v;..: four or more points (m) and their places in that film (px) give the camera");
  app.add_option("--align", a.comparison.align, "times of that film")
      ->check(CLI::IsMember({"none", "first-motion", "correlation"}))
      ->capture_default_str();
  app.add_option("--reach", a.comparison.reach, "largest lag that is searched (s)")->check(within(0.0, 1e6))->capture_default_str();
}

int main(int argc, char** argv) {
  erbs::prepare_streams();
  Arguments a;
  CLI::App app("Pictures, videos and figures of a run of erbs.", "erbs-render");
  app.add_option("DIR", a.dir, "the run folder")->required();
  app.add_option("--size", a.size, "pixels of a picture")->capture_default_str();
  app.add_option("--camera", a.cameras,
                 "cameras of the scene by name, with commas between them, or all; from_-x, from_+x, from_-y, from_+y, from_above (default: "
                 "the first)");
  app.add_option("--eye", a.eye, "x,y,z: position of a camera of your own (m)");
  app.add_option("--target", a.target, "x,y,z: the point that it looks at (m; default: the middle of the building)");
  const CLI::Option* fov =
      app.add_option("--fov", a.movie.fov, "its vertical angle of view (deg)")->check(within(0.1, 170.0))->capture_default_str();
  app.add_flag("--fit", a.movie.fit,
               "keep the direction of each camera and place it so that the blocks drawn fill the pictures: "
               "none is cut off in any picture, except those thrown far away");
  app.add_option("--path", a.movie.path,
                 "\"t:x,y,z:x,y,z; ..\": a camera that moves; time (s), eye and target (m) of two or more keyframes");
  app.add_option("--follow", a.movie.follow,
                 "a group, a block, or debris (what has fallen at the end): the camera moves with it; --fit: closely");
  app.add_flag("--split", a.movie.split, "all cameras, or those of --camera, side by side in one picture");
  app.add_option("--fps", a.movie.fps, "pictures a second of the video")->check(within(1.0, 240.0))->capture_default_str();
  app.add_option("--slow", a.movie.slow, "seconds of video for one second of the run")->check(within(0.001, 1000.0))->capture_default_str();
  app.add_option("--frames", a.movie.frames, "every: each recorded frame once; N: so many, evenly spread");
  app.add_option("--time", a.time, "T0:T1, only this span (s)");
  app.add_option("--stills", a.stills, "t1,t2,..: single pictures at these times (s), no video");
  app.add_option(
         "--color", a.color,
         "of blocks: material, damage, displacement, speed, largest opening or slip of their joints, kinetic energy, or normal_stress "
         "(compression) or "
         "shear_stress of their most stressed joint; or joint_state, of joints")
      ->check(CLI::IsMember(colorings))
      ->capture_default_str();
  app.add_option("--hide", a.movie.hide, "groups of blocks that are not drawn, with their joints")->delimiter(',');
  app.add_option("--ghost", a.movie.ghost, "groups of blocks drawn translucent")->delimiter(',');
  app.add_option("--section", a.section,
                 "x=1.2, y<0.5 or z>2: cut the blocks, where they are at rest, and draw what lies behind, below or above (m)");
  app.add_option("--magnify", a.movie.look.magnify, "factor on the displacements drawn")->check(within(1e-3, 1e6))->capture_default_str();
  app.add_option("--tilt", a.tilt, "of a tilting test: the table turns, or the camera stays level with it")
      ->check(CLI::IsMember({"table", "camera"}))
      ->capture_default_str();
  app.add_option("--shaking", a.shaking, "of shaken ground: the camera moves with it, or the table shakes before a camera at rest")
      ->check(CLI::IsMember({"camera", "table"}))
      ->capture_default_str();
  app.add_option("--background", a.background,
                 "sky, white for print, or transparent: pictures or a WebP of blocks "
                 "and their shadow; --no-overlay leaves out title and legend as well")
      ->check(CLI::IsMember(backgrounds))
      ->capture_default_str();
  app.add_flag("--forces", a.movie.marks.forces,
               "lines of the normal forces of joints, as wide as the force (of a scene with frame_stress)");
  app.add_flag(
      "--thrust", a.movie.marks.thrust,
      "the line of thrust, as wide as the force: between the two joints of a voussoir, branching in a wall (of a scene with frame_stress)");
  app.add_option("--mechanism", a.movie.marks.mechanism,
                 "arrows of velocities and rotations: motion, of this run, or the FOLDER of erbs limit SCENE -o FOLDER");
  app.add_flag("--dust", a.movie.dust, "clouds of dust where blocks hit something: an illustration, not computed");
  app.add_flag("--svg", a.movie.svg,
               "line drawings in place of pictures, at the times of --stills: outlines and cracks, with --forces .. too");
  app.add_flag_callback(
      "--no-overlay", [&a] { a.movie.look.overlay = false; }, "the scene alone: no title, clock, legend, scale, axes and ground motion");
  CLI::Option* video = app.add_flag("--video", a.movie.video, "an MP4 a camera (default)");
  app.add_flag_callback(
         "--no-video", [&a] { a.movie.video = false; }, "pictures alone")
      ->excludes(video);
  app.add_flag("--webp", a.movie.webp, "an animated WebP that repeats itself in place of the MP4, for pages such as a README");
  app.add_flag("--figures", a.figures_only, "only histories.svg and energy.svg");
  app.add_flag("--no-figures", a.no_figures, "no figures");
  app.add_option("--threads", a.movie.threads, "frames drawn at a time, each by a process (default: one a processor)")
      ->check(within(1, 256));
  app.add_option("--expect", a.movie.expected,
                 "a PNG that the one still of --stills is compared with; the result is in DIR/pictures (expect_image of a scene uses it)");
  app.add_option("--context", a.movie.context, "source of OpenGL: osmesa, egl or auto")->check(CLI::IsMember({"osmesa", "egl", "auto"}));
  add_comparison(app, a);
  app.add_flag("--force", a.movie.force, "write over pictures and videos that are there");
  app.add_flag("-q,--quiet", a.movie.quiet, "no progress and no summary");
  try {
    app.parse(argc, argv);
    a.known_fov = fov->count() > 0;
    return erbs::finish_streams(run(a), 2);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return erbs::finish_streams(app.exit(e), 2);
    erbs::tell(stderr, std::string("error: ") + e.what());
    return 2;
  } catch (const Error& e) {
    erbs::tell(stderr, std::string("error: ") + e.what());
    return 2;
  } catch (const std::filesystem::filesystem_error& e) {
    erbs::tell(stderr, fmt::format("error: {}: {}; check the path", e.path1().string(), e.code().message()));
    return 2;
  } catch (const std::logic_error& e) {
    erbs::tell(stderr, std::string("error: ") + e.what());
    return 1;
  } catch (const std::exception& e) {
    erbs::tell(stderr, std::string("error: ") + e.what());
    return 2;
  }
}
