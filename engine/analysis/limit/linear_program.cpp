#include "engine/analysis/limit/linear_program.h"

#include <ClpSimplex.hpp>

namespace erbs::analysis {

struct LinearSolver::Inner {
  ClpSimplex clp;
  bool solved = false;
};

LinearSolver::LinearSolver(const LinearProgram& p) : inner_(std::make_unique<Inner>()) {
  ClpSimplex& clp = inner_->clp;
  clp.setLogLevel(0);
  clp.messageHandler()->setLogLevel(0);
  const std::vector<CoinBigIndex> first(p.first.begin(), p.first.end());
  clp.loadProblem(p.columns(), p.rows, first.data(), p.row.data(), p.entry.data(), p.low.data(), p.high.data(), p.cost.data(),
                  p.right.data(), p.right.data());
  clp.setOptimizationDirection(-1);
}
LinearSolver::~LinearSolver() = default;

LinearSolution LinearSolver::solve() {
  ClpSimplex& clp = inner_->clp;
  if (inner_->solved) clp.dual();
  else clp.initialSolve();
  inner_->solved = true;
  LinearSolution out;
  using Status = LinearSolution::Status;
  out.status = clp.isProvenOptimal()            ? Status::optimal
               : clp.isProvenPrimalInfeasible() ? Status::infeasible
               : clp.isProvenDualInfeasible()   ? Status::unbounded
                                                : Status::failed;
  out.iterations = clp.numberIterations();
  out.value = clp.objectiveValue();
  out.x.assign(clp.primalColumnSolution(), clp.primalColumnSolution() + clp.numberColumns());
  out.price.assign(clp.dualRowSolution(), clp.dualRowSolution() + clp.numberRows());
  return out;
}

void LinearSolver::set_bounds(const std::vector<double>& low, const std::vector<double>& high) {
  for (int i = 0; i < inner_->clp.numberColumns(); ++i) inner_->clp.setColumnBounds(i, low[std::size_t(i)], high[std::size_t(i)]);
}

}  // namespace erbs::analysis
