// An off-screen OpenGL 3.3 core context of the calling thread. Pictures are drawn into our own framebuffer, so a context is
// nothing but a source of functions.
#pragma once
#include <memory>
#include <string>

namespace erbs::render {

class Context {
 public:
  virtual ~Context() = default;
  virtual void* function(const char* name) const = 0;  // nullptr where the driver has no such function
};

// Makes the context current in this thread; nullptr where this kind does not work here.
std::unique_ptr<Context> make_osmesa_context();
std::unique_ptr<Context> make_egl_context();

// kind: osmesa | egl | auto (OSMesa, then EGL). Error where none works.
std::unique_ptr<Context> make_context(const std::string& kind = "auto");

// Settings that the software rasteriser reads from the environment when the first context is made. Call before any thread starts.
void prepare_contexts();

}  // namespace erbs::render
