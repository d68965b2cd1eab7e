#include "render/draw/overlay.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/units.h"

namespace erbs::render {
namespace {

// "mm/s" of "20 mm/s"
std::string unit_of_number(const std::string& text) { return text.substr(text.find_last_of(' ') + 1); }

// At a share of a scale (Pa); the unit stands at its end only, where there is room.
std::string stress_text(double share, double scale) {
  const bool mega = scale >= 1e5, kilo = scale >= 100;
  return fmt::format("{:.3g}{}", share * scale * (mega ? 1e-6 : kilo ? 1e-3 : 1), share < 1 ? "" : mega ? " MPa" : kilo ? " kPa" : " Pa");
}

// With the prefix that leaves one to three digits before the point.
std::string with_prefix(double value, const char* unit) {
  constexpr std::pair<double, const char*> prefixes[] = {{1e9, "G"},  {1e6, "M"},       {1e3, "k"}, {1, ""},
                                                         {1e-3, "m"}, {1e-6, "\u00b5"}, {1e-9, "n"}};
  for (const auto& [one, prefix] : prefixes)
    if (value >= one * (1 - 1e-9) || one == 1e-9) return fmt::format("{:.3g} {}{}", value / one, prefix, unit);
  return "";
}

const char* quantity_name(Coloring coloring) {
  switch (coloring) {
    case Coloring::displacement:
      return "displacement";
    case Coloring::speed:
      return "speed";
    case Coloring::opening:
      return "largest joint opening";
    case Coloring::slip:
      return "largest joint slip";
    case Coloring::energy:
      return "kinetic energy, log scale";
    case Coloring::normal_stress:
      return "compression in joints";
    case Coloring::shear_stress:
      return "shear stress in joints";
    default:
      return "joints broken or open";
  }
}

}  // namespace

std::string length_text(double m) {
  return m >= 1      ? fmt::format("{:.3g} m", m)
         : m >= 0.01 ? fmt::format("{:.3g} cm", 100 * m)
         : m >= 1e-4 ? fmt::format("{:.3g} mm", 1000 * m)
                     : fmt::format("{:.3g} \u00b5m", 1e6 * m);
}

double legible(double size, double unit) { return std::max(size * unit, std::min(12.5 * unit, 9.4)); }

double overlay_unit(int width, int height) {
  return std::min(std::max(height / 720.0, std::min(0.75, height / 480.0)), std::max(width / 640.0, 0.2));
}
double overlay_top(int width, int height) { return 58.0 * overlay_unit(width, height); }
double overlay_bottom(int width, int height, bool with_record) { return (with_record ? 116.0 : 34.0) * overlay_unit(width, height); }

Overlay::Overlay(const Run& run, const Show& show, const Look& look, const std::string& camera, double slow)
    : run_(run),
      show_(show),
      look_(look),
      camera_(camera),
      slow_(slow),
      unit_(look.unit > 0 ? look.unit : overlay_unit(look.width, look.height)),
      legend_top_(below_title * unit_),
      regular_(Font::Face::regular),
      bold_(Font::Face::bold) {
  std::replace(camera_.begin(), camera_.end(), '_', ' ');
  if (camera_ == "own") camera_.clear();  // a camera given after the run has no name to show
  reduce_record();
}

void Overlay::see(const View& view) {
  turn_ = view.view.topLeftCorner<3, 3>();
  pixel_ = static_cast<double>(view.pixel * view.target_distance);
}

void Overlay::draw_legends(Image& image, const std::vector<MarkRow>& marks) const {
  draw_mark_legend(image, marks, draw_legend(image), border, unit_, regular_);
}

void Overlay::draw_in_tile(Image& image, double t, const View& view) {
  see(view);
  draw_scale(image);
  draw_axes(image, t);
  const double u = unit_, size = 13 * u, width = regular_.width(camera_, size);
  if (camera_.empty()) return;
  fill_box(image, border * u - 10 * u, 12 * u, border * u + width + 10 * u, 36 * u, panel);
  regular_.draw(image, camera_, border * u, 29 * u, size, text_ink);
}

void Overlay::draw_around_tiles(Image& image, double t, const std::vector<MarkRow>& marks, double legend_top) {
  legend_top_ = legend_top;
  draw_title(image, t);
  draw_legends(image, marks);
  if (!strip_.empty()) draw_record(image, t);
}

void Overlay::draw(Image& image, double t, const View& view, const std::vector<MarkRow>& marks) {
  see(view);
  draw_title(image, t);
  draw_legends(image, marks);
  draw_scale(image);
  draw_axes(image, t);
  if (!strip_.empty()) draw_record(image, t);
}

void Overlay::draw_title(Image& image, double t) const {
  const double u = unit_, base = 36 * u;
  fill_fade(image, 0, static_cast<int>(60 * u), {250, 251, 252, 0.75}, 0.0);
  bold_.draw(image, clock_text(run_, t), image.width - border * u, base, 24 * u, text_ink, Font::Align::right);
  std::string beside = run_.status.empty() ? camera_ : run_.status + "   " + camera_;
  if (std::abs(slow_ - 1) > 0.02)
    beside += slow_ > 1 ? fmt::format("   slow motion {:.3g} : 1", slow_) : fmt::format("   time lapse 1 : {:.3g}", 1 / slow_);
  if (!show_.cut.empty()) beside = show_.cut + "   " + beside;
  if (look_.magnify != 1) beside = fmt::format("displacements x {:g}   ", look_.magnify) + beside;
  // Text beside the clock must not move: it ends at the start of the widest clock text.
  const double right = image.width - border * u - bold_.width(widest_clock(run_), 24 * u) - 18 * u;
  regular_.draw(image, beside, right, base, 14 * u, quiet_ink, Font::Align::right);
  // A long title is drawn smaller, then on two lines; what these cannot hold is cut.
  const double room = right - regular_.width(beside, 14 * u) - 2 * border * u;
  const double fitting = 21 * u * room / std::max(1.0, bold_.width(run_.title, 21 * u));
  if (fitting >= 16 * u) {
    bold_.draw(image, run_.title, border * u, base, std::min(fitting, 21 * u), text_ink);
    return;
  }
  const double size = 15 * u;
  const auto cut = [&](std::string text, const char* end) {  // the words that fit
    if (bold_.width(text, size) <= room) return text;
    while (text.size() > 1 && bold_.width(text + end, size) > room) {
      const std::size_t space = text.find_last_of(' ');
      text = text.substr(0, space == std::string::npos ? text.size() - 1 : space);
    }
    return text + end;
  };
  const std::string first = cut(run_.title, "");
  std::string rest = run_.title.substr(first.size());
  rest.erase(0, rest.find_first_not_of(' '));
  bold_.draw(image, first, border * u, base - 10 * u, size, text_ink);
  if (!rest.empty()) bold_.draw(image, cut(rest, " ..."), border * u, base + 10 * u, size, text_ink);
}

// The number at a share of the map, with its unit.
std::string Overlay::map_number(double share) const {
  const double value = share * show_.scale;
  switch (look_.coloring) {
    case Coloring::damage:
      return fmt::format("{:g}{}", 100 * share, share > 0 ? " %" : "");
    case Coloring::energy:
      return with_prefix(show_.scale * std::pow(10.0, energy_decades * (share - 1)), "J");
    case Coloring::normal_stress:
    case Coloring::shear_stress:
      return stress_text(share, show_.scale);
    case Coloring::speed:
      return share == 0 ? "0" : with_prefix(value, "m/s");
    default:
      return share == 0 ? "0" : length_text(value / (look_.coloring == Coloring::displacement ? look_.magnify : 1));
  }
}

double Overlay::draw_map(Image& image) const {
  const double u = unit_, right = image.width - border * u, size = 13 * u, width = 170 * u, left = right - width, y = legend_top_ + 18 * u;
  const char* const remark = is_stress(look_.coloring) && show_.replaced ? "0 at released joints" : "";
  const double small = legible(11, u), wide = std::max(width, regular_.width(remark, small)), more = *remark != '\0' ? 17 * u : 0;
  fill_box(image, right - wide - 10 * u, y - 18 * u, right + 10 * u, y + 36 * u + more, panel);
  regular_.draw(image, remark, right, y + 34 * u + more, small, quiet_ink, Font::Align::right);
  regular_.draw(image, quantity_name(look_.coloring), left, y, size, text_ink);
  for (int c = 0; c < static_cast<int>(width); ++c)
    fill_box(image, left + c, y + 8 * u, left + c + 1, y + 19 * u,
             display(look_.coloring == Coloring::damage ? damage_color(c / width) : map_color(c / width)));
  regular_.draw(image, map_number(0), left, y + 33 * u, size, quiet_ink);
  // What moves more than 98 % of the blocks has the last colour too.
  const std::string end = (look_.coloring == Coloring::damage ? "" : "\u2265 ") + map_number(1), unit = unit_of_number(end);
  std::string half = map_number(0.5);
  const double room = 0.5 * width - regular_.width(end, size) - 6 * u;
  // Where there is no room for the unit, it stands at the end alone; another one there would mislead.
  if (0.5 * regular_.width(half, size) > room) half = unit_of_number(half) == unit ? half.substr(0, half.find(' ')) : "";
  if (0.5 * regular_.width(half, size) > room) half = "";
  regular_.draw(image, half, 0.5 * (left + right), y + 33 * u, size, quiet_ink, Font::Align::middle);
  regular_.draw(image, end, right, y + 33 * u, size, quiet_ink, Font::Align::right);
  return y + 36 * u + more;
}

double Overlay::draw_legend(Image& image) const {
  if (look_.coloring == Coloring::damage || is_quantity(look_.coloring)) return draw_map(image);
  const double u = unit_, right = image.width - border * u, size = 13 * u;
  double y = legend_top_ + 18 * u;
  const bool by_state = look_.coloring == Coloring::joint_state;
  struct Row {
    std::string name;
    Ink ink;
    double half;  // height of its sample
  };
  std::vector<bool> used(run_.materials.size());
  for (std::size_t b = 0; b < show_.scene->blocks.size(); ++b) {
    const int m = show_.scene->blocks[b].material;
    if (!show_.stage.hidden[b] && m >= 0 && m < static_cast<int>(used.size())) used[static_cast<std::size_t>(m)] = true;
  }
  std::vector<Row> rows;
  for (std::size_t m = 0; m < used.size(); ++m)
    if (used[m] && !run_.materials[m].name.empty()) rows.push_back({run_.materials[m].name, display(run_.materials[m].color), 6});
  if (by_state) rows.clear();
  if (const std::size_t more = rows.size(); more > 6) {
    rows.resize(5);
    rows.push_back({fmt::format("and {} more materials", more - 5), {0, 0, 0, 0}, 0});
  }
  const std::string wide = "open by " + length_text(show_.open_crack / (by_state ? 1 : look_.magnify)) + " or more";
  if (by_state) {
    rows.push_back({"intact joint", display(state_color(JointState::intact)), 2});
    rows.push_back({"damaged joint", display(state_color(JointState::cracked)), 2});
    rows.push_back({wide, display(state_color(JointState::open)), 2});
  } else if (!show_.scene->joints.empty()) {
    rows.push_back({show_.mortared ? "cracked joint" : "joint that opened", {82, 72, 66, 1}, 0.8});
    rows.push_back({wide, {20, 18, 18, 1}, 1.6});
  }
  double widest = 0;
  for (const Row& row : rows) widest = std::max(widest, regular_.width(row.name, size));
  if (!rows.empty())
    fill_box(image, right - 30 * u - widest, y - 14 * u, right + 10 * u, y + (20 * static_cast<double>(rows.size()) - 6) * u, panel);
  for (const Row& row : rows) {
    regular_.draw(image, row.name, right - 20 * u, y + 4.5 * u, size, text_ink, Font::Align::right);
    fill_box(image, right - 12 * u, y - row.half * u, right, y + row.half * u, row.ink);
    y += 20 * u;
  }
  return y - 6 * u;
}

void Overlay::draw_scale(Image& image) const {
  const double u = unit_, wish = 110 * u * pixel_, ten = std::pow(10.0, std::floor(std::log10(wish)));
  const double length = ten * (wish < 2 * ten ? 1 : wish < 5 * ten ? 2 : 5), width = length / pixel_;
  const double right = image.width - border * u, y = image.height - look_.bottom - 14 * u;
  const bool lines = show_.stage.on_ground || (show_.stage.positions.empty() && !show_.stage.bounded);
  const std::string grid = lines ? "grid " + length_text(show_.grid) : "";
  fill_box(image, right - width - 34 * u - regular_.width(grid, 12 * u), y - 26 * u, right + 10 * u, y + 10 * u, panel);
  fill_box(image, right - width, y - u, right, y + u, text_ink);
  for (double x : {right - width, right - 1.6 * u}) fill_box(image, x, y - 5 * u, x + 1.6 * u, y + 5 * u, text_ink);
  regular_.draw(image, length_text(length), right - 0.5 * width, y - 9 * u, 13 * u, text_ink, Font::Align::middle);
  regular_.draw(image, grid, right - width - 14 * u, y + 4.5 * u, 12 * u, quiet_ink, Font::Align::right);
}

// Axes of the scene as the camera sees them. The axis of shaking has arrows at both ends; gravity has one where a test tilts.
void Overlay::draw_axes(Image& image, double t) const {
  const double u = unit_, length = 30 * u;
  const bool tilting = !run_.gravity.empty(), shaking = !run_.record.axis.empty();
  const Mat3 level = look_.table_turns ? levelling(run_.gravity, t) : Mat3(Mat3::Identity());
  struct Arrow {
    Eigen::Vector2d end;  // px, from the origin; rows count downwards
    std::string name;
    bool shaken;
  };
  std::vector<Arrow> arrows;
  const auto add = [&](const Vec3& direction, const std::string& name, bool shaken) {
    const Eigen::Vector3d seen = (turn_ * (level * direction).cast<float>()).cast<double>();
    arrows.push_back({length * Eigen::Vector2d(seen.x(), -seen.y()), name, shaken});
  };
  for (int i = 0; i < 3; ++i) {
    const std::string name(1, "xyz"[i]);
    add(Vec3::Unit(i), name, name == run_.record.axis);
  }
  if (shaking && run_.record.axis.size() > 1) add(run_.record.direction, "", true);
  if (tilting) add(gravity_at(run_.gravity, t).normalized(), "g", false);
  // The panel is as large as what it holds; where a table turns, as what it may hold.
  Eigen::AlignedBox2d held(Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero());
  for (const Arrow& a : arrows) {
    const Eigen::Vector2d letter = a.end + 8 * u * a.end.normalized(), half(5 * u, 7 * u);
    held.extend(Eigen::AlignedBox2d(letter - half, letter + half));
    if (a.shaken) held.extend(Eigen::Vector2d(-a.end));
  }
  const Eigen::Vector2d around = Eigen::Vector2d::Constant(length + 13 * u);
  if (tilting) held = {-around, around};
  const double wide = std::max(held.sizes().x(), shaking ? regular_.width("shaking", 11.5 * u) : 0.0);
  const double pad = 6 * u, left = border * u, right = left + wide + 2 * pad, bottom = image.height - look_.bottom - 2 * u;
  const double x = 0.5 * (left + right) - held.center().x(), y = bottom - pad - (shaking ? 14 * u : 0) - held.max().y();
  fill_box(image, left, y + held.min().y() - pad, right, bottom, panel);
  for (const Arrow& a : arrows) {
    const Ink ink = a.shaken ? accent : quiet_ink;
    const double seen = a.end.norm(), width = (a.shaken ? 2.4 : 1.5) * u, head = 6 * u;
    const Eigen::Vector2d from = a.shaken ? Eigen::Vector2d(-a.end) : Eigen::Vector2d::Zero(), along = a.end / std::max(seen, 1e-9);
    draw_line(image, x + from.x(), y + from.y(), x + a.end.x(), y + a.end.y(), width, ink);
    if (seen < 0.25 * length) continue;  // along the view: no room for an arrow and a letter
    for (const double end : {1.0, -1.0}) {
      if (end < 0 && !a.shaken) continue;
      for (const double side : {1.0, -1.0}) {
        const Eigen::Vector2d tip = end * a.end,
                              barb = tip - end * head * (0.85 * along + side * 0.55 * Eigen::Vector2d(along.y(), -along.x()));
        draw_line(image, x + tip.x(), y + tip.y(), x + barb.x(), y + barb.y(), width, ink);
      }
    }
    regular_.draw(image, a.name, x + a.end.x() + 8 * u * along.x(), y + a.end.y() + 8 * u * along.y() + 4 * u, 12 * u, ink,
                  Font::Align::middle);
  }
  if (shaking) regular_.draw(image, "shaking", 0.5 * (left + right), bottom - pad, 11.5 * u, accent, Font::Align::middle);
}

}  // namespace erbs::render
