#include "engine/contact/law/impact_bound.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

#include "engine/contact/law/frame.h"
#include "engine/model/joint_pack.h"

namespace erbs {
namespace {

// Event rate (`event_bound.h`) of a spring of stiffness k (N/m) that opens or closes at `speed` (m/s) after the distance `left` (m).
double event_rate(double k, double speed, double left, const PairFrame& s, const ContactSettings& settings) {
  if (!(settings.event_budget > 0 && speed > 0)) return 0;
  const double own = 0.5 * speed * speed / (s.other_block->inverse_mass + s.reference_block->inverse_mass);
  const double budget =
      speed > settings.reference_speed ? std::min(settings.event_budget, settings.blow_share * own) : settings.event_budget;
  left -= speed * settings.horizon;
  return std::min(speed * std::sqrt(event_share * k / budget), left > 0 ? event_steps * speed / left : 1e300);
}

// Rates of both bodies if a face lands on the other, of which at most `share` presses before the next evaluation. The patch is within a
// face of either body and at most as large as that share of the smaller face; all of this bounds the rates. A part of a face may be at its
// edge, at the distance `reach` from the centroid.
void face_impact_omega2(const ContactPair& pair, const PairFrame& s, double share, PairResult& result) {
  const double k = (pair.law.kn + pair.law.ks) * std::min(s.reference->largest_face, s.other->largest_face);
  // for a face about the centroid above it: Int r^2 dA / A is at most reach^2 / 3 for a rectangle
  const auto rate = [&](const ContactBlock& block, const ContactShape& part) {
    const double by_area = k * (block.inverse_mass + part.reach * part.reach / 3 * block.inverse_inertia);
    const double by_part = share * k * (block.inverse_mass + part.reach * part.reach * block.inverse_inertia);
    const double by_face = pair.law.kn * part.face_across + pair.law.ks * part.face_along;
    return std::min({by_area, by_part, by_face > 0 ? by_face : by_area});
  };
  const double other = rate(*s.other_block, *s.other), reference = rate(*s.reference_block, *s.reference);
  result.impact_omega2_a = pair.b_is_reference ? other : reference;
  result.impact_omega2_b = pair.b_is_reference ? reference : other;
}

// A separating feature: a face of the reference, a face of the other body, or a plane along an edge of each.
struct SeparatingFeature {
  enum Kind { face, other_face, edges } kind;
  std::size_t face_or_a, b;
};
SeparatingFeature separating_feature(int separating_axis, const PairFrame& s) {
  const std::size_t at = std::size_t(separating_axis), own = s.reference->normal.size(), faces = own + s.other->normal.size();
  if (at < own) return {SeparatingFeature::face, at, 0};
  if (at < faces) return {SeparatingFeature::other_face, at - own, 0};
  const std::size_t edges = s.other->edge.size();
  return {SeparatingFeature::edges, (at - faces) / edges, (at - faces) % edges};
}

// Approach of two bodies, along the normal of the separating face if there is one. A body that flies off strikes nothing, and nor do
// neighbours that turn together: what counts is the motion of one body as seen from the other.
struct Approach {
  SeparatingFeature::Kind by = SeparatingFeature::edges;
  Vec3 n = Vec3::Zero();  // unit, from the reference to the other; zero: unknown
  double apart = 0, along = 0;
};

// m/s, of the centroid of the other body as seen from a body that has the spin `w` (rad/s) of one of the two.
Vec3 speed_seen(const PairFrame& s, const Vec3& w) {
  const ContactBlock &r = *s.reference_block, &o = *s.other_block;
  return (o.v - r.v) - w.cross((o.rest - r.rest) + (o.u - r.u));
}

// Least and greatest n . x over the corners of a body.
struct Extent {
  double least, most;
};
Extent extent(const SmallShape& body, const Vec3& n) {
  double x[few];
  for (int i = 0; i < few; ++i) x[i] = n[0] * body.vertex[0][i] + n[1] * body.vertex[1][i] + n[2] * body.vertex[2][i];
  Extent e{x[0], x[0]};
  for (int i = 1; i < few; ++i) e.least = std::min(e.least, x[i]), e.most = std::max(e.most, x[i]);
  return e;
}

bool corners_known(const PairFrame& s) { return s.reference->small.faces > 0 && s.other->small.faces > 0; }

// Approach by the feature `separating_axis`; `apart` is set only if all corners are known.
Approach approach(int separating_axis, const PairFrame& s) {
  constexpr double parallel = 1e-6;
  const ContactShape &reference = *s.reference, &other = *s.other;
  const ContactBlock &r = *s.reference_block, &o = *s.other_block;
  const SeparatingFeature by = separating_feature(separating_axis, s);
  const Vec3 between = (o.rest - r.rest) + (o.u - r.u), v = speed_seen(s, by.kind == SeparatingFeature::other_face ? o.w : r.w);
  const bool measured = corners_known(s);
  Approach way{by.kind, Vec3::Zero(), 0, v.norm()};
  if (by.kind == SeparatingFeature::face) {
    way.n = r.rotation * reference.normal[by.face_or_a];
    if (measured)
      way.apart = extent(other.small, o.rotation.transpose() * way.n).least + way.n.dot(between) - reference.offset[by.face_or_a];
    way.along = -v.dot(way.n);
  } else if (by.kind == SeparatingFeature::other_face) {
    const Vec3 n = o.rotation * other.normal[by.face_or_a];
    if (measured) way.apart = extent(reference.small, r.rotation.transpose() * n).least - n.dot(between) - other.offset[by.face_or_a];
    way.along = v.dot(n);
    way.n = -n;
  } else if (measured) {
    Vec3 n = (r.rotation * reference.edge[by.face_or_a]).cross(o.rotation * other.edge[by.b]);
    const double sine = n.norm();
    if (sine < parallel) return way;
    n /= sine;
    const Extent one = extent(reference.small, r.rotation.transpose() * n), two = extent(other.small, o.rotation.transpose() * n);
    const double gap = n.dot(between), above = two.least + gap - one.most, below = one.least - (two.most + gap);
    way.n = above > below ? n : Vec3(-n);
    way.apart = std::max(above, below);
  }
  return way;
}

// Keeps the three least heights, in order.
void lower(double x, double low[3]) {
  for (int k = 0; k < 3; ++k)
    if (x < low[k]) std::swap(x, low[k]);
}

// Share of a face that presses once a body has sunk in by `depth` along n: the whole face if it lands flat, a strip for an edge, a triangle
// for a corner. `corner_travel` (m): relative motion of the corners by rotation until then.
double pressed_share(const double low[3], double depth, double corner_travel) {
  const auto part = [&](double rise) { return rise > depth + corner_travel ? depth / (rise - corner_travel) : 1.0; };
  return part(low[1] - low[0]) * part(low[2] - low[0]);
}
double pressed_share(const SmallShape& body, const Vec3& n, double depth, double corner_travel) {
  double low[3] = {1e300, 1e300, 1e300};
  for (int i = 0; i < few; ++i) lower(n[0] * body.vertex[0][i] + n[1] * body.vertex[1][i] + n[2] * body.vertex[2][i], low);
  return pressed_share(low, depth, corner_travel);
}

// m, length over which two bodies overlap as seen along the unit vector `t` (world); negative: apart by that much.
double overlap_along(const PairFrame& s, const Vec3& t) {
  const ContactBlock &r = *s.reference_block, &o = *s.other_block;
  const double between = t.dot((o.rest - r.rest) + (o.u - r.u));
  const Extent one = extent(s.reference->small, r.rotation.transpose() * t), two = extent(s.other->small, o.rotation.transpose() * t);
  return std::min(one.most, two.most + between) - std::max(one.least, two.least + between);
}

// Share of the smaller face that can press along n (unit, world): what one body covers of the other as seen along n, of neighbours across
// the crossing of two joints next to nothing. `travel` (m): motion along the face until then.
double covered_share(const PairFrame& s, const Vec3& n, double travel) {
  constexpr double along_face = 0.7;  // least sine between n and the edges asked for
  if (!corners_known(s)) return 1;
  double covered = std::min(s.reference->largest_face, s.other->largest_face);
  const auto cover = [&](const ContactShape& shape, const Mat3& rotation) {
    for (const Vec3& axis : shape.normal) {
      const Vec3 m = rotation * axis, t = m - m.dot(n) * n;
      const double size = t.norm();
      if (size < along_face) continue;
      const double width = overlap_along(s, t / size) + travel, length = overlap_along(s, n.cross(t) / size) + travel;
      covered = std::min(covered, std::max(0.0, width) * std::max(0.0, length));
    }
  };
  cover(*s.reference, s.reference_block->rotation);
  cover(*s.other, s.other_block->rotation);
  return covered / std::min(s.reference->largest_face, s.other->largest_face);
}

// True if bodies that are about to touch may gain an energy that matters: at a speed at which it does, or at any speed if the step dt is
// beyond what the face bears, since it then multiplies the speed by (omega dt)^2.
bool gains(const ContactPair& pair, const PairFrame& s, const ContactSettings& settings, double speed, double dt) {
  constexpr double steep = 3;  // omega dt
  if (speed > settings.reference_speed || settings.first_fall > 0) return true;
  PairResult whole;
  face_impact_omega2(pair, s, 1, whole);
  return dt * dt * std::max(whole.impact_omega2_a, whole.impact_omega2_b) > steep * steep;
}

// A body that sinks in deeper in its first step than the step allows gains energy. So the step is short enough for the largest face before
// an impact: if the bodies could touch within the next few steps, at a speed at which this energy matters.
void impact_bound(const ContactPair& pair, const PairFrame& s, const ContactSettings& settings, const Approach& way, double dt,
                  PairResult& result) {
  const ContactBlock &r = *s.reference_block, &o = *s.other_block;
  const double arm = way.by == SeparatingFeature::other_face ? s.reference->reach : s.other->reach;
  const double spin = (o.w - r.w).norm() * arm, speed = way.along + spin;
  const double k = pair.law.kn * std::min(s.reference->largest_face, s.other->largest_face);
  result.event_rate = event_rate(k, speed, way.apart, s, settings);
  const double depth = std::max(look_ahead * speed * dt, settings.first_fall);
  const bool soon = way.apart <= depth && gains(pair, s, settings, speed, dt);
  double share = 1;
  if ((soon || result.event_rate * dt > 0.5) && !way.n.isZero(0) && corners_known(s)) {
    const double corner_travel = speed > 0 ? 2 * spin * way.apart / speed : 0;  // evaluated every few steps only
    if (way.by != SeparatingFeature::other_face)
      share *= pressed_share(s.other->small, o.rotation.transpose() * way.n, depth, corner_travel);
    if (way.by != SeparatingFeature::face)
      share *= pressed_share(s.reference->small, -(r.rotation.transpose() * way.n), depth, corner_travel);
    const double travel = depth + look_ahead * dt * (speed_seen(s, r.w).norm() + spin);
    share = std::min(share, covered_share(s, way.n, travel));
    result.event_rate = event_rate(share * k, speed, way.apart, s, settings);
  }
  if (soon) face_impact_omega2(pair, s, share, result);
}

}  // namespace

void impact_bound(const ContactPair& pair, const PairFrame& s, const ContactSettings& settings, double apart, double dt,
                  PairResult& result) {
  Approach way = pair.separating_axis < 0 ? Approach{} : approach(pair.separating_axis, s);
  if (pair.separating_axis < 0) way.along = speed_seen(s, s.reference_block->w).norm();
  way.apart = apart;
  impact_bound(pair, s, settings, way, dt, result);
}

namespace {

constexpr double facing = 0.9;  // cosine; faces farther from flat wait for later steps
const double oblique = std::sqrt(1 - facing * facing);

// Faces of the other body that may be nearly flat on a face of the reference, and a bound that excludes faces of the reference. Most faces
// of a stone with hundreds of faces have other directions. If the normals n_f and n_g are opposite within this angle, a corner x on face g
// has n_f . x <= -cos n_g . x + sin |x|. The corners of both bodies are behind planes no nearer to the centroid than their nearest face.
struct Opposite {
  int count = 0;
  std::size_t face[most_faces];
  Vec3 normal[most_faces];  // world axes
  double least;             // m, lower bound of n_f . apart less the offset of face f, if one of these faces may be flat on it

