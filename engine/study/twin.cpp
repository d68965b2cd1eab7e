#include "engine/study/twin.h"

#include <algorithm>
#include <cmath>

#include "engine/record/folder/motion_file.h"

namespace erbs::study {
namespace {

double apart(const MotionFrame& a, const MotionFrame& b) {
  double most = 0;
  for (std::size_t i = 0; i + 7 <= std::min(a.poses.size(), b.poses.size()); i += 7) {
    double square = 0;
    for (std::size_t k = 0; k < 3; ++k) square += std::pow(double(a.poses[i + k]) - double(b.poses[i + k]), 2);
    if (!(square <= 1e300)) return 1e150;  // one of the runs has a NaN or an overflow
    most = std::max(most, std::sqrt(square));
  }
  return most;
}

}  // namespace

std::optional<double> parting_time(const std::string& run, const std::string& twin, double distance) {
  const MotionReader a(run), b(twin);
  const std::size_t frames = std::min(a.times().size(), b.times().size());
  double before = 0, time = 0;
  for (std::size_t i = 0; i < frames; ++i) {
    const double now = apart(a.read(int(i)), b.read(int(i))), t = a.times()[i];
    if (now > distance) {
      const double floor = 1e-9;  // poses are stored with seven digits
      const double share = i == 0 ? 1 : std::log(distance / std::max(before, floor)) / std::log(now / std::max(before, floor));
      return time + std::clamp(share, 0.0, 1.0) * (t - time);
    }
    before = now, time = t;
  }
  return std::nullopt;
}

}  // namespace erbs::study
