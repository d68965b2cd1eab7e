#include "engine/contact/overlap/general.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/count.h"
#include "engine/contact/overlap/ramp.h"
#include "engine/geometry/clip.h"

namespace erbs {
namespace {

using std::size_t;
constexpr int most_corners = most_vertices + most_faces + 2;  // a convex loop gains at most one corner per cut

// Vertices of B inside each face of A, as bits.
struct Inside {
  Word of[most_faces][most_words];  // only vertices of faces that may reach A
  int cut_face[most_faces];         // faces of A with vertices of B on both sides
  int cut_faces = 0;
};

struct CutLoop {
  int n = 0;
  Vec3 p[most_corners];
};

// The part of `in` with value(x) = c - n.x >= 0. A loop in the plane counts only if `keep_zero`, so that it belongs to exactly one of two
// complementary cuts. False if nothing is left.
bool cut(const CutLoop& in, const Vec3& n, double c, bool keep_zero, CutLoop& out) {
  double d[most_corners];
  bool positive = false, negative = false;
  for (int i = 0; i < in.n; ++i) {
    d[i] = c - n.dot(in.p[i]);
    positive = positive || d[i] > 0;
    negative = negative || d[i] < 0;
  }
  out.n = 0;
  if (!positive && (negative || !keep_zero)) return false;
  cut_polygon(
      in.n, [&](int i) -> const Vec3& { return in.p[i]; }, [&](int i) { return d[i]; }, [&](const Vec3& p, double) { out.p[out.n++] = p; });
  return out.n >= 3;
}

bool is_inside(const ContactShape& a, int f, const Vec3& x, const Fragments& w) { return w.c[f] - a.normal[z(f)].dot(x) > 0; }

// True if all of B is on the outer side of face f of A.
bool face_separates(const ContactShape& a, int nv, int f, const Fragments& w) {
  return std::none_of(w.v, w.v + nv, [&](const Vec3& x) { return is_inside(a, f, x, w); });
}

bool share_none(const Word* one, const Word* other, int words) {
  Word both = 0;
  for (int k = 0; k < words; ++k) both |= one[k] & other[k];
  return both == 0;
}

bool holds_all(const Word* set, const Word* of, int words) {
  Word left = 0;
  for (int k = 0; k < words; ++k) left |= of[k] & ~set[k];
  return left == 0;
}

// Faces of B that may reach into A, and their vertices: faces with a vertex inside the face of A that is nearest to the centroid of B. A
// stone of hundreds of faces has only a few of them, and only their vertices are tested against the other faces of A.
int faces_that_reach(const ContactShape& a, const ContactShape& b, const Fragments& w, int* face, int* vertex, int& vertices) {
  const int nfb = static_cast<int>(b.normal.size()), nv = static_cast<int>(b.vertex.size());
  const int towards = static_cast<int>(std::min_element(w.c, w.c + a.normal.size()) - w.c);
  Word in[most_words] = {}, used[most_words] = {};
  for (int k = 0; k < nv; ++k) in[k / word_bits] |= Word(is_inside(a, towards, w.v[k], w)) << k % word_bits;
  int faces = 0;
  for (int j = 0; j < nfb; ++j) {
    const Word* mask = &b.mask[z(j * b.words)];
    if (share_none(mask, in, b.words)) continue;
    face[faces++] = j;
    for (int k = 0; k < b.words; ++k) used[k] |= mask[k];
  }
  vertices = 0;
  for (int k = 0; k < nv; ++k)
    if ((used[k / word_bits] >> k % word_bits & 1u) != 0) vertex[vertices++] = k;
  return faces;
}

// True if all of A is on the outer side of face j of B.
bool face_of_other_separates(const ContactShape& a, const ContactShape& b, const PairPose& pose, int j) {
  const Vec3 n = pose.rotation * b.normal[z(j)];
  const double c = b.offset[z(j)] + n.dot(pose.shift);
  return std::all_of(a.vertex.begin(), a.vertex.end(), [&](const Vec3& x) { return n.dot(x) >= c; });
}

void place_other(const ContactShape& a, const ContactShape& b, const PairPose& pose, Fragments& w) {
  for (size_t k = 0; k < b.vertex.size(); ++k) w.v[k] = pose.rotation * b.vertex[k];
  for (size_t f = 0; f < a.normal.size(); ++f) w.c[f] = a.offset[f] - a.normal[f].dot(pose.shift);
}

void append(Fragments& w, int face, int nearest, const CutLoop& loop, const Vec3& n, double c) {
  w.fragment.push_back({face, nearest, static_cast<int>(w.vertex.size()), loop.n});
  for (int i = 0; i < loop.n; ++i) {
    w.vertex.push_back(loop.p[i]);
    w.depth.push_back(std::max(0.0, c - n.dot(loop.p[i])));
  }
}

// Splits face j of B, already clipped to A, where another face of A becomes the nearest.
void split(const ContactShape& a, int j, CutLoop& g, CutLoop& h, Fragments& w) {
  const int nf = static_cast<int>(a.normal.size());
  double least[most_faces];
  // A face of A is nearest somewhere on the loop only if its least depth is below the smallest of the greatest depths.
  double bound = std::numeric_limits<double>::infinity();
  for (int f = 0; f < nf; ++f) {
    double low = std::numeric_limits<double>::infinity(), high = 0;
    for (int i = 0; i < g.n; ++i) {
      const double d = w.c[f] - a.normal[z(f)].dot(g.p[i]);
      low = std::min(low, d);
      high = std::max(high, d);
    }
    least[f] = low;
    bound = std::min(bound, high);
  }
  int near[most_faces], count = 0;
  for (int f = 0; f < nf; ++f) {
    if (least[f] <= bound) near[count++] = f;
  }
  if (count == 1) {
    append(w, j, near[0], g, a.normal[z(near[0])], w.c[near[0]]);
    return;
  }
  CutLoop other;
  for (int i = 0; i < count; ++i) {
    const int f = near[i];
    CutLoop *from = &g, *to = &h, *spare = &other;
    bool left = true;
    for (int k = 0; k < count && left; ++k) {
      const int e = near[k];
      if (e == f) continue;
      left = cut(*from, a.normal[z(e)] - a.normal[z(f)], w.c[e] - w.c[f], f < e, *to);
      from = to;
      std::swap(to, spare);
    }
    if (left) append(w, j, f, *from, a.normal[z(f)], w.c[f]);
  }
}

double distance_along_edges(const ContactShape& a, const ContactShape& b, const PairPose& pose, int k) {
  constexpr double parallel = 1e-6;
  const int nb = static_cast<int>(b.edge.size());
  Vec3 n = a.edge[z(k / nb)].cross(pose.rotation * b.edge[z(k % nb)]);
  const double length = n.norm(), between = n.dot(pose.shift) / length;
  if (length < parallel) return -1;
  n /= length;
  const Vec3 m = pose.rotation.transpose() * n;
  double low_a = std::numeric_limits<double>::infinity(), high_a = -low_a, low_b = low_a, high_b = -low_a;
  for (const Vec3& x : a.vertex) low_a = std::min(low_a, n.dot(x)), high_a = std::max(high_a, n.dot(x));
  for (const Vec3& x : b.vertex) low_b = std::min(low_b, m.dot(x)), high_b = std::max(high_b, m.dot(x));
  return std::max(low_b + between - high_a, low_a - (high_b + between));
}

}  // namespace

double distance(const ContactShape& a, const ContactShape& b, const PairPose& pose, int separating_axis) {
  const int nfa = static_cast<int>(a.normal.size());
  if (separating_axis < 0) return -1;
  const int faces = nfa + static_cast<int>(b.normal.size());
  if (separating_axis >= faces) return distance_along_edges(a, b, pose, separating_axis - faces);
  double least = std::numeric_limits<double>::infinity();
  if (separating_axis >= nfa) {
    const Vec3 n = pose.rotation * b.normal[z(separating_axis - nfa)];
    const double c = b.offset[z(separating_axis - nfa)] + n.dot(pose.shift);
    for (const Vec3& x : a.vertex) least = std::min(least, n.dot(x) - c);
    return least;
  }
  const Vec3 n = pose.rotation.transpose() * a.normal[z(separating_axis)];
  const double c = a.offset[z(separating_axis)] - a.normal[z(separating_axis)].dot(pose.shift);
  for (const Vec3& x : b.vertex) least = std::min(least, n.dot(x) - c);
  return least;
}

int separating_face_of_other(const ContactShape& a, const ContactShape& b, const PairPose& pose) {
  for (int j = 0; j < static_cast<int>(b.normal.size()); ++j)
    if (face_of_other_separates(a, b, pose, j)) return static_cast<int>(a.normal.size()) + j;
  return -1;
}

int separating_edges(const ContactShape& a, const ContactShape& b, const PairPose& pose) {
  constexpr int most_axes = 1024;
  const int na = static_cast<int>(a.edge.size()), nb = static_cast<int>(b.edge.size());
  if (na * nb > most_axes) return -1;
  int best = -1;
  double most = 0;
  for (int k = 0; k < na * nb; ++k) {
    const double shown = distance_along_edges(a, b, pose, k);
    if (shown > most) most = shown, best = k;
  }
  return best < 0 ? -1 : static_cast<int>(a.normal.size() + b.normal.size()) + best;
}

bool find_fragments(const ContactShape& a, const ContactShape& b, const PairPose& pose, int& separating_axis, Fragments& w) {
  const int nfa = static_cast<int>(a.normal.size()), nv = static_cast<int>(b.vertex.size());
  w.fragment.clear();
  w.vertex.clear();
  w.depth.clear();
  if (distance(a, b, pose, separating_axis) >= 0) return false;
  place_other(a, b, pose, w);
  int reaching[most_faces], vertex[most_vertices], vertices = 0;
  const int faces = faces_that_reach(a, b, w, reaching, vertex, vertices);
  Inside in;
  bool apart = false;  // of the faces that may reach A
  for (int f = 0; f < nfa; ++f) {
    Word* set = in.of[f];
    std::fill_n(set, b.words, Word(0));
    int count = 0;
    for (int i = 0; i < vertices; ++i) {
      const int k = vertex[i];
      const bool is_in = is_inside(a, f, w.v[k], w);
      set[k / word_bits] |= Word(is_in) << k % word_bits;
      count += is_in;
    }
    if (count == 0) {
      if (face_separates(a, nv, f, w)) {
        separating_axis = f;
        return false;
      }
      apart = true;
    }
    if (count < vertices) in.cut_face[in.cut_faces++] = f;
  }
  CutLoop one, two;
  for (int i = 0; i < faces && !apart; ++i) {
    const int j = reaching[i];
    const Word* mask = &b.mask[z(j * b.words)];
    const auto outside = [&](int f) { return share_none(in.of[f], mask, b.words); };
    if (std::any_of(in.cut_face, in.cut_face + in.cut_faces, outside)) continue;
    CutLoop *g = &one, *h = &two;
    g->n = 0;
    for (int l = b.loop_first[z(j)]; l < b.loop_first[z(j) + 1]; ++l) g->p[g->n++] = w.v[b.loop[z(l)]];
    bool left = true;
    for (int k = 0; k < in.cut_faces && left; ++k) {
      const int f = in.cut_face[k];
      if (holds_all(in.of[f], mask, b.words)) continue;
      left = cut(*g, a.normal[z(f)], w.c[f], false, *h);
      std::swap(g, h);
    }
    if (!left) continue;
    w.n[j] = pose.rotation * b.normal[z(j)];
    split(a, j, *g, *h, w);
  }
  separating_axis = -1;
  if (!w.fragment.empty()) return true;
  separating_axis = separating_face_of_other(a, b, pose);
  return false;
}

Patch elastic_patch(const Fragments& w) {
  Patch out;
  Vec3 pressure = Vec3::Zero(), area = Vec3::Zero();
  double second[6] = {};
  for (const Fragment& fragment : w.fragment) {
    const Vec3& n = w.n[fragment.face];
    const Vec3* x = &w.vertex[z(fragment.first)];
    const double* phi = &w.depth[z(fragment.first)];
    double i0 = 0;
    Vec3 i1 = Vec3::Zero();
    for (int k = 1; k + 1 < fragment.count; ++k) {
      const Vec3 &p = x[0], &q = x[k], &r = x[k + 1];
      const double dS = 0.5 * n.dot((q - p).cross(r - p));
      const double sum = phi[0] + phi[k] + phi[k + 1];
      const Vec3 s = p + q + r;
      i0 += dS / 3 * sum;
      i1 += dS / 12 * (sum * s + phi[0] * p + phi[k] * q + phi[k + 1] * r);
      out.area += dS;
      area += dS / 3 * s;
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        second[i] += dS / 12 * (s[i] * s[i] + p[i] * p[i] + q[i] * q[i] + r[i] * r[i]);
        second[3 + i] += dS / 12 * (s[i] * s[j] + p[i] * p[j] + q[i] * q[j] + r[i] * r[j]);
      }
    }
    for (int k = 0; k < fragment.count; ++k) out.max_depth = std::max(out.max_depth, phi[k]);
    out.total += i0;
    pressure += i1;
    out.force -= i0 * n;
    out.moment -= i1.cross(n);
  }
  finish_patch(pressure, area, symmetric(second), out);
  return out;
}

