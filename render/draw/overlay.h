// Overlay of a picture: title, time, ground motion with a moving cursor, scale and legend.
#pragma once
#include "render/draw/draw.h"
#include "render/image/text.h"
#include "render/run/stage.h"

namespace erbs::render {

// Pixels of the overlay at top and bottom of the picture; the camera aims at the part between.
double overlay_top(int height);
double overlay_bottom(int height, bool with_record);

class Overlay {
 public:
  // slow: seconds of video per second of the run.
  Overlay(const Run& run, const Show& show, const Look& look, const Camera& camera, const View& view, double slow);
  void draw(Image& image, double t) const;  // t: s

 private:
  void draw_title(Image& image, double t) const;
  void draw_record(Image& image, double t) const;
  void draw_times(Image& image, double top, double bottom, double now) const;
  void draw_legend(Image& image) const;
  void draw_map(Image& image) const;  // the legend of a colour map
  std::string map_number(double share) const;
  void draw_scale(Image& image) const;
  void draw_axes(Image& image, double t) const;
  double column(double t) const;  // pixel column of the strip at time t
  const Run& run_;
  const Show& show_;
  Look look_;
  std::string camera_;
  Eigen::Matrix3f turn_;  // rotation from world to picture: right, up, towards the eye
  double pixel_;          // m, size of a pixel at the distance of the camera's target
  double slow_, unit_;    // unit_: pixels per row of a picture with 720 rows
  Font regular_, bold_;
  struct Reach {
    double low, high;
  };
  std::vector<Reach> strip_;  // range of the record over each pixel column, relative to its peak
  double strip_left_, strip_right_, end_time_;
};

}  // namespace erbs::render
