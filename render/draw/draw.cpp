#include "render/draw/draw.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "engine/base/error.h"
#include "render/gl/shaders.h"

namespace erbs::render {
namespace {

// Linear colours around the model.
struct Backdrop {
  Eigen::Vector3f horizon, high, ground, floor;  // high: of the sky
};
Backdrop backdrop(Background background) {
  const Eigen::Vector3f paper = Eigen::Vector3f::Ones();
  if (background != Background::sky) return {paper, paper, {0.84F, 0.84F, 0.85F}, paper};
  return {{0.80F, 0.83F, 0.86F}, {0.46F, 0.60F, 0.76F}, {0.54F, 0.535F, 0.52F}, {0.56F, 0.57F, 0.58F}};
}

// Of a linear colour, as the shaders encode it.
float encoded(float linear) { return std::pow(std::clamp(linear, 0.0F, 1.0F), 1 / 2.2F); }

// Buffers of one kind of geometry.
struct Drawable {
  GLuint vao = 0, vertices = 0, index = 0;
  GLsizei count = 0;
};

const void* offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

template <class V>
Drawable upload(const Gl& gl, const std::vector<V>& vertices) {
  Drawable d;
  gl.GenVertexArrays(1, &d.vao);
  gl.BindVertexArray(d.vao);
  gl.GenBuffers(1, &d.vertices);
  gl.BindBuffer(GL_ARRAY_BUFFER, d.vertices);
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(V)), vertices.data(), GL_STATIC_DRAW);
  gl.GenBuffers(1, &d.index);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, d.index);
  return d;
}

void choose(const Gl& gl, Drawable& d, const std::vector<std::uint32_t>& index) {
  gl.BindVertexArray(d.vao);
  gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(index.size() * sizeof(std::uint32_t)), index.data(), GL_STREAM_DRAW);
  d.count = static_cast<GLsizei>(index.size());
}

template <class V>
void floats(const Gl& gl, GLuint location, GLint n, std::size_t at) {
  gl.EnableVertexAttribArray(location);
  gl.VertexAttribPointer(location, n, GL_FLOAT, GL_FALSE, sizeof(V), offset(at));
}
template <class V>
void integers(const Gl& gl, GLuint location, GLint n, std::size_t at) {
  gl.EnableVertexAttribArray(location);
  gl.VertexAttribIPointer(location, n, GL_UNSIGNED_INT, sizeof(V), offset(at));
}

// A buffer that shaders read as vectors of four floats.
struct Texels {
  GLuint buffer = 0, texture = 0;
};

}  // namespace

struct Painter::Hidden {
  const Show& show;
  Look look_;
  Backdrop around;
  std::unique_ptr<Context> context;
  Gl gl;
  std::unique_ptr<Canvas> canvas;
  GLuint solid, shade, crack, ground, dim, flat, sky, cloud;  // dim: a ground that only shows its shadow; flat: its depth alone
  Drawable bricks, shades, cracks, plane, discs;
  Texels blocks, joints;

