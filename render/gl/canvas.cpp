#include "render/gl/canvas.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "engine/base/error.h"
#include "render/gl/shaders.h"

namespace erbs::render {

Target& Target::operator=(Target&& other) noexcept {
  std::swap(width, other.width);
  std::swap(height, other.height);
  std::swap(framebuffer, other.framebuffer);
  std::swap(color, other.color);
  std::swap(depth, other.depth);
  std::swap(buffers, other.buffers);
  std::swap(gl_, other.gl_);
  return *this;
}

Target::~Target() {
  if (!gl_) return;
  gl_->DeleteFramebuffers(1, &framebuffer);
  gl_->DeleteTextures(1, &color);
  gl_->DeleteTextures(1, &depth);
  gl_->DeleteRenderbuffers(2, buffers);
}

namespace {

GLuint make_texture(const Gl& gl, GLint format, GLenum layout, GLenum type, int width, int height, GLint filter) {
  GLuint texture = 0;
  gl.GenTextures(1, &texture);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.TexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, layout, type, nullptr);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

void check(const Gl& gl, int width, int height) {
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw Error(fmt::format("pictures of {}x{} are too large for the OpenGL driver; ask for a smaller --size", width, height));
}

}  // namespace

Target shadow_target(const Gl& gl, int side) {
  Target t(&gl, side, side);
  t.depth = make_texture(gl, GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, side, side, GL_NEAREST);
  gl.BindFramebuffer(GL_FRAMEBUFFER, t.framebuffer);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, t.depth, 0);
  gl.DrawBuffer(GL_NONE);
  gl.ReadBuffer(GL_NONE);
  check(gl, side, side);
  return t;
}

Target multisampled_target(const Gl& gl, int width, int height, int samples) {
  Target t(&gl, width, height);
  gl.BindFramebuffer(GL_FRAMEBUFFER, t.framebuffer);
  gl.GenRenderbuffers(2, t.buffers);
  const GLenum formats[2] = {GL_RGBA8, GL_DEPTH_COMPONENT24}, points[2] = {GL_COLOR_ATTACHMENT0, GL_DEPTH_ATTACHMENT};
  for (int i = 0; i < 2; ++i) {
    gl.BindRenderbuffer(GL_RENDERBUFFER, t.buffers[i]);
    gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, formats[i], width, height);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, points[i], GL_RENDERBUFFER, t.buffers[i]);
  }
  check(gl, width, height);
  return t;
}

Target picture_target(const Gl& gl, int width, int height, bool with_depth) {
  Target t(&gl, width, height);
  t.color = make_texture(gl, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, width, height, GL_LINEAR);
  gl.BindFramebuffer(GL_FRAMEBUFFER, t.framebuffer);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, t.color, 0);
  if (with_depth) {
    t.depth = make_texture(gl, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, width, height, GL_NEAREST);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, t.depth, 0);
  }
  check(gl, width, height);
  return t;
}

Canvas::Canvas(const Gl& gl, int width, int height, int shadow_side)
    : gl_(gl),
      width_(width),
      height_(height),
      shadow_(shadow_target(gl, shadow_side)),
      resolved_(picture_target(gl, width, height, true)),
      occlusion_(picture_target(gl, (width + 1) / 2, (height + 1) / 2, false)),
      blurred_(picture_target(gl, (width + 1) / 2, (height + 1) / 2, false)),
      backdrop_(picture_target(gl, width, height, false)),
      final_(picture_target(gl, width, height, false)),
      occlusion_program_(make_program(gl, shader_common, screen_vertex, occlusion_fragment)),
      blur_program_(make_program(gl, shader_common, screen_vertex, blur_fragment)),
      finish_program_(make_program(gl, shader_common, screen_vertex, finish_fragment)),
      empty_(0) {
  gl.GenVertexArrays(1, &empty_);
}

