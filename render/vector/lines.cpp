// The lines of a drawing: edges of blocks, cracks, and the ground.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "engine/base/error.h"
#include "render/draw/marks_picture.h"
#include "render/vector/drawing.h"

namespace erbs::render {
namespace {

constexpr double grazing = 0.12;  // cosine; cracks of a face seen more from its edge would merge to a dark stripe
constexpr double steep = 0.3;     // cosine; on a face seen more from its edge lines may crowd

// A convex body in space: its faces, and for each edge the two faces that meet there.
struct Solid {
  std::vector<std::vector<Vec3>> faces;
  struct Edge {
    Vec3 p{0, 0, 0}, q{0, 0, 0};
    int left = -1, right = -1;
  };
  std::vector<Edge> edges;
};

Solid solid_of(const MotionShape& shape, const Vec3& at, const Eigen::Quaterniond& turn) {
  Solid solid;
  std::map<std::pair<int, int>, std::size_t> known;
  for (const std::vector<int>& loop : shape.faces) {
    const int face = static_cast<int>(solid.faces.size());
    solid.faces.emplace_back();
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const int i = loop[k], j = loop[(k + 1) % loop.size()];
      solid.faces.back().push_back(at + turn * corner_of(shape, i));
      const auto [edge, fresh] = known.try_emplace(std::minmax(i, j), solid.edges.size());
      if (fresh) solid.edges.push_back({at + turn * corner_of(shape, i), at + turn * corner_of(shape, j), face, -1});
      else solid.edges[edge->second].right = face;
    }
  }
  return solid;
}

// Without those lines that run beside one that stays, nearer than `apart` (px): on a face seen nearly from its edge they would merge.
std::vector<Piece> thinned(std::vector<Piece> pieces, double apart) {
  constexpr double cell = 8;  // px
  std::map<std::pair<int, int>, std::vector<Piece>> kept;
  const auto place = [](const Eigen::Vector2d& p) {
    return std::pair(static_cast<int>(std::floor(p.x() / cell)), static_cast<int>(std::floor(p.y() / cell)));
  };
  const auto beside = [&](const Eigen::Vector2d& p, const Eigen::Vector2d& direction) {
    const auto [x, y] = place(p);
    for (int i = x - 1; i <= x + 1; ++i)
      for (int j = y - 1; j <= y + 1; ++j)
        if (const auto here = kept.find({i, j}); here != kept.end())
          for (const Piece& k : here->second) {
            const Eigen::Vector2d way = k.to - k.from, d = way.normalized();
            if (std::fabs(d.dot(direction)) < 0.98) continue;  // 11 degrees
            const double along = std::clamp((p - k.from).dot(d), 0.0, way.norm());
            if ((p - k.from - along * d).norm() < apart) return true;
          }
    return false;
  };
  std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return (a.to - a.from).norm() > (b.to - b.from).norm(); });
  std::vector<Piece> out;
  for (const Piece& piece : pieces) {
    const Eigen::Vector2d way = piece.to - piece.from;
    const double length = way.norm();
    const auto at = [&](double s) { return Eigen::Vector2d(piece.from + s * way); };
    // Short ones follow each other in one long line.
    if (length > 2 * apart && beside(at(0.15), way / length) && beside(at(0.5), way / length) && beside(at(0.85), way / length)) continue;
    out.push_back(piece);
    const int steps = 1 + static_cast<int>(length / (0.5 * cell));
    std::pair<int, int> last(-1000, -1000);
    for (int i = 0; i <= steps; ++i)
      if (const auto here = place(at(static_cast<double>(i) / steps)); here != last) kept[here].push_back(piece), last = here;
  }
  return out;
}

Vec3 normal_of(const std::vector<Vec3>& loop) { return area_normal(loop).normalized(); }

class Lines {
 public:
  explicit Lines(const DrawnInstant& d)
      : d_(d),
        camera_(d.position ? in_scene(d.camera, *d.position) : d.camera),
        projection_(camera_, d.parallel, d.look.width, d.look.height, d.look.top, d.look.bottom),
        eps_(1e-3 * std::max(1e-6, thinnest())),
        contour_step_(2 * std::max(1e-6, thinnest())),
        hidden_(projection_, d.look.width, d.look.height, eps_),
        unit_(d.look.height / 720.0) {
    for (std::size_t b = 0; b < d.solid.blocks.size(); ++b) add_block(b);
    for (std::size_t j = 0; j < d.solid.joints.size(); ++j) add_mortar(j);
    if (d.position && d.show.stage.on_ground) add_table();
  }