  Hidden(const Show& s, const Look& l, const std::string& kind)
      : show(s), look_(l), around(backdrop(l.background)), context(make_context(kind)), gl(load_gl(*context)) {
    canvas = std::make_unique<Canvas>(gl, l.width, l.height);
    solid = make_program(gl, shader_common, solid_vertex, solid_fragment);
    shade = make_program(gl, shader_common, shade_vertex, shade_fragment);
    crack = make_program(gl, shader_common, crack_vertex, crack_fragment);
    ground = make_program(gl, shader_common, ground_vertex, ground_fragment);
    dim = make_program(gl, shader_common, ground_vertex, dim_fragment);
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
    for (GLuint program : {solid, shade, crack, ground, dim, flat, sky, cloud}) gl.DeleteProgram(program);
    for (Drawable* d : {&bricks, &shades, &cracks, &plane, &discs}) {
      gl.DeleteVertexArrays(1, &d->vao);
      gl.DeleteBuffers(1, &d->vertices);
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
    floats<Vertex>(gl, 0, 3, offsetof(Vertex, p));
    floats<Vertex>(gl, 1, 3, offsetof(Vertex, n));
    integers<Vertex>(gl, 2, 1, offsetof(Vertex, block));
    integers<Vertex>(gl, 3, 1, offsetof(Vertex, joint));
    shades = upload(gl, show.mesh.shades);
    floats<Vertex>(gl, 0, 3, offsetof(Vertex, p));
    integers<Vertex>(gl, 2, 1, offsetof(Vertex, block));
    choose(gl, shades, show.mesh.shade_index);
    cracks = upload(gl, show.mesh.cracks);
    floats<CrackVertex>(gl, 0, 3, offsetof(CrackVertex, pa));
    floats<CrackVertex>(gl, 1, 3, offsetof(CrackVertex, pb));
    floats<CrackVertex>(gl, 2, 3, offsetof(CrackVertex, out));
    floats<CrackVertex>(gl, 3, 3, offsetof(CrackVertex, normal));
    integers<CrackVertex>(gl, 4, 3, offsetof(CrackVertex, a));
    floats<CrackVertex>(gl, 5, 1, offsetof(CrackVertex, side));
    using Disc = std::array<float, 8>;
    discs = upload(gl, std::vector<Disc>{});
    floats<Disc>(gl, 0, 4, 0);
    floats<Disc>(gl, 1, 4, 4 * sizeof(float));
    using Corner = std::array<float, 2>;
    plane = upload(gl, std::vector<Corner>{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});
    floats<Corner>(gl, 0, 2, 0);
    choose(gl, plane, {0, 1, 2, 0, 2, 3});
  }

  void fill(const Texels& t, const std::vector<float>& values) const {
    gl.BindBuffer(GL_TEXTURE_BUFFER, t.buffer);
    gl.BufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(values.size() * sizeof(float)), values.data(), GL_STREAM_DRAW);
    gl.BindTexture(GL_TEXTURE_BUFFER, t.texture);
    gl.TexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, t.buffer);
  }

  void number(GLuint program, const char* name, double value) const {
    gl.Uniform1f(gl.GetUniformLocation(program, name), static_cast<float>(value));
  }
  void vector(GLuint program, const char* name, const Eigen::Vector3f& v) const {
    gl.Uniform3f(gl.GetUniformLocation(program, name), v.x(), v.y(), v.z());
  }
  void four(GLuint program, const char* name, const Eigen::Vector4f& v) const {
    gl.Uniform4f(gl.GetUniformLocation(program, name), v.x(), v.y(), v.z(), v.w());
  }
  void matrix(GLuint program, const char* name, const Eigen::Matrix4f& m) const {
    gl.UniformMatrix4fv(gl.GetUniformLocation(program, name), 1, GL_FALSE, m.data());
  }

  // Selects a program and sets the uniforms common to all programs.
  struct Light {
    Eigen::Matrix4f camera, to_shadow;
    Eigen::Vector3f eye, sun;
    double shadow_texel;          // m
    Eigen::AlignedBox2f casters;  // of the shadow map
    Eigen::Vector4f seen_side;    // of the ground
  };
  void use(GLuint program, const Light& light, const Eigen::Matrix4f& camera) const {
    gl.UseProgram(program);
    matrix(program, "camera", camera);
    matrix(program, "to_shadow", light.to_shadow);
    vector(program, "eye", light.eye);
    vector(program, "sun", light.sun);
    vector(program, "horizon", around.horizon);
    number(program, "shadow_texel", light.shadow_texel);
    number(program, "shadow_step", 1.0 / Canvas::shadow_side);
    four(program, "casters", {light.casters.min().x(), light.casters.min().y(), light.casters.max().x(), light.casters.max().y()});
    four(program, "seen_side", light.seen_side);
    const std::array<const char*, 3> samplers{"blocks", "joints", "shadow"};
    for (int unit = 0; unit < 3; ++unit) gl.Uniform1i(gl.GetUniformLocation(program, samplers[static_cast<std::size_t>(unit)]), unit);
  }
  void draw(const Drawable& d) const {
    gl.BindVertexArray(d.vao);
    gl.DrawElements(GL_TRIANGLES, d.count, GL_UNSIGNED_INT, nullptr);
  }

  void draw_shadow(const Light& light) const {
    gl.ActiveTexture(GL_TEXTURE2);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    gl.Enable(GL_CULL_FACE);
    if (!look_.shadow) return gl.BindTexture(GL_TEXTURE_2D, canvas->shadow_map());  // the map is not read
    canvas->begin_shadow();
    gl.CullFace(GL_FRONT);  // back faces cast the shadows, so lit faces do not shadow themselves
    use(shade, light, light.to_shadow);
    draw(shades);
    gl.CullFace(GL_BACK);
    gl.BindTexture(GL_TEXTURE_2D, canvas->shadow_map());
  }

  // A rectangle of the ground, from its middle.
  void place_plane(GLuint program, const Light& light, const Vec3& middle, const Vec3& along, const Vec3& across) const {
    use(program, light, light.camera);
    vector(program, "middle", middle.cast<float>());
    vector(program, "along", along.cast<float>());
    vector(program, "across", across.cast<float>());
    vector(program, "normal", along.cross(across).normalized().cast<float>());
  }

  void draw_plane(const Light& light, const View& v, const Vec3& middle, const Vec3& along, const Vec3& across, bool lines,
                  bool part_of_model) const {
    const Stage& stage = show.stage;
    place_plane(ground, light, middle, along, across);
    vector(ground, "tone", around.ground);
    number(ground, "grid", lines ? show.grid : 1e9);
    number(ground, "last", part_of_model ? 1 : 0);
    number(ground, "fade", 1.5 * stage.size());
    number(ground, "far", std::max(static_cast<double>(v.target_distance), stage.size()));
    draw(plane);
  }

  void draw_table(const Light& light, const View& v) const {
    const Eigen::AlignedBox3d& table = show.stage.table;
    const Vec3 middle = table.center(), half = 0.5 * table.sizes();
    const auto face = [&](const Vec3& out, const Vec3& along, bool lines) {
      draw_plane(light, v, middle + out.cwiseProduct(half), along.cwiseProduct(half), out.cross(along).cwiseProduct(half), lines, true);
    };
    face(Vec3::UnitZ(), Vec3::UnitX(), true);
    face(-Vec3::UnitZ(), Vec3::UnitX(), false);
    for (const double sign : {-1.0, 1.0}) {
      face(sign * Vec3::UnitX(), Vec3::UnitY(), false);
      face(sign * Vec3::UnitY(), Vec3::UnitZ(), false);
    }
  }

  void name_states(GLuint program) const {
    number(program, "by_state", look_.coloring == Coloring::joint_state ? 1 : 0);
    for (const JointState s : {JointState::intact, JointState::cracked, JointState::open})
      vector(program, fmt::format("states[{}]", static_cast<int>(s)).c_str(), state_color(s).cast<float>());
  }

  void draw_bricks(const Light& light, double opacity) const {
    use(solid, light, light.camera);
    vector(solid, "mortar", {0.50F, 0.475F, 0.43F});
    number(solid, "darker_edge", show.mortared ? 0.12 : 0.42);
    number(solid, "by_damage", look_.coloring == Coloring::material ? 0 : 1);
    name_states(solid);
    number(solid, "opacity", opacity);
    draw(bricks);
  }

  // Translucent blocks over the model: of each pixel the nearest surface only, whatever the order of drawing.
  void draw_ghosts(const Light& light, const std::vector<std::uint32_t>& index) {
    choose(gl, bricks, index);
    gl.Enable(GL_CULL_FACE);
    gl.Enable(GL_CLIP_DISTANCE0);
    gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    draw_bricks(light, 1);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.Enable(GL_BLEND);
    gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl.DepthFunc(GL_LEQUAL);
    draw_bricks(light, 0.28);
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
    use(cloud, light, light.camera);
    gl.ActiveTexture(GL_TEXTURE3);
    gl.BindTexture(GL_TEXTURE_2D, canvas->depth_map());
    gl.Uniform1i(gl.GetUniformLocation(cloud, "depth"), 3);
    const Eigen::Matrix4f& p = v.projection;
    gl.Uniform2f(gl.GetUniformLocation(cloud, "depth_range"), p(2, 3) / (p(2, 2) - 1), p(2, 3) / (p(2, 2) + 1));
    gl.Uniform2f(gl.GetUniformLocation(cloud, "size"), static_cast<float>(look_.width), static_cast<float>(look_.height));
    vector(cloud, "right", v.view.row(0).head<3>().transpose());
    vector(cloud, "up", v.view.row(1).head<3>().transpose());
    vector(cloud, "tone", {0.60F, 0.545F, 0.48F});
    gl.Disable(GL_DEPTH_TEST);
    gl.Enable(GL_BLEND);
    gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    draw(discs);
    gl.Disable(GL_BLEND);
    gl.Enable(GL_DEPTH_TEST);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    gl.ActiveTexture(GL_TEXTURE0);
  }

  void draw_model(const Light& light, const View& v, bool with_table) const {
    gl.Enable(GL_CLIP_DISTANCE0);
    draw_bricks(light, 1);
    gl.Disable(GL_CULL_FACE);
    use(crack, light, light.camera);
    name_states(crack);
    number(crack, "pixel", v.pixel);
    number(crack, "thinnest", 2.2 * look_.height / 720.0);
    number(crack, "proud", 0.35 * show.chamfer);
    number(crack, "open", show.open_crack);
    number(crack, "widest", 60 * show.open_crack);
    draw(cracks);
    gl.Disable(GL_CLIP_DISTANCE0);
    if (with_table) draw_table(light, v);
  }

  // The level ground, or its depth or shadow alone.
  void draw_ground(GLuint program, const Light& light, const View& v) const {
    const Stage& stage = show.stage;
    const Vec3 middle(stage.building.center().x(), stage.building.center().y(), stage.ground_z);
    const double reach = 12 * (stage.size() + static_cast<double>(v.target_distance));
    if (program == ground) return draw_plane(light, v, middle, reach * Vec3::UnitX(), reach * Vec3::UnitY(), true, false);
    place_plane(program, light, middle, reach * Vec3::UnitX(), reach * Vec3::UnitY());
    draw(plane);
  }

  void draw_backdrop(const Light& light, const View& v, const std::optional<Eigen::Isometry3d>& position) const {
    const bool backed = look_.background != Background::transparent;
    const Eigen::Vector3f far = around.horizon.unaryExpr([](float c) { return encoded(c); });
    canvas->begin_backdrop(backed ? Eigen::Vector4f(far.x(), far.y(), far.z(), 0) : Eigen::Vector4f(0, 0, 0, 1));
    if (backed) draw_sky(light, v, position);
    if (!position) draw_ground(backed ? ground : dim, light, v);
  }

  void draw_sky(const Light& light, const View& v, const std::optional<Eigen::Isometry3d>& position) const {
    const Stage& stage = show.stage;
    const Eigen::Matrix4f to_world = light.camera.inverse();
    use(sky, light, light.camera);
    matrix(sky, "to_world", to_world);
    const Vec3 zenith = position ? Vec3(position->linear().transpose().col(2)) : Vec3(Vec3::UnitZ());
    vector(sky, "zenith", zenith.cast<float>());
    vector(sky, "high", around.high);
    vector(sky, "floor_tone", around.floor);
    number(sky, "with_floor", position ? 1 : 0);
    if (position) {
      const Eigen::AlignedBox3d& table = stage.table;
      const Vec3 below(table.center().x(), table.center().y(), table.min().z());
      vector(sky, "floor_point", (position->inverse() * below).cast<float>());
      vector(sky, "table_middle", below.cast<float>());
      gl.Uniform2f(gl.GetUniformLocation(sky, "table_half"), static_cast<float>(0.5 * table.sizes().x()),
                   static_cast<float>(0.5 * table.sizes().y()));
      number(sky, "softest", 0.01 * stage.size());
      number(sky, "far", std::max(static_cast<double>(v.target_distance), stage.size()));
    }
    const Region whole{0, 0, look_.width, look_.height};
    canvas->limit_to(position ? whole : rising(to_world, light.eye, zenith.cast<float>(), look_.width, look_.height));
    gl.BindVertexArray(plane.vao);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    canvas->limit_to(whole);
  }

  // What blocks and dust may cover, or darken within `radius` (m).
  std::vector<Sphere> extents(const MotionFrame& frame, const std::vector<Puff>& dust, double radius) const {
    std::vector<Sphere> all;
    for (std::size_t b = 0; b < show.radius.size(); ++b)
      if (show.radius[b] > 0)
        all.push_back({Eigen::Map<const Eigen::Vector3f>(&frame.poses[7 * b]), show.radius[b] + static_cast<float>(radius)});
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
  light.to_shadow = shadow_view(stage, light.sun);
  light.shadow_texel = 2.0 / Canvas::shadow_side / static_cast<double>(light.to_shadow.row(0).head<3>().norm());
  const std::vector<Sphere> spheres = h.extents(frame, dust, 1.6 * radius);
  if (l.shadow) light.casters = box_of(spheres, light.to_shadow).intersection({Eigen::Vector2f::Zero(), Eigen::Vector2f::Ones()});
  const bool above = light.eye.z() >= static_cast<float>(stage.ground_z);
  if (!position) light.seen_side = Eigen::Vector4f(0, 0, 1, -static_cast<float>(stage.ground_z)) * (above ? 1.0F : -1.0F);
  const bool with_table = position && stage.on_ground;
  const double shade = 0.5 * l.height * static_cast<double>(v.projection(1, 1)) * radius / nearest_of(spheres, v.view, v.projection);  // px
  const Region region =
      with_table ? Region{0, 0, l.width, l.height}
                 : region_of(spheres, v.view, v.projection, l.width, l.height, std::min<double>(l.width, shade + 2 + Canvas::border));
  const FrameTexels texels = texels_of(h.show, frame, l.coloring, camera.eye);
  h.gl.ActiveTexture(GL_TEXTURE0);
  h.fill(h.blocks, texels.blocks);
  h.gl.ActiveTexture(GL_TEXTURE1);
  h.fill(h.joints, texels.joints);
  choose(h.gl, h.bricks, texels.index);
  choose(h.gl, h.cracks, texels.crack_index);
  h.draw_shadow(light);
  h.canvas->begin_model(region);
  h.draw_model(light, v, with_table);
  h.canvas->begin_depth();
  if (!position) h.draw_ground(h.flat, light, v);
  h.canvas->begin_translucent();
  if (!texels.ghost_index.empty()) h.draw_ghosts(light, texels.ghost_index);
  if (!dust.empty()) h.draw_dust(light, v, dust);
  h.draw_backdrop(light, v, position);
  Image image = h.canvas->finish(v.projection, radius, l.background == Background::transparent);
  if (const GLenum error = h.gl.GetError(); error != GL_NO_ERROR)
    throw std::logic_error(fmt::format("internal error: OpenGL reports {:#x}; please report it", error));
  return image;
}

}  // namespace erbs::render
