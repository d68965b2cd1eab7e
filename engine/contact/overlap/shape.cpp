#include "engine/contact/overlap/shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "engine/base/error.h"
#include "engine/base/symmetric.h"
#include "engine/geometry/mass.h"

namespace erbs {
namespace {

// Of two faces in one plane, both would be the nearest face.
bool has_coplanar_faces(const std::vector<Plane>& faces, double size) {
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (std::size_t g = 0; g < f; ++g) {
      if (faces[f].n.dot(faces[g].n) > 1 - 1e-14 && std::abs(faces[f].d - faces[g].d) < 1e-9 * size) return true;
    }
  }
  return false;
}

std::vector<Vec3> edge_directions(const ContactShape& s) {
  std::vector<Vec3> out;
  for (std::size_t f = 0; f + 1 < s.loop_first.size(); ++f) {
    for (int i = s.loop_first[f]; i < s.loop_first[f + 1]; ++i) {
      const int to = i + 1 < s.loop_first[f + 1] ? i + 1 : s.loop_first[f];
      const Vec3 e = (s.vertex[std::size_t(s.loop[std::size_t(to)])] - s.vertex[std::size_t(s.loop[std::size_t(i)])]).normalized();
      if (std::none_of(out.begin(), out.end(), [&](const Vec3& x) { return x.cross(e).squaredNorm() < 1e-20; })) out.push_back(e);
    }
  }
  return out;
}

void fill_small(ContactShape& s) {
  const std::size_t nv = s.vertex.size(), nf = s.normal.size();
  s.is_small = nv <= few && nf <= few;
  for (std::size_t f = 0; f < nf && s.is_small; ++f) s.is_small = s.loop_first[f + 1] - s.loop_first[f] <= few;
  if (!s.is_small) return;
  SmallShape& out = s.small;
  out.edge = s.smallest_edge;
  out.vertices = int(nv);
  out.faces = int(nf);
  for (std::size_t i = 0; i < few; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      out.vertex[k][i] = s.vertex[std::min(i, nv - 1)][Eigen::Index(k)];
      out.normal[k][i] = i < nf ? s.normal[i][Eigen::Index(k)] : 0;
    }
    out.offset[i] = i < nf ? s.offset[i] : 1e30;
    out.count[i] = 0;
    if (i >= nf) continue;
    for (int at = s.loop_first[i]; at < s.loop_first[i + 1]; ++at)
      out.loop[i][out.count[i]++] = static_cast<unsigned char>(s.loop[std::size_t(at)]);
    out.mask[i] = static_cast<unsigned char>(s.mask[i]);
    for (std::size_t k = out.count[i]; k < few; ++k) out.loop[i][k] = out.loop[i][0];
  }
}

// Up to round-off.
bool equal(const ContactShape& a, const ContactShape& b) {
  if (a.vertex.size() != b.vertex.size() || a.edge.size() != b.edge.size() || a.loop_first != b.loop_first || a.loop != b.loop)
    return false;
  const auto near = [](const auto& x, const auto& y, double error) {
    for (std::size_t i = 0; i < x.size(); ++i)
      if (!((x[i] - y[i]).norm() <= error)) return false;
    return true;
  };
  const auto same_rate = [](double x, double y) { return std::abs(x - y) <= 1e-9 * std::abs(x); };
  constexpr double round_off = 1e-12;
  return near(a.vertex, b.vertex, round_off * a.reach) && near(a.normal, b.normal, round_off) && near(a.edge, b.edge, round_off) &&
         same_rate(a.face_across, b.face_across) && same_rate(a.face_along, b.face_along);
}

}  // namespace

ContactShape contact_shape(const Polyhedron& part) {
  const Box box = bounding_box(part);
  const double size = (box.high - box.low).norm();
  const Polyhedron p = has_coplanar_faces(planes(part), size) ? hull(part.vertices) : part;
  if (p.vertices.size() > std::size_t(most_vertices) || p.faces.size() > std::size_t(most_faces)) {
    throw Error(
        fmt::format("a convex part of it has {} corners and {} faces; contact takes up to {} and {}: give it fewer, or split it into parts",
                    p.vertices.size(), p.faces.size(), most_vertices, most_faces));
  }
  ContactShape s;
  s.vertex = p.vertices;
  for (const Plane& plane : planes(p)) {
    s.normal.push_back(plane.n);
    s.offset.push_back(plane.d);
  }
  s.words = (int(s.vertex.size()) + word_bits - 1) / word_bits;
  for (const auto& face : p.faces) {
    s.loop_first.push_back(static_cast<int>(s.loop.size()));
    s.mask.resize(s.mask.size() + std::size_t(s.words));
    Word* mask = s.mask.data() + (s.mask.size() - std::size_t(s.words));
    for (int v : face) mask[v / word_bits] |= Word(1) << v % word_bits;
    s.loop.insert(s.loop.end(), face.begin(), face.end());
  }
  s.loop_first.push_back(static_cast<int>(s.loop.size()));
  for (std::size_t f = 0; f < s.normal.size(); ++f) {
    Vec3 twice = Vec3::Zero();
    const auto corner = [&](int i) -> const Vec3& { return s.vertex[std::size_t(s.loop[std::size_t(i)])]; };
    for (int i = s.loop_first[f] + 1; i + 1 < s.loop_first[f + 1]; ++i)
      twice += (corner(i) - corner(s.loop_first[f])).cross(corner(i + 1) - corner(s.loop_first[f]));
    s.largest_face = std::max(s.largest_face, twice.norm() / 2);
  }
  s.edge = edge_directions(s);
  s.volume = mass_properties(p).volume;
  s.thickness = thickness(p);
  s.smallest_edge = smallest_edge(p);
  s.centre = (box.low + box.high) / 2;
  s.half = (box.high - box.low) / 2;
  for (const Vec3& v : p.vertices) {
    s.radius = std::max(s.radius, (v - s.centre).norm());
    s.reach = std::max(s.reach, v.norm());
  }
  fill_small(s);
  return s;
}

