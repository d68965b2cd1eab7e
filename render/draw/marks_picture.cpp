#include "render/draw/marks_picture.h"

#include <algorithm>
#include <cmath>

namespace erbs::render {
namespace {

constexpr Ink halo{255, 255, 255, 0.62};

struct Line {
  double x0, y0, x1, y1;
};

// Two strokes back from the tip.
std::array<Line, 2> head_of(const Line& l, double size) {
  const double length = std::max(1e-9, std::hypot(l.x1 - l.x0, l.y1 - l.y0)), ex = (l.x1 - l.x0) / length, ey = (l.y1 - l.y0) / length;
  const double s = std::min(size, 0.8 * length);
  return {{{l.x1, l.y1, l.x1 - s * (0.88 * ex - 0.48 * ey), l.y1 - s * (0.88 * ey + 0.48 * ex)},
           {l.x1, l.y1, l.x1 - s * (0.88 * ex + 0.48 * ey), l.y1 - s * (0.88 * ey - 0.48 * ex)}}};
}

}  // namespace

Ink display(const Vec3& linear) {
  const auto byte = [](double x) { return static_cast<std::uint8_t>(std::lround(255 * std::pow(std::clamp(x, 0.0, 1.0), 1 / 2.2))); };
  return {byte(linear.x()), byte(linear.y()), byte(linear.z()), 1};
}

void draw_marks(Image& image, const Marks& marks, const View& view, double unit) {
  const Eigen::Matrix4d camera = (view.projection * view.view).cast<double>();
  std::vector<Line> lines;
  for (const Stroke& s : marks.strokes) {
    Eigen::Vector4d a = camera * s.from.homogeneous(), b = camera * s.to.homogeneous();
    const double least = 0.02 * static_cast<double>(view.target_distance);
    if (!(a.w() > least && b.w() > least)) {  // behind the eye
      lines.push_back({NAN, NAN, NAN, NAN});
      continue;
    }
    const auto x = [&](const Eigen::Vector4d& p) { return 0.5 * (p.x() / p.w() + 1) * image.width; };
    const auto y = [&](const Eigen::Vector4d& p) { return 0.5 * (1 - p.y() / p.w()) * image.height; };
    lines.push_back({x(a), y(a), x(b), y(b)});
  }
  const auto draw = [&](bool around, const auto& ink_of) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const Line& l = lines[i];
      const Stroke& s = marks.strokes[i];
      const double far = 4.0 * (image.width + image.height);
      if (!(std::fabs(l.x0) < far && std::fabs(l.y0) < far && std::fabs(l.x1) < far && std::fabs(l.y1) < far)) continue;
      const double width = (s.width + (around ? std::min(2.0, 0.4 + 0.7 * s.width) : 0)) * unit;
      draw_line(image, l.x0, l.y0, l.x1, l.y1, width, ink_of(s));
      if (s.head)
        for (const Line& h : head_of(l, (5 + 2 * s.width) * unit)) draw_line(image, h.x0, h.y0, h.x1, h.y1, width, ink_of(s));
    }
  };
  draw(true, [](const Stroke&) { return halo; });
  draw(false, [](const Stroke& s) { return display(s.color); });
}

void draw_mark_legend(Image& image, const std::vector<MarkRow>& rows, double top, double margin, double unit, const Font& font) {
  if (rows.empty()) return;
  const double u = unit, right = image.width - margin * u, size = 13 * u, sample = 34 * u;
  double widest = 0;
  for (const MarkRow& row : rows) widest = std::max(widest, font.width(row.name, size));
  double y = top + 24 * u;
  fill_box(image, right - sample - 20 * u - widest, y - 14 * u, right + 10 * u, y + (20 * static_cast<double>(rows.size()) - 6) * u, panel);
  for (const MarkRow& row : rows) {
    font.draw(image, row.name, right - sample - 8 * u, y + 4.5 * u, size, text_ink, Font::Align::right);
    const Line l{right - sample, y, right - (row.head ? 2 * u : 0), y};
    const double half = std::max(0.5, 0.5 * row.width * u);
    if (row.width > 0 && !row.head) fill_box(image, l.x0, y - half, l.x1, y + half, display(row.color));
    if (row.head) {
      draw_line(image, l.x0, l.y0, l.x1, l.y1, row.width * u, display(row.color));
      for (const Line& h : head_of(l, 9 * u)) draw_line(image, h.x0, h.y0, h.x1, h.y1, row.width * u, display(row.color));
    }
    y += 20 * u;
  }
}

}  // namespace erbs::render
