#include "engine/analysis/rocking.h"

#include <algorithm>
#include <cmath>

#include "engine/base/units.h"

namespace erbs::analysis {
namespace {

struct Phase {
  double theta, spin;
};

// Equation of motion over one arch: s is the sign of theta, constant during a step.
class Equation {
 public:
  Equation(const RockingBlock& block, const RockingLoad& load) : b_(block), load_(load) {}
  double ground(double t) const { return load_.wave ? load_.factor * value(*load_.wave, t) / b_.gravity : 0; }  // in g
  double uplift() const { return b_.linear ? b_.alpha : std::tan(b_.alpha); }                                   // in g
  Phase rate(double t, Phase y, double s) const {
    const double left = s * b_.alpha - y.theta, a = ground(t);
    return {y.spin, -b_.p * b_.p * (b_.linear ? left + a : std::sin(left) + a * std::cos(left))};
  }
  // Free rocking: energy in excess of the energy needed to pass over the edge, over p^2. Negative: the block will fall back.
  double beyond_edge(Phase y) const {
    const double left = b_.alpha - std::fabs(y.theta), kinetic = 0.5 * y.spin * y.spin / (b_.p * b_.p);
    return b_.linear ? kinetic - 0.5 * left * left : kinetic + std::cos(left) - 1;
  }

 private:
  const RockingBlock& b_;
  const RockingLoad load_;  // a copy: callers pass temporaries
};

struct Trial {
  Phase y;
  double error;  // of one step, relative to the tolerance
};

// One step of order 5 with an embedded order 4 (Dormand and Prince 1980, J. Comp. Appl. Math. 6, 19, Table 2).
Trial attempt(const Equation& f, double t, Phase y, double s, double h, double theta_scale, double spin_scale) {
  static constexpr double a[6][6] = {{1. / 5},
                                     {3. / 40, 9. / 40},
                                     {44. / 45, -56. / 15, 32. / 9},
                                     {19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729},
                                     {9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656},
                                     {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84}};
  static constexpr double c[6] = {1. / 5, 3. / 10, 4. / 5, 8. / 9, 1, 1};
  static constexpr double e[7] = {71. / 57600, 0, -71. / 16695, 71. / 1920, -17253. / 339200, 22. / 525, -1. / 40};
  Phase k[7];
  k[0] = f.rate(t, y, s);
  Phase next = y;
  for (int i = 0; i < 6; ++i) {
    next = y;
    for (int j = 0; j <= i; ++j) next.theta += h * a[i][j] * k[j].theta, next.spin += h * a[i][j] * k[j].spin;
    k[i + 1] = f.rate(t + c[i] * h, next, s);
  }
  double theta = 0, spin = 0;
  for (int i = 0; i < 7; ++i) theta += h * e[i] * k[i].theta, spin += h * e[i] * k[i].spin;
  return {next, std::max(std::fabs(theta) / theta_scale, std::fabs(spin) / spin_scale)};
}

// Root of f between low and high, where f has opposite signs: regula falsi after Dowell and Jarratt 1971 ("Illinois").
template <class F>
double root(F f, double low, double high) {
  double f_low = f(low), f_high = f(high);
  for (int i = 0; i < 100 && high - low > 1e-15 * (std::fabs(low) + std::fabs(high)); ++i) {
    const double x = std::clamp((low * f_high - high * f_low) / (f_high - f_low), low, high), y = f(x);
    if (y == 0 || x == low || x == high) return x;
    if ((y > 0) == (f_high > 0)) high = x, f_high = y, f_low *= 0.5;
    else low = x, f_low = y, f_high *= 0.5;
  }
  return 0.5 * (low + high);
}

class Rocker {
 public:
  Rocker(const RockingBlock& block, const RockingLoad& load, double duration, bool verdict_only)
      : b_(block), f_(block, load), duration_(duration), verdict_only_(verdict_only) {
    load_end_ = load.wave ? end_time(*load.wave) : 0;
    longest_ = 0.1 / block.p;
    if (load.wave) longest_ = std::max(std::min(longest_, resolution(*load.wave)), 1e-6 * duration);
  }

