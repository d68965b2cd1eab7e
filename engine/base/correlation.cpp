#include "engine/base/correlation.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"

namespace erbs {
namespace {

// The signal at n even times from `from`.
std::vector<double> sampled(const Samples& s, double from, double step, int n) {
  std::vector<double> values;
  std::size_t k = 0;
  for (int i = 0; i < n; ++i) {
    const double at = std::clamp(from + i * step, s.t.front(), s.t.back());
    while (k + 2 < s.t.size() && s.t[k + 1] < at) ++k;
    const double wide = s.t[k + 1] - s.t[k];
    values.push_back(wide > 0 ? s.y[k] + (s.y[k + 1] - s.y[k]) * (at - s.t[k]) / wide : s.y[k]);
  }
  return values;
}

// Pearson's coefficient of n pairs.
double pearson(const double* a, const double* b, int n) {
  double sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
  for (int i = 0; i < n; ++i) sa += a[i], sb += b[i];
  const double ma = sa / n, mb = sb / n;
  for (int i = 0; i < n; ++i) {
    const double p = a[i] - ma, q = b[i] - mb;
    saa += p * p, sbb += q * q, sab += p * q;
  }
  return saa > 0 && sbb > 0 ? sab / std::sqrt(saa * sbb) : NAN;
}

}  // namespace

double Samples::at(double time) const {
  if (time <= t.front()) return y.front();
  if (time >= t.back()) return y.back();
  const std::size_t i = std::size_t(std::upper_bound(t.begin(), t.end(), time) - t.begin());
  return y[i - 1] + (y[i] - y[i - 1]) * (time - t[i - 1]) / (t[i] - t[i - 1]);
}

double Samples::step() const { return t.size() < 2 ? 0 : (t.back() - t.front()) / double(t.size() - 1); }

Lag lag_of(const Samples& first, const Samples& second, double reach) {
  Lag best{0, NAN, false};
  if (first.t.size() < 3 || second.t.size() < 3) return best;
  const double shorter = std::min(first.t.back() - first.t.front(), second.t.back() - second.t.front());
  const double longer = std::max(first.t.back() - first.t.front(), second.t.back() - second.t.front());
  const double step = std::max(std::min(first.step(), second.step()), longer / 3000);
  if (!(step > 0) || !(shorter > 2 * step)) return best;
  const int n = int((first.t.back() - first.t.front()) / step + 1e-6) + 1, m = int((second.t.back() - second.t.front()) / step + 1e-6) + 1;
  const std::vector<double> a = sampled(first, first.t.front(), step, n), b = sampled(second, second.t.front(), step, m);
  const double offset = first.t.front() - second.t.front();  // lag of a shift of no samples
  const int low = int(std::ceil((-reach - offset) / step)), high = int(std::floor((reach - offset) / step));
  const int least = std::max(3, std::min(n, m) / 2);
  std::vector<double> values(std::size_t(std::max(0, high - low + 1)), NAN);
  int at = -1;
  for (int k = low; k <= high; ++k) {  // a[i + k] beside b[i]
    const int from = std::max(0, -k), to = std::min(m, n - k);
    if (to - from < least) continue;
    const std::size_t i = std::size_t(k - low);
    values[i] = pearson(a.data() + from + k, b.data() + from, to - from);
    if (std::isfinite(values[i]) && (at < 0 || values[i] > values[std::size_t(at)])) at = int(i);
  }
  if (at < 0) return best;
  best = {(low + at) * step + offset, values[std::size_t(at)], true};
  if (at == 0 || at + 1 >= int(values.size())) return best;
  const double before = values[std::size_t(at - 1)], after = values[std::size_t(at + 1)];
  const double curvature = before - 2 * best.correlation + after;
  if (!std::isfinite(curvature)) return best;
  best.at_edge = false;
  if (curvature < 0) best.lag += 0.5 * step * (before - after) / curvature;
  return best;
}

std::string lag_text(double lag) { return fmt::format("{:.4f} s {}", std::abs(lag), lag < 0 ? "earlier" : "later"); }

double first_motion(const Samples& signal, double share) {
  double peak = 0;
  for (const double y : signal.y) peak = std::max(peak, std::abs(y - signal.y.front()));
  if (!(peak > 0)) return NAN;
  for (std::size_t i = 1; i < signal.y.size(); ++i) {
    const double now = std::abs(signal.y[i] - signal.y.front()), before = std::abs(signal.y[i - 1] - signal.y.front());
    if (now < share * peak) continue;
    return signal.t[i - 1] + (signal.t[i] - signal.t[i - 1]) * std::clamp((share * peak - before) / (now - before), 0.0, 1.0);
  }
  return NAN;
}

}  // namespace erbs
