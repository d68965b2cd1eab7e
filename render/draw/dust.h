// Dust that rises where blocks hit the ground or each other: an illustration for films, of no physical meaning.
#pragma once
#include <vector>

#include "engine/record/folder/motion_file.h"

namespace erbs::render {

// A blow between two frames: a block has lost speed that no free flight takes.
struct Impact {
  double t = 0;       // s
  Vec3 at{0, 0, 0};   // m, below the block
  double speed = 0;   // m/s, lost
  double size = 0;    // m, cube root of the block's volume
  unsigned seed = 0;  // of its form, from block and frame
};

// A soft cloud, as a sphere.
struct Puff {
  Vec3 at{0, 0, 0};    // m
  double radius = 0;   // m
  double opacity = 0;  // 0..1, in its middle
  double seed = 0;     // 0..1
};

inline constexpr double least_blow = 0.5;        // m/s, that raises dust
inline constexpr std::size_t most_puffs = 1200;  // of a picture

// Blows of the blocks in frames in order of time: `read(i)` gives frame i. Blows of one frame in one place are one.
class ImpactFinder {
 public:
  explicit ImpactFinder(const MotionScene& scene) : scene_(scene) {}
  void add(MotionFrame frame);
  std::vector<Impact> impacts;

 private:
  const MotionScene& scene_;
  std::vector<MotionFrame> last_;  // at most two
};

// What is to be seen of them at time t (s).
std::vector<Puff> dust_at(const std::vector<Impact>& impacts, double t);

}  // namespace erbs::render
