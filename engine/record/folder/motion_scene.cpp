#include "engine/record/folder/motion_scene.h"

#include <algorithm>

#include "engine/base/error.h"

namespace erbs {
namespace {

// Lists of different lengths as one array, with the start of each list.
template <class T>
struct Ragged {
  std::vector<T> items;
  std::vector<int> start{0};
  void end_list(std::size_t columns = 1) { start.push_back(static_cast<int>(items.size() / columns)); }
};

template <class T>
Ragged<T> get_ragged(const h5::File& store, const std::string& items, const std::string& start, std::size_t columns = 1) {
  Ragged<T> r{store.get<T>(items), store.get<int>(start)};
  const bool rising = !r.start.empty() && r.start.front() == 0 && std::is_sorted(r.start.begin(), r.start.end());
  if (!rising || static_cast<std::size_t>(r.start.back()) * columns != r.items.size()) store.unreadable(start);
  return r;
}

void put_shapes(const h5::File& store, const MotionScene& scene) {
  Ragged<float> vertices;
  Ragged<int> corners, faces;  // corners of each face; faces of each shape
  for (const MotionShape& shape : scene.shapes) {
    vertices.items.insert(vertices.items.end(), shape.vertices.begin(), shape.vertices.end());
    vertices.end_list(3);
    for (const std::vector<int>& face : shape.faces) {
      corners.items.insert(corners.items.end(), face.begin(), face.end());
      corners.end_list();
    }
    faces.start.push_back(faces.start.back() + static_cast<int>(shape.faces.size()));
  }
  store.put("/shape_vertex", vertices.items, 3);
  store.put("/shape_vertex_start", vertices.start);
  store.put("/face_corner", corners.items);
  store.put("/face_start", corners.start);
  store.put("/shape_face_start", faces.start);
}

// Extents of a block at rest, for glyphs.
Eigen::Vector3f block_size(const MotionScene& scene, const MotionBlock& block) {
  Eigen::AlignedBox3f box;
  for (int part : block.parts) {
    const std::vector<float>& v = scene.shapes[static_cast<std::size_t>(part)].vertices;
    for (std::size_t i = 0; i + 2 < v.size(); i += 3) box.extend(Eigen::Vector3f(v[i], v[i + 1], v[i + 2]));
  }
  return box.isEmpty() ? Eigen::Vector3f::Zero() : Eigen::Vector3f(box.sizes());
}

void put_blocks(const h5::File& store, const MotionScene& scene) {
  std::vector<std::string> names, groups;
  std::vector<int> group, material;
  std::vector<std::uint8_t> fixed;
  std::vector<double> rest;
  std::vector<float> size;
  Ragged<int> parts;
  for (const MotionBlock& block : scene.blocks) {
    names.push_back(block.name);
    auto known = std::find(groups.begin(), groups.end(), block.group);
    group.push_back(static_cast<int>(known - groups.begin()));
    if (known == groups.end()) groups.push_back(block.group);
    material.push_back(block.material);
    fixed.push_back(block.fixed ? 1 : 0);
    rest.insert(rest.end(), block.rest.data(), block.rest.data() + 3);
    const Eigen::Vector3f s = block_size(scene, block);
    size.insert(size.end(), s.data(), s.data() + 3);
    parts.items.insert(parts.items.end(), block.parts.begin(), block.parts.end());
    parts.end_list();
  }
  store.put_names("/block_name", names);
  store.put_names("/group_name", groups);
  store.put("/block_group", group);
  store.put("/block_material", material);
  store.put("/block_fixed", fixed);
  store.put("/block_rest", rest, 3);
  store.put("/block_size", size, 3);
  store.put("/block_part", parts.items);
  store.put("/block_part_start", parts.start);
}

// Writes one array at a time to save memory: a model may have very many joints.
void put_joints(const h5::File& store, const MotionScene& scene) {
  const auto put = [&](const char* name, std::size_t columns, auto item, const auto& append) {
    std::vector<decltype(item)> items;
    items.reserve(columns * scene.joints.size());
    for (const MotionJoint& joint : scene.joints) append(joint, items);
    store.put(name, items, columns);
  };
  put("/joint_blocks", 2, 0, [](const MotionJoint& joint, auto& out) { out.insert(out.end(), {joint.a, joint.b}); });
  put("/joint_normal", 3, 0.0,
      [](const MotionJoint& joint, auto& out) { out.insert(out.end(), joint.normal.data(), joint.normal.data() + 3); });
  put("/joint_thickness", 1, 0.0, [](const MotionJoint& joint, auto& out) { out.push_back(joint.thickness); });
  Ragged<double> polygon;
  std::size_t corners = 0;
  for (const MotionJoint& joint : scene.joints) corners += joint.polygon.size();
  polygon.items.reserve(3 * corners);
  for (const MotionJoint& joint : scene.joints) {
    for (const Vec3& p : joint.polygon) polygon.items.insert(polygon.items.end(), p.data(), p.data() + 3);
    polygon.end_list(3);
  }
  store.put("/joint_polygon", polygon.items, 3);
  store.put("/joint_polygon_start", polygon.start);
}

Vec3 row(const std::vector<double>& a, std::size_t i) { return {a[3 * i], a[3 * i + 1], a[3 * i + 2]}; }

void get_shapes(const h5::File& store, MotionScene& scene) {
  const Ragged<float> vertices = get_ragged<float>(store, "/shape_vertex", "/shape_vertex_start", 3);
  const Ragged<int> corners = get_ragged<int>(store, "/face_corner", "/face_start");
  const std::vector<int> faces = store.get<int>("/shape_face_start");
  if (faces.size() != vertices.start.size() || static_cast<std::size_t>(faces.back()) + 1 != corners.start.size())
    store.unreadable("/shape_face_start");
  for (std::size_t s = 0; s + 1 < faces.size(); ++s) {
    MotionShape shape;
    shape.vertices.assign(vertices.items.begin() + 3 * vertices.start[s], vertices.items.begin() + 3 * vertices.start[s + 1]);
    for (auto f = static_cast<std::size_t>(faces[s]); f < static_cast<std::size_t>(faces[s + 1]); ++f) {
      shape.faces.emplace_back(corners.items.begin() + corners.start[f], corners.items.begin() + corners.start[f + 1]);
      for (int corner : shape.faces.back())
        if (corner < 0 || static_cast<std::size_t>(corner) >= shape.vertices.size() / 3) store.unreadable("/face_corner");
    }
    scene.shapes.push_back(std::move(shape));
  }
}

void get_blocks(const h5::File& store, MotionScene& scene) {
  const std::vector<std::string> names = store.get_names("/block_name"), groups = store.get_names("/group_name");
  const std::vector<int> group = store.get<int>("/block_group"), material = store.get<int>("/block_material");
  const std::vector<std::uint8_t> fixed = store.get<std::uint8_t>("/block_fixed");
  const std::vector<double> rest = store.get<double>("/block_rest");
  const Ragged<int> parts = get_ragged<int>(store, "/block_part", "/block_part_start");
  const std::size_t n = names.size();
  if (group.size() != n || material.size() != n || fixed.size() != n || rest.size() != 3 * n || parts.start.size() != n + 1)
    store.unreadable("the list of blocks");
  for (std::size_t i = 0; i < n; ++i) {
    MotionBlock block;
    block.name = names[i];
    if (group[i] < 0 || static_cast<std::size_t>(group[i]) >= groups.size()) store.unreadable("/block_group");
    block.group = groups[static_cast<std::size_t>(group[i])];
    block.material = material[i];
    block.fixed = fixed[i] != 0;
    block.rest = row(rest, i);
    block.parts.assign(parts.items.begin() + parts.start[i], parts.items.begin() + parts.start[i + 1]);
    for (int part : block.parts)
      if (part < 0 || static_cast<std::size_t>(part) >= scene.shapes.size()) store.unreadable("/block_part");
    scene.blocks.push_back(std::move(block));
  }
}

void get_joints(const h5::File& store, MotionScene& scene) {
  const std::vector<int> blocks = store.get<int>("/joint_blocks");
  const std::vector<double> normal = store.get<double>("/joint_normal"), thickness = store.get<double>("/joint_thickness");
  const Ragged<double> polygon = get_ragged<double>(store, "/joint_polygon", "/joint_polygon_start", 3);
  const std::size_t n = thickness.size();
  if (blocks.size() != 2 * n || normal.size() != 3 * n || polygon.start.size() != n + 1) store.unreadable("the list of joints");
  for (std::size_t j = 0; j < n; ++j) {
    MotionJoint joint{blocks[2 * j], blocks[2 * j + 1], {}, row(normal, j), thickness[j]};
    for (int block : {joint.a, joint.b})
      if (block < 0 || static_cast<std::size_t>(block) >= scene.blocks.size()) store.unreadable("/joint_blocks");
    for (int p = polygon.start[j]; p < polygon.start[j + 1]; ++p) joint.polygon.push_back(row(polygon.items, static_cast<std::size_t>(p)));
    scene.joints.push_back(std::move(joint));
  }
}

}  // namespace

void put_scene(const h5::File& store, const MotionScene& scene) {
  put_shapes(store, scene);
  put_blocks(store, scene);
  put_joints(store, scene);
}

MotionScene get_scene(const h5::File& store) {
  MotionScene scene;
  get_shapes(store, scene);
  get_blocks(store, scene);
  get_joints(store, scene);
  return scene;
}

int share_shape(MotionScene& scene, MotionShape shape) {
  auto known = std::find(scene.shapes.begin(), scene.shapes.end(), shape);
  const int index = static_cast<int>(known - scene.shapes.begin());
  if (known == scene.shapes.end()) scene.shapes.push_back(std::move(shape));
  return index;
}

}  // namespace erbs
