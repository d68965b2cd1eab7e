// Draws one frame of a run from one camera.
#pragma once
#include <memory>

#include "render/canvas.h"
#include "render/mesh.h"
#include "render/run.h"
#include "render/stage.h"

namespace erbs::render {

enum class Coloring { material, damage };

struct Look {
  Coloring coloring = Coloring::material;
  int width = 1280, height = 720;
  double top = 0, bottom = 0;  // pixels that the overlay takes
};

// What a picture is made of, the same for every frame and thread.
struct Show {
  const MotionScene* scene = nullptr;
  Stage stage;
  Mesh mesh;
  double chamfer = 0;             // m
  double open_crack = 0;          // m, a hundredth of the thinnest brick: a joint parted by so much is drawn as an open one
  bool mortared = false;          // joints have a thickness: mortar, not an edge, parts the bricks
  double grid = 1;                // m, distance of the lines on the ground
  std::vector<float> joint_area;  // m2                                                              [joints]
  std::vector<Vec3> block_color;  // linear, by material with a slight variation from brick to brick  [blocks]
};
Show prepare_show(const MotionScene& scene, const Run& run, const std::vector<MotionFrame>& some_frames);

// 1, 2 or 5 times a power of ten, about `size`.
double round_length(double size);

// Colour of a block by the share of its joints that is broken, 0..1 (linear), as in the legend.
Vec3 damage_color(double damage);

// What the shaders read, 12 floats a block and 4 a joint, and the triangles that can be seen.
struct FrameTexels {
  std::vector<float> blocks, joints;
  std::vector<std::uint32_t> index, crack_index;
};
FrameTexels texels_of(const Show& show, const MotionFrame& frame, Coloring coloring, const Vec3& eye);

class Painter {
 public:
  // Makes a context current in the calling thread, which alone may use this object.
  Painter(const Show& show, const Look& look, const std::string& context_kind);
  ~Painter();
  Image draw(const MotionFrame& frame, const Camera& camera);

 private:
  struct Hidden;
  std::unique_ptr<Hidden> hidden_;
};

}  // namespace erbs::render
