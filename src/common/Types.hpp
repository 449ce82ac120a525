// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The numeric types used by all rooms. Dense and sparse storage is Eigen's; solvers convert it to
/// Tpetra objects, each behind one .cpp (src/linalg), so that Trilinos headers stay out of the
/// physics.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <complex>
#include <vector>

namespace tooljoint {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;
using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
using Complex = std::complex<double>;
using ComplexVector = Eigen::VectorXcd;
using ComplexMatrix = Eigen::MatrixXcd;
using Sparse = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;
using Triplet = Eigen::Triplet<double, int>;
using Triplets = std::vector<Triplet>;

}  // namespace tooljoint
