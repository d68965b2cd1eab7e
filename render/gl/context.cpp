#include "render/gl/context.h"

#include <cstdlib>
#include <string_view>

#include "engine/base/error.h"

namespace erbs::render {

void prepare_contexts() {
  // One thread per context: parallel work is divided by frames, and no thread waits for a slower tile.
  setenv("LP_NUM_THREADS", "0", 1);
  // llvmpipe of Mesa 22.3 crashes with vectors of 512 bits.
  const char* width = std::getenv("LP_NATIVE_VECTOR_WIDTH");
  if (width && std::string_view(width) == "512") setenv("LP_NATIVE_VECTOR_WIDTH", "256", 1);
}

std::unique_ptr<Context> make_context(const std::string& kind) {
  std::unique_ptr<Context> context;
  if (kind == "osmesa" || kind == "auto") context = make_osmesa_context();
  if (!context && (kind == "egl" || kind == "auto")) context = make_egl_context();
  if (!context) throw Error("no OpenGL 3.3 context can be made (" + kind + "); install libosmesa6, or libegl1 and libgl1-mesa-dri");
  return context;
}

}  // namespace erbs::render
