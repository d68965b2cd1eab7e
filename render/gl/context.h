// An off-screen OpenGL 3.3 core context of the calling thread. Pictures are drawn into our own framebuffer, so a context only supplies
// functions.
#pragma once
#include <memory>
#include <string>

namespace erbs::render {

class Context {
 public:
  virtual ~Context() = default;
  virtual void* function(const char* name) const = 0;  // nullptr if the driver has no such function
};

// Makes the context current in this thread; nullptr if this kind does not work here.
std::unique_ptr<Context> make_osmesa_context();
std::unique_ptr<Context> make_egl_context();

// kind: osmesa | egl | auto (OSMesa, then EGL). Error if none works.
std::unique_ptr<Context> make_context(const std::string& kind = "auto");

// Sets environment variables that the software rasteriser reads with the first context. Call before any thread starts.
void prepare_contexts();

}  // namespace erbs::render
