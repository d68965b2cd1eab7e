// The shaders, as text. Each program is one vertex and one fragment source, with `shader_common` before both.
#pragma once
#include <string>

namespace erbs::render {

extern const std::string shader_common;
extern const std::string solid_vertex, solid_fragment;  // bricks and mortar
extern const std::string shade_vertex, shade_fragment;  // the same into the shadow map
extern const std::string crack_vertex, crack_fragment;
extern const std::string ground_vertex, ground_fragment;
extern const std::string screen_vertex;  // one triangle over the whole picture
extern const std::string sky_fragment, occlusion_fragment, blur_fragment, finish_fragment;

}  // namespace erbs::render
