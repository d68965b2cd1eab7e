#include "render/draw/draw.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "engine/base/error.h"
#include "render/draw/backdrop.h"
#include "render/gl/buffers.h"
#include "render/gl/shaders.h"

namespace erbs::render {

struct Painter::Hidden {
  const Show& show;
  Look look_;
  Backdrop around;
  std::unique_ptr<Context> context;
  Gl gl;
  std::unique_ptr<Canvas> canvas;
  // fine: solid for what is about a pixel wide. ground, and what is the same for each frame of it: open ground, where no shadow falls;
  // dim: a ground that only shows its shadow; flat: its depth alone.
  GLuint solid, fine, shade, crack, ground, open_ground, dim, flat, sky, cloud;
  Drawable bricks, edges, shades, cracks, plane, discs;
  Texels blocks, joints;
  std::optional<Standpoint> backdrop_of;  // drawn last
  // The last picture, and all that it depends on: where nothing has moved since, it is the next one as well.
  struct Last {
    Standpoint from;
    FrameTexels texels;
    Image image;
  };
  std::optional<Last> last;

  Hidden(const Show& s, const Look& l, const std::string& kind)
      : show(s), look_(l), around(backdrop(l.background)), context(make_context(kind)), gl(load_gl(*context)) {
    canvas = std::make_unique<Canvas>(gl, l.width, l.height, l.shadow_side());
    const std::string taps = l.shadow ? all_taps : no_tap;
    solid = make_program(gl, shader_common, solid_vertex, taps + solid_fragment);
    fine = make_program(gl, shader_common, solid_vertex, (l.shadow ? one_tap : no_tap) + solid_fragment);
    shade = make_program(gl, shader_common, shade_vertex, shade_fragment);
    crack = make_program(gl, shader_common, crack_vertex, crack_fragment);
    ground = make_program(gl, shader_common, ground_vertex, taps + ground_fragment);
    open_ground = make_program(gl, shader_common, ground_vertex, no_tap + ground_fragment);
    dim = make_program(gl, shader_common, ground_vertex, taps + dim_fragment);
    flat = make_program(gl, shader_common, ground_vertex, shade_fragment);
    sky = make_program(gl, shader_common, screen_vertex, sky_fragment);
    cloud = make_program(gl, shader_common, dust_vertex, dust_fragment);
    upload_geometry();
    for (Texels* t : {&blocks, &joints}) {
      gl.GenBuffers(1, &t->buffer);
      gl.GenTextures(1, &t->texture);
    }
  }
  ~Hidden() {
    for (GLuint program : {solid, fine, shade, crack, ground, open_ground, dim, flat, sky, cloud}) gl.DeleteProgram(program);
    for (Drawable* d : {&bricks, &edges, &shades, &cracks, &plane, &discs}) {
      gl.DeleteVertexArrays(1, &d->vao);
      if (d != &edges) gl.DeleteBuffers(1, &d->vertices);
      gl.DeleteBuffers(1, &d->index);
    }
    for (Texels* t : {&blocks, &joints}) {
      gl.DeleteTextures(1, &t->texture);
      gl.DeleteBuffers(1, &t->buffer);
    }
  }
  Hidden(const Hidden&) = delete;
  Hidden& operator=(const Hidden&) = delete;

  void upload_geometry() {
    bricks = upload(gl, show.mesh.vertices);
    for (Drawable* d : {&bricks, &edges}) {
      if (d == &edges) edges = again(gl, bricks);
      floats<Vertex>(gl, 0, 3, offsetof(Vertex, p));
      floats<Vertex>(gl, 1, 3, offsetof(Vertex, n));
      integers<Vertex>(gl, 2, 1, offsetof(Vertex, block));
      integers<Vertex>(gl, 3, 1, offsetof(Vertex, joint));
    }
    shades = upload(gl, show.mesh.shades);
    floats<Vertex>(gl, 0, 3, offsetof(Vertex, p));
    integers<Vertex>(gl, 2, 1, offsetof(Vertex, block));
    cracks = upload(gl, show.mesh.cracks);
    floats<CrackVertex>(gl, 0, 3, offsetof(CrackVertex, pa));
    floats<CrackVertex>(gl, 1, 3, offsetof(CrackVertex, pb));
    floats<CrackVertex>(gl, 2, 3, offsetof(CrackVertex, out));
    floats<CrackVertex>(gl, 3, 3, offsetof(CrackVertex, normal));
    integers<CrackVertex>(gl, 4, 3, offsetof(CrackVertex, a));
    floats<CrackVertex>(gl, 5, 1, offsetof(CrackVertex, side));
    floats<CrackVertex>(gl, 6, 3, offsetof(CrackVertex, facing));
    using Disc = std::array<float, 8>;
    discs = upload(gl, std::vector<Disc>{});
    floats<Disc>(gl, 0, 4, 0);
    floats<Disc>(gl, 1, 4, 4 * sizeof(float));
    using Corner = std::array<float, 2>;
    plane = upload(gl, std::vector<Corner>{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});
    floats<Corner>(gl, 0, 2, 0);
    choose(gl, plane, {0, 1, 2, 0, 2, 3});
  }