  std::vector<LineGroup> groups() {
    std::vector<LineGroup> out;
    LineGroup ground{"ground", {"#b9bcc0", 0.7 * unit_}, {}}, outline{"outlines", {"#14171b", 1.25 * unit_}, {}};
    LineGroup edge{"edges", {"#3f454c", (d_.show.mortared ? 0.55 : 0.8) * unit_}, {}}, ghost{"ghosts", {"#a4a9af", 0.5 * unit_}, {}};
    LineGroup aslant{"edges of faces seen aslant", {"#7b8187", 0.4 * unit_}, {}};
    std::vector<Piece> crowded;
    if (!d_.position) add_ground(ground);
    for (const Body& body : bodies_)
      for (const Solid::Edge& e : body.solid.edges) {
        if ((!front(body.solid, e.left) && !front(body.solid, e.right)) || (body.in_many_parts && inner(body, e))) continue;
        for (const Piece& piece : hidden_.visible(e.p, e.q, body.id)) {
          if (body.ghost) ghost.pieces.push_back(piece);
          else if (const auto [contour, crowds] = sides_of(piece); contour) outline.pieces.push_back(piece);
          else (crowds ? crowded : edge.pieces).push_back(piece);
        }
      }
    aslant.pieces = thinned(std::move(crowded), 2.6 * unit_);
    for (LineGroup* group : {&ground, &ghost, &aslant, &edge, &outline})
      if (!group->pieces.empty()) out.push_back(std::move(*group));
    add_cracks(out);
    return out;
  }

 private:
  struct Body {
    Solid solid;
    int id = 0;
    bool ghost = false, in_many_parts = false;
    std::size_t block = 0;
  };

  // m, the least thickness of a block.
  double thinnest() const {
    double least = HUGE_VAL;
    for (const MotionShape& shape : d_.solid.shapes) {
      Eigen::AlignedBox3f box;
      for (std::size_t i = 0; i + 2 < shape.vertices.size(); i += 3)
        box.extend(Eigen::Vector3f(shape.vertices[i], shape.vertices[i + 1], shape.vertices[i + 2]));
      if (!box.isEmpty()) least = std::min(least, static_cast<double>(box.sizes().minCoeff()));
    }
    return std::isfinite(least) ? least : 1;
  }

  // What lies on both sides of a visible line: is it a contour, behind which there is nothing or something far away? Does it lie on a face
  // that is seen nearly from its edge, where lines crowd?
  std::pair<bool, bool> sides_of(const Piece& piece) const {
    const Eigen::Vector2d way = piece.to - piece.from, middle = 0.5 * (piece.from + piece.to);
    const double aside = 1.2;  // px
    const Eigen::Vector2d across = aside * Eigen::Vector2d(-way.y(), way.x()) / std::max(1e-9, way.norm());
    const auto left = hidden_.sight(middle + across), right = hidden_.sight(middle - across);
    if (!left || !right) return {true, false};
    const double least = std::min(left->facing, right->facing),
                 step = std::fabs(projection_.depth_of(left->near) - projection_.depth_of(right->near));
    // A slanting face itself is deeper on one side of the line than on the other.
    const double own = 2 * aside / projection_.pixels_per_metre() / std::max(0.02, least);
    return {step > contour_step_ + own, least < steep};
  }

  static void append(LineGroup& to, const std::vector<Piece>& pieces) { to.pieces.insert(to.pieces.end(), pieces.begin(), pieces.end()); }

  // Cosine between the normal of a face and the direction to the eye; -1 without a face.
  double facing(const Solid& solid, int face) const {
    if (face < 0) return -1;
    const std::vector<Vec3>& loop = solid.faces[static_cast<std::size_t>(face)];
    return cosine(area_normal(loop), loop.front());
  }
  double cosine(const Vec3& direction, const Vec3& at) const {
    const Vec3 view = projection_.parallel() ? projection_.back() : Vec3(projection_.eye() - at);
    return direction.dot(view) / std::max(1e-300, direction.norm() * view.norm());
  }
  bool front(const Solid& solid, int face) const { return facing(solid, face) > 1e-7; }

