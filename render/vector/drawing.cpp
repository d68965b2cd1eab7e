#include "render/vector/drawing.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "render/draw/overlay.h"
#include "render/movie/scenery.h"

namespace erbs::render {
namespace {

namespace fs = std::filesystem;

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : printable(text))
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

std::string color_of(const Vec3& linear) {
  const Ink ink = display(linear);
  return fmt::format("#{:02x}{:02x}{:02x}", ink.r, ink.g, ink.b);
}

// The text of an SVG file in lengths of a picture of 720 rows.
class Sheet {
 public:
  Sheet(double width, double height)
      : width_(width), height_(height), u_(overlay_unit(static_cast<int>(width), static_cast<int>(height))) {}
  double u() const { return u_; }
  double width() const { return width_; }
  double height() const { return height_; }
  void raw(const std::string& text) { body_ += text; }
  void text(double x, double y, double size, const std::string& color, const std::string& text, const char* anchor = "start",
            bool bold = false) {
    body_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:.1f}\" fill=\"{}\" text-anchor=\"{}\"{}>{}</text>\n", x, y,
                         size * u_, color, anchor, bold ? " font-weight=\"bold\"" : "", escaped(text));
  }
  void line(double x0, double y0, double x1, double y1, const std::string& color, double width, const char* more = "") {
    body_ += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" stroke-width=\"{:.2f}\"{}/>\n", x0,
                         y0, x1, y1, color, width * u_, more);
  }
  std::string whole(const std::string& title, const std::string& description) const {
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:g}\" height=\"{1:g}\" "
        "viewBox=\"0 0 {0:g} {1:g}\" font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\">\n<title>{2}</title>\n<desc>{3}</desc>\n"
        "<rect width=\"{0:g}\" height=\"{1:g}\" fill=\"#ffffff\"/>\n{4}</svg>\n",
        width_, height_, escaped(title), escaped(description), body_);
  }

 private:
  double width_, height_, u_;
  std::string body_;
};

const char* const text_color = "#262a30";
const char* const quiet_color = "#5f666e";
constexpr double margin = 22, foot = 64;  // of 720 rows; foot: the legend below the model

std::string path_of(const std::vector<Piece>& pieces) {
  std::string d;
  Eigen::Vector2d last(NAN, NAN);
  for (const Piece& p : pieces) {
    if (!((p.from - last).norm() < 0.005)) d += fmt::format("M{:.2f} {:.2f}", p.from.x(), p.from.y());
    d += fmt::format("L{:.2f} {:.2f}", p.to.x(), p.to.y());
    last = p.to;
  }
  return d;
}

void put_lines(Sheet& sheet, const std::vector<LineGroup>& groups, double top, double bottom) {
  sheet.raw(fmt::format(
      "<clipPath id=\"model\"><rect x=\"0\" y=\"{:.1f}\" width=\"{:g}\" height=\"{:.1f}\"/></clipPath>\n<g clip-path=\"url(#model)\" "
      "fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n",
      top, sheet.width(), sheet.height() - top - bottom));
  for (const LineGroup& group : groups)
    sheet.raw(fmt::format("<path data-name=\"{}\" stroke=\"{}\" stroke-width=\"{:.2f}\" d=\"{}\"/>\n", group.name, group.ink.color,
                          group.ink.width, path_of(group.pieces)));
  sheet.raw("</g>\n");
}

std::string arrow_head(double x0, double y0, double x1, double y1, double size) {
  const double length = std::max(1e-9, std::hypot(x1 - x0, y1 - y0)), ex = (x1 - x0) / length, ey = (y1 - y0) / length,
               s = std::min(size, 0.8 * length);
  return fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}L{:.1f} {:.1f}", x1 - s * (0.88 * ex - 0.48 * ey), y1 - s * (0.88 * ey + 0.48 * ex), x1,
                     y1, x1 - s * (0.88 * ex + 0.48 * ey), y1 - s * (0.88 * ey - 0.48 * ex));
}