  // Selects a program and sets the uniforms common to all programs.
  struct Light {
    Eigen::Matrix4f camera, to_shadow;
    Eigen::Vector3f eye, sun;
    double shadow_texel;          // m
    Eigen::AlignedBox2f casters;  // of the shadow map
    Eigen::Vector4f seen_side;    // of the ground
  };
  Uniforms use(GLuint program, const Light& light, const Eigen::Matrix4f& camera) const {
    gl.UseProgram(program);
    const Uniforms u{gl, program};
    u.matrix("camera", camera);
    u.matrix("to_shadow", light.to_shadow);
    u.vector("eye", light.eye);
    u.vector("sun", light.sun);
    u.vector("horizon", around.horizon);
    u.number("shadow_texel", light.shadow_texel);
    u.number("shadow_side", canvas->shadow_side());
    u.four("casters", {light.casters.min().x(), light.casters.min().y(), light.casters.max().x(), light.casters.max().y()});
    u.four("seen_side", light.seen_side);
    u.sampler("blocks", 0);
    u.sampler("joints", 1);
    u.sampler("shadow", 2);
    return u;
  }

  void draw_shadow(const Light& light) const {
    gl.ActiveTexture(GL_TEXTURE2);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    gl.Enable(GL_CULL_FACE);
    if (!look_.shadow) return gl.BindTexture(GL_TEXTURE_2D, canvas->shadow_map());  // the map is not read
    canvas->begin_shadow();
    gl.CullFace(GL_FRONT);  // back faces cast the shadows, so lit faces do not shadow themselves
    use(shade, light, light.to_shadow);
    draw_triangles(gl, shades);
    gl.CullFace(GL_BACK);
    gl.BindTexture(GL_TEXTURE_2D, canvas->shadow_map());
  }

  // A rectangle of the ground.
  struct Plane {
    Vec3 middle, along, across;  // m
    bool lines, part_of_model;
  };
  void draw_plane(GLuint program, const Light& light, const View& v, const Plane& p) const {
    const Uniforms u = use(program, light, light.camera);
    u.vector("middle", p.middle.cast<float>());
    u.vector("along", p.along.cast<float>());
    u.vector("across", p.across.cast<float>());
    u.vector("normal", p.along.cross(p.across).normalized().cast<float>());
    u.vector("tone", around.ground);
    u.number("grid", p.lines ? show.grid : 1e9);
    u.number("last", p.part_of_model ? 1 : 0);
    u.number("fade", 1.5 * show.stage.size());
    u.number("far", std::max(static_cast<double>(v.target_distance), show.stage.size()));
    draw_triangles(gl, plane);
  }

  void draw_table(const Light& light, const View& v) const {
    const Eigen::AlignedBox3d& table = show.stage.table;
    const Vec3 middle = table.center(), half = 0.5 * table.sizes();
    const auto face = [&](const Vec3& out, const Vec3& along, bool lines) {
      draw_plane(ground, light, v,
                 {middle + out.cwiseProduct(half), along.cwiseProduct(half), out.cross(along).cwiseProduct(half), lines, true});
    };
    face(Vec3::UnitZ(), Vec3::UnitX(), true);
    face(-Vec3::UnitZ(), Vec3::UnitX(), false);
    for (const double sign : {-1.0, 1.0}) {
      face(sign * Vec3::UnitX(), Vec3::UnitY(), false);
      face(sign * Vec3::UnitY(), Vec3::UnitZ(), false);
    }
  }