  RockingRun run(const RockingStart& start) {
    y_ = {start.theta, start.spin};
    s_ = start.theta != 0 ? std::copysign(1.0, start.theta) : std::copysign(1.0, start.spin);
    keep();
    if (start.theta == 0 && start.spin == 0) resting_ = true;
    peak_ = std::fabs(start.theta);
    while (t_ < duration_ && !out_.overturned) {
      if (resting_ && !lift_off()) break;
      step();
      if (verdict_only_ && t_ >= load_end_ && !resting_ && decided()) break;
    }
    if (peak_ > 0) out_.amplitude.push_back(peak_);
    if (t_ < duration_ && !verdict_only_ && !out_.overturned) {
      t_ = duration_;
      keep();
    }
    return std::move(out_);
  }
  Phase phase() const { return y_; }

 private:
  void keep() {
    if (verdict_only_) return;
    out_.t.push_back(t_);
    out_.theta.push_back(y_.theta);
    out_.spin.push_back(y_.spin);
  }

  // Moves from rest to the instant the ground acceleration exceeds the threshold; false if it never does.
  bool lift_off() {
    const auto over = [&](double t) { return std::fabs(f_.ground(t)) - f_.uplift(); };
    double before = t_;
    while (over(t_) <= 0) {
      if (t_ >= std::min(duration_, load_end_)) return false;
      before = t_;
      t_ = std::min(t_ + longest_, duration_);
    }
    if (t_ > before) {  // bisection, since the acceleration may jump
      double low = before, high = t_;
      for (int i = 0; i < 60; ++i) (over(0.5 * (low + high)) > 0 ? high : low) = 0.5 * (low + high);
      t_ = high;
    }
    s_ = -std::copysign(1.0, f_.ground(t_));
    y_ = {0, 0};
    resting_ = false;
    fresh_ = true;
    keep();
    return true;
  }

  // Decides after the end of the load: either the energy is too small to pass over the edge, or the block is passing over it.
  bool decided() {
    const bool inside = std::fabs(y_.theta)<b_.alpha, outwards = y_.theta * y_.spin> 0, enough = f_.beyond_edge(y_) > 0;
    if ((outwards && enough) || (!inside && !enough)) {
      out_.overturned = true;
      out_.overturned_at = t_;
    }
    return out_.overturned || (inside && !enough);
  }

  void step() {
    const double tolerance = verdict_only_ ? 1e-9 : 1e-11;
    const double theta_scale = tolerance * b_.alpha, spin_scale = tolerance * b_.alpha * b_.p;
    h_ = std::min({h_ > 0 ? h_ : 1e-3 * longest_, longest_, duration_ - t_});
    if (t_ < load_end_ && load_end_ < t_ + h_) h_ = load_end_ - t_;  // the load may have a kink or jump there
    Trial trial = attempt(f_, t_, y_, s_, h_, theta_scale, spin_scale);
    while (trial.error > 1 && h_ > 1e-9 * longest_) {
      h_ *= std::max(0.2, 0.9 * std::pow(trial.error, -0.2));
      trial = attempt(f_, t_, y_, s_, h_, theta_scale, spin_scale);
    }
    const double next = h_ * std::min(4.0, 0.9 * std::pow(std::max(trial.error, 1e-6), -0.2));
    const auto at = [&](double h) { return attempt(f_, t_, y_, s_, h, theta_scale, spin_scale).y; };
    if (s_ * trial.y.theta < 0 && !(fresh_ && s_ * trial.y.theta > -1e-14 * b_.alpha)) {
      const double early = y_.theta == 0 ? 1e-6 * h_ : 0;
      const bool leaves = s_ * at(early).theta > 0;
      const double h = leaves ? root([&](double x) { return s_ * at(x).theta; }, early, h_) : early;
      peak_within(at, h);
      y_ = at(h);
      t_ += h;
      impact();
    } else {
      peak_within(at, h_);
      y_ = trial.y;
      t_ += h_;
      fresh_ = false;
      keep();
    }
    h_ = next;
    if (std::fabs(y_.theta) > (b_.linear ? 30 * b_.alpha : 0.5 * pi)) {
      out_.overturned = true;
      out_.overturned_at = t_;
    }
  }

