// Functions of a script: materials, blocks, the ground, and transformations of blocks.
#include <lua5.4/lua.hpp>

#include "engine/base/spelling.h"
#include "engine/base/text.h"
#include "engine/contact/overlap/shape.h"
#include "engine/geometry/mass.h"
#include "engine/geometry/polyhedron.h"
#include "engine/scene/mesh_file.h"
#include "lua/language/api.h"

namespace erbs::lua {

static constexpr double far = 1e6;                // m, limit of every coordinate
static constexpr int most_given_vertices = 5000;  // the cost of a hull grows with their square

const Keys& part_keys() {
  static const Keys keys = {{"vertices", "points", "m", "corners", -far, far, true, "", ""},
                            {"faces", "faces", "", "loops of vertex numbers, counter-clockwise seen from outside (default: the hull)"}};
  return keys;
}
namespace {

const Keys& initial_keys() {
  static const Keys keys = keys_of<Initial>();
  return keys;
}

Keys placed_keys() {
  Keys keys = keys_of<Block>();
  keys.push_back({"material", "string", "", "name of its material (default: the only one there is)"});
  keys.push_back({"rotation", "vec3", "rad", "rotation vector about the centroid", -100, 100, false, "", "{ 0, 0, 0 }"});
  keys.push_back({"initial", "initial", "", "initial state", -unbounded, unbounded, false, "", "", initial_keys()});
  return keys;
}

// Coefficients of friction by the names of materials, { stone = 0.3 }; Scene's check knows the names.
void read_frictions(Call& call, Material& item) {
  lua_getfield(call.lua, 1, "friction_with");
  if (lua_istable(call.lua, -1)) {
    for (lua_pushnil(call.lua); lua_next(call.lua, -2) != 0; lua_pop(call.lua, 1)) {
      if (lua_type(call.lua, -2) != LUA_TSTRING || lua_type(call.lua, -1) != LUA_TNUMBER)
        call.mistake("friction_with takes numbers by the names of materials, such as { stone = 0.3 }");
      else item.friction_with.emplace_back(shown(lua_tostring(call.lua, -2), 60), lua_tonumber(call.lua, -1));
    }
    std::sort(item.friction_with.begin(), item.friction_with.end());
  } else if (!lua_isnil(call.lua, -1)) {
    call.mistake("friction_with must be a table of numbers by the names of materials, such as { stone = 0.3 }");
  }
  lua_pop(call.lua, 1);
}

int material(Call& call) {
  Material item;
  Arguments arguments = call.arguments();
  if (arguments.read(item); !arguments.has("ks")) item.ks = 0.4 * item.kn;
  read_frictions(call, item);
  item.place = call.place;
  lua_pushstring(call.lua, item.name.c_str());
  call.context.materials.push_back(static_cast<int>(call.context.scene.materials.size()));
  call.context.scene.materials.push_back(std::move(item));
  return 1;
}

// Index of the material that the block names; -1 after a mistake.
int material_of(Call& call, Arguments& arguments) {
  const auto& materials = call.context.scene.materials;
  std::vector<std::string> known;
  for (const auto& item : materials) known.push_back(item.name);
  std::string name;
  arguments.read("material", name);
  for (size_t i = materials.size(); i-- > 0;)
    if (arguments.has("material") && materials[i].name == name) return static_cast<int>(i);
  if (!arguments.has("material")) {
    if (call.context.materials.size() == 1) return call.context.materials.front();
    arguments.mistake(materials.empty() ? "there is no material yet; begin with material{ name = \"brick\", density = 1800 }"
                                        : fmt::format("\"material\" is missing; known are {}", fmt::join(known, ", ")));
  } else if (!name.empty()) {
    arguments.mistake(fmt::format("material \"{}\" is unknown{}", name, did_you_mean(name, known)));
  }
  return -1;
}

void read_initial(Arguments& arguments, const Frame& frame, Initial& initial) {
  const auto table = arguments.table("initial", initial_keys());
  if (!table) return;
  Arguments keys = *table;
  keys.read(initial);
  initial.given = true;
  initial.has_about = keys.has("about");
  initial.position = frame.vector(initial.position);
  initial.rotation = frame.vector(initial.rotation);
  initial.velocity = frame.vector(initial.velocity);
  initial.spin = frame.vector(initial.spin);
  initial.about = frame.point(initial.about);
}

Vec3 centroid_of(const std::vector<Polyhedron>& parts) {
  const MassProperties mass = mass_properties(parts);
  return mass.volume > 0 && mass.centroid.allFinite() ? mass.centroid : mean_vertex(parts.front());
}

// Reads the keys common to all blocks, moves the shape to its place and adds the block.
int add_block(Call& call, Arguments& arguments, std::vector<Polyhedron> parts, const char* kind) {
  Context& context = call.context;
  if (context.scene.blocks.size() >= static_cast<size_t>(context.scene.most_blocks))
    throw Error(
        fmt::format("a scene holds at most {} blocks; build fewer, or raise the limit with --max-blocks (about 4 KiB of memory each)",
                    context.scene.most_blocks),
        call.place);
  Block block;
  block.place = call.place;
  arguments.read(block);
  block.material = material_of(call, arguments);
  Vec3 theta = Vec3::Zero();
  arguments.read("rotation", theta);
  if (!parts.empty()) {
    const Frame& frame = context.frame();
    const Vec3 centre = theta.isZero(0) ? Vec3(Vec3::Zero()) : centroid_of(parts);
    const Quat q = rotation(theta);
    for (Polyhedron& part : parts)
      for (Vec3& vertex : part.vertices) {
        const Vec3 turned = theta.isZero(0) ? vertex : Vec3(centre + q * (vertex - centre));
        vertex = frame.point(turned);
      }
  }
  for (size_t i = 0; !context.scene.blocks.empty() && i < std::min(parts.size(), context.scene.blocks.back().parts.size()); ++i)
    if (const Faces& last = context.scene.blocks.back().parts[i].faces; parts[i].faces == last) parts[i].faces = last;
  block.parts = std::move(parts);
  if (block.name.empty()) block.name = fmt::format("{}_{}", block.group.empty() ? kind : block.group, context.scene.blocks.size() + 1);
  Initial initial;
  read_initial(arguments, context.frame(), initial);
  if (initial.given) block.started = std::make_shared<const Initial>(initial);
  size_t bytes = sizeof(Block);
  for (const Polyhedron& part : block.parts) bytes += sizeof(Polyhedron) + part.vertices.size() * sizeof(Vec3);
  context.took(bytes);
  lua_pushstring(call.lua, block.name.c_str());
  context.scene.blocks.push_back(std::move(block));
  return 1;
}

int box(Call& call) {
  Arguments arguments = call.arguments();
  Vec3 size = Vec3::Zero(), at = Vec3::Zero(), center = Vec3::Zero();
  arguments.read("size", size);
  arguments.read("at", at);
  arguments.read("center", center);
  if (arguments.has("at") && arguments.has("center")) arguments.mistake("\"at\" and \"center\" say the same twice; keep one");
  if (arguments.has("center")) at = center - size / 2;
  std::vector<Polyhedron> parts;
  if (size.minCoeff() > 0) parts = {box_polyhedron(at, at + size)};
  return add_block(call, arguments, std::move(parts), "box");
}

// One convex part from its vertices and faces, or from their hull; empty after a mistake.
std::vector<Polyhedron> read_part(Arguments& arguments) {
  Polyhedron part;
  arguments.read("vertices", part.vertices);
  Faces::List loops;
  arguments.read("faces", loops);
  part.faces = std::move(loops);
  const int n = static_cast<int>(part.vertices.size());
  if (n > most_given_vertices) {
    arguments.mistake(
        fmt::format("vertices has {} points; at most {} are allowed, of which {} may be corners", n, most_given_vertices, most_vertices));
    return {};
  }
  if (n < 4) {
    arguments.mistake(fmt::format("vertices has {} point(s); a block needs at least 4", n));
    return {};
  }
  bool valid = true;
  for (const auto& face : part.faces)
    for (const int vertex : face) {
      if (vertex < n) continue;
      arguments.mistake(fmt::format("faces name vertex {}, but there are {}", vertex + 1, n));
      valid = false;
    }
  if (!valid) return {};
  if (arguments.has("faces")) return {part};
  try {
    return {hull(part.vertices)};
  } catch (const Error& error) {
    arguments.mistake(error.what());
    return {};
  }
}

int block(Call& call) {
  Arguments arguments = call.arguments();
  std::vector<Polyhedron> parts;
  if (arguments.has("parts")) {
    if (arguments.has("vertices")) arguments.mistake("\"parts\" and \"vertices\" exclude each other; put the vertices into a part");
    for (Arguments& table : arguments.tables("parts", part_keys()))
      for (auto& part : read_part(table)) parts.push_back(std::move(part));
  } else if (arguments.has("vertices")) {
    parts = read_part(arguments);
  } else {
    arguments.mistake("there is no shape; give vertices = { {x, y, z}, ... } or parts = { ... }");
  }
  Vec3 at = Vec3::Zero();
  arguments.read("at", at);
  for (auto& part : parts) part = translated(part, at);
  return add_block(call, arguments, std::move(parts), "block");
}

// The prism over a polygon in the plane normal to `axis`. The cyclic order of the axes keeps the prism right-handed.
Polyhedron extruded(const std::vector<Eigen::Vector2d>& polygon, double height, int axis) {
  Polyhedron prism;
  const int n = static_cast<int>(polygon.size());
  for (const double z : {0.0, height})
    for (const auto& corner : polygon) {
      Vec3 vertex;
      vertex[(axis + 1) % 3] = corner.x();
      vertex[(axis + 2) % 3] = corner.y();
      vertex[axis] = z;
      prism.vertices.push_back(vertex);
    }
  Faces::List loops;
  std::vector<int> bottom, top;
  for (int i = 0; i < n; ++i) {
    bottom.push_back(n - 1 - i);
    top.push_back(n + i);
    loops.push_back({i, (i + 1) % n, n + (i + 1) % n, n + i});
  }
  loops.push_back(bottom);
  loops.push_back(top);
  prism.faces = std::move(loops);
  return prism;
}

int prism(Call& call) {
  Arguments arguments = call.arguments();
  std::vector<double> flat;
  std::vector<Eigen::Vector2d> polygon;
  arguments.read_pairs("polygon", polygon);
  double height = 0;
  std::string axis = "z";
  Vec3 at = Vec3::Zero();
  arguments.read("height", height);
  arguments.read("axis", axis);
  arguments.read("at", at);
  double doubled_area = 0;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const auto& a = polygon[i];
    const auto& b = polygon[(i + 1) % polygon.size()];
    doubled_area += a.x() * b.y() - a.y() * b.x();
  }
  if (doubled_area < 0) std::reverse(polygon.begin(), polygon.end());  // either orientation of the polygon is accepted
  std::vector<Polyhedron> parts;
  if (polygon.size() < 3 || doubled_area == 0) arguments.mistake("polygon must be at least three points { x, y } that span an area");
  else if (height > 0) parts = {translated(extruded(polygon, height, axis[0] - 'x'), at)};
  return add_block(call, arguments, std::move(parts), "prism");
}

int mesh(Call& call) {
  Arguments arguments = call.arguments();
  std::string file;
  double scale = 1;
  Vec3 at = Vec3::Zero();
  arguments.read("file", file);
  arguments.read("scale", scale);
  arguments.read("at", at);
  std::vector<Polyhedron> parts;
  if (file.empty() && arguments.has("file")) arguments.mistake("file = \"\" names no file; give one");
  if (!file.empty()) try {
      const auto path = find_input(call.context, file, {});
      read_input(call.context, path, {});
      const auto folders = readable_folders(call.context);
      parts = read_mesh(path.string(), [&](const std::string& other) { return may_read(folders, other); });
      for (auto& part : parts) {
        for (auto& vertex : part.vertices) vertex *= scale;
        part = translated(part, at);
      }
    } catch (const Error& error) { arguments.mistake(error.what()); }
  return add_block(call, arguments, std::move(parts), "mesh");
}

int ground(Call& call) {
  Arguments arguments = call.arguments();
  Scene& scene = call.context.scene;
  double z = 0, size = 20, depth = 1;
  Block block;
  block.name = block.group = "ground";
  block.fixed = true;
  block.place = call.place;
  arguments.read("z", z);
  arguments.read("size", size);
  arguments.read("depth", depth);
  arguments.read("name", block.name);
  arguments.read("group", block.group);
  Material own;
  own.name = "ground";
  own.density = 2000;
  own.color = {0.45, 0.44, 0.42};
  if (arguments.has("material")) {
    block.material = material_of(call, arguments);
    if (block.material >= 0) own = scene.materials[static_cast<size_t>(block.material)], own.name = block.name + " of " + own.name;
  }
  own.place = call.place;
  arguments.read("friction", own.friction);
  if (!arguments.has("material") || arguments.has("friction")) {
    block.material = static_cast<int>(scene.materials.size());
    scene.materials.push_back(own);
  }
  if (size > 0 && depth > 0) block.parts = {box_polyhedron({-size / 2, -size / 2, z - depth}, {size / 2, size / 2, z})};
  for (auto& part : block.parts.edit())
    for (Vec3& vertex : part.vertices) vertex = call.context.frame().point(vertex);
  lua_pushstring(call.lua, block.name.c_str());
  scene.blocks.push_back(std::move(block));
  return 1;
}

// Removes the frame on every way out of its scope.
struct Inside {
  std::vector<Frame>& frames;
  Inside(std::vector<Frame>& all, const Frame& frame) : frames(all) { frames.push_back(frame); }
  ~Inside() { frames.pop_back(); }
};

int transform(Call& call) {
  Arguments arguments = call.arguments();
  Vec3 at = Vec3::Zero(), theta = Vec3::Zero(), about = Vec3::Zero();
  arguments.read("at", at);
  arguments.read("rotation", theta);
  arguments.read("about", about);
  if (!arguments.is_function("1"))
    throw Error("transform: the function that builds is missing; write transform{ at = {1, 0, 0}, function() ... end }", call.place);
  const Quat q = rotation(theta);
  const Frame& outer = call.context.frame();
  // outer(about + q (x - about) + at)
  const Frame inner{outer.rotation * q, outer.point(about - q * about + at)};
  const Inside inside(call.context.frames, inner);
  lua_settop(call.lua, 1);
  lua_rawgeti(call.lua, 1, 1);
  call_script(call.lua, call.context, 0, LUA_MULTRET);
  return lua_gettop(call.lua) - 1;
}

}  // namespace

