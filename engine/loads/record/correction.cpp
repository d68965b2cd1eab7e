#include "engine/loads/record/correction.h"

#include <algorithm>
#include <cmath>

#include "engine/base/units.h"
#include "engine/base/vec.h"
#include "engine/loads/waves/polyline.h"

namespace erbs {
namespace {

// One section of a filter: y[i] = b0 x[i] + b1 x[i-1] + b2 x[i-2] - a1 y[i-1] - a2 y[i-2]
struct Section {
  double b0, b1, b2, a1, a2;
};

// Sections of a Butterworth filter; k = tan(pi corner dt).
std::vector<Section> butterworth(double k, int order, bool high) {
  std::vector<Section> out;
  for (int i = 0; i < order / 2; ++i) {
    const double damping = 2 * std::sin(pi * (2 * i + 1) / (2 * order));  // 1 / Q of this pair of poles
    const double norm = 1 / (1 + damping * k + k * k), b0 = high ? norm : k * k * norm;
    out.push_back({b0, high ? -2 * b0 : 2 * b0, b0, 2 * (k * k - 1) * norm, (1 - damping * k + k * k) * norm});
  }
  if (order % 2 == 1) {
    const double b0 = high ? 1 / (1 + k) : k / (1 + k);
    out.push_back({b0, high ? -b0 : b0, 0, (k - 1) / (k + 1), 0});
  }
  return out;
}

void run(const Section& s, std::vector<double>& x) {
  double x1 = 0, x2 = 0, y1 = 0, y2 = 0;
  for (double& value : x) {
    const double y = s.b0 * value + s.b1 * x1 + s.b2 * x2 - s.a1 * y1 - s.a2 * y2;
    x2 = x1, x1 = value, y2 = y1, y1 = y;
    value = y;
  }
}

}  // namespace

int baseline_degree(std::string_view word) {
  constexpr std::string_view words[] = {"none", "constant", "linear", "quadratic", "cubic"};
  return static_cast<int>(std::find(std::begin(words), std::end(words), word) - std::begin(words)) - 1;
}

void remove_baseline(const std::vector<double>& times, std::vector<double>& acceleration, int degree) {
  if (degree < 0) return;
  const auto n = static_cast<Eigen::Index>(times.size());
  const double middle = 0.5 * (times.front() + times.back()), half = 0.5 * (times.back() - times.front());
  Eigen::MatrixXd powers(n, degree + 1), velocities(n, degree + 1);
  for (int k = 0; k <= degree; ++k) {
    std::vector<double> power;
    for (const double t : times) power.push_back(std::pow((t - middle) / half, k));
    const Polyline line = make_polyline(times, power);
    for (Eigen::Index i = 0; i < n; ++i)
      powers(i, k) = line.values[static_cast<size_t>(i)], velocities(i, k) = line.area[static_cast<size_t>(i)];
  }
  const Polyline given = make_polyline(times, acceleration);
  const Eigen::VectorXd velocity = Eigen::Map<const Eigen::VectorXd>(given.area.data(), n);
  const Eigen::VectorXd share = velocities.colPivHouseholderQr().solve(velocity);
  const Eigen::VectorXd baseline = powers * share;
  for (Eigen::Index i = 0; i < n; ++i) acceleration[static_cast<size_t>(i)] -= baseline[i];
}

void band_pass(double dt, std::vector<double>& values, const Band& band, const Place& file) {
  const double nyquist = 0.5 / dt, nearly = (1 - 1e-6) * nyquist;  // the step of a file of times has their rounding
  for (const auto& [name, corner] : {std::pair{"low", band.low}, std::pair{"high", band.high}})
    if (corner >= nearly)
      throw Error(
          fmt::format("{} = {:g} Hz does not lie below half the sampling rate, {:.6g} Hz (step {:.6g} s); lower it, or leave it out", name,
                      corner, nyquist, dt),
          file);
  const double longest = 1.5 * band.order / (band.low > 0 ? band.low : band.high);
  constexpr double most = 2e7;
  if (longest / dt > most)
    throw Error(fmt::format("low = {:g} Hz needs a rest of {:.0f} s before and after the record, more than {:g} points; raise it", band.low,
                            longest, most),
                file);
  const auto pad = static_cast<size_t>(std::ceil(longest / dt));
  std::vector<double> x(pad, 0.0);
  x.insert(x.end(), values.begin(), values.end());
  x.insert(x.end(), pad, 0.0);
  for (int pass = 0; pass < 2; ++pass) {
    if (band.low > 0)
      for (const Section& section : butterworth(std::tan(pi * band.low * dt), band.order, true)) run(section, x);
    if (band.high > 0)
      for (const Section& section : butterworth(std::tan(pi * band.high * dt), band.order, false)) run(section, x);
    std::reverse(x.begin(), x.end());
  }
  std::copy_n(x.begin() + static_cast<std::ptrdiff_t>(pad), values.size(), values.begin());
}

}  // namespace erbs