Canvas::~Canvas() {
  for (GLuint program : {occlusion_program_, blur_program_, finish_program_}) gl_.DeleteProgram(program);
  gl_.DeleteVertexArrays(1, &empty_);
}

namespace {

// Pixels of four channels as pixels of the first three. Four at a time, which takes a quarter of the time.
void drop_last(const std::uint8_t* from, int count, std::uint8_t* to) {
  for (; count >= 4; count -= 4, from += 16, to += 12) {
    std::array<std::uint32_t, 4> p;
    std::memcpy(p.data(), from, sizeof p);
    for (std::uint32_t& pixel : p) pixel &= 0xffffffU;  // the first byte is the lowest one
    const std::array<std::uint32_t, 3> packed{p[0] | p[1] << 24U, p[1] >> 8U | p[2] << 16U, p[2] >> 16U | p[3] << 8U};
    std::memcpy(to, packed.data(), sizeof packed);
  }
  for (; count > 0; --count, from += 4, to += 3) std::copy_n(from, 3, to);
}

// Colours times opacity, and transparency, as colours and opacity.
void unmultiply(const std::uint8_t* from, int count, std::uint8_t* to) {
  for (; count > 0; --count, from += 4, to += 4) {
    const int opacity = to[3] = static_cast<std::uint8_t>(255 - from[3]);
    for (int c = 0; c < 3; ++c)
      to[c] = opacity > 0 ? static_cast<std::uint8_t>(std::min(255, (255 * from[c] + opacity / 2) / opacity)) : from[c];
  }
}

}  // namespace

void Canvas::begin_shadow() {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, shadow_.framebuffer);
  gl_.Viewport(0, 0, shadow_.width, shadow_.height);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.Clear(GL_DEPTH_BUFFER_BIT);
}

void Canvas::limit_to(const Region& r) {
  gl_.Enable(GL_SCISSOR_TEST);
  gl_.Scissor(r.left, r.bottom, std::max(0, r.width()), std::max(0, r.height()));
}

// The multisampled buffers hold the region alone: to clear those of a whole picture of 1280 x 720 takes 7 ms.
void Canvas::begin_model(const Region& within) {
  region_ = within;
  const auto rounded = [](int pixels) { return std::max(64, (pixels + 63) / 64 * 64); };
  const int w = std::max(sampled_.width, rounded(within.width())), h = std::max(sampled_.height, rounded(within.height()));
  if (w > sampled_.width || h > sampled_.height) sampled_ = multisampled_target(gl_, w, h, 4);
  bind_model();
  gl_.Enable(GL_DEPTH_TEST);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);  // of all buffers: faster than of a part
}

void Canvas::bind_model() const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, sampled_.framebuffer);
  gl_.Viewport(-region_.left, -region_.bottom, width_, height_);
}

void Canvas::resolve(GLenum what) {
  const Region& r = region_;
  if (r.empty()) return;
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, sampled_.framebuffer);
  gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.framebuffer);
  gl_.BlitFramebuffer(0, 0, r.width(), r.height(), r.left, r.bottom, r.right, r.top, what, GL_NEAREST);
}

void Canvas::begin_depth() {
  resolve(GL_DEPTH_BUFFER_BIT);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, resolved_.framebuffer);
  gl_.Viewport(0, 0, width_, height_);
  limit_to(region_);
  gl_.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
}

void Canvas::begin_translucent() {
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  bind_model();
}

// One sample a pixel and no depth.
void Canvas::begin_flat(const Target& target) const {
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl_.Disable(GL_DEPTH_TEST);
  gl_.Disable(GL_CULL_FACE);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
  gl_.Viewport(0, 0, width_, height_);
}

void Canvas::begin_backdrop(const Eigen::Vector4f& clear) {
  begin_flat(backdrop_);
  gl_.ClearColor(clear.x(), clear.y(), clear.z(), clear.w());
  gl_.Clear(GL_COLOR_BUFFER_BIT);
  gl_.ClearColor(0, 0, 0, 0);
}

