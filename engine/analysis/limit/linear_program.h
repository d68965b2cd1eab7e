// Linear programs: maximise cost x with A x = right and low <= x <= high. linear_program.cpp alone includes CLP (coinor-libclp-dev).
#pragma once
#include <memory>
#include <vector>

namespace erbs::analysis {

struct LinearProgram {
  int rows = 0;
  // columns, one after the other                     [columns]
  std::vector<int> first{0};  // entries of column i: first[i] to first[i + 1]      [columns + 1]
  std::vector<int> row;       //                                                    [entries]
  std::vector<double> entry;  //                                                    [entries]
  std::vector<double> cost, low, high;
  std::vector<double> right;  // [rows]

  int columns() const { return int(cost.size()); }
  void end_column(double its_cost, double its_low, double its_high) {
    first.push_back(int(row.size()));
    cost.push_back(its_cost), low.push_back(its_low), high.push_back(its_high);
  }
};

struct LinearSolution {
  enum class Status { optimal, infeasible, unbounded, failed } status = Status::failed;
  double value = 0;
  std::vector<double> x, price;  // price: change of the value with the right-hand side [rows]
  int iterations = 0;
};

// Keeps the basis between solutions of programs that differ in bounds only.
class LinearSolver {
 public:
  explicit LinearSolver(const LinearProgram& program);
  ~LinearSolver();
  LinearSolution solve();  // dual simplex
  void set_bounds(const std::vector<double>& low, const std::vector<double>& high);

 private:
  struct Inner;
  std::unique_ptr<Inner> inner_;
};

}  // namespace erbs::analysis
