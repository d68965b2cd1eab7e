// Overlay of a picture: title, time, ground motion with a moving cursor, scale and legend.
#pragma once
#include "render/draw/draw.h"
#include "render/draw/marks_picture.h"
#include "render/image/text.h"
#include "render/run/stage.h"

namespace erbs::render {

inline constexpr Ink quiet_ink{95, 102, 110, 1}, accent{176, 48, 28, 1};
inline constexpr double border = 22;       // in rows of a picture with 720 rows, as all lengths of the overlay
double legible(double size, double unit);  // px, of small type: in pictures of 360 rows 9.4 in place of 8.3, which H.264 blurs

// Pixels of the overlay's unit of length: a row of a picture with 720 rows. Smaller pictures have relatively larger text: at 360 rows its
// smallest letters still have 8 pixels. In an upright picture the width counts.
double overlay_unit(int width, int height);
// Pixels of the overlay at top and bottom of the picture; the camera aims at the part between.
double overlay_top(int width, int height);
double overlay_bottom(int width, int height, bool with_record);
// Of a legend of four rows at the upper right, with its margin; height from the part that the camera aims at on; in rows of a picture with
// 720 rows.
constexpr double legend_width = 214, legend_height = 100, below_title = 60;

std::string length_text(double m);  // "1.5 m", "20 cm", "3 mm"

class Overlay {
 public:
  // camera: its name; slow: seconds of video per second of the run.
  Overlay(const Run& run, const Show& show, const Look& look, const std::string& camera, double slow);
  // Of a picture of one camera, which has this view at time t (s). `marks`: legend of the lines laid over it.
  void draw(Image& image, double t, const View& view, const std::vector<MarkRow>& marks);
  // Of a picture of several cameras: what belongs to one tile, and what belongs to all of them.
  void draw_in_tile(Image& image, double t, const View& view);
  // `legend_top`: px, row below which the legend has room.
  void draw_around_tiles(Image& image, double t, const std::vector<MarkRow>& marks, double legend_top);

 private:
  void see(const View& view);
  void draw_title(Image& image, double t) const;
  void reduce_record();
  void draw_record(Image& image, double t) const;
  void draw_times(Image& image, double top, double bottom, double now) const;
  void draw_legends(Image& image, const std::vector<MarkRow>& marks) const;
  double draw_legend(Image& image) const;  // returns the row at which it ends (px)
  double draw_map(Image& image) const;     // the legend of a colour map
  std::string map_number(double share) const;
  void draw_scale(Image& image) const;
  void draw_axes(Image& image, double t) const;
  double column(double t) const;  // pixel column of the strip at time t
  const Run& run_;
  const Show& show_;
  Look look_;
  std::string camera_;
  Eigen::Matrix3f turn_ = Eigen::Matrix3f::Identity();  // rotation from world to picture: right, up, towards the eye
  double pixel_ = 1;                                    // m, size of a pixel at the distance of the camera's target
  double slow_, unit_;                                  // unit_: pixels per row of a picture with 720 rows
  double legend_top_;                                   // px
  Font regular_, bold_;
  struct Reach {
    double low = 0, high = 0;
  };
  std::vector<Reach> strip_;  // range of the record over each pixel column
  Reach range_;               // of the whole record, and zero
  double strip_left_, strip_right_, end_time_;
};

}  // namespace erbs::render
