// Render targets of one picture: a multisampled image, its resolved copy with depth, the shadow map, and the final passes.
#pragma once
#include <vector>

#include "engine/base/vec.h"
#include "render/gl/gl.h"
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
  Canvas(const Gl& gl, int width, int height);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  void begin_shadow();   // afterwards draw everything that casts a shadow
  void begin_picture();  // afterwards draw everything visible
  // Afterwards draw what is translucent: it darkens no corners.
  void begin_translucent();
  // Darkens corners within `radius` (m), then returns the pixels, perhaps with their opacity.
  Image finish(const Eigen::Matrix4f& projection, double radius, bool with_opacity);

  int width() const { return width_; }
  int height() const { return height_; }
  GLuint shadow_map() const { return shadow_.depth; }
  GLuint depth_map() const { return resolved_.depth; }  // after begin_translucent()
  static constexpr int shadow_side = 2048;              // texels

 private:
  Image read(bool with_opacity) const;
  void resolve(GLenum what);
  void screen_pass(GLuint program, const Target& target);
  void occlusion_uniforms(GLuint program, const Eigen::Matrix4f& projection, double radius);
  const Gl& gl_;
  int width_, height_;
  bool translucent_ = false;  // the depth of the picture is taken
  Target shadow_, sampled_, resolved_, occlusion_, blurred_, final_;
  GLuint occlusion_program_, blur_program_, finish_program_, empty_;
};

}  // namespace erbs::render
