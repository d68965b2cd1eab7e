#include "render/overlay.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/units.h"

namespace erbs::render {
namespace {

constexpr Ink text_ink{38, 42, 48, 1}, quiet_ink{95, 102, 110, 1}, panel{250, 251, 252, 0.80}, accent{176, 48, 28, 1};
constexpr double margin = 22;  // of 720 rows, as all lengths here

Ink display(const Vec3& linear) {
  const auto byte = [](double x) { return static_cast<std::uint8_t>(std::lround(255 * std::pow(std::clamp(x, 0.0, 1.0), 1 / 2.2))); };
  return {byte(linear.x()), byte(linear.y()), byte(linear.z()), 1};
}

// The record at time t, linear between its rows and zero outside.
double value_at(const GroundRecord& r, double t) {
  if (r.t.empty() || t < r.t.front() || t > r.t.back()) return 0;
  const auto after = static_cast<std::size_t>(std::upper_bound(r.t.begin(), r.t.end(), t) - r.t.begin());
  if (after == r.t.size()) return r.a.back();
  const double s = (t - r.t[after - 1]) / (r.t[after] - r.t[after - 1]);
  return r.a[after - 1] + s * (r.a[after] - r.a[after - 1]);
}

std::string length_text(double m) {
  return m >= 1 ? fmt::format("{:g} m", m) : m >= 0.01 ? fmt::format("{:g} cm", 100 * m) : fmt::format("{:g} mm", 1000 * m);
}

}  // namespace

double overlay_top(int height) { return 58.0 * height / 720; }
double overlay_bottom(int height, bool with_record) { return (with_record ? 104.0 : 34.0) * height / 720; }

Overlay::Overlay(const Run& run, const Show& show, const Look& look, double slow)
    : run_(run), show_(show), look_(look), slow_(slow), unit_(look.height / 720.0), regular_(Font::Face::regular), bold_(Font::Face::bold) {
  strip_left_ = (margin + 128) * unit_;
  strip_right_ = look.width - (margin + 12) * unit_;
  const GroundRecord& r = run.record;
  end_time_ = r.t.empty() ? 0 : r.t.back();
  if (r.axis.empty() || end_time_ <= 0) return;
  const auto columns = static_cast<std::size_t>(std::max(1.0, strip_right_ - strip_left_));
  const double per_column = end_time_ / static_cast<double>(columns);
  std::size_t row = 0;
  for (std::size_t c = 0; c < columns; ++c) {
    const double t0 = static_cast<double>(c) * per_column, t1 = t0 + per_column;
    const double a0 = value_at(r, t0), a1 = value_at(r, t1);
    Reach reach{std::min(a0, a1), std::max(a0, a1)};
    for (; row < r.t.size() && r.t[row] < t1; ++row)
      if (r.t[row] >= t0) reach = {std::min(reach.low, r.a[row]), std::max(reach.high, r.a[row])};
    strip_.push_back({reach.low / r.peak, reach.high / r.peak});
  }
}

void Overlay::draw(Image& image, double t, const std::string& camera, double pixel) const {
  const double u = unit_, base = 36 * u;
  fill_fade(image, 0, static_cast<int>(60 * u), {250, 251, 252, 0.75}, 0.0);
  const std::string clock = fmt::format("{:.2f} s", t);
  bold_.draw(image, clock, image.width - margin * u, base, 24 * u, text_ink, Font::Align::right);
  std::string beside = camera;
  std::replace(beside.begin(), beside.end(), '_', ' ');
  if (std::abs(slow_ - 1) > 0.02)
    beside += slow_ > 1 ? fmt::format("   slow motion {:.3g} : 1", slow_) : fmt::format("   time lapse 1 : {:.3g}", 1 / slow_);
  // What is beside the clock keeps its place: it ends where the widest clock would begin.
  const double right = image.width - margin * u - bold_.width("00.00 s", 24 * u) - 18 * u;
  regular_.draw(image, beside, right, base, 14 * u, quiet_ink, Font::Align::right);
  // A long title is written smaller, then cut.
  const double room = right - regular_.width(beside, 14 * u) - 2 * margin * u;
  const double size = std::clamp(21 * u * room / std::max(1.0, bold_.width(run_.title, 21 * u)), 13 * u, 21 * u);
  std::string title = run_.title;
  while (bold_.width(title, size) > room && title.size() > 4) {
    const std::size_t space = title.find_last_of(' ', title.size() - 5);
    title = title.substr(0, space == std::string::npos ? 0 : space) + " ...";
  }
  bold_.draw(image, title, margin * u, base, size, text_ink);
  draw_legend(image);
  draw_scale(image, pixel);
  if (!strip_.empty()) draw_record(image, t);
}

void Overlay::draw_record(Image& image, double t) const {
  const double u = unit_, height = 74 * u, bottom = image.height - 14 * u, top = bottom - height, middle = 0.5 * (top + bottom);
  fill_box(image, margin * u, top, image.width - margin * u, bottom, panel);
  const double x = (margin + 14) * u;
  regular_.draw(image, "ground, along " + run_.record.axis, x, top + 21 * u, 12.5 * u, quiet_ink);
  bold_.draw(image, fmt::format("{:+.2f} g", value_at(run_.record, t) / standard_g), x, top + 43 * u, 17 * u, text_ink);
  regular_.draw(image, fmt::format("peak {:.3g} g", run_.record.peak / standard_g), x, top + 62 * u, 12.5 * u, quiet_ink);
  const double half = 0.5 * height - 8 * u, thin = 0.65 * u;
  fill_box(image, strip_left_, middle - 0.5, strip_right_, middle + 0.5, {150, 156, 163, 0.8});
  const double now = strip_left_ + std::clamp(t / end_time_, 0.0, 1.0) * (strip_right_ - strip_left_);
  for (std::size_t c = 0; c < strip_.size(); ++c) {
    const double left = strip_left_ + static_cast<double>(c);
    const Ink ink = left < now ? Ink{48, 60, 76, 1} : Ink{150, 158, 168, 1};
    fill_box(image, left, middle - half * strip_[c].high - thin, left + 1, middle - half * strip_[c].low + thin, ink);
  }
  fill_box(image, now - 0.9 * u, top + 3 * u, now + 0.9 * u, bottom - 3 * u, accent);
  const double at = middle - half * value_at(run_.record, t) / run_.record.peak;
  fill_box(image, now - 3.5 * u, at - 3.5 * u, now + 3.5 * u, at + 3.5 * u, accent);
}

void Overlay::draw_legend(Image& image) const {
  const double u = unit_, right = image.width - margin * u, size = 13 * u;
  double y = 78 * u;
  if (look_.coloring == Coloring::damage) {
    const double width = 150 * u, left = right - width;
    regular_.draw(image, "joint damage", left, y, size, text_ink);
    y += 8 * u;
    for (int c = 0; c < static_cast<int>(width); ++c)
      fill_box(image, left + c, y, left + c + 1, y + 11 * u, display(damage_color(c / width)));
    regular_.draw(image, "intact", left, y + 27 * u, size, quiet_ink);
    regular_.draw(image, "broken", right, y + 27 * u, size, quiet_ink, Font::Align::right);
    return;
  }
  std::vector<bool> used(run_.materials.size());
  for (std::size_t b = 0; b < show_.scene->blocks.size(); ++b) {
    const int m = show_.scene->blocks[b].material;
    if (!show_.stage.hidden[b] && m >= 0 && m < static_cast<int>(used.size())) used[static_cast<std::size_t>(m)] = true;
  }
  std::vector<std::pair<std::string, Ink>> rows;
  for (std::size_t m = 0; m < used.size(); ++m)
    if (used[m] && !run_.materials[m].name.empty()) rows.emplace_back(run_.materials[m].name, display(run_.materials[m].color));
  if (rows.size() > 6) rows.clear();
  if (!show_.scene->joints.empty()) rows.emplace_back("cracked joint", Ink{26, 24, 23, 1});
  for (const auto& [name, ink] : rows) {
    regular_.draw(image, name, right - 20 * u, y + 4.5 * u, size, text_ink, Font::Align::right);
    fill_box(image, right - 12 * u, y - 6 * u, right, y + 6 * u, ink);
    y += 20 * u;
  }
}

void Overlay::draw_scale(Image& image, double pixel) const {
  const double u = unit_, wish = 110 * u * pixel, ten = std::pow(10.0, std::floor(std::log10(wish)));
  const double length = ten * (wish < 2 * ten ? 1 : wish < 5 * ten ? 2 : 5), width = length / pixel;
  const double right = image.width - margin * u, y = image.height - look_.bottom - 8 * u;
  fill_box(image, right - width, y - u, right, y + u, text_ink);
  for (double x : {right - width, right - 1.6 * u}) fill_box(image, x, y - 5 * u, x + 1.6 * u, y + 5 * u, text_ink);
  regular_.draw(image, length_text(length), right - 0.5 * width, y - 9 * u, 13 * u, text_ink, Font::Align::middle);
  regular_.draw(image, "grid " + length_text(show_.grid), right - width - 14 * u, y + 4.5 * u, 12 * u, quiet_ink, Font::Align::right);
}

}  // namespace erbs::render
