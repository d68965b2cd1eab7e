#include "render/gl/shaders.h"

namespace erbs::render {

// Texels of `blocks`: 3 b: centroid and damage; 3 b + 1: quaternion x, y, z, w; 3 b + 2: colour (linear).
// Texels of `joints`: damage 0..1, distance (m) of the two sides, state 0..2.
const std::string shader_common = R"(
uniform samplerBuffer blocks;
uniform samplerBuffer joints;
uniform mat4 camera;          // world to clip
uniform vec4 seen_side;       // of a plane: what lies beyond is hidden by the ground
uniform vec3 eye;
uniform vec3 sun;
uniform vec3 horizon;

vec3 turn(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }
// c to the power of 1 / 2.2, to a tenth of a level of 255 (two thirds below .0005), in half the time that a power takes.
vec3 srgb(vec3 c) {
  c = clamp(c, 0.0, 1.0);
  vec3 root = sqrt(c), fourth = sqrt(root);
  return 0.894448 * root + 0.182190 * fourth - 0.0412156 * sqrt(fourth) - 0.0357210 * c;
}
)";

const std::string all_taps = "const float most_taps = 9.0;\n", one_tap = "const float most_taps = 1.0;\n",
                  no_tap = "const float most_taps = 0.0;\n";

// Where a point lies in the shadow map, 0..1. It is moved off its surface, so that a surface does not shade itself.
static const std::string shadow_place = R"(
uniform mat4 to_shadow;
uniform float shadow_texel;   // m
vec3 shadow_at(vec3 p, vec3 n) { return (to_shadow * vec4(p + n * (2.0 * shadow_texel), 1.0)).xyz * 0.5 + vec3(0.5, 0.5, 0.4996); }
)";

static const std::string lighting = R"(
uniform sampler2D shadow;
uniform float shadow_side;    // texels
uniform vec4 casters;         // of the map, 0..1: the part that holds what throws a shadow; empty if none is drawn

// Share of the sun that reaches a place of the shadow map: the mean of 3 x 3 bilinear comparisons, which see 4 x 4 texels (percentage-closer
// filtering; Reeves, Salesin and Cook 1987), gathered four at a time. A software rasteriser runs through the rest of a loop after a break,
// so it has one, at its end.
float sunlight(vec3 place, float facing) {
  if (most_taps == 0.0) return 1.0;
#ifdef GL_ARB_ES3_1_compatibility
  bool unseen = gl_HelperInvocation;  // computed beside a covered pixel: it need not keep its neighbours in the loop
#else
  bool unseen = false;
#endif
  bool free = unseen || facing <= 0.0 || any(lessThan(place.xy, casters.xy)) || any(greaterThan(place.xy, casters.zw)) || place.z > 1.0;
  vec2 at = place.xy * shadow_side - 0.5, first = floor(at), f = at - first;
  float lit = 0.0;
  for (int part = most_taps == 1.0 ? 4 : 0;; ++part) {  // 0 to 3: a quarter of the texels each; 4: the four of a single comparison
    vec2 of = part == 4 ? vec2(1.0) : vec2(2 * (part & 1), 2 * (part >> 1));
    vec4 bare = step(place.zzzz, textureGather(shadow, (first + of) / shadow_side));  // of its corners (0, 1), (1, 1), (1, 0), (0, 0)
    vec2 x = of.x == 0.0 ? vec2(1.0 - f.x, 1.0) : of.x == 2.0 ? vec2(1.0, f.x) : vec2(1.0 - f.x, f.x);
    vec2 y = of.y == 0.0 ? vec2(1.0 - f.y, 1.0) : of.y == 2.0 ? vec2(1.0, f.y) : vec2(1.0 - f.y, f.y);
    lit += dot(bare, x.xyyx * y.yyxx);
    if (free || part >= 3) break;
  }
  return free ? 1.0 : lit / most_taps;
}

