// Shapes of the joints of a pack: shared by packs of one type, own where types meet in one pack.
#include <algorithm>
#include <cmath>

#include "engine/base/count.h"
#include "engine/joints/cracked/cracked.h"

namespace erbs {
// Whether cells lie in a grid, point n b + a between the lines a and a + 1 along s, b and b + 1 along t, as quadrature() numbers them.
Cracked::CellGrid Cracked::grid_of(const JointType& type) const {
  const double near = 1e-12 * type.radius;
  CellGrid grid;
  const auto* corner = &model_.overlap_corner[z(type.first_corner)];
  grid.rectangle = type.corners == 4 && std::all_of(corner, corner + 4, [&](const auto& c) {
                     return std::fabs(std::fabs(c.x()) - type.half_s) < near && std::fabs(std::fabs(c.y()) - type.half_t) < near;
                   });
  const int n = int(std::lround(std::sqrt(type.points)));
  if (!grid.rectangle || type.inset || n * n != type.points || n > most_cells_in_line) return grid;
  const auto loop = [&](int a, int b) { return &model_.cell_loop[z(model_.cell[z(type.first_cell + n * b + a)].first)]; };
  for (int i = 0; i < type.points; ++i)
    if (model_.cell[z(type.first_cell + i)].corners != 4) return grid;
  for (int i = 0; i < n; ++i) grid.s[i] = loop(i, 0)[0].x(), grid.t[i] = loop(0, i)[0].y();
  grid.s[n] = loop(n - 1, 0)[1].x(), grid.t[n] = loop(0, n - 1)[3].y();
  for (int b = 0; b < n; ++b)
    for (int a = 0; a < n; ++a)
      for (int k = 0; k < 4; ++k) {
        const auto& c = loop(a, b)[k];
        const double s = grid.s[a + (k == 1 || k == 2 ? 1 : 0)], t = grid.t[b + (k >= 2 ? 1 : 0)];
        if (std::fabs(c.x() - s) > near || std::fabs(c.y() - t) > near) return grid;
      }
  grid.lines = (grid.s[n] > grid.s[0]) == (grid.t[n] > grid.t[0]) ? n : 0;
  return grid;
}

// Writes the shape of one type to lane l of `shapes`, which has the same number of points and corners.
void Cracked::set_shape(Shapes& shapes, int l, const JointType& type) const {
  for (int i = 0; i < type.corners; ++i) {
    const auto& c = model_.overlap_corner[z(type.first_corner + i)];
    shapes.overlap_corner[z(i)].s[l] = c.x(), shapes.overlap_corner[z(i)].t[l] = c.y();
  }
  const CellGrid& grid = grid_.at(&type);
  for (int i = 0; i < int(shapes.line.size()); ++i) shapes.line[z(i)].s[l] = grid.s[i], shapes.line[z(i)].t[l] = grid.t[i];
  const Quat frame(type.frame);
  for (int i = 0; i < 4; ++i) shapes.face.frame[i][l] = frame.coeffs()[i];
  for (int i = 0; i < 6; ++i) shapes.face.stiffness[i][l] = type.stiffness[i];
  shapes.face.half_s[l] = type.half_s, shapes.face.half_t[l] = type.half_t, shapes.face.radius[l] = type.radius;
  shapes.face.bend_s[l] = type.face[0], shapes.face.bend_t[l] = type.face[1], shapes.face.twist[l] = type.face[2];
  const int first = model_.cell[z(type.first_cell)].first;
  for (int i = 0; i < int(shapes.cell_loop.size()); ++i) {
    const auto &c = model_.cell_loop[z(first + i)], &w = model_.tension_loop[z(first + i)];
    shapes.cell_loop[z(i)].s[l] = c.x(), shapes.cell_loop[z(i)].t[l] = c.y();
    if (!shapes.tension_loop.empty()) shapes.tension_loop[z(i)].s[l] = w.x(), shapes.tension_loop[z(i)].t[l] = w.y();
  }
  for (int i = 0; i < type.points; ++i) {
    const Point& from = model_.point[z(type.first_cell + i)];
    const Cell& cell = model_.cell[z(type.first_cell + i)];
    CellPack& k = shapes.cell[z(i)];
    k.s[l] = cell.s, k.t[l] = cell.t, k.ss[l] = cell.ss, k.st[l] = cell.st, k.tt[l] = cell.tt;
    PointPack& p = shapes.point[z(i)];
    p.s[l] = from.s, p.t[l] = from.t, p.weight[l] = from.weight;
  }
}

std::shared_ptr<Cracked::Shapes> Cracked::shared_shapes(const JointType& type) {
  std::shared_ptr<Shapes>& shared = of_type_[&type];
  if (!shared) {
    shared = std::make_shared<Shapes>();
    shared->overlap_corner.resize(z(type.corners));
    shared->point.resize(z(type.points));
    shared->cell.resize(z(type.points));
    shared->first.push_back(0);
    for (int i = type.first_cell; i < type.first_cell + type.points; ++i)
      shared->first.push_back(shared->first.back() + model_.cell[z(i)].corners);
    shared->cell_loop.resize(z(shared->first.back()));
    const CellGrid& grid = grid_.at(&type);
    shared->rectangles = grid.rectangle;
    if (grid.lines > 0) shared->line.resize(z(grid.lines + 1));
    if (type.inset) shared->tension_loop.resize(shared->cell_loop.size());
    for (int k = 0; k < pack_size; ++k) set_shape(*shared, k, type);
  }
  return shared;
}

// Lanes without a joint may have any shape: they neither move nor transmit a force.
void Cracked::add_shape(Group& group, int l, const JointType& type) {
  if (group.empty()) {
    group.type = &type;
    group.shapes = shared_shapes(type);
  } else if (group.type != &type) {
    if (group.type != nullptr) group.shapes = std::make_shared<Shapes>(*group.shapes);
    group.type = nullptr;
    set_shape(*group.shapes, l, type);
  }
}

}  // namespace erbs
