// Where two convex bodies overlap, and the elastic and damping pressure there.
//
// Inner-distance potential: E = kn Int_{A and B} phi dV with phi(x) = least depth of x below the faces of the reference body A.
// phi vanishes on the surface of A, so moving boundaries add nothing and the force is an exact derivative of E,
//   force on B = -kn sum_j n_j Int_{face j of B inside A} phi dS,
// the same law for faces, edges and corners. Each face of B is clipped to A and split where another face of A is the nearest;
// phi is linear on each piece.
#pragma once
#include <vector>

#include "engine/contact/shape.h"

namespace erbs {

// Pair axes: the axes of the reference body A, origin at the centroid of the other body B, so that lever arms stay short even
// where A is a slab of many metres.
struct PairPose {
  Mat3 turn;   // x (pair axes) = turn * x (axes of B at rest)
  Vec3 shift;  // m, centroid of B relative to the centroid of A, axes of A
};

struct Piece {
  int face;          // of B
  int nearest;       // face of A
  int first, count;  // vertices in Pieces::vertex
};

// Room that is used again from call to call, one per thread.
struct Pieces {
  std::vector<Piece> piece;
  std::vector<Vec3> vertex;     // m, pair axes
  std::vector<double> depth;    // m, phi
  std::vector<double> closing;  // m/s, speed of B into A along the normal of the patch
  Vec3 v[most_vertices];        // m, vertices of B, pair axes
  Vec3 n[most_faces];           // normals of B, pair axes
  double c[most_faces];         // m, depth of the origin below the faces of A
};

// What keeps two bodies apart, as a number: a face of A, after those a face of B, after those a plane along an edge of each (directions
// i, j of ContactShape::edge: i times those of B plus j); -1: nothing known.
// Distance (m) that it still shows between them; below zero where it shows none.
double distance(const ContactShape& a, const ContactShape& b, const PairPose& pose, int separating);
int separating_face_of_other(const ContactShape& a, const ContactShape& b, const PairPose& pose);
// The edges that show the greatest distance; found, but for round-off, where bodies without a face between them do not overlap.
int separating_edges(const ContactShape& a, const ContactShape& b, const PairPose& pose);

// Finds the pieces. `separating` caches what keeps the bodies apart.
// False if they do not overlap.
bool find_pieces(const ContactShape& a, const ContactShape& b, const PairPose& pose, int& separating, Pieces& out);

// What the elastic part says about the patch; everything in pair axes, kn = 1.
struct Patch {
  Vec3 force = Vec3::Zero();   // m3, on B
  Vec3 moment = Vec3::Zero();  // m4, on B about its centroid
  Vec3 normal = Vec3::Zero();  // unit, direction of the force on B
  double total = 0;            // m3, Int phi dS
  double area = 0;             // m2, surface of B inside A
  double gyration = 0;         // m, polar radius of gyration of that surface
  Mat3 second;                 // m4, Int x x^T dS over that surface
  double deepest = 0;          // m
  double closing = 0;          // m/s, greatest
  Vec3 pressure_centre = Vec3::Zero();
  Vec3 centroid = Vec3::Zero();
};
Patch elastic_patch(const Pieces& pieces);
// Centres, gyration and normal from Int phi x dS, Int x dS, Int x x^T dS; total becomes 0 where there is no patch to speak of.
void finish_patch(const Vec3& pressure, const Vec3& area, const Mat3& second, Patch& patch);
Mat3 symmetric(const double* six);  // xx, yy, zz, xy, yz, zx

// Speed of B into A along the normal of the patch at every vertex of the pieces; `linear` and `angular` as of a body with its
// centroid at the origin.
void closing_speeds(Pieces& pieces, const Vec3& linear, const Vec3& angular, Patch& patch);

// Damping pressure phi (s - 1), s = 1 + chi closing clamped to [0, limit], the clamp integrated exactly: never pulls, power never positive.
// It acts along the normal of the patch, not of the faces: an edge that slides over a face must not feel its two flanks plough,
// which would let a leaning brick creep at a steady speed.
void damping_wrench(const Pieces& pieces, const Vec3& normal, double chi, double limit, Vec3& force, Vec3& moment);

// E / kn (m4) of the pieces, or summed triangles, found last for the same bodies.
double energy_integral(const ContactShape& a, const ContactShape& b, const PairPose& pose, const Pieces& pieces);
double energy_integral(const ContactShape& a, const ContactShape& b, const PairPose& pose, const Triangles& triangles);

}  // namespace erbs