void Canvas::lay_backdrop() {
  begin_flat(final_);
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, backdrop_.framebuffer);
  gl_.BlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, final_.framebuffer);
}

void Canvas::screen_pass(GLuint program, const Target& target, const Region& within) {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
  gl_.Viewport(0, 0, target.width, target.height);
  limit_to(within);
  gl_.UseProgram(program);
  gl_.BindVertexArray(empty_);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  gl_.Disable(GL_SCISSOR_TEST);
}

void Canvas::occlusion_uniforms(GLuint program, const Eigen::Matrix4f& p, double radius) {
  gl_.UseProgram(program);
  const auto at = [&](const char* name) { return gl_.GetUniformLocation(program, name); };
  const float near = p(2, 3) / (p(2, 2) - 1), far = p(2, 3) / (p(2, 2) + 1);
  gl_.Uniform4f(at("unproject"), 1 / p(0, 0), 1 / p(1, 1), p(0, 2), p(1, 2));
  gl_.Uniform2f(at("depth_range"), near, far);
  gl_.Uniform1f(at("radius"), static_cast<float>(radius));
  gl_.Uniform1f(at("radius_uv"), 0.5F * p(1, 1) * static_cast<float>(radius));
  gl_.Uniform1i(at("depth"), 0);
  gl_.Uniform1i(at("occlusion"), 1);
  gl_.Uniform1i(at("picture"), 0);
}

Image Canvas::finish(const Eigen::Matrix4f& projection, double radius, bool with_opacity) {
  gl_.Disable(GL_SCISSOR_TEST);  // also for the next picture, whose shadow map is larger than this one
  if (region_.empty()) return read(with_opacity);
  resolve(GL_COLOR_BUFFER_BIT);
  // Each pass reads beyond the pixel that it writes: the passes of the corners' darkness reach beyond the last one, on all sides.
  const Region half{region_.left / 2, region_.bottom / 2, (region_.right + 1) / 2, (region_.top + 1) / 2};
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, resolved_.depth);
  occlusion_uniforms(occlusion_program_, projection, radius);
  gl_.Uniform2f(gl_.GetUniformLocation(occlusion_program_, "texel"), 1.0F / static_cast<float>(width_), 1.0F / static_cast<float>(height_));
  screen_pass(occlusion_program_, occlusion_, half);
  gl_.ActiveTexture(GL_TEXTURE1);
  gl_.BindTexture(GL_TEXTURE_2D, occlusion_.color);
  occlusion_uniforms(blur_program_, projection, radius);
  gl_.Uniform2f(gl_.GetUniformLocation(blur_program_, "texel"), 1.0F / static_cast<float>(occlusion_.width),
                1.0F / static_cast<float>(occlusion_.height));
  screen_pass(blur_program_, blurred_, inset(half, 3, occlusion_.width, occlusion_.height));
  gl_.BindTexture(GL_TEXTURE_2D, blurred_.color);
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, resolved_.color);
  occlusion_uniforms(finish_program_, projection, radius);
  gl_.Enable(GL_BLEND);
  gl_.BlendFuncSeparate(GL_ONE, GL_SRC_ALPHA, GL_ZERO, GL_SRC_ALPHA);
  screen_pass(finish_program_, final_, inset(region_, Canvas::border, width_, height_));
  gl_.Disable(GL_BLEND);
  return read(with_opacity);
}

Image Canvas::read(bool with_opacity) {
  Image image(width_, height_, with_opacity ? 4 : 3);
  pixels_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * 4);
  gl_.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, pixels_.data());
  for (int y = 0; y < height_; ++y) {
    const std::uint8_t* from = &pixels_[static_cast<std::size_t>(height_ - 1 - y) * static_cast<std::size_t>(width_) * 4];
    if (with_opacity) unmultiply(from, width_, image.pixel(0, y));
    else drop_last(from, width_, image.pixel(0, y));
  }
  return image;
}

}  // namespace erbs::render