vec3 lit(vec3 albedo, vec3 place, vec3 n, float cavity) {
  float direct = max(dot(n, sun), 0.0);
  direct *= sunlight(place, direct);
  vec3 sky = mix(vec3(0.31, 0.29, 0.27), vec3(0.42, 0.45, 0.49), 0.5 + 0.5 * n.z);
  return albedo * (sky * cavity + vec3(1.00, 0.95, 0.87) * direct);
}
)";

const std::string solid_vertex = shadow_place + R"(
layout(location = 0) in vec3 at;
layout(location = 1) in vec3 normal;
layout(location = 2) in uint block;
layout(location = 3) in uint joint;
uniform vec3 mortar;
uniform float by_damage, by_state;
uniform vec3 states[3];
out vec3 place, n, albedo;
void main() {
  int b = int(block) * 3;
  vec4 pose = texelFetch(blocks, b), q = texelFetch(blocks, b + 1);
  vec3 world = pose.xyz + turn(q, at);
  n = turn(q, normal);
  place = shadow_at(world, n);
  albedo = texelFetch(blocks, b + 2).rgb;
  if (joint != 0xffffffffu) {
    vec4 j = texelFetch(joints, int(joint));
    albedo = by_damage > 0.5 ? mix(albedo, vec3(0.75), 0.15) : mortar;
    if (by_state > 0.5) albedo = states[int(j.z)];
  }
  gl_Position = camera * vec4(world, 1.0);
  gl_ClipDistance[0] = dot(seen_side, vec4(world, 1.0));
}
)";

// Across a chamfer the normal is interpolated from one face to the next. Its length, below 1, gives the distance from the faces.
const std::string solid_fragment = lighting + R"(
in vec3 place, n, albedo;
uniform float darker_edge;
uniform float opacity;        // of faces; edges are denser
out vec4 color;
void main() {
  float edge = clamp((1.0 - dot(n, n)) * 2.2, 0.0, 1.0);
  color.rgb = srgb(lit(albedo * (1.0 - darker_edge * edge), place, normalize(n), 1.0 - 0.25 * edge));
  color.a = mix(opacity, 1.0, 0.4 * edge);
}
)";

const std::string shade_vertex = R"(
layout(location = 0) in vec3 at;
layout(location = 2) in uint block;
void main() {
  int b = int(block) * 3;
  gl_Position = camera * vec4(texelFetch(blocks, b).xyz + turn(texelFetch(blocks, b + 1), at), 1.0);
}
)";
const std::string shade_fragment = "void main() {}\n";

// The band of a crack spans the gap between the two sides. It is at least `thinnest` pixels wide if the joint has parted by `open` or more.
// A joint that is only cracked has a little more than half of that. A crack of a tenth of a millimetre is thus visible from ten metres, and
// distinct from an open joint. In a wide gap, no longer dark throughout, the band sinks inwards and then vanishes.
const std::string crack_vertex = R"(
layout(location = 0) in vec3 at_a;
layout(location = 1) in vec3 at_b;
layout(location = 2) in vec3 out_of;
layout(location = 3) in vec3 normal;
layout(location = 4) in uvec3 who;
layout(location = 5) in float side;
layout(location = 6) in vec3 facing;
uniform float pixel, thinnest, proud, open, widest, by_state;
uniform vec3 states[3];
flat out vec3 tone;
void main() {
  int a = int(who.x) * 3, b = int(who.y) * 3;
  vec4 qa = texelFetch(blocks, a + 1), qb = texelFetch(blocks, b + 1);
  vec3 pa = texelFetch(blocks, a).xyz + turn(qa, at_a), pb = texelFetch(blocks, b).xyz + turn(qb, at_b);
  vec4 j = texelFetch(joints, int(who.z));
  float parted = clamp(j.y / open, 0.0, 1.0);
  vec3 crack = mix(vec3(0.17, 0.14, 0.12), vec3(0.008, 0.007, 0.007), j.x * (0.75 + 0.25 * parted));
  tone = srgb(by_state > 0.5 ? states[int(j.z + 0.5)] : crack);
  float gap = distance(pa, pb), at_pixel = pixel * distance(eye, pa);
  float least = thinnest * at_pixel * (0.3 + 0.3 * j.x + 0.4 * parted) * (1.0 + 0.4 * by_state);
  float half_more = 0.5 * max(0.0, least - gap);
  vec4 q = side < 0.0 ? qa : qb;
  vec3 p = (side < 0.0 ? pa : pb) + turn(q, normal * (side * half_more) + out_of * max(proud, 0.15 * at_pixel) - facing * max(0.0, gap - least));
  bool shown = (j.x > 0.05 || by_state > 0.5) && j.y < widest;
  gl_Position = shown ? camera * vec4(p, 1.0) : vec4(0.0, 0.0, 2.0, 1.0);
  gl_ClipDistance[0] = dot(seen_side, vec4(p, 1.0));
}
)";
const std::string crack_fragment = R"(
flat in vec3 tone;
out vec4 color;
void main() { color = vec4(tone, 1.0); }
)";

