// The strip below pictures: the ground motion or the tilt over the whole run, with the events, and where the picture lies.
#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/units.h"
#include "render/draw/overlay.h"

namespace erbs::render {
namespace {

// The record at time t: linear between rows, zero outside.
double value_at(const GroundRecord& r, double t) {
  if (r.t.empty() || t < r.t.front() || t > r.t.back()) return 0;
  const auto after = static_cast<std::size_t>(std::upper_bound(r.t.begin(), r.t.end(), t) - r.t.begin());
  if (after == r.t.size()) return r.a.back();
  const double s = (t - r.t[after - 1]) / (r.t[after] - r.t[after - 1]);
  return r.a[after - 1] + s * (r.a[after] - r.a[after - 1]);
}

}  // namespace

// To the extremes of each column of pixels.
void Overlay::reduce_record() {
  strip_left_ = (border + 128) * unit_;
  strip_right_ = look_.width - (border + 12) * unit_;
  const GroundRecord& r = run_.strip();
  end_time_ = r.t.empty() ? 0 : r.t.back();
  if (r.axis.empty() || end_time_ <= 0) return;
  const auto columns = static_cast<std::size_t>(std::max(1.0, strip_right_ - strip_left_));
  const double per_column = end_time_ / static_cast<double>(columns);
  std::size_t row = 0;
  for (std::size_t c = 0; c < columns; ++c) {
    const double t0 = static_cast<double>(c) * per_column, t1 = std::min(t0 + per_column, end_time_);
    const double a0 = value_at(r, t0), a1 = value_at(r, t1);
    Reach reach{std::min(a0, a1), std::max(a0, a1)};
    for (; row < r.t.size() && r.t[row] < t1; ++row)
      if (r.t[row] >= t0) reach = {std::min(reach.low, r.a[row]), std::max(reach.high, r.a[row])};
    strip_.push_back(reach);
    range_ = {std::min(range_.low, reach.low), std::max(range_.high, reach.high)};
  }
}

double Overlay::column(double t) const { return strip_left_ + std::clamp(t / end_time_, 0.0, 1.0) * (strip_right_ - strip_left_); }

void Overlay::draw_record(Image& image, double t) const {
  const double u = unit_, height = 88 * u, bottom = image.height - 14 * u, top = bottom - height;
  fill_box(image, border * u, top, image.width - border * u, bottom, panel);
  const double x = (border + 14) * u;
  const GroundRecord& r = run_.strip();
  const bool tilting = run_.record.axis.empty();
  const double one = tilting ? 1 : standard_g;
  const char* unit = tilting ? "\u00b0" : " g";
  const auto fitted = [&](const std::string& text, double y) {
    const double size = 12.5 * u, room = strip_left_ - x - 8 * u;
    regular_.draw(image, text, x, y, size * std::min(1.0, room / std::max(1.0, regular_.width(text, size))), quiet_ink);
  };
  const double higher = tilting ? 0 : 5 * u;  // four rows of text in place of three
  fitted((tilting ? "tilt, about " : r.axis.size() > 1 ? "along " : "ground, along ") + r.axis, top + 25 * u - higher);
  const double now_shown = std::round(100 * value_at(r, t) / one) / 100 + 0.0;  // no -0.00
  bold_.draw(image, fmt::format("{:+.2f}{}", now_shown, unit), x, top + 49 * u - higher, 17 * u, text_ink);
  const std::string peak = fmt::format("{:.3g}{}", r.peak / one, unit);
  fitted(!tilting ? "peak shown" : (run_.multipliers.empty() ? "peak " : "stood at ") + peak, top + 71 * u - 2 * higher);
  if (!tilting) fitted(peak, top + 78 * u);  // rows may miss that of the wave
  const double upper = top + (run_.marks.empty() ? 6 : 18) * u, lower = bottom - 19 * u, thin = 0.65 * u, now = column(t);
  const auto row = [&](double value) { return upper + (lower - upper) * (range_.high - value) / (range_.high - range_.low); };
  fill_box(image, strip_left_, row(0) - 0.5, strip_right_, row(0) + 0.5, {150, 156, 163, 0.8});
  for (std::size_t c = 0; c < strip_.size(); ++c) {
    const double left = strip_left_ + static_cast<double>(c);
    const Ink ink = left < now ? Ink{48, 60, 76, 1} : Ink{150, 158, 168, 1};
    fill_box(image, left, row(strip_[c].high) - thin, left + 1, row(strip_[c].low) + thin, ink);
  }
  fill_box(image, now - 0.9 * u, top + 3 * u, now + 0.9 * u, lower + 3 * u, accent);
  const double at = row(value_at(r, t));
  fill_box(image, now - 3.5 * u, at - 3.5 * u, now + 3.5 * u, at + 3.5 * u, accent);
  draw_times(image, top, lower + 2 * u, now);  // names lie over the cursor
}

// Seconds, or states of a push, below the strip, and event names above it.
void Overlay::draw_times(Image& image, double top, double bottom, double now) const {
  const bool states = !run_.multipliers.empty() && run_.state_dt > 0;
  const double u = unit_, one = states ? run_.state_dt : 1, step = round_length(end_time_ / one * 110 * u / (strip_right_ - strip_left_));
  const double last_state = states ? one * (static_cast<double>(run_.multipliers.size()) - 1) : end_time_;  // a fall may follow
  const auto label = [&](const std::string& text, double x, Font::Align align) {
    const double size = legible(11, u), base = bottom + std::max(14 * u, 4 * u + 0.9 * size);  // clear of the tick
    regular_.draw(image, text, x, base, size, quiet_ink, align);
  };
  if (column(end_time_) - column(last_state) > 60 * u) label("fall", 0.5 * (column(end_time_) + column(last_state)), Font::Align::middle);
  for (int i = 0; i * step * one <= std::min(last_state, end_time_) * (1 + 1e-9); ++i) {
    const double x = column(i * step * one);
    fill_box(image, x - 0.5 * u, bottom, x + 0.5 * u, bottom + 3 * u, quiet_ink);
    const Font::Align align = x + 14 * u > strip_right_ ? Font::Align::right : Font::Align::middle;
    label(fmt::format("{}{:g}{}", states && i == 0 ? "state " : "", i * step, states ? "" : " s"), x, align);
  }
  double last = strip_left_;  // end of the previous name
  for (const Mark& mark : run_.marks) {
    if (mark.t > end_time_) continue;
    const double x = column(mark.t), size = legible(11.5, u), width = regular_.width(mark.name, size);
    const Ink ink = x <= now + 0.5 ? text_ink : quiet_ink;
    fill_box(image, x - 0.6 * u, top + 4 * u, x + 0.6 * u, bottom, ink);
    // The first name stands before its line and later names behind theirs, if there is room.
    const bool before = (&mark == &run_.marks.front() || x + width + 5 * u > strip_right_) && x - width - 5 * u > last;
    const double left = before ? x - 5 * u - width : x + 5 * u;
    // A name that would reach over the next line is left out: the later event matters more.
    const Mark* next = &mark == &run_.marks.back() ? nullptr : &mark + 1;
    if (!before && next && next->t <= end_time_ && left + width > column(next->t)) continue;
    if (now > left - 3 * u && now < left + width + 3 * u)
      fill_box(image, left - 2 * u, top + 2 * u, left + width + 2 * u, top + 16 * u, {250, 251, 252, 0.9});
    regular_.draw(image, mark.name, before ? x - 5 * u : x + 5 * u, top + 13 * u, size, ink,
                  before ? Font::Align::right : Font::Align::left);
    last = before ? x : x + 5 * u + width;
  }
}

}  // namespace erbs::render