  void name_states(const Uniforms& u) const {
    u.number("by_state", look_.coloring == Coloring::joint_state ? 1 : 0);
    for (const JointState s : {JointState::intact, JointState::cracked, JointState::open})
      u.vector(fmt::format("states[{}]", static_cast<int>(s)).c_str(), state_color(s).cast<float>());
  }

  void draw_bricks(GLuint program, const Drawable& what, const Light& light, double opacity) const {
    const Uniforms u = use(program, light, light.camera);
    u.vector("mortar", {0.50F, 0.475F, 0.43F});
    u.number("darker_edge", show.mortared ? 0.12 : 0.42);
    u.number("by_damage", look_.coloring == Coloring::material ? 0 : 1);
    name_states(u);
    u.number("opacity", opacity);
    draw_triangles(gl, what);
  }

  // Translucent blocks over the model: of each pixel the nearest surface only, whatever the order of drawing.
  void draw_ghosts(const Light& light, const std::vector<std::uint32_t>& index) {
    choose(gl, bricks, index);
    gl.Enable(GL_CULL_FACE);
    gl.Enable(GL_CLIP_DISTANCE0);
    gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    draw_bricks(solid, bricks, light, 1);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.Enable(GL_BLEND);
    gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl.DepthFunc(GL_LEQUAL);
    draw_bricks(solid, bricks, light, 0.28);
    gl.DepthFunc(GL_LESS);
    gl.Disable(GL_BLEND);
    gl.Disable(GL_CLIP_DISTANCE0);
    gl.Disable(GL_CULL_FACE);
  }

  // Far clouds first. They do not hide each other, and take no part in the darkening of corners.
  void draw_dust(const Light& light, const View& v, std::vector<Puff> dust) {
    const Vec3 eye = light.eye.cast<double>();
    std::stable_sort(dust.begin(), dust.end(),
                     [&](const Puff& a, const Puff& b) { return (a.at - eye).squaredNorm() > (b.at - eye).squaredNorm(); });
    std::vector<std::array<float, 8>> corners;
    std::vector<std::uint32_t> index;
    for (const Puff& puff : dust) {
      const auto first = static_cast<std::uint32_t>(corners.size());
      const Eigen::Vector3f at = puff.at.cast<float>();
      for (const auto& [x, y] : {std::pair{-1.0F, -1.0F}, {1.0F, -1.0F}, {1.0F, 1.0F}, {-1.0F, 1.0F}})
        corners.push_back({at.x(), at.y(), at.z(), static_cast<float>(puff.radius), x, y, static_cast<float>(puff.opacity),
                           static_cast<float>(puff.seed)});
      index.insert(index.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
    }
    choose(gl, discs, index);
    gl.BindBuffer(GL_ARRAY_BUFFER, discs.vertices);
    gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size() * sizeof(corners[0])), corners.data(), GL_STREAM_DRAW);
    const Uniforms u = use(cloud, light, light.camera);
    gl.ActiveTexture(GL_TEXTURE3);
    gl.BindTexture(GL_TEXTURE_2D, canvas->depth_map());
    u.sampler("depth", 3);
    const Eigen::Matrix4f& p = v.projection;
    u.two("depth_range", static_cast<double>(p(2, 3) / (p(2, 2) - 1)), static_cast<double>(p(2, 3) / (p(2, 2) + 1)));
    u.two("size", look_.width, look_.height);
    u.two("corner", canvas->model_region().left, canvas->model_region().bottom);
    u.vector("right", v.view.row(0).head<3>().transpose());
    u.vector("up", v.view.row(1).head<3>().transpose());
    u.vector("tone", {0.60F, 0.545F, 0.48F});
    gl.Disable(GL_DEPTH_TEST);
    gl.Enable(GL_BLEND);
    gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    draw_triangles(gl, discs);
    gl.Disable(GL_BLEND);
    gl.Enable(GL_DEPTH_TEST);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    gl.ActiveTexture(GL_TEXTURE0);
  }