void put_marks(Sheet& sheet, const Marks& marks, const Projection& projection) {
  if (marks.strokes.empty()) return;
  sheet.raw("<g clip-path=\"url(#model)\" fill=\"none\" stroke-linecap=\"round\" stroke-opacity=\"0.85\">\n");
  for (const Stroke& s : marks.strokes) {
    const Vec3 a = projection.in_camera(s.from), b = projection.in_camera(s.to);
    if (!projection.parallel() && (a.z() < projection.least_depth() || b.z() < projection.least_depth())) continue;
    const Eigen::Vector2d p = projection.see(a).at, q = projection.see(b).at;
    if (!p.allFinite() || !q.allFinite()) continue;
    std::string d = fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", p.x(), p.y(), q.x(), q.y());
    if (s.head) d += arrow_head(p.x(), p.y(), q.x(), q.y(), (5 + 2 * s.width) * sheet.u());
    sheet.raw(fmt::format("<path stroke=\"{}\" stroke-width=\"{:.2f}\" d=\"{}\"/>\n", color_of(s.color), s.width * sheet.u(), d));
  }
  sheet.raw("</g>\n");
}

// Below the model: what the lines mean, and the scale.
void put_legend(Sheet& sheet, const DrawnInstant& d, const Projection& projection) {
  const double u = sheet.u(), y = sheet.height() - 38 * u, low = sheet.height() - 15 * u;
  double x = margin * u;
  sheet.line(x, sheet.height() - foot * u, sheet.width() - x, sheet.height() - foot * u, "#d4d7db", 0.8);
  const auto room = [&](const std::string& text, double size) { return (0.6 * static_cast<double>(text.size()) + 0.7) * size * u; };
  const auto entry = [&](double row, const std::string& color, double width, const std::string& text, bool head = false) {
    sheet.line(x, row - 4 * u, x + 26 * u, row - 4 * u, color, width, " stroke-linecap=\"butt\"");
    if (head)
      sheet.raw(fmt::format("<path fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2f}\" d=\"{}\"/>\n", color, width * u,
                            arrow_head(x, row - 4 * u, x + 26 * u, row - 4 * u, 8 * u)));
    sheet.text(x + 33 * u, row, 12.5, text_color, text);
    return 33 * u + room(text, 12.5) + 14 * u;
  };
  if (!d.solid.joints.empty()) {
    const double first = entry(y, color_of(state_color(JointState::cracked)), 1.6, d.show.mortared ? "cracked joint" : "joint that opened");
    const double second =
        entry(low, color_of(state_color(JointState::open)), 2.4, "open by " + length_text(d.show.open_crack) + " or more");
    x += std::max(first, second);
    sheet.text(x, y, 12.5, text_color, "opening of the joint at this point");
    double at = x;
    for (const double opening : {1e-4, 1e-3, 1e-2, 1e-1}) {
      sheet.line(at, low - 4 * u, at + 20 * u, low - 4 * u, "#5b6168", crack_width(opening));
      const std::string text = length_text(opening);
      sheet.text(at + 26 * u, low, 11.5, quiet_color, text);
      at += 26 * u + room(text, 11.5) + 8 * u;
    }
    x = std::max(at, x + room("opening of the joint at this point", 12.5)) + 10 * u;
  }
  const double ppm = projection.pixels_per_metre(), wish = 110 * u / ppm, ten = std::pow(10.0, std::floor(std::log10(wish)));
  const double length = ten * (wish < 2 * ten   ? 1
                               : wish < 5 * ten ? 2
                                                : 5),
               right = sheet.width() - margin * u, left = right - length * ppm;
  // The lines over the model stand beside those, two below each other; where they would meet the scale, at the upper right instead.
  const std::vector<MarkRow>& rows = d.marks.legend;
  std::vector<double> wide;  // px, of each column
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (const double one = 47 * u + room(rows[i].name, 12.5); i % 2 == 0) wide.push_back(one);
    else wide.back() = std::max(wide.back(), one);
  const bool below = std::accumulate(wide.begin(), wide.end(), x) < left - 20 * u;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!below) x = right - std::ranges::max(wide);
    entry(!below       ? d.look.top + (20 + 20 * static_cast<double>(i)) * u
          : i % 2 == 0 ? y
                       : low,
          color_of(rows[i].color), rows[i].width, rows[i].name, rows[i].head);
    if (below && i % 2 == 1) x += wide[i / 2];
  }
  sheet.line(left, low - 6 * u, right, low - 6 * u, text_color, 1.6);
  for (const double end : {left, right}) sheet.line(end, low - 11 * u, end, low - u, text_color, 1.6);
  sheet.text(0.5 * (left + right), y + 2 * u, 12.5, text_color, length_text(length), "middle");
}

}  // namespace

