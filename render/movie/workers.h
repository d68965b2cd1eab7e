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

  std::size_t count() const { return workers_.size(); }
  void order(std::size_t worker, std::size_t index, const MotionFrame& frame);
  Image collect(std::size_t worker);  // the picture ordered; rethrows an error of that process

 private:
  struct Worker {
    Child process;  // takes orders and sends answers
    unsigned char* shared = nullptr;
  };
  void serve(const Worker& worker, int orders, int answers, const std::function<Draw()>& prepare);
  void put(Worker& worker, const MotionFrame& frame) const;
  MotionFrame get(const Worker& worker, double t) const;
  unsigned char* pixels(const Worker& worker) const { return worker.shared + poses_ + openings_ + derived_ + damages_; }

  Image empty_;
  std::size_t poses_, openings_, derived_, damages_, pixels_;  // bytes of each part of the shared memory, in this order
  std::vector<Worker> workers_;
};

}  // namespace erbs::render
