// The only file that includes Eigen's sparse matrices and factorisations.
#pragma once
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <vector>

namespace erbs {

using Sparse = Eigen::SparseMatrix<double>;
using Triplets = std::vector<Eigen::Triplet<double>>;
using SparseLdlt = Eigen::SimplicialLDLT<Sparse>;
using SparseLu = Eigen::SparseLU<Sparse>;
using VecX = Eigen::VectorXd;

}  // namespace erbs
