// Overlap of two convex bodies, and the elastic and damping pressure there.
//
// Inner-distance potential: E = kn Int_{A and B} phi dV with phi(x) = least depth of x below the faces of the reference body A. phi
// vanishes on the surface of A. So moving boundaries add nothing, and the force is the exact derivative of E,
//   force on B = -kn sum_j n_j Int_{face j of B inside A} phi dS.
// The law is the same for faces, edges and corners. Each face of B is clipped to A and split where another face of A becomes the nearest;
// phi is linear on each piece.
#pragma once
#include <vector>

#include "engine/contact/overlap/shape.h"

namespace erbs {

// Pair axes: axes of the reference body A, origin at the centroid of the other body B. Lever arms then stay short even if A is a slab of
// many metres.
struct PairPose {
  Mat3 rotation;  // x (pair axes) = `rotation` * x (axes of B at rest)
  Vec3 shift;     // m, centroid of B relative to the centroid of A, axes of A
};

struct Fragment {
  int face;          // of B
  int nearest;       // face of A
  int first, count;  // vertices in `Fragments::vertex`
};

// Workspace, used again from call to call; one per thread.
struct Fragments {
  std::vector<Fragment> fragment;
  std::vector<Vec3> vertex;           // m, pair axes
  std::vector<double> depth;          // m, phi
  std::vector<double> closing_speed;  // m/s, closing speed of B along the normal of the patch
  Vec3 v[most_vertices];              // m, vertices of B, pair axes
  Vec3 n[most_faces];                 // normals of B, pair axes
  double c[most_faces];               // m, depth of the origin below the faces of A
};

// A separating feature has a number. It is a face of A, then a face of B, then a plane along an edge of each (directions i, j of
// `ContactShape::edge`, i times their number in B plus j); -1: unknown. Returns the distance (m) along this feature; negative if it does
// not separate the bodies.
double distance(const ContactShape& a, const ContactShape& b, const PairPose& pose, int separating_axis);
int separating_face_of_other(const ContactShape& a, const ContactShape& b, const PairPose& pose);
// Pair of edges with the greatest distance. Up to round-off it exists if no face separates two bodies without overlap; -1 if there is none.
int separating_edges(const ContactShape& a, const ContactShape& b, const PairPose& pose);

// Finds the pieces; false if the bodies do not overlap. `separating_axis` caches the separating feature.
bool find_fragments(const ContactShape& a, const ContactShape& b, const PairPose& pose, int& separating_axis, Fragments& out);

// The patch by its elastic pressure alone, in pair axes, kn = 1.
struct Patch {
  Vec3 force = Vec3::Zero();   // m3, on B
  Vec3 moment = Vec3::Zero();  // m4, on B about its centroid
  Vec3 normal = Vec3::Zero();  // unit, direction of the force on B
  double total = 0;            // m3, Int phi dS
  double area = 0;             // m2, surface of B inside A
  double gyration = 0;         // m, polar radius of gyration of that surface
  Mat3 second;                 // m4, Int x x^T dS over that surface
  double max_depth = 0;        // m, greatest
  double closing_speed = 0;    // m/s, greatest
  Vec3 pressure_centre = Vec3::Zero();
  Vec3 centroid = Vec3::Zero();
};
Patch elastic_patch(const Fragments& fragments);
// Sets centres, gyration and normal from Int phi x dS, Int x dS, Int x x^T dS; sets `total` to 0 if the patch is degenerate.
void finish_patch(const Vec3& pressure, const Vec3& area, const Mat3& second, Patch& patch);
Mat3 symmetric(const double* six);  // xx, yy, zz, xy, yz, zx

// Closing speed of B along the normal of the patch, at every vertex of the pieces. `linear` and `angular` are the motion of a body with its
// centroid at the origin.
void closing_speeds(Fragments& fragments, const Vec3& linear, const Vec3& angular, Patch& patch);

// The integral over the patch of the damping pressure phi (s - 1), s = 1 + chi closing clamped to [0, limit], and its first moment, kn = 1.
// The clamp is integrated exactly: damping never pulls, and its power is never positive. Damping acts along the normal of the patch, not of
// the faces. Otherwise an edge that slides over a face would be resisted at its two flanks, and a leaning brick would creep steadily.
double damping(const Fragments& fragments, const Vec3& normal, double chi, double limit, Vec3& first);

// E / kn (m4) of the pieces, or of the summed triangles, found last for the same bodies.
double energy_integral(const ContactShape& a, const ContactShape& b, const PairPose& pose, const Fragments& fragments);
double energy_integral(const ContactShape& a, const ContactShape& b, const PairPose& pose, const Triangles& triangles);

}  // namespace erbs
