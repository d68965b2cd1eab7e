#include "engine/geometry/mass.h"

namespace erbs {
namespace {

// Steiner term: inertia per unit density of a volume v whose centroid lies at offset r from the reference point.
Mat3 steiner(double v, const Vec3& r) { return v * (r.squaredNorm() * Mat3::Identity() - r * r.transpose()); }

Mat3 inertia_of_covariance(const Mat3& c) { return c.trace() * Mat3::Identity() - c; }

}  // namespace

MassProperties mass_properties(const Polyhedron& p) {
  MassProperties m;
  const Vec3 origin = mean_vertex(p);
  Vec3 first = Vec3::Zero();   // int x dV
  Mat3 second = Mat3::Zero();  // int x x^T dV
  for (const auto& f : p.faces) {
    const Vec3 a = p.vertices[static_cast<std::size_t>(f[0])] - origin;
    for (std::size_t i = 1; i + 1 < f.size(); ++i) {
      const Vec3 b = p.vertices[static_cast<std::size_t>(f[i])] - origin;
      const Vec3 c = p.vertices[static_cast<std::size_t>(f[i + 1])] - origin;
      const double v = a.dot(b.cross(c)) / 6;
      const Vec3 s = a + b + c;
      m.volume += v;
      first += v / 4 * s;
      second += v / 20 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
    }
  }
  const Vec3 local = first / m.volume;
  m.centroid = origin + local;
  m.inertia = inertia_of_covariance(second - m.volume * local * local.transpose());
  return m;
}

MassProperties mass_properties(const std::vector<Polyhedron>& parts) {
  std::vector<MassProperties> each;
  for (const Polyhedron& p : parts) each.push_back(mass_properties(p));
  if (each.size() == 1) return each[0];
  MassProperties m;
  const Vec3 origin = each[0].centroid;
  Vec3 first = Vec3::Zero();
  for (const MassProperties& part : each) {
    m.volume += part.volume;
    first += part.volume * (part.centroid - origin);
  }
  m.centroid = origin + first / m.volume;
  for (const MassProperties& part : each) m.inertia += part.inertia + steiner(part.volume, part.centroid - m.centroid);
  return m;
}

}  // namespace erbs