const std::string ground_vertex = shadow_place + R"(
layout(location = 0) in vec2 corner;
uniform vec3 middle, along, across, normal;
out vec3 world, place;
void main() {
  world = middle + corner.x * along + corner.y * across;
  place = shadow_at(world, normal);
  gl_Position = camera * vec4(world, 1.0);
}
)";
const std::string ground_fragment = lighting + R"(
in vec3 world, place;
uniform vec3 middle, normal, tone;  // tone: linear colour of the ground
uniform float grid, fade, far;  // m: lines, where they end, where the ground is lost in the haze
uniform float last;           // component of the colour: opacity of what is part of the model, transparency of the backdrop
out vec4 color;
// Coverage of lines of the given width, one each `period`, as a box filter of the pixel would see them.
float lines(float x, float period, float width) {
  float w = fwidth(x) + 1e-6;
  float d = abs(fract(x / period + 0.5) - 0.5) * period;
  return clamp((0.5 * (width + w) - d) / w, 0.0, 1.0) * min(1.0, width / w) ;
}
void main() {
  vec2 p = world.xy;
  float line = max(lines(p.x, grid, 0.016 * grid), lines(p.y, grid, 0.016 * grid));
  float r = distance(world.xy, middle.xy) / fade;
  vec3 base = mix(tone, 0.6 * tone, line * 0.6 * clamp(1.8 - r, 0.0, 1.0));
  vec3 c = lit(base, place, normal, 1.0);
  color = vec4(srgb(mix(c, horizon, smoothstep(1.0, 5.0, distance(eye, world) / far))), last);
}
)";

// The shadow alone, black and as dense as it darkens the ground; the last component is transparency.
const std::string dim_fragment = lighting + R"(
in vec3 place;
uniform vec3 normal;
out vec4 color;
void main() { color = vec4(0.0, 0.0, 0.0, 1.0 - 0.36 * (1.0 - sunlight(place, max(dot(normal, sun), 0.0)))); }
)";

