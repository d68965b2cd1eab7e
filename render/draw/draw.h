// Draws one frame of a run from one camera.
#pragma once
#include <algorithm>
#include <memory>
#include <optional>

#include "render/draw/dust.h"
#include "render/gl/canvas.h"
#include "render/run/excerpt.h"
#include "render/run/mesh.h"
#include "render/run/run.h"
#include "render/run/stage.h"

namespace erbs::render {

// What the colour of a block shows: its material, the broken share of its joint area, or a quantity on a scale that ends at Show::scale.
// With joint_state the joints are coloured, not the blocks.
enum class Coloring { material, damage, displacement, speed, opening, slip, energy, normal_stress, shear_stress, joint_state };
inline bool is_quantity(Coloring c) { return c >= Coloring::displacement && c <= Coloring::shear_stress; }
inline bool is_stress(Coloring c) { return c == Coloring::normal_stress || c == Coloring::shear_stress; }

// Intact, damaged, or open by Show::open_crack or more.
enum class JointState { intact, cracked, open };
Vec3 state_color(JointState state);  // linear

inline constexpr double widest_crack = 60;  // of Show::open_crack: in a wider gap no band is drawn

enum class Background { sky, white, transparent };

struct Look {
  Coloring coloring = Coloring::material;
  int width = 1280, height = 720;
  double top = 0, bottom = 0;               // pixels covered by the overlay
  double unit = 0;                          // of the overlay's lengths, px; 0: as the height of the picture requires
  bool overlay = true;                      // title, clock, legend, scale, axes and ground motion
  double magnify = 1;                       // factor on the displacements drawn
  Background background = Background::sky;  // white: with the ground, for print; transparent: of the ground, only its shadow
  bool shadow = true;                       // of the sun
  bool table_turns = true;                  // a tilting test is drawn level, with its table turning; otherwise gravity turns
  // Texels along each side of the shadow map: finer than the picture. Filling the map takes a sixth of the time of a frame.
  int shadow_side() const { return std::clamp((6 * std::max(width, height) / 5 + 255) / 256 * 256, 768, 8192); }
};

// Constant data of a picture, common to all frames and threads.
struct Show {
  const MotionScene* scene = nullptr;
  Stage stage;
  Mesh mesh;
  double chamfer = 0;              // m
  double fine_width = 0;           // m, of chamfers and mortar
  double open_crack = 0;           // m, a hundredth of the thinnest brick: a joint parted this far is drawn as open
  bool mortared = false;           // joints have thickness: mortar between the bricks, not an edge
  std::string cut;                 // "cut at x = 1.2 m" of a section; else empty
  double grid = 1;                 // m, spacing of the lines on the ground
  std::vector<float> joint_area;   // m2 [joints]
  std::vector<float> opened_from;  // m, opening from which a joint without bond counts as one that opened; infinite with a bond [joints]
  double scale = 1;                // m, m/s, J or Pa, the value that has the last colour of the map
  bool replaced = false;           // contact has taken the place of joints, which then tell no forces and stresses
  std::vector<Vec3> block_color;   // linear, by material with a slight variation between bricks [blocks]
  std::vector<bool> ghost;         // drawn translucent, without shadow [blocks]
  std::vector<float> radius;       // m, of a sphere about the centroid of each block, its mortar included; 0: not drawn [blocks]
};
Show prepare_show(const MotionScene& scene, const Run& run, const std::vector<MotionFrame>& some_frames);
// The same on a stage that is set, with ghosts (empty: none) and a section whose side is known.
// `sharp`: blocks alone, without chamfers, mortar and cracks, for pictures too small to show them.
Show prepare_show(const MotionScene& scene, const Run& run, Stage stage, std::vector<bool> ghost, const std::optional<Section>& section,
                  bool sharp = false);

// Damage of a joint as pictures and drawings show it, 0..1. One without a bond has none to lose; it is drawn as broken while it is open,
// since the states of a push release no joint to contact.
double damage_drawn(const Show& show, const MotionFrame& frame, std::size_t joint);

// Nearest to `size` among 1, 2 or 5 times a power of ten.
double round_length(double size);

// Colour of a block in the legend, by the broken share of its joint area, 0..1 (linear).
Vec3 damage_color(double damage);

// Colour of a quantity at this share of its scale, 0..1 (linear): viridis, even in perceived lightness.
Vec3 map_color(double share);

// Share of the map, 0..1, of a value on a scale: linear, for energies logarithmic over so many decades.
inline constexpr double energy_decades = 6;
double map_share(double value, double scale, Coloring coloring);

// Kinetic energy (J), displacement (m), speed (m/s), largest joint opening or slip (m), or largest mean compression or shear of its joints
// (Pa) of each block, as the colouring says [blocks].
std::vector<double> block_values(const MotionScene& scene, const MotionFrame& frame, Coloring coloring);

// The next of 1, 2 or 5 times a power of ten; `value` itself if it is one, up to rounding.
double round_up(double value);

// The scale of a colouring: what 98 % of the blocks never exceed in these frames, rounded up to 1, 2 or 5 times a power of ten. What a
// block does outside of `seen`, as one that falls past the ground for ever, does not count; empty: all counts.
double color_scale(const MotionScene& scene, const std::vector<MotionFrame>& frames, Coloring coloring,
                   const Eigen::AlignedBox3d& seen = {});

// Input of the shaders, 12 floats per block and 4 per joint, and the visible triangles.
struct FrameTexels {
  std::vector<float> blocks, joints;
  std::vector<std::uint32_t> index;       // of faces
  std::vector<std::uint32_t> fine_index;  // of chamfers and mortar
  std::vector<std::uint32_t> crack_index;
  std::vector<std::uint32_t> shade_index;  // of what casts shadows
  std::vector<std::uint32_t> ghost_index;  // triangles of translucent blocks
  bool operator==(const FrameTexels&) const = default;
};
// How finely a picture is drawn. m, at a distance of 1 m: `pixel`, 0: as small as needed; `band`, the least width of the band of a joint
// that has opened wide (a joint that is only cracked has three tenths and more of it).
struct Fineness {
  double pixel = 0, band = 0;
};
Fineness fineness_of(double pixel, int height);
// What is too narrow to be seen, or lies behind a band, is left out, and poses are rounded to a fiftieth of a pixel (visible.h).
FrameTexels texels_of(const Show& show, const MotionFrame& frame, Coloring coloring, const Vec3& eye, const Fineness& fineness = {});

class Painter {
 public:
  // Makes a context current in the calling thread. Only this thread may use the object.
  Painter(const Show& show, const Look& look, const std::string& context_kind);
  ~Painter();
  // levelling: of the instant, where the table turns. The camera is that of the level world.
  Image draw(const MotionFrame& frame, const Camera& camera, const std::optional<Mat3>& levelling = std::nullopt,
             const std::vector<Puff>& dust = {});

 private:
  struct Hidden;
  std::unique_ptr<Hidden> hidden_;
};

}  // namespace erbs::render
