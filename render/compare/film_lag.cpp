// By how much the run is later than the film.
#include <algorithm>
#include <cmath>

#include "engine/base/correlation.h"
#include "engine/base/error.h"
#include "render/compare/compare_film.h"

namespace erbs::render {
namespace {

// Films repeat pictures where their rate was raised or they were slowed: then nothing moves in most of their pictures. A mean over this
// many pictures of the film, or frames of the run, levels that.
constexpr double levelled = 2.5;
constexpr double near_by = 0.25;      // s, around the lag of the whole pictures, in which their parts are searched
constexpr double alike_places = 0.6;  // a lower likeness of the places of changes speaks of another camera

// Means over `width` (s) about each sample.
Samples levelled_over(const Samples& signal, double width) {
  Samples out{signal.t, {}};
  for (const double t : signal.t) {
    const auto low = std::lower_bound(signal.t.begin(), signal.t.end(), t - 0.5 * width);
    const auto high = std::upper_bound(low, signal.t.end(), t + 0.5 * width);
    double sum = 0;
    for (auto i = signal.y.begin() + (low - signal.t.begin()); i != signal.y.begin() + (high - signal.t.begin()); ++i) sum += *i;
    out.y.push_back(sum / static_cast<double>(high - low));
  }
  return out;
}

// When the pictures first change by a twentieth of the way from `rest` to their largest change. A run may move from its first picture on.
double first_change(const Samples& signal, double rest) {
  Samples moved = signal;
  moved.t.insert(moved.t.begin(), signal.t.front()), moved.y.insert(moved.y.begin(), rest);
  return first_motion(moved);
}

// Films of tests are often slow motion, and do not say so. A faster pace leaves too little that is level to be told from another. The same
// fall at another pace is much like itself: a pace counts that leaves half of what is unlike.
void try_paces(FilmErrors& errors, double slow, const Samples& run, const Samples& film, double width, double reach) {
  double best = std::isfinite(errors.correlation) ? std::max(doubtful, 0.5 * (1 + errors.correlation)) : doubtful;
  for (const double pace : {0.5, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 16.0, 20.0}) {
    Samples faster = film;
    for (double& t : faster.t) t /= pace;
    if (pace > 1 && faster.t.back() - faster.t.front() < 10 * width) break;
    if (const double correlation = lag_of(run, levelled_over(faster, width), reach).correlation; correlation > best)
      best = errors.better_correlation = correlation, errors.better_slow = slow * pace;
  }
}

// Cosine between the changes of all squares, those of the run taken `shift` pictures later; NaN without an overlap.
double likeness(const MotionSignal& run, const MotionSignal& film, long shift) {
  const long from = std::max(0L, -shift), to = std::min(static_cast<long>(film.where.size()), static_cast<long>(run.where.size()) - shift);
  double both = 0, own = 0, other = 0;
  for (long i = from; i < to; ++i) {
    const std::vector<float>&a = run.where[static_cast<std::size_t>(i + shift)], &b = film.where[static_cast<std::size_t>(i)];
    if (a.size() != b.size()) return NAN;
    for (std::size_t k = 0; k < a.size(); ++k) both += double(a[k] * b[k]), own += double(a[k] * a[k]), other += double(b[k] * b[k]);
  }
  return own > 0 && other > 0 ? both / std::sqrt(own * other) : NAN;
}

// How much a picture changes also depends on its light: shadows, cracks and dust that only one of the two shows displace the lag by a
// picture or two. Where it changes does not, and this lag near the first one brings the same places together. Both are sampled in equal
// steps; a parabola through three of them refines it.
void refine(FilmErrors& errors, double step) {
  const double offset = errors.run.t.front() - errors.film.t.front();  // lag of a shift of no pictures
  const long middle = std::lround((errors.lag - offset) / step), wide = std::clamp(std::lround(near_by / step), 2L, 50L);
  long best = middle;
  double most = NAN;
  for (long shift = middle - wide; shift <= middle + wide; ++shift)
    if (const double now = likeness(errors.run, errors.film, shift); std::isfinite(now) && !(now <= most)) best = shift, most = now;
  if (!(most >= alike_places) || std::labs(best - middle) == wide) return;
  errors.lag = static_cast<double>(best) * step + offset;
  const double before = likeness(errors.run, errors.film, best - 1), after = likeness(errors.run, errors.film, best + 1);
  const double curvature = before - 2 * most + after;
  if (curvature < 0) errors.lag += 0.5 * step * (before - after) / curvature;
}

}  // namespace

void align_film(FilmErrors& errors, const FilmComparison& wish, double slow, const std::vector<double>& recorded) {
  const double step = 1 / errors.fps, frame = (recorded.back() - recorded.front()) / std::max(1.0, double(recorded.size()) - 1);
  const double width = levelled * std::max(step, frame);
  const Samples run{errors.run.t, errors.run.y}, film{errors.film.t, errors.film.y};
  const Samples level = levelled_over(run, width);
  const Lag found = lag_of(level, levelled_over(film, width), wish.reach);
  errors.correlation = found.correlation;
  const bool by_correlation = wish.align == "correlation";
  if (by_correlation && !found.at_edge) try_paces(errors, slow, level, film, width, wish.reach);
  if (by_correlation) errors.lag = found.lag, errors.at_edge = found.at_edge;
  if (wish.align == "first-motion") {
    errors.lag =
        first_change(run, 0) - first_change(film, *std::min_element(film.y.begin(), film.y.end()));  // a film has its noise at rest
    if (found.correlation >= doubtful && std::fabs(found.lag - errors.lag) > 2 * width) errors.correlated_lag = found.lag;
  }
  if (!std::isfinite(errors.lag) || (by_correlation && !std::isfinite(found.correlation)))
    throw Error("nothing moves in it, or it has no time in common with the run, so that the times cannot be aligned; add --align none",
                {wish.film});
  if (by_correlation && !errors.at_edge) refine(errors, step);
}

}  // namespace erbs::render
