// The figure of a limit analysis: two panels of equal scale, the thrusts in the joints and the mechanism.
#include <algorithm>
#include <cmath>

#include "engine/analysis/limit/report.h"
#include "engine/base/count.h"
#include "engine/base/units.h"
#include "engine/record/plot/figure.h"

namespace erbs::analysis {
namespace {

// The plane that is drawn: along the push (to the right) and up.
struct DrawnPlane {
  Vec3 right, up, towards;  // towards: the eye
  Eigen::Vector2d flat(const Vec3& p) const { return {right.dot(p), up.dot(p)}; }
};

DrawnPlane drawn_plane(const LimitLoad& load, const Model& m) {
  DrawnPlane v;
  v.up = m.gravity.norm() > 0 ? Vec3(-m.gravity.normalized()) : Vec3(Vec3::UnitZ());
  v.right = load.direction - load.direction.dot(v.up) * v.up;
  if (v.right.norm() < 1e-6) v.right = Vec3::UnitX() - v.up.x() * v.up;
  v.right.normalize();
  v.towards = v.right.cross(v.up);
  return v;
}

// Corners of the outline of a part, counter-clockwise (monotone chain, Andrew 1979).
std::vector<Eigen::Vector2d> outline(std::vector<Eigen::Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
  std::vector<Eigen::Vector2d> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t floor = hull.size();
    for (const auto& p : points) {
      while (hull.size() >= floor + 2) {
        const Eigen::Vector2d a = hull.back() - hull[hull.size() - 2], b = p - hull.back();
        if (a.x() * b.y() - a.y() * b.x() > 0) break;
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

std::string rows_of(const std::vector<Eigen::Vector2d>& corners) {
  std::string text;
  for (const auto& c : corners) text += fmt::format("{:.6g} {:.6g}\n", c.x(), c.y());
  return text.empty() ? text : text + fmt::format("{:.6g} {:.6g}\n\n", corners.front().x(), corners.front().y());
}

// Where a material point of a block lies in a pose.
Vec3 place_of(const Model& m, const BlockPoses& pose, int b, const Vec3& at) {
  const Vec3 moved = pose.u[z(b)];
  const Quat attitude = pose.q[z(b)];
  return m.rest[z(b)] + moved + attitude * (at - m.rest[z(b)]);
}

struct Bounds {
  Eigen::Vector2d low{1e300, 1e300}, high{-1e300, -1e300};
  void add(const Eigen::Vector2d& p) { low = low.cwiseMin(p), high = high.cwiseMax(p); }
};

// Outlines of the blocks of one kind at their displaced places.
std::string outlines(const Model& m, const DrawnPlane& plane, const BlockPoses& pose, bool moving, Bounds& bounds) {
  std::string text;
  for (int b = 0; b < m.nblock; ++b) {
    if ((m.kind[z(b)] == Kind::moving) != moving) continue;
    for (const Polyhedron& part : m.parts[z(b)]) {
      std::vector<Eigen::Vector2d> flat;
      for (const Vec3& v : part.vertices) flat.push_back(plane.flat(place_of(m, pose, b, v)));
      if (moving)
        for (const auto& p : flat) bounds.add(p);
      text += rows_of(outline(flat));
    }
  }
  return text;
}

// Two lines of a segment through `at` along `force`, `length` long; and the points through which blocks of two joints pass their thrust.
std::string thrust_rows(const LimitResult& r, const Model& m, const DrawnPlane& plane, double longest) {
  const std::vector<Thrust> all = thrusts(r, m);
  std::vector<std::vector<int>> pressed(z(m.nblock));
  double most = 1e-300;
  for (const Thrust& one : all) most = std::max(most, one.force.norm());
  std::string text;
  for (int j = 0; j < m.njoint; ++j) {
    const Thrust& one = all[z(j)];
    if (one.force.norm() < 1e-3 * most) continue;
    pressed[z(m.joint[z(j)].a)].push_back(j), pressed[z(m.joint[z(j)].b)].push_back(j);
    const Vec3 half = 0.5 * longest * std::sqrt(one.force.norm() / most) * one.force.normalized();
    const auto from = plane.flat(one.at - half), to = plane.flat(one.at + half);
    text += fmt::format("{:.6g} {:.6g}\n{:.6g} {:.6g}\n\n", from.x(), from.y(), to.x(), to.y());
  }
  // an arch or a column: every block passes its thrust from one joint to the next
  bool chain = true;
  for (int b = 0; b < m.nblock; ++b) chain = chain && (m.kind[z(b)] != Kind::moving || pressed[z(b)].size() <= 2);
  for (int b = 0; chain && b < m.nblock; ++b) {
    if (m.kind[z(b)] != Kind::moving || pressed[z(b)].size() != 2) continue;
    const auto from = plane.flat(all[z(pressed[z(b)][0])].at), to = plane.flat(all[z(pressed[z(b)][1])].at);
    text += fmt::format("{:.6g} {:.6g}\n{:.6g} {:.6g}\n\n", from.x(), from.y(), to.x(), to.y());
  }
  return text;
}

// Places of the joints of one kind, displaced with their block a.
std::string joint_rows(const LimitMechanism& found, const Model& m, const DrawnPlane& plane, const BlockPoses& pose, Movement kind) {
  std::string text;
  for (const MovedJoint& one : found.joints.moved) {
    if (one.kind != kind) continue;
    const int a = m.joint[z(one.joint)].a;
    const Vec3 at(one.at[0], one.at[1], one.at[2]);
    const auto p = plane.flat(place_of(m, pose, a, at));
    text += fmt::format("{:.6g} {:.6g}\n", p.x(), p.y());
  }
  return text;
}

double mean_size(const Model& m) {
  double sum = 0;
  for (int b = 0; b < m.nblock; ++b) sum += m.kind[z(b)] == Kind::moving ? m.smallest_edge[z(b)] : 0;
  return sum / double(std::max<std::ptrdiff_t>(1, std::count(m.kind.begin(), m.kind.end(), Kind::moving)));
}

std::string multiplier_text(const LimitResult& r) {
  if (!r.stands) return fmt::format("does not stand: carries {:.3g} of its constant load", r.standing_share);
  std::string text = fmt::format("associated {:.4f}", r.associated.middle());
  if (r.has_nonassociated) text += fmt::format(", non-associated {:.4f}", r.nonassociated.middle());
  return text;
}

}  // namespace

void draw_limit(const LimitResult& r, const LimitLoad& load, const Model& m, const std::string& title, const std::string& path) {
  const DrawnPlane plane = drawn_plane(load, m);
  Bounds bounds;
  const BlockPoses still = poses_of(r, m, 0);
  plot::Figure figure;
  const std::string ground = figure.add_rows(outlines(m, plane, still, false, bounds) + "nan nan\n");  // there may be no ground
  const std::string blocks = figure.add_rows(outlines(m, plane, still, true, bounds));
  const Eigen::Vector2d size = bounds.high - bounds.low;
  const BlockPoses pose = poses_of(r, m, 0.05 * size.maxCoeff());
  const std::string moved = figure.add_rows(outlines(m, plane, pose, true, bounds));
  const LimitMechanism found = limit_mechanism(r, m);
  const double margin = 0.06 * size.maxCoeff();
  const Eigen::Vector2d low = bounds.low.array() - margin, high = bounds.high.array() + margin;
  const std::string x_range = fmt::format("[{:.6g}:{:.6g}]", low.x(), high.x()),
                    y_range = fmt::format("[{:.6g}:{:.6g}]", low.y(), high.y());
  const double share = std::clamp((high.y() - low.y()) / (high.x() - low.x()), 0.3, 2.0);
  const double side = share > 1.2 ? 480 : 620, top = 92, foot = 84, left = 76;  // px
  figure.width = 2 * (side + left) + 30, figure.height = side * share + top + foot;
  figure.grid = "";
  const double w = figure.width, h = figure.height;
  figure.labels = {{title, fmt::format("screen 0.5,{:.5f}", 1 - 22 / h), "center font ',16'"},
                   {multiplier_text(r), fmt::format("screen 0.5,{:.5f}", 1 - 46 / h), "center"}};
  const std::string line = "lines lw 1 lc rgb ";
  for (int i = 0; i < 2; ++i) {
    plot::Panel panel;
    const double from = i * (side + left + 15) + left;
    panel.axes = {from / w, (from + side) / w, foot / h, 1 - top / h};
    panel.x = {load.tilt ? "towards the side that goes down (m)" : "along the push (m)", x_range, "", "", ""};
    panel.y = {i == 0 ? "height (m)" : "", y_range, "", "", ""};
    panel.settings = "set size ratio -1\n";
    panel.labels = {{i == 0 ? "thrust in the joints" : found.kind, "graph 0.5, 1.03", "center"}};
    panel.series = {{ground + " using 1:2", "filledcurves closed lc rgb '#dddddd'"}, {ground + " using 1:2", line + "'#999999'"}};
    if (i == 0) {
      panel.series.push_back({blocks + " using 1:2", line + "'#b5a089'"});
      const std::string rows = thrust_rows(r, m, plane, 0.8 * mean_size(m));
      if (!rows.empty()) panel.series.push_back({figure.add_rows(rows) + " using 1:2", "lines lw 2 lc rgb '#c02020'"});
    } else {
      panel.series.push_back({blocks + " using 1:2", line + "'#dccfbf'"});
      panel.series.push_back({moved + " using 1:2", line + "'#5a4630'"});
      panel.key = fmt::format("at screen {:.5f}, screen {:.5f} right center horizontal", (from + side) / w, 14 / h);
      const auto add = [&](Movement kind, const char* style, const char* words) {
        const std::string rows = joint_rows(found, m, plane, pose, kind);
        if (!rows.empty()) panel.series.push_back({figure.add_rows(rows) + " using 1:2", std::string("points ") + style, words});
      };
      add(Movement::slide, "pt 4 ps 0.9 lw 1.5 lc rgb '#1060c0'", "slides");
      add(Movement::hinge, "pt 7 ps 0.8 lc rgb '#c02020'", "opens");
      add(Movement::part, "pt 8 ps 0.9 lw 1.5 lc rgb '#209020'", "parts");
    }
    figure.panels.push_back(panel);
  }
  plot::draw(figure, path);
}

}  // namespace erbs::analysis