// Clouds of dust: discs that face the eye, denser in the middle and mottled, and thinner where something solid is near behind them.
const std::string dust_vertex = R"(
layout(location = 0) in vec4 ball;   // m: middle, radius
layout(location = 1) in vec4 form;   // corner of the disc, opacity, seed
uniform vec3 right, up;
out vec2 at;
out vec2 kind;                // opacity, seed
out float radius;
out vec3 world;
void main() {
  at = form.xy;
  kind = form.zw;
  radius = ball.w;
  world = ball.xyz + ball.w * (form.x * right + form.y * up);
  gl_Position = camera * vec4(world, 1.0);
}
)";
const std::string dust_fragment = R"(
in vec2 at;
in vec2 kind;
in float radius;
in vec3 world;
uniform sampler2D depth;
uniform vec2 depth_range;     // near, far (m)
uniform vec2 size, corner;    // px, of the picture, and of what is drawn in it
uniform vec3 right, up, tone;
out vec4 color;
float scatter(vec2 p) { return fract(sin(dot(p, vec2(127.1, 311.7))) * 43758.5453); }
float mottle(vec2 p) {
  vec2 i = floor(p), f = fract(p);
  f = f * f * (3.0 - 2.0 * f);
  return mix(mix(scatter(i), scatter(i + vec2(1.0, 0.0)), f.x), mix(scatter(i + vec2(0.0, 1.0)), scatter(i + vec2(1.0, 1.0)), f.x), f.y);
}
float along(float z) {
  z = z * 2.0 - 1.0;
  return 2.0 * depth_range.x * depth_range.y / (depth_range.y + depth_range.x - z * (depth_range.y - depth_range.x));
}
void main() {
  float d = length(at), ball = sqrt(max(0.0, 1.0 - d * d));
  vec2 p = at * 1.7 + 31.0 * kind.y;
  float cloud = 0.6 * mottle(p * 1.3) + 0.4 * mottle(p * 2.9);
  float dense = smoothstep(1.0, 0.15, d + 0.55 * (cloud - 0.5));
  float behind = along(texture(depth, (gl_FragCoord.xy + corner) / size).r) - along(gl_FragCoord.z);
  float alpha = kind.x * dense * clamp((behind + radius * ball) / (1.2 * radius), 0.0, 1.0);
  vec3 n = at.x * right + at.y * up;
  float lit = 0.80 + 0.22 * dot(n, sun) + 0.10 * at.y;
  color = vec4(srgb(tone * lit), alpha);
}
)";

const std::string screen_vertex = R"(
out vec2 uv;
void main() {
  uv = vec2((gl_VertexID & 1) * 2, (gl_VertexID >> 1) * 2);
  gl_Position = vec4(uv * 2.0 - 1.0, 1.0, 1.0);
}
)";

const std::string sky_fragment = R"(
in vec2 uv;
uniform mat4 to_world;        // clip to world
uniform vec3 zenith;          // of the level world
uniform vec3 high, floor_tone;  // linear colours of the sky above and of the floor
// The floor below a table that turns, with the table's shadow: softer, the higher the table stands above it.
uniform float with_floor;
uniform vec3 floor_point, table_middle;
uniform vec2 table_half;      // m
uniform float far, softest;   // m
out vec4 color;
void main() {
  vec4 end = to_world * vec4(uv * 2.0 - 1.0, 1.0, 1.0);
  vec3 ray = normalize(end.xyz / end.w - eye);
  float up = dot(ray, zenith);
  vec3 c = mix(horizon, high, smoothstep(0.0, 0.55, up));
  if (with_floor > 0.5 && up < -1e-4) {
    float s = dot(floor_point - eye, zenith) / up;
    vec3 p = eye + s * ray;
    float height = (table_middle.z - p.z) / zenith.z;
    vec2 beyond = abs((p + height * zenith - table_middle).xy) - table_half;
    float d = length(max(beyond, 0.0)) + min(max(beyond.x, beyond.y), 0.0), soft = softest + 0.5 * max(height, 0.0);
    float shade = 0.42 * (1.0 - smoothstep(-0.7 * soft, soft, d));
    c = mix(floor_tone * (1.0 - shade), horizon, smoothstep(1.0, 5.0, s / far));
  }
  color = vec4(srgb(c), 0.0);
}
)";

// Alchemy ambient obscurance (McGuire, Osman, Bukowski, Hennessy 2011, eq. 10), from the depth alone, at half resolution.
const std::string occlusion_fragment = R"(
in vec2 uv;
uniform sampler2D depth;
uniform vec4 unproject;       // of clip to view: 1/p00, 1/p11, p02, p12
uniform vec2 depth_range;     // near, far (m)
uniform float radius;         // m
uniform float radius_uv;      // of the picture's height at a distance of 1 m
uniform vec2 texel;           // of the depth
out vec4 color;

