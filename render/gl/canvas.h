// Render targets of one picture: a multisampled image, its resolved copy with depth, the shadow map, and the final passes.
#pragma once
#include <vector>

#include "engine/base/vec.h"
#include "render/gl/gl.h"
#include "render/gl/region.h"
#include "render/image/image.h"

namespace erbs::render {

// A texture (or a multisampled buffer) with its framebuffer; frees both.
class Target {
 public:
  Target() = default;
  Target(const Gl* gl, int w, int h) : width(w), height(h), gl_(gl) { gl->GenFramebuffers(1, &framebuffer); }
  Target(Target&& other) noexcept { *this = std::move(other); }
  Target& operator=(Target&& other) noexcept;
  ~Target();
  int width = 0, height = 0;
  GLuint framebuffer = 0, color = 0, depth = 0;  // textures
  GLuint buffers[2] = {0, 0};                    // or multisampled renderbuffers

 private:
  const Gl* gl_ = nullptr;
};

Target shadow_target(const Gl& gl, int side);
Target multisampled_target(const Gl& gl, int width, int height, int samples);
Target picture_target(const Gl& gl, int width, int height, bool with_depth);

class Canvas {
 public:
  Canvas(const Gl& gl, int width, int height, int shadow_side);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  // The steps of a picture, in this order. The model is drawn with several samples a pixel and only within a region, before nothing; the
  // backdrop, which has no edges of its own, with one sample a pixel everywhere. It is kept: pictures of a camera at rest have the same
  // one.
  void begin_shadow();                     // afterwards draw everything that casts a shadow
  void begin_model(const Region& within);  // afterwards draw what stands on the ground
  void begin_depth();                      // takes the depth of the model; afterwards draw the ground, of which only the depth counts
  void begin_translucent();                // afterwards draw what darkens no corners, if there is any
  void begin_backdrop(const Eigen::Vector4f& clear);  // colour and transparency; afterwards draw ground and sky, with their transparency
  void lay_backdrop();                                // the one drawn last; afterwards draw shadows on it
  // Darkens corners within `radius` (m), lays the model over the backdrop and returns the pixels, perhaps with their opacity.
  Image finish(const Eigen::Matrix4f& projection, double radius, bool with_opacity);

  void limit_to(const Region& region);  // draws there alone
  Region whole() const { return {0, 0, width_, height_}; }
  const Region& model_region() const { return region_; }  // whose lower left corner is gl_FragCoord's origin while the model is drawn
  int width() const { return width_; }
  int height() const { return height_; }
  GLuint shadow_map() const { return shadow_.depth; }
  GLuint depth_map() const { return resolved_.depth; }  // after begin_depth()
  int shadow_side() const { return shadow_.width; }     // texels
  static constexpr int border = 8;                      // px, of the region around the model: without model

 private:
  Image read(bool with_opacity);
  void resolve(GLenum what);
  void begin_flat(const Target& target) const;
  void bind_model() const;
  void screen_pass(GLuint program, const Target& target, const Region& within);
  void occlusion_uniforms(GLuint program, const Eigen::Matrix4f& projection, double radius);
  const Gl& gl_;
  int width_, height_;
  Region region_;
  std::vector<std::uint8_t> pixels_;  // as read
  Target shadow_, sampled_, resolved_, occlusion_, blurred_, backdrop_, final_;
  GLuint occlusion_program_, blur_program_, finish_program_, empty_;
};

}  // namespace erbs::render
