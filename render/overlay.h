// What is written over a picture: title, time, ground motion with a moving cursor, scale and legend.
#pragma once
#include "render/draw.h"
#include "render/stage.h"
#include "render/text.h"

namespace erbs::render {

// Pixels at the top and the bottom that the overlay takes from the picture; the camera looks at what lies between.
double overlay_top(int height);
double overlay_bottom(int height, bool with_record);

class Overlay {
 public:
  // slow: seconds of video for one of the run.
  Overlay(const Run& run, const Show& show, const Look& look, const Camera& camera, const View& view, double slow);
  void draw(Image& image, double t) const;  // t: s

 private:
  void draw_title(Image& image, double t) const;
  void draw_record(Image& image, double t) const;
  void draw_times(Image& image, double top, double bottom, double now) const;
  void draw_legend(Image& image) const;
  void draw_scale(Image& image) const;
  void draw_axes(Image& image) const;
  double column(double t) const;  // of the strip, in pixels
  const Run& run_;
  const Show& show_;
  Look look_;
  std::string camera_;
  Eigen::Matrix3f turn_;  // world to picture: right, up, towards the eye
  double pixel_;          // m, size of a pixel at the distance of the camera's target
  double slow_, unit_;    // unit_: pixels of the picture for one of 720 rows
  Font regular_, bold_;
  struct Reach {
    double low, high;
  };
  std::vector<Reach> strip_;  // of the record over each column of pixels, in units of its peak
  double strip_left_, strip_right_, end_time_;
};

}  // namespace erbs::render
