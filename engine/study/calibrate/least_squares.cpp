#include "engine/study/calibrate/least_squares.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/vec.h"
#include "engine/study/sweep/design.h"

namespace erbs::study {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

class Search {
 public:
  Search(std::size_t n, const EvaluateAll& evaluate, const LeastSquares& how) : n_(n), evaluate_(evaluate), how_(how) {}

  Minimum run() {
    scan();
    for (int round = 0; out_.found && !out_.converged && round < how_.rounds; ++round) step();
    if (out_.found) deviate();
    return out_;
  }

 private:
  // True if one of the points is better than all before.
  bool take(const std::vector<Shares>& points) {
    const std::vector<Residuals> answers = evaluate_(points);
    bool better = false;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!answers[i]) continue;
      const double sum = sum_of_squares(*answers[i]);
      if (out_.found && !(sum < out_.sum)) continue;
      out_.found = better = true;
      out_.best = points[i], out_.residuals = *answers[i], out_.sum = sum;
    }
    return better;
  }

  void scan() {
    std::vector<Shares> points;
    if (n_ == 1) {
      for (int i = 0; i <= 8; ++i) points.push_back({i / 8.0});
      h_ = 1.0 / 16;
    } else {
      std::vector<Range> ranges(n_);
      const int count = int(8 * n_ + 1);
      for (const auto& row : latin_hypercube(ranges, count, 1).rows) {
        points.emplace_back();
        for (const Value& value : row) points.back().push_back(std::get<double>(value));
      }
      h_ = 1.0 / 16;
    }
    take(points);
  }

  // Central differences, one-sided at an end; columns of params whose runs failed are zero.
  void differentiate() {
    std::vector<Shares> points;
    for (std::size_t k = 0; k < n_; ++k)
      for (const double sign : {-1.0, 1.0}) {
        points.push_back(out_.best);
        points.back()[k] = std::clamp(out_.best[k] + sign * h_, 0.0, 1.0);
      }
    const std::vector<double> here = out_.residuals;
    const Shares at = out_.best;
    const std::vector<Residuals> answers = evaluate_(points);
    jacobian_ = Matrix::Zero(Eigen::Index(here.size()), Eigen::Index(n_));
    for (std::size_t k = 0; k < n_; ++k) {
      const Residuals &low = answers[2 * k], &high = answers[2 * k + 1];
      const double a = low ? points[2 * k][k] : at[k], b = high ? points[2 * k + 1][k] : at[k];
      if (!(b > a)) continue;
      for (std::size_t i = 0; i < here.size(); ++i)
        jacobian_(Eigen::Index(i), Eigen::Index(k)) = ((high ? *high : here)[i] - (low ? *low : here)[i]) / (b - a);
    }
    // A neighbour may be better than the point itself.
    for (std::size_t i = 0; i < points.size(); ++i)
      if (answers[i] && sum_of_squares(*answers[i]) < out_.sum)
        out_.best = points[i], out_.residuals = *answers[i], out_.sum = sum_of_squares(*answers[i]);
  }

  void step() {
    const Shares from = out_.best;
    differentiate();
    if (out_.best != from) return;  // a better point: differences are taken about it in the next round
    const Vector gradient = jacobian_.transpose() * Eigen::Map<const Vector>(out_.residuals.data(), Eigen::Index(out_.residuals.size()));
    Matrix free = jacobian_;
    for (std::size_t k = 0; k < n_; ++k) {
      const double wants = -gradient(Eigen::Index(k));
      if ((from[k] <= 0 && wants < 0) || (from[k] >= 1 && wants > 0)) free.col(Eigen::Index(k)).setZero();
    }
    const Matrix normal = free.transpose() * free;
    std::vector<Shares> trials;
    double longest = 0;
    for (const double factor : {0.01, 1.0, 100.0}) {
      Matrix damped = normal;
      for (Eigen::Index k = 0; k < damped.rows(); ++k) damped(k, k) += factor * lambda_ * normal(k, k) + 1e-12 * (1 + normal.trace());
      const Vector move =
          damped.ldlt().solve(-(free.transpose() * Eigen::Map<const Vector>(out_.residuals.data(), Eigen::Index(out_.residuals.size()))));
      Shares to = from;
      double length = 0;
      for (std::size_t k = 0; k < n_; ++k) {
        to[k] = std::clamp(from[k] + move(Eigen::Index(k)), 0.0, 1.0);
        length = std::max(length, std::fabs(to[k] - from[k]));
      }
      if (length > 0) trials.push_back(to), longest = std::max(longest, length);
    }
    const double before = out_.sum;
    const bool better = !trials.empty() && take(trials);
    double moved = 0;
    for (std::size_t k = 0; k < n_; ++k) moved = std::max(moved, std::fabs(out_.best[k] - from[k]));
    if (better) lambda_ = std::max(1e-6, lambda_ / 10), h_ = std::clamp(moved, 0.25 * h_, h_);
    else lambda_ = std::min(1e6, lambda_ * 10), h_ *= 0.25;
    out_.converged = better ? moved < how_.rel && before - out_.sum < 1e-3 * before : h_ < how_.rel;
    h_ = std::max(h_, 0.5 * how_.rel);
  }

  void deviate() {
    out_.deviation.assign(n_, std::numeric_limits<double>::infinity());
    if (jacobian_.size() == 0) return;
    const Matrix normal = jacobian_.transpose() * jacobian_;
    const auto spare = jacobian_.rows() - jacobian_.cols();
    const double scatter = spare > 0 ? out_.sum / double(spare) : std::nan("");  // without spare residuals nothing scatters
    const Matrix inverse = normal.completeOrthogonalDecomposition().pseudoInverse();
    for (std::size_t k = 0; k < n_; ++k)
      if (normal(Eigen::Index(k), Eigen::Index(k)) > 1e-12)
        out_.deviation[k] = std::sqrt(scatter * inverse(Eigen::Index(k), Eigen::Index(k)));
  }

  std::size_t n_;
  const EvaluateAll& evaluate_;
  const LeastSquares& how_;
  Minimum out_;
  Matrix jacobian_;  // of the residuals by the shares, at the last point about which differences were taken
  double h_ = 0.1, lambda_ = 1e-2;
};

}  // namespace

double sum_of_squares(const std::vector<double>& residuals) {
  double sum = 0;
  for (const double r : residuals) sum += r * r;
  return sum;
}

Minimum least_squares(std::size_t n, const EvaluateAll& evaluate, const LeastSquares& how) { return Search(n, evaluate, how).run(); }

}  // namespace erbs::study