  // An edge where a part of its block goes on in one plane: no edge of the whole.
  bool inner(const Body& body, const Solid::Edge& edge) const {
    const Vec3 middle = 0.5 * (edge.p + edge.q);
    for (const int face : {edge.left, edge.right}) {
      if (!front(body.solid, face)) continue;
      const Vec3 n = normal_of(body.solid.faces[static_cast<std::size_t>(face)]);
      bool goes_on = false;
      auto first = static_cast<std::size_t>(body.id);  // the parts of a block lie side by side
      while (first > 0 && bodies_[first - 1].block == body.block) --first;
      for (std::size_t k = first; k < bodies_.size() && bodies_[k].block == body.block; ++k) {
        const Body& other = bodies_[k];
        if (other.id == body.id) continue;
        for (const std::vector<Vec3>& loop : other.solid.faces) {
          if (normal_of(loop).dot(n) < 0.9999 || std::fabs((middle - loop.front()).dot(n)) > eps_) continue;
          bool within = true;
          for (std::size_t i = 0; i < loop.size() && within; ++i)
            within = n.cross(loop[(i + 1) % loop.size()] - loop[i]).normalized().dot(middle - loop[i]) > -eps_;
          goes_on = goes_on || within;
        }
      }
      if (!goes_on) return false;
    }
    return true;
  }

  void add_solid(Solid solid, std::size_t block, bool ghost, bool in_many_parts) {
    const int id = static_cast<int>(bodies_.size());
    if (!ghost)
      for (std::size_t f = 0; f < solid.faces.size(); ++f)
        if (front(solid, static_cast<int>(f))) hidden_.add_face(solid.faces[f], id);
    bodies_.push_back({std::move(solid), id, ghost, in_many_parts, block});
  }

  void add_block(std::size_t b) {
    if (d_.show.stage.hidden[b] || !position_of(d_.frame, b).allFinite()) return;
    const MotionBlock& block = d_.solid.blocks[b];
    for (const int part : block.parts)
      add_solid(solid_of(d_.solid.shapes[static_cast<std::size_t>(part)], position_of(d_.frame, b), rotation_of(d_.frame, b)), b,
                d_.show.ghost[b], block.parts.size() > 1);
  }

  // What stands on the table is pressed into it, and its foot must not be hidden: the top lies lower than it is.
  void add_table() {
    Eigen::AlignedBox3d table = d_.show.stage.table;
    table.max().z() = std::max(table.min().z(), table.max().z() - 0.02 * thinnest());
    MotionShape box;
    for (int i = 0; i < 8; ++i) {
      const Vec3 p = table.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
      for (int c = 0; c < 3; ++c) box.vertices.push_back(static_cast<float>(p[c]));
    }
    box.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    add_solid(solid_of(box, Vec3::Zero(), Eigen::Quaterniond::Identity()), d_.solid.blocks.size(), false, false);
  }

  // A point of a joint, relative to a at rest, as each of its blocks has moved it.
  std::pair<Vec3, Vec3> ends(const MotionJoint& joint, const Vec3& p) const {
    const auto a = static_cast<std::size_t>(joint.a), b = static_cast<std::size_t>(joint.b);
    const Vec3 to_b = d_.solid.blocks[b].rest - d_.solid.blocks[a].rest;
    return {position_of(d_.frame, a) + rotation_of(d_.frame, a) * p, position_of(d_.frame, b) + rotation_of(d_.frame, b) * (p - to_b)};
  }
  double parted(const MotionJoint& joint) const {  // m, slip included
    double most = 0;
    for (const Vec3& p : joint.polygon) {
      const auto [pa, pb] = ends(joint, p);
      most = std::max(most, (pa - pb).norm());
    }
    return most;
  }