std::string svg_of(const DrawnInstant& d) {
  Sheet sheet(d.look.width, d.look.height);
  const double u = sheet.u();
  const Camera camera = d.position ? in_scene(d.camera, *d.position) : d.camera;
  const Projection projection(camera, d.parallel, d.look.width, d.look.height, d.look.top, d.look.bottom);
  put_lines(sheet, lines_of(d), d.look.top, d.look.bottom);
  put_marks(sheet, d.marks, projection);
  const std::string when = clock_text(d.run, d.frame.t);
  if (d.look.overlay) {
    std::string name = d.camera.name == "own" ? "" : d.camera.name;
    std::replace(name.begin(), name.end(), '_', ' ');
    if (d.look.magnify != 1) name = fmt::format("displacements x {:g}   {}", d.look.magnify, name);
    sheet.text(margin * u, 34 * u,
               std::min(20.0, (d.look.width / u - 330) / 0.62 / std::max<double>(1, static_cast<double>(d.run.title.size()))), text_color,
               d.run.title, "start", true);
    sheet.text(d.look.width - margin * u, 34 * u, 20, text_color, when, "end", true);
    sheet.text(d.look.width - (margin + 40 + 12 * static_cast<double>(when.size())) * u, 34 * u, 13, quiet_color, name, "end");
    put_legend(sheet, d, projection);
  }
  return sheet.whole(d.run.title + ", " + when, "Outlines of the blocks, and cracks of the joints, as computed by ERBS.");
}

bool make_drawings(const Run& run, const MotionReader& reader, const Movie& wish, const std::atomic<bool>& stop,
                   const std::function<void()>& checked) {
  Movie movie = wish;
  if (movie.stills.empty() && !reader.times().empty()) movie.stills = {reader.times().back()};
  movie.look.coloring = Coloring::material;
  movie.look.top = movie.look.overlay ? overlay_top(movie.look.width, movie.look.height) : 0;
  movie.look.bottom = movie.look.overlay ? foot * overlay_unit(movie.look.width, movie.look.height) : 0;
  const Schedule schedule = schedule_of(movie, reader.times());
  const Look& l = movie.look;
  Scenery scenery(run, reader, movie, l.width / (l.height - l.top - l.bottom), schedule.times);
  scenery.check_eyes(schedule.times);
  const Show show = scenery.show(schedule.times);
  const MotionScene& whole = scenery.excerpt().scene;
  const MotionScene solid = scenery.section() ? cut_scene(whole, *scenery.section(), show.stage.hidden) : whole;
  const fs::path folder = fs::path(run.dir) / "frames";
  std::vector<std::string> paths;
  const auto path_of_still = [&](const Shot& shot, double t) {
    return (folder / fmt::format("{}_t{:.3f}s.svg", file_stem(shot.camera.name), t)).string();
  };
  for (const Shot& shot : scenery.shots())
    for (const double t : schedule.times)
      if (const std::string path = path_of_still(shot, t); !movie.force && fs::exists(path))
        throw Error("it exists already; --force writes it anew", {path, 0});
  if (checked) checked();
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) throw Error("the folder cannot be made; may you write there?", {folder.string(), 0});
  for (const Shot& shot : scenery.shots())
    for (const double t : schedule.times) {
      if (stop) return false;
      const MotionFrame frame = scenery.drawn(t);
      DrawnInstant instant{run, show, solid, l, shot.at(t), shot.camera.name.starts_with("from_"), frame, std::nullopt, scenery.marks(t)};
      if (const auto level = levelling_at(run, show.stage, l, t)) instant.position = table_position(show.stage, *level);
      const std::string path = path_of_still(shot, t), unfinished = path + ".part";
      std::ofstream out(unfinished);
      out << svg_of(instant);
      out.close();
      if (out) fs::rename(unfinished, path, failed);
      if (!out || failed) throw WriteError("it cannot be written; is the disk full?", {path, 0});
      if (!movie.quiet) tell(stdout, "drawing: " + shown(path, 400));
    }
  return true;
}

}  // namespace erbs::render