  template <class At>
  void peak_within(const At& at, double h) {
    const Phase end = at(h);
    peak_ = std::max({peak_, s_ * y_.theta, s_ * end.theta});
    if (s_ * y_.spin > 0 && s_ * end.spin < 0)
      peak_ = std::max(peak_, s_ * at(root([&](double x) { return s_ * at(x).spin; }, 0.0, h)).theta);
  }

  void impact() {
    y_ = {0, b_.mu * y_.spin};
    out_.impact.push_back(t_);
    out_.amplitude.push_back(peak_);
    peak_ = 0;
    s_ = -s_;
    keep();
    if (std::fabs(y_.spin) < 1e-7 * b_.p * b_.alpha || out_.impact.size() > 100000) {
      y_.spin = 0;
      resting_ = true;
    }
  }

  const RockingBlock& b_;
  Equation f_;
  double duration_, load_end_ = 0, longest_ = 0, h_ = 0;
  bool verdict_only_, resting_ = false, fresh_ = false;
  double t_ = 0, s_ = 1, peak_ = 0;
  Phase y_{};
  RockingRun out_;
};

struct Verdict {
  bool overturned;
  int impacts;  // before overturning; 0 if the block stands
  bool operator==(const Verdict&) const = default;
};

Verdict verdict(const RockingBlock& block, const Wave& wave, double factor, Criterion criterion, double duration) {
  if (criterion == Criterion::alpha_at_end) {
    // Evaluated at the end of the wave, or earlier if the block has overturned by then.
    Rocker rocker(block, {&wave, factor}, end_time(wave), true);
    const RockingRun run = rocker.run({});
    const bool there = std::fabs(rocker.phase().theta) >= block.alpha;
    return {there, there ? int(run.impact.size()) : 0};
  }
  const RockingRun run = rock(block, {&wave, factor}, {}, duration, true);
  return {run.overturned, run.overturned ? int(run.impact.size()) : 0};
}

}  // namespace

RockingBlock homogeneous_block(double width, double height, double gravity) {
  RockingBlock block;
  const double R = 0.5 * std::hypot(width, height), sine = 0.5 * width / R;
  block.alpha = std::atan2(width, height);
  block.p = std::sqrt(0.75 * gravity / R);
  block.mu = 1 - 1.5 * sine * sine;
  block.gravity = gravity;
  return block;
}

RockingRun rock(const RockingBlock& block, const RockingLoad& load, const RockingStart& start, double duration, bool verdict_only) {
  return Rocker(block, load, duration, verdict_only).run(start);
}

std::vector<OverturningBand> overturning_bands(const RockingBlock& block, const Wave& wave, Criterion criterion, double low, double high,
                                               int points, double duration) {
  const auto at = [&](double factor) { return verdict(block, wave, factor, criterion, duration); };
  std::vector<OverturningBand> bands;
  Verdict last = at(low);
  const auto change = [&](double factor, double to, Verdict now) {
    if (last.overturned) bands.back().to = factor;
    if (now.overturned) bands.push_back({to, high, now.impacts});
    last = now;
  };
  if (last.overturned) bands.push_back({low, high, last.impacts});
  double before = low;
  for (int i = 1; i <= points; ++i) {
    const double factor = low + (high - low) * i / points;
    const Verdict now = at(factor);
    for (int inside = 0; !(now == last) && inside < 20; ++inside) {  // finds each change between the two factors
      double a = before, b = factor;
      Verdict upper = now;
      while (b - a > 1e-9 * b) {
        const Verdict middle = at(0.5 * (a + b));
        if (middle == last) a = 0.5 * (a + b);
        else b = 0.5 * (a + b), upper = middle;
      }
      change(a, b, upper);
      before = b;
    }
    before = factor;
  }
  return bands;
}

}  // namespace erbs::analysis
