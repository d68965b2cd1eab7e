// Geometry, data and uniforms of the shaders: thin wraps of OpenGL's buffers.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/base/vec.h"
#include "render/gl/gl.h"

namespace erbs::render {

// Buffers of one kind of geometry.
struct Drawable {
  GLuint vao = 0, vertices = 0, index = 0;
  GLsizei count = 0;
};

inline const void* offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

template <class V>
Drawable upload(const Gl& gl, const std::vector<V>& vertices) {
  Drawable d;
  gl.GenVertexArrays(1, &d.vao);
  gl.BindVertexArray(d.vao);
  gl.GenBuffers(1, &d.vertices);
  gl.BindBuffer(GL_ARRAY_BUFFER, d.vertices);
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(V)), vertices.data(), GL_STATIC_DRAW);
  gl.GenBuffers(1, &d.index);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, d.index);
  return d;
}

inline void choose(const Gl& gl, Drawable& d, const std::vector<std::uint32_t>& index) {
  gl.BindVertexArray(d.vao);
  gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(index.size() * sizeof(std::uint32_t)), index.data(), GL_STREAM_DRAW);
  d.count = static_cast<GLsizei>(index.size());
}

// The same vertices with an index of their own.
inline Drawable again(const Gl& gl, const Drawable& d) {
  Drawable other = d;
  gl.GenVertexArrays(1, &other.vao);
  gl.BindVertexArray(other.vao);
  gl.BindBuffer(GL_ARRAY_BUFFER, d.vertices);
  gl.GenBuffers(1, &other.index);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, other.index);
  return other;
}

template <class V>
void floats(const Gl& gl, GLuint location, GLint n, std::size_t at) {
  gl.EnableVertexAttribArray(location);
  gl.VertexAttribPointer(location, n, GL_FLOAT, GL_FALSE, sizeof(V), offset(at));
}
template <class V>
void integers(const Gl& gl, GLuint location, GLint n, std::size_t at) {
  gl.EnableVertexAttribArray(location);
  gl.VertexAttribIPointer(location, n, GL_UNSIGNED_INT, sizeof(V), offset(at));
}

inline void draw_triangles(const Gl& gl, const Drawable& d) {
  gl.BindVertexArray(d.vao);
  gl.DrawElements(GL_TRIANGLES, d.count, GL_UNSIGNED_INT, nullptr);
}

// A buffer that shaders read as vectors of four floats.
struct Texels {
  GLuint buffer = 0, texture = 0;
};

inline void fill(const Gl& gl, const Texels& t, const std::vector<float>& values) {
  gl.BindBuffer(GL_TEXTURE_BUFFER, t.buffer);
  gl.BufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(values.size() * sizeof(float)), values.data(), GL_STREAM_DRAW);
  gl.BindTexture(GL_TEXTURE_BUFFER, t.texture);
  gl.TexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, t.buffer);
}

// Uniforms of the program in use.
struct Uniforms {
  const Gl& gl;
  GLuint program;
  GLint at(const char* name) const { return gl.GetUniformLocation(program, name); }
  void number(const char* name, double value) const { gl.Uniform1f(at(name), static_cast<float>(value)); }
  void sampler(const char* name, int unit) const { gl.Uniform1i(at(name), unit); }
  void two(const char* name, double x, double y) const { gl.Uniform2f(at(name), static_cast<float>(x), static_cast<float>(y)); }
  void vector(const char* name, const Eigen::Vector3f& v) const { gl.Uniform3f(at(name), v.x(), v.y(), v.z()); }
  void four(const char* name, const Eigen::Vector4f& v) const { gl.Uniform4f(at(name), v.x(), v.y(), v.z(), v.w()); }
  void matrix(const char* name, const Eigen::Matrix4f& m) const { gl.UniformMatrix4fv(at(name), 1, GL_FALSE, m.data()); }
};

}  // namespace erbs::render
