// Times shown by a movie.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "engine/base/error.h"
#include "render/movie/movie.h"
#include "render/run/mesh.h"

namespace erbs::render {
namespace {

void evenly(Schedule& s, double from, double step, int count) {
  for (int i = 0; i < count; ++i) s.times.push_back(from + step * i);
}

}  // namespace

Schedule schedule_of(const Movie& movie, const std::vector<double>& recorded) {
  if (recorded.empty()) throw Error("the run has no frames yet; run it longer than its frame_dt");
  const double first = recorded.front(), last = recorded.back();
  Schedule s{{}, movie.slow};
  if (!movie.stills.empty()) {
    // The last step may fall slightly short of the duration that the user asks for.
    const double slack = 1e-9 + (recorded.size() > 1 ? 0.05 * (last - first) / static_cast<double>(recorded.size() - 1) : 0);
    for (double t : movie.stills) {
      if (t < first - slack || t > last + slack)
        throw Error(fmt::format("--stills {} is not within the run, which has frames from {:.6g} s to {:.6g} s", t, first, last));
      if (std::ranges::none_of(s.times, [&](double other) { return std::fabs(t - other) < 1e-9; })) s.times.push_back(t);
    }
    return s;
  }
  const double from = movie.range ? std::max(first, movie.range->first) : first;
  const double to = movie.range ? std::min(last, movie.range->second) : last;
  if (from > to)
    throw Error(fmt::format("--time {}:{} holds no frame; the run has frames from {:.6g} s to {:.6g} s", movie.range->first,
                            movie.range->second, first, last));
  if (movie.frames.empty()) {
    const double step = 1 / (movie.fps * movie.slow);
    evenly(s, from, step, 1 + static_cast<int>((to - from) / step + 1e-6));
    if (to - s.times.back() > 0.25 * step) s.times.push_back(to);  // what a run came to is worth a picture, the rest of a step is not
    return s;
  }
  if (movie.frames == "every") {
    for (double t : recorded)
      if (t >= from - 1e-9 && t <= to + 1e-9) s.times.push_back(t);
  } else {
    int count = 0;
    const char* end = movie.frames.data() + movie.frames.size();
    if (std::from_chars(movie.frames.data(), end, count).ptr != end || count < 1)
      throw Error("--frames " + movie.frames + " is neither `every` nor a number of frames from 1 on");
    evenly(s, from, count > 1 ? (to - from) / (count - 1) : 0, count);
  }
  if (s.times.size() > 1 && s.times.back() > s.times.front())
    s.slow = static_cast<double>(s.times.size() - 1) / movie.fps / (s.times.back() - s.times.front());
  return s;
}

MotionFrame frame_at(const MotionReader& reader, double t) {
  const std::vector<double>& times = reader.times();
  const auto after = static_cast<int>(std::lower_bound(times.begin(), times.end(), t - 1e-9) - times.begin());
  if (after == 0) return reader.read(0);
  if (after == static_cast<int>(times.size())) return reader.read(after - 1);
  if (times[static_cast<std::size_t>(after)] - t < 1e-6) return reader.read(after);
  MotionFrame f = reader.read(after - 1);
  const MotionFrame g = reader.read(after);
  const auto s = static_cast<float>((t - f.t) / (g.t - f.t));
  for (std::size_t b = 0; b + 6 < f.poses.size(); b += 7) {
    for (std::size_t k = b; k < b + 3; ++k) f.poses[k] += s * (g.poses[k] - f.poses[k]);
    const Eigen::Quaternionf p(f.poses[b + 3], f.poses[b + 4], f.poses[b + 5], f.poses[b + 6]);
    const Eigen::Quaternionf q = p.slerp(s, Eigen::Quaternionf(g.poses[b + 3], g.poses[b + 4], g.poses[b + 5], g.poses[b + 6]));
    f.poses[b + 3] = q.w(), f.poses[b + 4] = q.x(), f.poses[b + 5] = q.y(), f.poses[b + 6] = q.z();
  }
  f.t = t;
  return f;
}

Rates rates_at(const MotionReader& reader, const Excerpt* excerpt, double t) {
  const std::vector<double>& times = reader.times();
  const auto read = [&](std::size_t i) {
    MotionFrame frame = reader.read(static_cast<int>(i));
    return excerpt ? excerpt_of(*excerpt, std::move(frame)) : frame;
  };
  if (times.size() < 3) return rates_between(read(0), read(times.size() - 1));
  const auto after = static_cast<std::size_t>(std::lower_bound(times.begin(), times.end(), t) - times.begin());
  const std::size_t nearest = after > 0 && (after == times.size() || t - times[after - 1] < times[after] - t) ? after - 1 : after;
  const std::size_t i = std::clamp<std::size_t>(nearest, 1, times.size() - 2);
  const MotionFrame f = read(i - 1), g = read(i), h = read(i + 1);
  Rates rates = rates_between(f, g);
  const Rates later = rates_between(g, h);
  const double share = std::clamp((2 * t - f.t - g.t) / (h.t - f.t), -1.0, 2.0);  // both are means of their intervals
  for (std::size_t b = 0; b < rates.velocity.size(); ++b) {
    rates.velocity[b] += share * (later.velocity[b] - rates.velocity[b]);
    rates.spin[b] += share * (later.spin[b] - rates.spin[b]);
  }
  return rates;
}

void derive_speeds(const MotionReader& reader, MotionFrame& frame) {
  const Rates rates = rates_at(reader, nullptr, frame.t);
  frame.derived.clear();
  for (const Vec3& velocity : rates.velocity) frame.derived.push_back(static_cast<float>(velocity.norm()));
}

void derive_stresses(const MotionReader& reader, bool shear, MotionFrame& frame) {
  if (!reader.has_stress() && !reader.scene().joints.empty())
    throw Error("the run has kept no stresses of its joints; say analysis{ frame_stress = true } and run the scene again");
  frame.derived.assign(frame.poses.size() / 7, 0);
  for (std::size_t j = 0; j < frame.normal_stress.size(); ++j) {
    const float stress = shear ? frame.shear_stress[j] : -frame.normal_stress[j];
    for (const int block : {reader.scene().joints[j].a, reader.scene().joints[j].b}) {
      float& largest = frame.derived[static_cast<std::size_t>(block)];
      largest = std::max(largest, stress);
    }
  }
}

void derive_slips(const MotionScene& scene, MotionFrame& frame) {
  frame.derived.assign(scene.blocks.size(), 0);
  const auto turn = [&](std::size_t b) {
    const float* p = &frame.poses[7 * b];
    return Eigen::Quaterniond(p[3], p[4], p[5], p[6]).normalized();
  };
  for (const MotionJoint& joint : scene.joints) {
    const auto a = static_cast<std::size_t>(joint.a), b = static_cast<std::size_t>(joint.b);
    const Eigen::Quaterniond qa = turn(a), qb = turn(b);
    const Vec3 between =
        (Eigen::Map<const Eigen::Vector3f>(&frame.poses[7 * b]) - Eigen::Map<const Eigen::Vector3f>(&frame.poses[7 * a])).cast<double>();
    const Vec3 n = qa * joint_normal(scene, joint), to_b = scene.blocks[b].rest - scene.blocks[a].rest;
    const double width = std::sqrt(0.5 * area_normal(joint.polygon).norm());
    double slip = 0, gap = 0;
    for (const Vec3& p : joint.polygon) {
      const Vec3 way = between + qb * (p - to_b) - qa * p;
      gap = std::max(gap, std::fabs(way.dot(n)));
      slip = std::max(slip, (way - way.dot(n) * n).norm());
    }
    if (!(gap < 0.25 * width)) continue;
    for (const std::size_t block : {a, b}) frame.derived[block] = std::max(frame.derived[block], static_cast<float>(slip));
  }
}

void magnify(const MotionScene& scene, double factor, MotionFrame& frame) {
  if (factor == 1) return;
  for (std::size_t b = 0; b < scene.blocks.size(); ++b) {
    float* p = &frame.poses[7 * b];
    Eigen::Map<Eigen::Vector3f> centre(p);
    centre = (scene.blocks[b].rest + factor * (centre.cast<double>() - scene.blocks[b].rest)).cast<float>();
    Eigen::AngleAxisd rotation(Eigen::Quaterniond(p[3], p[4], p[5], p[6]).normalized());
    if (rotation.angle() > pi) rotation.angle() -= 2 * pi;
    rotation.angle() *= factor;
    const Eigen::Quaternionf q(Eigen::Quaterniond(rotation).cast<float>());
    p[3] = q.w(), p[4] = q.x(), p[5] = q.y(), p[6] = q.z();
  }
}

}  // namespace erbs::render