  // `nearest`: m, distance of the nearest block.
  void draw_model(const Light& light, const View& v, double nearest, bool with_table) const {
    gl.Enable(GL_CLIP_DISTANCE0);
    draw_bricks(solid, bricks, light, 1);
    draw_bricks(show.fine_width < 2.5 * static_cast<double>(v.pixel) * nearest ? fine : solid, edges, light, 1);
    gl.Disable(GL_CULL_FACE);
    const Uniforms u = use(crack, light, light.camera);
    name_states(u);
    u.number("pixel", v.pixel);
    u.number("thinnest", fineness_of(1, look_.height).band);
    u.number("proud", 0.35 * show.chamfer);
    u.number("open", show.open_crack);
    u.number("widest", widest_crack * show.open_crack);
    draw_triangles(gl, cracks);
    gl.Disable(GL_CLIP_DISTANCE0);
    if (with_table) draw_table(light, v);
  }

  // The level ground, or its depth or shadow alone.
  void draw_ground(GLuint program, const Light& light, const View& v) const {
    const Stage& stage = show.stage;
    const Vec3 middle(stage.building.center().x(), stage.building.center().y(), stage.ground_z);
    const double reach = 12 * (stage.size() + static_cast<double>(v.target_distance));
    draw_plane(program, light, v, {middle, reach * Vec3::UnitX(), reach * Vec3::UnitY(), true, false});
  }

  static Standpoint standpoint(const Light& light, const View& v, const std::optional<Eigen::Isometry3d>& position) {
    return {light.camera, light.eye, light.sun, v.target_distance, position ? position->matrix() : Eigen::Matrix4d::Zero()};
  }

  // `shaded`: the part of the picture in which the model throws a shadow on the level ground. The rest is drawn for the first picture of a
  // camera at rest: at 1280 x 720, sky and ground take a fifth of a picture of the house.
  void draw_backdrop(const Light& light, const View& v, const std::optional<Eigen::Isometry3d>& position, const Region& shaded) {
    const bool backed = look_.background != Background::transparent;
    const Standpoint here = standpoint(light, v, position);
    if (!(backdrop_of && *backdrop_of == here)) {
      const Eigen::Vector3f far = around.horizon.unaryExpr([](float c) { return encoded(c); });
      canvas->begin_backdrop(backed ? Eigen::Vector4f(far.x(), far.y(), far.z(), 0) : Eigen::Vector4f(0, 0, 0, 1));
      if (backed) draw_sky(light, v, position);
      if (backed && !position) draw_ground(open_ground, light, v);
      backdrop_of = here;
    }
    canvas->lay_backdrop();
    if (position) return;
    canvas->limit_to(shaded);
    draw_ground(backed ? ground : dim, light, v);
    canvas->limit_to(canvas->whole());
  }

  void draw_sky(const Light& light, const View& v, const std::optional<Eigen::Isometry3d>& position) const {
    const Stage& stage = show.stage;
    const Eigen::Matrix4f to_world = light.camera.inverse();
    const Uniforms u = use(sky, light, light.camera);
    u.matrix("to_world", to_world);
    const Vec3 zenith = position ? Vec3(position->linear().transpose().col(2)) : Vec3(Vec3::UnitZ());
    u.vector("zenith", zenith.cast<float>());
    u.vector("high", around.high);
    u.vector("floor_tone", around.floor);
    const bool with_floor = position && stage.floor;
    u.number("with_floor", with_floor ? 1 : 0);
    if (with_floor) {
      const Eigen::AlignedBox3d& table = stage.table;
      const Vec3 below(table.center().x(), table.center().y(), table.min().z());
      u.vector("floor_point", (position->inverse() * below).cast<float>());
      u.vector("table_middle", below.cast<float>());
      u.two("table_half", 0.5 * table.sizes().x(), 0.5 * table.sizes().y());
      u.number("softest", 0.01 * stage.size());
      u.number("far", std::max(static_cast<double>(v.target_distance), stage.size()));
    }
    canvas->limit_to(position ? canvas->whole() : rising(to_world, light.eye, zenith.cast<float>(), look_.width, look_.height));
    gl.BindVertexArray(plane.vao);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    canvas->limit_to(canvas->whole());
  }

  // What blocks and dust may cover, or darken within `radius` (m).
  std::vector<Sphere> extents(const FrameTexels& texels, const std::vector<Puff>& dust, double radius) const {
    std::vector<Sphere> all;
    for (std::size_t b = 0; b < show.radius.size(); ++b)
      if (show.radius[b] > 0)
        all.push_back({Eigen::Map<const Eigen::Vector3f>(&texels.blocks[12 * b]), show.radius[b] + static_cast<float>(radius)});
    for (const Puff& puff : dust) all.push_back({puff.at.cast<float>(), static_cast<float>(1.5 * puff.radius)});
    return all;
  }
};

