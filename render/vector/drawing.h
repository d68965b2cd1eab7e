// An instant of a run as a line drawing (SVG): outlines of the blocks without hidden lines, cracks in the joints, legend and scale.
#pragma once
#include <atomic>
#include <string>

#include "render/movie/movie.h"
#include "render/vector/hidden_lines.h"

namespace erbs::render {

// Width (px of 720 rows) of a crack by the opening of its joint (m): a tenth of a millimetre, one, ten and a hundred are told apart.
double crack_width(double opening);

// A line of the drawing, by what it shows. The widths of cracks are their own.
struct LineInk {
  std::string color;  // "#rrggbb"
  double width = 1;   // px
};

// Lines by their ink, in the order in which they are drawn.
struct LineGroup {
  std::string name;
  LineInk ink;
  std::vector<Piece> pieces;
};

// `solid`: the scene as it is cut by a section. `position`: of the table that turns.
struct DrawnInstant {
  const Run& run;
  const Show& show;
  const MotionScene& solid;
  const Look& look;
  Camera camera;  // of the level world
  bool parallel = false;
  const MotionFrame& frame;
  std::optional<Eigen::Isometry3d> position;
  Marks marks;
};
std::vector<LineGroup> lines_of(const DrawnInstant& instant);
std::string svg_of(const DrawnInstant& instant);

// Writes DIR/frames/CAMERA_tTIME.svg for each camera and each time of --stills (without: the end of the run), and prints the paths. The
// elevations (from_-x ... from_above) are parallel projections. False if `stop` was set meanwhile.
bool make_drawings(const Run& run, const MotionReader& reader, const Movie& movie, const std::atomic<bool>& stop,
                   const std::function<void()>& checked = {});

}  // namespace erbs::render
