// Processes that draw frames in parallel. Threads would not help: llvmpipe lets only one thread of a process draw at a time, with any
// number of contexts. 50 frames of the house took 11.8 s both with one thread and with two.
#pragma once
#include <functional>
#include <vector>

#include "engine/base/system/process.h"
#include "engine/record/folder/motion_file.h"
#include "render/image/image.h"

namespace erbs::render {

class Workers {
 public:
  using Draw = std::function<Image(std::size_t index, const MotionFrame& frame)>;
  // Each process calls `prepare`, which returns its drawing function. All frames have the size of `like`, all pictures that of `empty`.
  Workers(std::size_t count, Image empty, const MotionFrame& like, const std::function<Draw()>& prepare);
  ~Workers();  // waits for frames being drawn
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  // Orders that a process may have at a time. With a second one it draws on while this process collects the first.
  static constexpr std::size_t most_orders = 2;

  std::size_t count() const { return workers_.size(); }
  void order(std::size_t worker, std::size_t index, const MotionFrame& frame);
  Image collect(std::size_t worker);  // the picture ordered first; rethrows an error of that process
  // Draws `count` frames, all processes at once, and calls take(index, picture) in their order; false from it ends the work.
  void draw_in_order(std::size_t count, const std::function<MotionFrame(std::size_t)>& frame,
                     const std::function<bool(std::size_t, Image)>& take);

 private:
  struct Worker {
    Child process;                           // takes orders and sends answers
    unsigned char* shared = nullptr;         // a place for each order, in turn
    std::size_t ordered = 0, collected = 0;  // so far
  };
  void serve(const Worker& worker, int orders, int answers, const std::function<Draw()>& prepare);
  void put(unsigned char* place, const MotionFrame& frame) const;
  MotionFrame get(const unsigned char* place, double t) const;
  unsigned char* place_of(const Worker& worker, std::size_t order) const { return worker.shared + order % most_orders * bytes(); }
  std::size_t bytes() const { return pixels_at() + pixels_; }  // of a place
  std::size_t pixels_at() const { return poses_ + openings_ + derived_ + damages_; }

  Image empty_;
  std::size_t poses_, openings_, derived_, damages_, pixels_;  // bytes of each part of a place, in this order
  std::vector<Worker> workers_;
};

}  // namespace erbs::render