Painter::Painter(const Show& show, const Look& look, const std::string& kind) : hidden_(new Hidden(show, look, kind)) {}
Painter::~Painter() = default;

Image Painter::draw(const MotionFrame& frame, const Camera& level_camera, const std::optional<Mat3>& levelling,
                    const std::vector<Puff>& dust) {
  Hidden& h = *hidden_;
  const Look& l = h.look_;
  std::optional<Eigen::Isometry3d> position;
  if (levelling) position = table_position(h.show.stage, *levelling);
  const Camera camera = position ? in_scene(level_camera, *position) : level_camera;
  const View v = look(camera, h.show.stage, l.width, l.height, l.top, l.bottom);
  const Stage& stage = h.show.stage;
  const double radius = 0.022 * stage.size();  // m, within which corners are dark
  Hidden::Light light{v.projection * v.view, {}, v.eye, sun_of(level_camera), 0, {}, {0, 0, 0, 1}};
  FrameTexels texels = texels_of(h.show, frame, l.coloring, camera.eye, fineness_of(static_cast<double>(v.pixel), l.height));
  const Standpoint from = Hidden::standpoint(light, v, position);
  if (dust.empty() && h.last && h.last->from == from && h.last->texels == texels) return h.last->image;
  light.to_shadow = shadow_view(stage, light.sun);
  light.shadow_texel = 2.0 / l.shadow_side() / static_cast<double>(light.to_shadow.row(0).head<3>().norm());
  const std::vector<Sphere> spheres = h.extents(texels, dust, 1.6 * radius);
  const Eigen::Vector2f border = Eigen::Vector2f::Constant(3.0F / static_cast<float>(l.shadow_side()));  // no texel beyond it is asked
  if (l.shadow) light.casters = box_of(spheres, light.to_shadow).intersection({border, Eigen::Vector2f::Ones() - border});
  const bool above = light.eye.z() >= static_cast<float>(stage.ground_z);
  if (!position) light.seen_side = Eigen::Vector4f(0, 0, 1, -static_cast<float>(stage.ground_z)) * (above ? 1.0F : -1.0F);
  const bool with_table = position && stage.on_ground;
  const double nearest = nearest_of(spheres, v.view, v.projection);
  const double shade = 0.5 * l.height * static_cast<double>(v.projection(1, 1)) * radius / nearest;  // px
  const Region region =
      with_table ? h.canvas->whole()
                 : region_of(spheres, v.view, v.projection, l.width, l.height, std::min<double>(l.width, shade + 2 + Canvas::border));
  h.gl.ActiveTexture(GL_TEXTURE0);
  fill(h.gl, h.blocks, texels.blocks);
  h.gl.ActiveTexture(GL_TEXTURE1);
  fill(h.gl, h.joints, texels.joints);
  choose(h.gl, h.bricks, texels.index);
  choose(h.gl, h.edges, texels.fine_index);
  choose(h.gl, h.cracks, texels.crack_index);
  choose(h.gl, h.shades, texels.shade_index);
  h.draw_shadow(light);
  h.canvas->begin_model(region);
  h.draw_model(light, v, nearest, with_table);
  h.canvas->begin_depth();
  if (!position) h.draw_ground(h.flat, light, v);
  h.canvas->begin_translucent();
  if (!texels.ghost_index.empty()) h.draw_ghosts(light, texels.ghost_index);
  if (!dust.empty()) h.draw_dust(light, v, dust);
  const Region shaded =
      region_of(l.shadow ? fallen_shadows(h.extents(texels, {}, 4 * light.shadow_texel), light.sun, stage.ground_z) : std::vector<Sphere>{},
                v.view, v.projection, l.width, l.height, 2);
  h.draw_backdrop(light, v, position, shaded);
  Image image = h.canvas->finish(v.projection, radius, l.background == Background::transparent);
  if (const GLenum error = h.gl.GetError(); error != GL_NO_ERROR)
    throw std::logic_error(fmt::format("internal error: OpenGL reports {:#x}; please report it", error));
  h.last.reset();
  if (dust.empty()) h.last = Hidden::Last{from, std::move(texels), image};
  return image;
}

}  // namespace erbs::render
