// The shaders, as text. A program has one vertex and one fragment source; `shader_common` precedes both.
#pragma once
#include <string>

namespace erbs::render {

extern const std::string shader_common;
// Before a fragment source that is lit by the sun: how finely the edge of a shadow is drawn.
extern const std::string all_taps, one_tap, no_tap;
extern const std::string solid_vertex, solid_fragment;  // bricks and mortar
extern const std::string shade_vertex, shade_fragment;  // the same for the shadow map
extern const std::string crack_vertex, crack_fragment;
extern const std::string ground_vertex, ground_fragment, dim_fragment, dust_vertex, dust_fragment;
extern const std::string screen_vertex;  // one triangle that covers the whole picture
extern const std::string sky_fragment, occlusion_fragment, blur_fragment, finish_fragment;

}  // namespace erbs::render