// Largest eigenvalues of M^-1/2 K M^-1/2, K = Int over the face of r r^T dA. r is the displacement of a point per motion of the block:
// across the face (n, x * n), and along it (t, x * t) in two directions. No patch within the face is stiffer.
void set_face_omega2(ContactShape& s, const ContactBlock& block) {
  s.face_across = s.face_along = 0;
  if (!(block.inverse_mass > 0)) return;
  Mat6 root = Mat6::Zero();  // root root^T = M^-1
  root.topLeftCorner<3, 3>() = std::sqrt(block.inverse_mass) * Mat3::Identity();
  root.bottomRightCorner<3, 3>() = block.inverse_tensor.llt().matrixL();
  for (std::size_t f = 0; f < s.normal.size(); ++f) {
    Mat6 across = Mat6::Zero(), along = Mat6::Zero();
    const Vec3 n = s.normal[f], t = n.unitOrthogonal(), b = n.cross(t);
    const auto corner = [&](int i) -> const Vec3& { return s.vertex[std::size_t(s.loop[std::size_t(i)])]; };
    for (int i = s.loop_first[f] + 1; i + 1 < s.loop_first[f + 1]; ++i) {
      const Vec3 p[3] = {corner(s.loop_first[f]), corner(i), corner(i + 1)};
      const double third = (p[1] - p[0]).cross(p[2] - p[0]).norm() / 6;  // quadratic integrand: exact from the midpoints of the sides
      for (int k = 0; k < 3; ++k) {
        const Vec3 x = (p[k] + p[(k + 1) % 3]) / 2;
        const auto add = [&](const Vec3& e, Mat6& to) {
          Vec6 r;
          r << e, x.cross(e);
          r = root.transpose() * r;
          to += third * r * r.transpose();
        };
        add(n, across), add(t, along), add(b, along);
      }
    }
    s.face_across = std::max(s.face_across, largest_eigenvalue(across));
    s.face_along = std::max(s.face_along, largest_eigenvalue(along));
  }
}

ContactShapes contact_shapes(const std::vector<std::vector<Polyhedron>>& parts_of_blocks, std::span<const ContactBlock> blocks) {
  ContactShapes all;
  std::unordered_multimap<long, int> known;
  for (std::size_t b = 0; b < parts_of_blocks.size(); ++b) {
    all.first.push_back(static_cast<int>(all.of.size()));
    for (const Polyhedron& p : parts_of_blocks[b]) {
      ContactShape s = contact_shape(p);
      if (!blocks.empty()) set_face_omega2(s, blocks[b]);
      // Almost all equal shapes have this key; equal shapes with another key are just not shared.
      const long key = std::lround(std::log(s.volume) * 1e7 + 0.37);
      const auto [from, to] = known.equal_range(key);
      const auto same = std::find_if(from, to, [&](const auto& one) { return equal(all.shape[std::size_t(one.second)], s); });
      all.block.push_back(static_cast<int>(b));
      all.of.push_back(same == to ? static_cast<int>(all.shape.size()) : same->second);
      if (same != to) continue;
      known.emplace(key, all.of.back());
      all.shape.push_back(std::move(s));
    }
  }
  all.first.push_back(static_cast<int>(all.of.size()));
  return all;
}

Mat3 contact_axes(const std::vector<Polyhedron>& parts) {
  constexpr double as_small = 1 + 1e-9;  // smaller by more than round-off
  const auto box = [&](const Mat3& axes) {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const Polyhedron& p : parts) {
      for (const Vec3& v : p.vertices) {
        const Vec3 x = axes.transpose() * v;
        low = low.cwiseMin(x), high = high.cwiseMax(x);
      }
    }
    return (high - low).prod();
  };
  Mat3 best = Mat3::Identity();
  double least = box(best);
  for (const Polyhedron& p : parts) {
    for (const auto& face : p.faces) {
      const auto corner = [&](std::size_t i) -> const Vec3& { return p.vertices[std::size_t(face[i])]; };
      const Vec3 along = (corner(1) - corner(0)).normalized(), across = along.cross(corner(2) - corner(1)).normalized();
      Mat3 axes;
      axes << along, across.cross(along), across;
      if (!(axes.determinant() > 0.5)) continue;  // its first corners are collinear
      const double size = box(axes);
      if (size * as_small < least) least = size, best = axes;
    }
  }
  return best;
}

}  // namespace erbs