  Opposite(const PairFrame& s, const Vec3& apart, double near) {
    const auto most_along = [](double across, double length) { return -(across > 0 ? facing : 1) * across + oblique * length; };
    const ContactShape &reference = *s.reference, &other = *s.other;
    const double margin = (2 * oblique * (1 + 1e-9)) * other.reach + near;
    least = -margin - most_along(*std::ranges::min_element(other.offset), other.reach);
    const double nearest = *std::ranges::min_element(reference.offset);
    for (std::size_t g = 0; g < other.normal.size(); ++g) {
      const Vec3 n = s.other_block->rotation * other.normal[g];
      const Vec3 x = apart + s.other_block->rotation * other.vertex[std::size_t(other.loop[std::size_t(other.loop_first[g])])];
      if (most_along(n.dot(x), x.norm()) < nearest - margin) continue;
      face[count] = g;
      normal[count++] = n;
    }
  }
  bool looks_away(double along, double offset) const { return along - offset < least; }
};

// Corners of one body that may come down on a plane of another: those of a face that is nearly flat on it, or all.
struct CornersOverPlane {
  const ContactShape& shape;
  const ContactBlock &block, &of_plane;
  std::span<const int> corner;
  Vec3 n;         // outward unit normal of the plane, world axes
  double offset;  // m, of the plane from the centroid of its body
};
std::span<const int> corners_of_face(const ContactShape& shape, std::size_t face) {
  return std::span(shape.loop)
      .subspan(std::size_t(shape.loop_first[face]), std::size_t(shape.loop_first[face + 1] - shape.loop_first[face]));
}

// Events and impacts of the corners that come down on the plane. With each the face presses with more: the last one lands it flat, one of
// two may land an edge.
struct FaceBlow {
  double event_rate = 0, soon = 0;  // 1/s; share of a face that lands within the next steps
};
FaceBlow foresee_landing(const CornersOverPlane& one, const PairFrame& s, const ContactSettings& settings, double face, double dt) {
  FaceBlow blow;
  const ContactBlock &c = one.block, &p = one.of_plane;
  const Vec3 apart = (c.rest - p.rest) + (c.u - p.u), v = c.v - p.v;
  double height[most_vertices], rate[most_vertices];  // m, m/s
  const std::size_t count = one.corner.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 r = c.rotation * one.shape.vertex[std::size_t(one.corner[i])];
    height[i] = one.n.dot(apart + r) - one.offset;
    rate[i] = one.n.dot(v + c.w.cross(r) - p.w.cross(apart + r));
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!(rate[i] < 0 && height[i] > 0)) continue;
    const double speed = -rate[i], time = height[i] / speed;
    const bool is_soon = speed > settings.reference_speed && time <= look_ahead * dt;
    // of stones with many corners most are too far to count, even with all of the face
    if (!is_soon && event_rate(0.5 * face, speed, height[i], s, settings) <= blow.event_rate) continue;
    double low[3] = {1e300, 1e300, 1e300};  // m, of the corners above the plane by then
    for (std::size_t j = 0; j < count; ++j) lower(j == i ? 0 : std::max(0.0, height[j] + rate[j] * time), low);
    const double share = pressed_share(low, look_ahead * speed * dt, 0);
    blow.event_rate = std::max(blow.event_rate, event_rate(0.5 * share * face, speed, height[i], s, settings));
    if (is_soon) blow.soon = std::max(blow.soon, share);
  }
  return blow;
}

}  // namespace

