// frames.json and frames.svg.
#include <algorithm>
#include <cmath>

#include "engine/base/correlation.h"
#include "engine/base/error.h"
#include "engine/base/system/process.h"
#include "engine/base/text.h"
#include "engine/base/units.h"
#include "engine/record/format/json.h"
#include "engine/record/plot/figure.h"
#include "render/compare/compare_film.h"

namespace erbs::render {
namespace {

constexpr double most_standing = 0.1;  // of its silhouette; noise of a film and edges of blocks make less than 0.02

// Mean of what is a number; NaN if nothing is.
template <class Value>
double mean_of(const std::vector<FrameErrors>& frames, Value&& value) {
  double sum = 0;
  int count = 0;
  for (const FrameErrors& frame : frames)
    if (std::isfinite(value(frame))) sum += value(frame), ++count;
  return count > 0 ? sum / count : NAN;
}

double direction_of(const Flow& flow) { return std::hypot(flow.x, flow.y) < 0.1 ? NAN : std::atan2(flow.y, flow.x) * 180 / pi; }

// The motions of all pictures together: direction in which the whole falls in the picture.
Flow sum_of(const std::vector<FrameErrors>& frames, Flow FrameErrors::*which) {
  Flow sum;
  for (const FrameErrors& frame : frames) {
    const Flow& f = frame.*which;
    sum.x += f.x * f.moving, sum.y += f.y * f.moving;
  }
  return sum;
}

template <class Value>
std::string rows_of(const std::vector<FrameErrors>& frames, Value&& value) {
  std::string rows;
  for (const FrameErrors& frame : frames)
    rows += std::isfinite(value(frame)) ? fmt::format("{:.6g} {:.6g}\n", frame.time, value(frame)) : std::string("\n");
  return rows;
}

plot::Figure figure_of(const FilmErrors& e, const std::string& note) {
  plot::Figure figure{960, 760};
  figure.settings = "set zeroaxis lc rgb '#b0b0b0' lt 1 lw 0.8\n";
  figure.labels = {{note, "screen 0.1,0.972", "left font ',13' tc rgb '#333333'"}};
  const double from = e.frames.front().time, to = e.frames.back().time;
  const auto panel = [&](int i, const std::string& label, const std::string& range) {
    plot::Panel p;
    const double top = 0.945 - 0.3 * i;
    p.axes = {0.1, 0.8, top - 0.265, top};
    p.key = "at graph 1.015,1 left top Left reverse samplen 2.5 spacing 1.2 noenhanced";
    p.x = {i == 2 ? "time of the film [s]" : "", fmt::format("[{:.6g}:{:.6g}]", from, to), "", i == 2 ? "" : "none", "", false};
    p.y = {label, range, "", "", "", false};
    return p;
  };
  const std::string run = "lines lw 1.6 lc rgb '#0072b2'", film = "lines lw 1.6 lc rgb '#d55e00' dashtype (14,5)";
  plot::Panel likeness = panel(0, "likeness [-]", "[0:1.02]");
  likeness.series = {{figure.add_rows(rows_of(e.frames, [](const auto& f) { return f.overlap; })) + " using 1:2", run, "silhouette IoU"},
                     {figure.add_rows(rows_of(e.frames, [](const auto& f) { return f.ssim; })) + " using 1:2", film, "SSIM"}};
  plot::Panel motion = panel(1, "change of brightness [1/s]", "[0:*]");
  std::string own, other;
  for (std::size_t i = 0; i < e.run.t.size(); ++i) own += fmt::format("{:.6g} {:.6g}\n", e.run.t[i] - e.lag, e.run.y[i]);
  for (std::size_t i = 0; i < e.film.t.size(); ++i) other += fmt::format("{:.6g} {:.6g}\n", e.film.t[i], e.film.y[i]);
  motion.series = {{figure.add_rows(own) + " using 1:2", run, "run"}, {figure.add_rows(other) + " using 1:2", film, "reference"}};
  plot::Panel flow = panel(2, "direction of motion [deg]", "[-185:185]");
  flow.y.tics = "-180,90,180";
  flow.series = {{figure.add_rows(rows_of(e.frames, [](const auto& f) { return direction_of(f.flow_run); })) + " using 1:2",
                  "points pt 7 ps 0.5 lc rgb '#0072b2'", "run"},
                 {figure.add_rows(rows_of(e.frames, [](const auto& f) { return direction_of(f.flow_film); })) + " using 1:2",
                  "points pt 6 ps 0.8 lc rgb '#d55e00'", "reference"}};
  figure.panels = {likeness, motion, flow};
  return figure;
}

Json list_of(const FilmErrors& e) {
  Json list = Json::array();
  for (const FrameErrors& f : e.frames)
    list.push_back({{"time_s", f.time},
                    {"iou", f.overlap},
                    {"ssim", f.ssim},
                    {"run_deg", direction_of(f.flow_run)},
                    {"reference_deg", direction_of(f.flow_film)},
                    {"angle_deg", f.angle}});
  return list;
}

}  // namespace

void draw_film_errors(const FilmErrors& e, const FilmComparison& wish) {
  const std::string note = fmt::format("the run is {} than the film, by {}; camera {}", lag_text(e.lag), wish.align, e.camera);
  if (can_start("gnuplot")) plot::draw(figure_of(e, note), wish.place + "/frames.svg");
  else tell(stderr, "warning: the figure needs gnuplot, which is not installed: it is left out; install the package gnuplot-nox");
}

void write_film_errors(const FilmErrors& e, const FilmComparison& wish, bool quiet) {
  const double iou = mean_of(e.frames, [](const auto& f) { return f.overlap; });
  const double ssim = mean_of(e.frames, [](const auto& f) { return f.ssim; });
  const double angle = mean_of(e.frames, [](const auto& f) { return f.angle; });
  const Flow run = sum_of(e.frames, &FrameErrors::flow_run), film = sum_of(e.frames, &FrameErrors::flow_film);
  const double least =
      std::min_element(e.frames.begin(), e.frames.end(), [](const auto& a, const auto& b) { return a.overlap < b.overlap; })->overlap;
  Json json;
  json["alignment"] = {{"method", wish.align}, {"lag_s", e.lag}, {"correlation", e.correlation}, {"at_edge", e.at_edge}, {"fps", e.fps}};
  if (std::isfinite(e.correlated_lag)) json["alignment"]["lag_by_correlation_s"] = e.correlated_lag;
  if (std::isfinite(e.better_slow)) json["alignment"]["better"] = {{"slow", e.better_slow}, {"correlation", e.better_correlation}};
  json["camera"] = {{"name", e.camera}, {"residual_px", wish.residual}};
  json["method"] = {{"silhouette",
                     "pixels that differ from the background by more than 30/255 in a channel; of the run: the drawing without "
                     "its blocks; of the film: " +
                         wish.background},
                    {"ssim", "windows of 8 x 8 pixels, Wang et al. 2004"},
                    {"motion", "block matching of squares of 16 pixels, up to 8 pixels"},
                    {"reduction", e.reduction}};
  json["iou_mean"] = iou, json["iou_least"] = least, json["ssim_mean"] = ssim, json["flow_angle_mean_deg"] = angle;
  json["direction_run_deg"] = direction_of(run), json["direction_reference_deg"] = direction_of(film);
  json["direction_error_deg"] = angle_between(run, film);
  json["standing_share"] = e.standing;
  json["frames_compared"] = e.frames.size(), json["frames_outside"] = e.outside, json["frames_missing"] = e.missing,
  json["wall_s"] = e.wall;
  json["frames"] = list_of(e);
  write_json(wish.place + "/frames.json", json);
  if (e.missing > 0)
    tell(stderr, fmt::format("warning: {}: the film breaks off: {} of its {} pictures cannot be read; is the file whole?",
                             shown(wish.film, 200), e.missing, e.missing + e.film.t.size() + 1));
  if (e.standing > most_standing)
    tell(stderr,
         fmt::format("warning: {:.0f} % of the silhouette of the film stand still where the run never shows a block, and count against the "
                     "IoU: a title, legend or strip, or what stands beside the structure. Draw films of erbs render with --no-overlay; for "
                     "others give a picture of the scene without the structure, by --film-background FILE.png",
                     100 * e.standing));
  if (e.outside > 0)
    tell(stderr, fmt::format("warning: {} picture{} outside the run: left out", e.outside,
                             e.outside == 1 ? " of the film lies" : "s of the film lie"));
  if (e.at_edge) tell(stderr, "warning: the best lag is the largest one searched; the true one may lie beyond, see --reach");
  if (std::isfinite(e.correlated_lag))
    tell(stderr, fmt::format("warning: by first motions the run is {} than the film, by correlation ({:.2f}) {}: what moves first lies "
                             "before the first picture of one of them, or is too faint; use --align correlation",
                             lag_text(e.lag), e.correlation, lag_text(e.correlated_lag)));
  if (std::isfinite(e.better_slow))
    tell(stderr, fmt::format("warning: the motions correlate by {:.3f}, and with --slow {:g} by {:.3f}; has the film that pace?",
                             e.correlation, e.better_slow, e.better_correlation));
  else if (wish.align == "correlation" && e.correlation < doubtful && !e.at_edge)
    tell(stderr, fmt::format("warning: the motions correlate by {:.2f} only, so that their lag is doubtful; try --align none or another "
                             "camera",
                             e.correlation));
  if (quiet) return;
  tell(stdout, fmt::format("pictures    {} compared in {:.1f} s, {:.0f} a second; {} outside the run; measured at 1/{} of their size",
                           e.frames.size(), e.wall, double(e.frames.size()) / e.wall, e.outside, e.reduction));
  tell(stdout, fmt::format("time        aligned by {}: the run is {} than the film{} (correlation {:.3f})", wish.align, lag_text(e.lag),
                           e.lag != 0 && std::abs(e.lag) < known_share / e.fps ? ", less than a quarter of a picture" : "", e.correlation));
  tell(stdout, fmt::format("silhouette  mean IoU {:.3f}, least {:.3f} (background of the film: {})", iou, least, wish.background));
  tell(stdout, fmt::format("SSIM        mean {:.3f}", ssim));
  const auto degrees = [](double value, int digits) { return std::isfinite(value) ? fmt::format("{:.{}f} deg", value, digits) : "none"; };
  tell(stdout, fmt::format("motion      run {}, film {} (0: to the right, 90: upwards); by picture {} apart in the mean",
                           degrees(direction_of(run), 0), degrees(direction_of(film), 0), degrees(angle, 1)));
}

}  // namespace erbs::render