Mat3 symmetric(const double* s) {
  Mat3 m;
  m << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return m;
}

void finish_patch(const Vec3& pressure, const Vec3& area, const Mat3& second, Patch& out) {
  const double size = out.force.norm();
  if (!(out.total > 0) || !(out.area > 0) || !(size > 0)) {
    out.total = 0;
    return;
  }
  out.pressure_centre = pressure / out.total;
  out.centroid = area / out.area;
  out.second = second;
  out.gyration = std::sqrt(std::max(0.0, second.trace() / out.area - out.centroid.squaredNorm()));
  out.normal = out.force / size;
}

void closing_speeds(Fragments& w, const Vec3& linear, const Vec3& angular, Patch& patch) {
  w.closing_speed.resize(w.vertex.size());
  patch.closing_speed = -std::numeric_limits<double>::infinity();
  const double along = -patch.normal.dot(linear);
  const Vec3 angular_part = angular.cross(patch.normal);  // n . (angular x x) = (n x angular) . x
  for (size_t i = 0; i < w.vertex.size(); ++i) {
    w.closing_speed[i] = along + angular_part.dot(w.vertex[i]);
    patch.closing_speed = std::max(patch.closing_speed, w.closing_speed[i]);
  }
}

double damping(const Fragments& w, const Vec3& normal, double chi, double limit, Vec3& first) {
  double total = 0;
  first.setZero();
  for (const Fragment& fragment : w.fragment) {
    const Vec3& n = w.n[fragment.face];
    const double along = -normal.dot(n);  // share of its pressure along the normal of the patch
    if (along <= 0) continue;
    for (int k = 1; k + 1 < fragment.count; ++k) {
      double f[3], s[3], x[3][3], change[4], i0 = 0, i1[3] = {};
      const int corner[3] = {fragment.first, fragment.first + k, fragment.first + k + 1};
      for (size_t c = 0; c < 3; ++c) {
        const size_t from = z(corner[c]);
        f[c] = w.depth[from];
        s[c] = chi * w.closing_speed[from];
        std::copy_n(w.vertex[from].data(), 3, x[c]);
      }
      const Vec3 &p = w.vertex[z(corner[0])], &q = w.vertex[z(corner[1])], &r = w.vertex[z(corner[2])];
      const double dS = along * (0.5 * n.dot((q - p).cross(r - p)));
      scalar::add_product<double>(f, s, x, dS, true, i0, i1);
      scalar::clamp_change<double>(f, s, x, dS, limit - 1, true, change);
      total += i0 + change[0];
      first += Vec3(i1[0] + change[1], i1[1] + change[2], i1[2] + change[3]);
    }
  }
  return total;
}

}  // namespace erbs
