// What of a model is drawn: its triangles that the eye may see, and poses as exact as pixels show.
#include <algorithm>
#include <cmath>
#include <limits>

#include "render/draw/visible.h"

namespace erbs::render {

std::vector<float> rounded_poses(const Show& show, const MotionFrame& frame, const Vec3& eye, double pixel) {
  std::vector<float> poses = frame.poses;
  for (std::size_t b = 0; b < show.radius.size(); ++b) {
    float* p = &poses[7 * b];
    const double radius = static_cast<double>(show.radius[b]);
    const double near = (Eigen::Map<const Eigen::Vector3f>(p).cast<double>() - eye).norm() - radius, most = pixel / 50 * near;  // m
    if (!(radius > 0 && most > 0 && std::isfinite(most))) continue;
    const double unit = std::exp2(std::floor(std::log2(most)));  // which a motion changes at a few distances only
    for (int k = 0; k < 3; ++k) {
      const double rest = show.scene->blocks[b].rest[k];
      p[k] = static_cast<float>(rest + unit * std::round((static_cast<double>(p[k]) - rest) / unit));
    }
    const double step = 0.5 * unit / radius;
    Eigen::Quaterniond q(p[3], p[4], p[5], p[6]);
    q.coeffs() = (q.coeffs() / step).array().round();
    q.normalize();
    p[3] = static_cast<float>(q.w()), p[4] = static_cast<float>(q.x()), p[5] = static_cast<float>(q.y()), p[6] = static_cast<float>(q.z());
  }
  return poses;
}

void choose_triangles(const Show& show, const MotionFrame& frame, Coloring coloring, const Vec3& eye, const Fineness& fineness,
                      FrameTexels& t) {
  const MotionScene& scene = *show.scene;
  const double pixel = fineness.pixel;
  const double moved = 0.1 * show.open_crack;       // m, ...
  const double leaky = 0.0005 * show.stage.size();  // ... some half a texel of the shadow map: no light is seen through it
  std::vector<bool> quiet(scene.blocks.size(), true), tight = quiet;
  std::vector<double> distances, gaps;  // m, of each joint, from the eye and between its two sides
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    const auto a = static_cast<std::size_t>(scene.joints[j].a), b = static_cast<std::size_t>(scene.joints[j].b);
    const bool to_ghost = show.ghost[a] != show.ghost[b];
    distances.push_back(static_cast<double>((place_of(frame, a) - eye.cast<float>()).norm()));
    gaps.push_back(static_cast<double>(t.joints[4 * j + 1]));
    if (gaps[j] >= moved || to_ghost) quiet[a] = quiet[b] = false;
    if (gaps[j] >= leaky || to_ghost) tight[a] = tight[b] = false;
  }
  const auto add = [](std::vector<std::uint32_t>& to, const std::vector<std::uint32_t>& from, Span span) {
    to.insert(to.end(), from.begin() + span.begin, from.begin() + span.end);
  };
  // What looks away from the eye at all corners is left out: in a model of many blocks it takes as long as what is seen.
  std::vector<Eigen::Vector3f> eyes;  // m, as each block sees it
  for (std::size_t b = 0; b < scene.blocks.size(); ++b)
    eyes.push_back(turn_of(frame, b).conjugate() * (eye.cast<float>() - place_of(frame, b)));
  const auto away = [&](const float* at, const float* normal, std::uint32_t block) {
    const Eigen::Vector3f to_eye = eyes[block] - Eigen::Map<const Eigen::Vector3f>(at);
    return Eigen::Map<const Eigen::Vector3f>(normal).dot(to_eye) < -1e-4F * to_eye.lpNorm<1>();  // the shaders round otherwise
  };
  const auto add_seen = [&](std::vector<std::uint32_t>& to, const std::vector<std::uint32_t>& from, Span span) {
    const auto hidden = [&](std::uint32_t corner) {
      const Vertex& v = show.mesh.vertices[corner];
      return away(v.p, v.n, v.block);
    };
    for (std::uint32_t i = span.begin; i + 2 < span.end; i += 3)
      if (!hidden(from[i]) || !hidden(from[i + 1]) || !hidden(from[i + 2])) to.insert(to.end(), &from[i], &from[i] + 3);
  };
  t.index.reserve(show.mesh.index.size());
  // Near blocks come first: hidden surfaces are then not shaded.
  std::vector<std::pair<float, std::size_t>> order;
  for (std::size_t b = 0; b < scene.blocks.size(); ++b) {
    const float distance = (place_of(frame, b) - eye.cast<float>()).squaredNorm();
    order.emplace_back(std::isfinite(distance) ? distance : std::numeric_limits<float>::max(), b);
  }
  std::sort(order.begin(), order.end());
  // Chamfers this narrow, in pixels, are left out. Where mortar has the colour of the bricks, they are the joints that one sees; without
  // mortar too, but two of them then darken a pixel by a twentieth at most.
  const double narrow = !show.mortared ? 0.06 : coloring == Coloring::material ? 0.25 : 0;
  const double plain_from = pixel * narrow * show.chamfer > 0 ? show.chamfer / (narrow * pixel) : HUGE_VAL;  // m
  for (const auto& [distance, b] : order) {
    if (show.ghost[b]) continue;
    add(t.shade_index, show.mesh.shade_index, (tight[b] ? show.mesh.rim_shade : show.mesh.whole_shade)[b]);
    if (static_cast<double>(distance) > plain_from * plain_from) {
      add_seen(t.index, show.mesh.plain_index, show.mesh.plain_open[b]);
      if (!quiet[b]) add_seen(t.index, show.mesh.plain_index, show.mesh.plain_buried[b]);
      continue;
    }
    for (const std::vector<Surface<Span>>* surfaces : {&show.mesh.open, &show.mesh.buried}) {
      if (surfaces == &show.mesh.buried && quiet[b]) continue;
      add_seen(t.index, show.mesh.index, (*surfaces)[b].faces);
      add_seen(t.fine_index, show.mesh.index, (*surfaces)[b].edges);
    }
  }
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    const auto a = static_cast<std::size_t>(scene.joints[j].a), b = static_cast<std::size_t>(scene.joints[j].b);
    const bool of_ghosts = show.ghost[a], closed = quiet[a] && quiet[b];
    if (of_ghosts != show.ghost[b]) continue;
    const auto add_mortar = [&](std::vector<std::uint32_t>& solid, Span span) {
      if (of_ghosts) add(t.ghost_index, show.mesh.index, span);
      else add_seen(solid, show.mesh.index, span);
    };
    // As the shader would drop it: wide open, or hardly damaged.
    const double damage = static_cast<double>(t.joints[4 * j]), parted = std::min(1.0, gaps[j] / show.open_crack);
    const bool shown = gaps[j] <= widest_crack * show.open_crack && (coloring == Coloring::joint_state || damage >= 0.05);
    const double band = shown ? fineness.band * distances[j] * (0.3 + 0.3 * damage + 0.4 * parted) : 0;  // m, as in the shader
    const double thick = scene.joints[j].thickness;                                                      // m
    const bool behind = !of_ghosts && 0.9 * band >= thick + gaps[j];
    if (gaps[j] < moved) {
      if (!behind) add_mortar(t.fine_index, show.mesh.sides[j].open);
      if (!behind && !closed) add_mortar(t.fine_index, show.mesh.sides[j].covered);
    } else if (!behind) {
      add_mortar(t.index, show.mesh.beds[j].faces);
      // Of debris, the sides of half a bed are left out where they are less than 0.4 pixels wide.
      if (of_ghosts || gaps[j] < 4 * thick || 0.5 * thick >= 0.4 * pixel * distances[j]) add_mortar(t.fine_index, show.mesh.beds[j].edges);
    }
    if (!shown || of_ghosts) continue;
    const auto hidden = [&](std::uint32_t k) {
      const CrackVertex& v = show.mesh.cracks[k];
      return away(v.pa, v.facing, v.a);
    };
    const Span bands = show.mesh.crack[j];
    for (std::uint32_t i = bands.begin; i + 2 < bands.end; i += 3) {
      const std::uint32_t* const corner = &show.mesh.crack_index[i];
      if (!hidden(corner[0]) || !hidden(corner[1]) || !hidden(corner[2])) t.crack_index.insert(t.crack_index.end(), corner, corner + 3);
    }
  }
  for (const auto& [distance, b] : order)
    if (show.ghost[b]) {
      for (const std::vector<Surface<Span>>* surfaces : {&show.mesh.open, &show.mesh.buried}) {
        if (surfaces == &show.mesh.buried && quiet[b]) continue;
        add(t.ghost_index, show.mesh.index, (*surfaces)[b].faces);
        add(t.ghost_index, show.mesh.index, (*surfaces)[b].edges);
      }
    }
}

}  // namespace erbs::render
