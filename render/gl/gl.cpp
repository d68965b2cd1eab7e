#include "render/gl/gl.h"

#include <array>
#include <stdexcept>

#include "engine/base/error.h"

namespace erbs::render {

Gl load_gl(const Context& context) {
  Gl gl;
  std::string missing;
#define X(TYPE, NAME)                                                          \
  gl.NAME = reinterpret_cast<PFNGL##TYPE##PROC>(context.function("gl" #NAME)); \
  if (!gl.NAME) missing += " gl" #NAME;
  ERBS_GL_FUNCTIONS(X)
#undef X
  if (!missing.empty()) throw Error("the OpenGL driver lacks" + missing + "; OpenGL 3.3 is needed: install libosmesa6");
  return gl;
}

namespace {

GLuint compile(const Gl& gl, GLenum stage, const std::string& source) {
  const GLuint shader = gl.CreateShader(stage);
  const char* text = source.c_str();
  gl.ShaderSource(shader, 1, &text, nullptr);
  gl.CompileShader(shader);
  GLint good = 0;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good) return shader;
  std::array<char, 2000> log{};
  gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
  throw std::logic_error(fmt::format("internal error: a shader does not compile: {}\n{}", log.data(), source));
}

}  // namespace

GLuint make_program(const Gl& gl, const std::string& common, const std::string& vertex, const std::string& fragment) {
  const std::string head =
      "#version 330 core\n#extension GL_ARB_texture_gather : require\n#extension GL_ARB_ES3_1_compatibility : enable\n" + common;
  const std::array<GLuint, 2> shaders{compile(gl, GL_VERTEX_SHADER, head + vertex), compile(gl, GL_FRAGMENT_SHADER, head + fragment)};
  const GLuint program = gl.CreateProgram();
  for (GLuint shader : shaders) gl.AttachShader(program, shader);
  gl.LinkProgram(program);
  for (GLuint shader : shaders) gl.DeleteShader(shader);
  GLint good = 0;
  gl.GetProgramiv(program, GL_LINK_STATUS, &good);
  if (good) return program;
  std::array<char, 2000> log{};
  gl.GetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
  throw std::logic_error(fmt::format("internal error: shaders do not link: {}", log.data()));
}

}  // namespace erbs::render
