#include <GL/osmesa.h>

#include <array>
#include <vector>

#include "render/gl/context.h"

namespace erbs::render {
namespace {

class OsmesaContext : public Context {
 public:
  explicit OsmesaContext(OSMesaContext context) : context_(context) {}
  ~OsmesaContext() override { OSMesaDestroyContext(context_); }
  OsmesaContext(const OsmesaContext&) = delete;
  OsmesaContext& operator=(const OsmesaContext&) = delete;
  bool make_current() { return OSMesaMakeCurrent(context_, surface_.data(), GL_UNSIGNED_BYTE, side, side); }
  void* function(const char* name) const override { return reinterpret_cast<void*>(OSMesaGetProcAddress(name)); }

 private:
  static constexpr int side = 16;  // pixels of a surface that is never drawn on
  OSMesaContext context_;
  std::vector<unsigned char> surface_ = std::vector<unsigned char>(4 * side * side);
};

}  // namespace

std::unique_ptr<Context> make_osmesa_context() {
  constexpr std::array<int, 15> wish{OSMESA_FORMAT,
                                     OSMESA_RGBA,
                                     OSMESA_DEPTH_BITS,
                                     24,
                                     OSMESA_STENCIL_BITS,
                                     0,
                                     OSMESA_ACCUM_BITS,
                                     0,
                                     OSMESA_PROFILE,
                                     OSMESA_CORE_PROFILE,
                                     OSMESA_CONTEXT_MAJOR_VERSION,
                                     3,
                                     OSMESA_CONTEXT_MINOR_VERSION,
                                     3,
                                     0};
  OSMesaContext raw = OSMesaCreateContextAttribs(wish.data(), nullptr);
  if (!raw) return nullptr;
  auto context = std::make_unique<OsmesaContext>(raw);
  if (!context->make_current()) return nullptr;
  return context;
}

}  // namespace erbs::render