float distance_at(vec2 at) {
  float z = texture(depth, at).r * 2.0 - 1.0;
  return 2.0 * depth_range.x * depth_range.y / (depth_range.y + depth_range.x - z * (depth_range.y - depth_range.x));
}
vec3 point(vec2 at) {
  at = (floor(at / texel) + 0.5) * texel;  // where the depth was taken
  float d = distance_at(at);
  vec2 ndc = at * 2.0 - 1.0;
  return vec3((ndc + unproject.zw) * unproject.xy * d, -d);
}
void main() {
  vec3 p = point(uv);
  if (-p.z > 0.98 * depth_range.y) { color = vec4(1.0, 0.0, 0.0, 1.0); return; }
  vec3 right = point(uv + vec2(texel.x, 0.0)) - p, left = p - point(uv - vec2(texel.x, 0.0));
  vec3 above = point(uv + vec2(0.0, texel.y)) - p, below = p - point(uv - vec2(0.0, texel.y));
  vec3 n = normalize(cross(abs(right.z) < abs(left.z) ? right : left, abs(above.z) < abs(below.z) ? above : below));
  ivec2 cell = ivec2(gl_FragCoord.xy) & 3;
  float kind = float((cell.x * 4 + cell.y * 7) & 15), turn = kind / 16.0 * 6.2831853, jitter = fract(kind * 0.618034);
  float r = radius_uv / -p.z, aspect = texel.x / texel.y, sum = 0.0;
  const int count = 9;
  for (int i = 0; i < count; ++i) {
    float along = (float(i) + jitter) / float(count), angle = turn + 6.2831853 * 4.0 * along;
    vec3 v = point(uv + vec2(cos(angle) * aspect, sin(angle)) * (r * along)) - p;
    float vv = dot(v, v);
    sum += max(0.0, dot(v, n) + p.z * 0.0012) / (vv + 0.01 * radius * radius) * step(vv, 2.5 * radius * radius);
  }
  color = vec4(clamp(1.0 - 1.5 * radius / float(count) * sum, 0.0, 1.0), 0.0, 0.0, 1.0);
}
)";

// Mean over the 4 x 4 pattern of rotations, of pixels with similar depth.
const std::string blur_fragment = R"(
in vec2 uv;
uniform sampler2D occlusion, depth;
uniform vec2 texel;           // of the occlusion
uniform vec2 depth_range;
out vec4 color;
float distance_at(vec2 at) {
  float z = texture(depth, at).r * 2.0 - 1.0;
  return 2.0 * depth_range.x * depth_range.y / (depth_range.y + depth_range.x - z * (depth_range.y - depth_range.x));
}
void main() {
  float here = distance_at(uv), sum = 0.0, weight = 0.0;
  for (int i = -2; i < 2; ++i)
    for (int j = -2; j < 2; ++j) {
      vec2 at = uv + (vec2(i, j) + 0.5) * texel;
      float w = max(0.001, 1.0 - abs(distance_at(at) - here) / (0.02 * here));
      sum += w * texture(occlusion, at).r;
      weight += w;
    }
  color = vec4(sum / weight, 0.0, 0.0, 1.0);
}
)";

// Lays the model, whose colours are times opacity, over the backdrop; the last component is transparency.
const std::string finish_fragment = R"(
in vec2 uv;
uniform sampler2D picture, occlusion;
out vec4 color;
void main() {
  float bright = 0.30 + 0.70 * texture(occlusion, uv).r;
  vec4 seen = texture(picture, uv);
  color = vec4(seen.rgb * bright, (1.0 - seen.a) * bright);
}
)";

}  // namespace erbs::render