void foresee(const ContactPair& pair, const PairFrame& s, const ContactSettings& settings, double dt, PairResult& result) {
  const ContactBlock &r = *s.reference_block, &o = *s.other_block;
  const Vec3 apart = (o.rest - r.rest) + (o.u - r.u), v = o.v - r.v, w = o.w - r.w, at = r.rotation * pair.c, n = r.rotation * pair.n;
  const double parting = n.dot(v + o.w.cross(at - apart) - r.w.cross(at));
  if (parting > 0) result.event_rate = std::max(result.event_rate, event_rate(pair.law.kn * pair.area, parting, result.depth, s, settings));
  const double lever = std::min(s.reference->reach, s.other->reach), thin = std::min(s.reference->thickness, s.other->thickness);
  const double face = pair.law.kn * std::min(s.reference->largest_face, s.other->largest_face);
  const bool of_other = s.other->reach <= s.reference->reach;  // corners of the smaller body
  const bool each_corner = std::isfinite(settings.blow_share);
  const double near = 0.01 * thin + (each_corner ? result.depth : 0);  // m
  double soon = 0;                                                     // `FaceBlow`
  bool flat = false;                                                   // nearly
  const auto lands = [&](const Vec3& along, const auto& predict) {
    FaceBlow now = predict(face);
    if (now.event_rate * dt > 0.5 || now.soon > soon) {  // few: only now does it matter how much of the face is covered
      const double travel = result.depth + look_ahead * dt * (speed_seen(s, r.w).norm() + w.norm() * s.other->reach);
      const double covered = covered_share(s, along, travel);
      now = {predict(covered * face).event_rate, std::min(now.soon, covered)};
    }
    result.event_rate = std::max(result.event_rate, now.event_rate);
    soon = std::max(soon, now.soon);
  };
  const Opposite opposite(s, apart, near);
  for (std::size_t f = 0; f < s.reference->normal.size(); ++f) {
    const Vec3 nf = r.rotation * s.reference->normal[f];
    if (opposite.looks_away(nf.dot(apart), s.reference->offset[f])) continue;
    for (int i = 0; i < opposite.count; ++i) {
      const std::size_t g = opposite.face[i];
      const Vec3& ng = opposite.normal[i];
      if (-nf.dot(ng) < facing) continue;
      const Vec3 across = nf.cross(ng);
      const double sine = across.norm(), closes = w.dot(across);  // rate of the angle between them, times its sine
      if (!each_corner && (!(closes > 0) || !(sine > 1e-9))) continue;
      const Vec3 corner = o.rotation * s.other->vertex[std::size_t(s.other->loop[std::size_t(s.other->loop_first[g])])];
      if (std::abs(nf.dot(apart + corner) - s.reference->offset[f]) > 2 * sine * s.other->reach + near) continue;
      flat = true;
      if (each_corner) {
        const CornersOverPlane corners =
            of_other ? CornersOverPlane{*s.other, o, r, corners_of_face(*s.other, g), nf, s.reference->offset[f]}
                     : CornersOverPlane{*s.reference, r, o, corners_of_face(*s.reference, f), ng, s.other->offset[g]};
        lands(nf, [&](double k) { return foresee_landing(corners, s, settings, k, dt); });
        continue;
      }
      const double rate = closes / sine, time = sine / rate;
      const bool is_near = rate * lever > settings.reference_speed && time <= look_ahead * dt;
      lands(nf, [&](double k) { return FaceBlow{event_rate(0.5 * k, rate * lever, sine * lever, s, settings), is_near ? 1.0 : 0.0}; });
    }
  }
  // An edge may still land on the plane of the contact.
  if (each_corner && !flat) {
    static constexpr auto all = [] {
      std::array<int, most_vertices> corner{};
      std::iota(corner.begin(), corner.end(), 0);
      return corner;
    }();
    const auto corners = [&](const ContactShape& shape) { return std::span(all).first(shape.vertex.size()); };
    const CornersOverPlane over = of_other ? CornersOverPlane{*s.other, o, r, corners(*s.other), n, n.dot(at)}
                                           : CornersOverPlane{*s.reference, r, o, corners(*s.reference), -n, n.dot(apart - at)};
    lands(n, [&](double k) { return foresee_landing(over, s, settings, k, dt); });
  }
  if (soon > 0) face_impact_omega2(pair, s, soon, result);
}

int cached_axis(const ContactPair& pair, const ContactShape& a, const ContactShape& b) {
  return pair.touching || !pair.lift.isZero(0) || !(a.small.faces > 0 && b.small.faces > 0) ? -1 : pair.separating_axis;
}

bool still_separated(int separating_axis, const ContactPair& pair, const PairFrame& s, const ContactSettings& settings, double dt,
                     PairResult& result) {
  constexpr double sure = 1e-12;
  const Approach way = separating_axis < 0 ? Approach{} : approach(separating_axis, s);
  if (!(way.apart > sure * (s.reference->reach + s.other->reach))) return false;
  result.apart = way.apart;
  impact_bound(pair, s, settings, way, dt, result);
  return true;
}

}  // namespace erbs