  // Mortar of a joint that is not yet wide open hides what is behind it: half of the bed sticks to each block.
  void add_mortar(std::size_t j) {
    const MotionJoint& joint = d_.solid.joints[j];
    const auto a = static_cast<std::size_t>(joint.a), b = static_cast<std::size_t>(joint.b);
    if (joint.thickness <= 0 || joint.polygon.size() < 3 || d_.show.ghost[a] || d_.show.ghost[b]) return;
    if (!(parted(joint) < 0.5 * joint.thickness)) return;
    const Vec3 n = joint_normal(d_.solid, joint), to_b = d_.solid.blocks[b].rest - d_.solid.blocks[a].rest;
    Loop polygon = joint.polygon;
    if (area_normal(polygon).dot(n) < 0) std::reverse(polygon.begin(), polygon.end());
    for (const double side : {-0.5, 0.5}) {
      const std::size_t block = side < 0 ? a : b;
      const Eigen::Quaterniond turn = rotation_of(d_.frame, block);
      const auto at = [&](const Vec3& p, double along) {
        return Vec3(position_of(d_.frame, block) + turn * (p - (side < 0 ? Vec3(Vec3::Zero()) : to_b) + along * n));
      };
      const double from = std::min(0.0, side * joint.thickness), to = std::max(0.0, side * joint.thickness);
      Solid bed;
      bed.faces.resize(2);
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        bed.faces.push_back({at(p, from), at(q, from), at(q, to), at(p, to)});
        bed.faces[0].push_back(at(p, to));
        bed.faces[1].insert(bed.faces[1].begin(), at(p, from));
      }
      for (std::size_t f = 0; f < bed.faces.size(); ++f)
        if (front(bed, static_cast<int>(f))) hidden_.add_face(bed.faces[f], -1);
    }
  }

  // In an elevation a line where the ground begins, else a grid.
  void add_ground(LineGroup& ground) const {
    const Stage& stage = d_.show.stage;
    const double z = stage.ground_z, step = d_.show.grid;
    if (projection_.parallel() && std::fabs(projection_.back().z()) < 1e-6) {
      const Vec3 along = Vec3::UnitZ().cross(projection_.back()) * 20 * stage.size(),
                 middle(stage.building.center().x(), stage.building.center().y(), z);
      append(ground, hidden_.visible(middle - along, middle + along, -1, 10 * stage.size()));
      return;
    }
    if (camera_.eye.z() < z) return;
    Eigen::AlignedBox3d near = stage.building;
    if (!stage.heap.isEmpty()) near.extend(stage.heap);
    Eigen::Array2d low = ((near.min().head<2>().array() / step).floor() - 1) * step,
                   high = ((near.max().head<2>().array() / step).ceil() + 1) * step;
    for (int axis = 0; axis < 2; ++axis)
      for (double x = low[axis]; x < high[axis] + 0.5 * step; x += step) {
        Vec3 p(0, 0, z), q(0, 0, z);
        p[axis] = q[axis] = x, p[1 - axis] = low[1 - axis], q[1 - axis] = high[1 - axis];
        append(ground, hidden_.visible(p, q, -1));
      }
  }

  // The sides of broken joints, in pieces as wide as the joint is open there.
  void add_cracks(std::vector<LineGroup>& out) const {
    std::map<std::pair<int, int>, LineGroup> groups;  // state, tenths of px
    for (std::size_t j = 0; j < d_.solid.joints.size(); ++j) {
      const MotionJoint& joint = d_.solid.joints[j];
      const auto a = static_cast<std::size_t>(joint.a), b = static_cast<std::size_t>(joint.b);
      const bool open = static_cast<double>(d_.frame.opening[j]) >= d_.show.open_crack;
      // From a twentieth of the damage on, as in pictures.
      if (joint.polygon.size() < 3 || (damage_drawn(d_.show, d_.frame, j) < 0.05 && !open) || d_.show.ghost[a] || d_.show.ghost[b])
        continue;
      if (!(parted(joint) < 60 * d_.show.open_crack)) continue;
      const Vec3 n = joint_normal(d_.solid, joint), along = rotation_of(d_.frame, a) * n;
      const double turning = area_normal(joint.polygon).dot(n) < 0 ? -1 : 1;
      const int pieces = open ? 6 : 1;
      for (std::size_t i = 0; i < joint.polygon.size(); ++i)
        for (int k = 0; k < pieces; ++k) {
          const Vec3 &p = joint.polygon[i], side = joint.polygon[(i + 1) % joint.polygon.size()] - p;
          const auto [a0, b0] = ends(joint, p + side * k / pieces);
          const auto [a1, b1] = ends(joint, p + side * (k + 1) / pieces);
          if (!(cosine(turning * (a1 - a0).cross(along), a0) > grazing)) continue;
          const double gap = 0.5 * ((b0 - a0) + (b1 - a1)).dot(along) / d_.look.magnify;
          const int tenths = static_cast<int>(std::lround(10 * crack_width(gap)));
          const JointState state = open ? JointState::open : JointState::cracked;
          LineGroup& group = groups[{static_cast<int>(state), tenths}];
          append(group, hidden_.visible(0.5 * (a0 + b0), 0.5 * (a1 + b1), -1, 2 * eps_ + 0.2 * joint.thickness));
          group.name = open ? "open joints" : "cracked joints";
          const Ink ink = display(state_color(state));
          group.ink = {fmt::format("#{:02x}{:02x}{:02x}", ink.r, ink.g, ink.b), 0.1 * tenths * unit_};
        }
    }
    for (auto& [key, group] : groups)
      if (!group.pieces.empty()) out.push_back(std::move(group));
  }

  const DrawnInstant& d_;
  Camera camera_;
  Projection projection_;
  double eps_, contour_step_;  // m
  HiddenLines hidden_;
  double unit_;
  std::vector<Body> bodies_;
};

}  // namespace

double crack_width(double opening) { return std::clamp(0.8 + std::log10(1 + std::max(0.0, opening) / 1e-4), 0.8, 5.0); }

std::vector<LineGroup> lines_of(const DrawnInstant& instant) { return Lines(instant).groups(); }

}  // namespace erbs::render