std::vector<Function> block_functions() {
  const Keys placed = placed_keys();
  const Key at{"at", "vec3", "m", "displacement of the shape", -far, far, false, "", "{ 0, 0, 0 }"};
  const std::string name = "string: the name of the block";
  return {
      {"material", material, "{ ... }", "string: its name",
       "A material of blocks, and its behaviour as debris. Between two materials the smaller friction and the smaller restitution apply, "
       "unless one says its friction_with the other.",
       joined({keys_of<Material>(),
               {{"friction_with", "frictions", "", "coefficients against other materials, or its own, by their names: { stone = 0.3 }"}}})},
      {"box", box, "{ ... }", name, "A rectangular block.",
       joined({{{"size", "vec3", "m", "lengths along x, y, z", 1e-6, far, true, "", ""},
                {"at", "vec3", "m", "its lower corner", -far, far, false, "", "{ 0, 0, 0 }"},
                {"center", "vec3", "m", "its centre, instead of at", -far, far, false, "", ""}},
               placed})},
      {"block", block, "{ ... }", name, "A convex polyhedron, or several convex parts that are one rigid block.",
       joined({{{"vertices", "points", "m", "corners of a single part", -far, far, false, "", ""},
                {"faces", "faces", "", "loops of vertex numbers, counter-clockwise seen from outside (default: the hull)"},
                {"parts", "parts", "", "several convex parts: { { vertices = ..., faces = ... }, ... }"},
                at},
               placed})},
      {"prism", prism, "{ ... }", name, "A convex polygon extruded along an axis.",
       joined({{{"polygon", "pairs", "m", "corners { u, v }; u and v are the axes after `axis` in the order x, y, z, x, ...", -far, far,
                 true, "", ""},
                {"height", "number", "m", "length along the axis", 1e-6, far, true, "", ""},
                {"axis", "string", "", "direction of extrusion", -unbounded, unbounded, false, "x|y|z", "z"},
                at},
               placed})},
      {"mesh", mesh, "{ ... }", name, "A block from a file (OBJ, STL, PLY, glTF); each mesh in it is one convex part.",
       joined({{{"file", "string", "", "path, in the folder of the scene or in a folder of --allow", -unbounded, unbounded, true, "", ""},
                {"scale", "number", "", "factor that converts its coordinates to metres", 1e-9, 1e9, false, "", "1"},
                at},
               placed})},
      {"ground",
       ground,
       "{ ... }",
       name,
       "A fixed plate as the ground.",
       {{"z", "number", "m", "height of its top", -far, far, false, "", "0"},
        {"size", "number", "m", "length of its sides; blocks that fall beyond them never land", 1e-3, far, false, "", "20"},
        {"depth", "number", "m", "thickness of the plate", 1e-3, far, false, "", "1"},
        {"material", "string", "", "name of its material (default: its own, with the defaults of material)"},
        {"friction", "number", "", "coefficient of friction, instead of its material's", 0, 10, false, "", ""},
        {"name", "string", "", "its name", -unbounded, unbounded, false, "", "ground"},
        {"group", "string", "", "its group", -unbounded, unbounded, false, "", "ground"}}},
      {"transform",
       transform,
       "{ ..., function() ... end }",
       "any: what the function returns",
       "Moves everything that is built inside the function as a rigid body: x -> about + rotation (x - about) + at. Initial velocities, "
       "spins and directions of loads rotate with it.",
       {{"1", "function", "", "function that builds; it is called immediately", -unbounded, unbounded, true, "", ""},
        {"at", "vec3", "m", "shift, after the rotation", -far, far, false, "", "{ 0, 0, 0 }"},
        {"rotation", "vec3", "rad", "rotation vector", -100, 100, false, "", "{ 0, 0, 0 }"},
        {"about", "vec3", "m", "centre of the rotation", -far, far, false, "", "{ 0, 0, 0 }"}}},
  };
}

}  // namespace erbs::lua
