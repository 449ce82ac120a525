// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/CoupledModes.hpp"

#include <Eigen/SparseCholesky>

#include "linalg/SemidefiniteModes.hpp"
#include "reduction/Partition.hpp"

namespace tooljoint::coupling {

namespace {

/// Scaled to unit diagonal, M has a pivot that is rounding: massless dofs, multipliers, residual flexibility without mass.
bool isSingular(const Sparse& M) {
  const Vector diagonal = M.diagonal();
  if (!(diagonal.array() > 0).all()) return true;
  const Vector scale = diagonal.cwiseSqrt().cwiseInverse();
  const Eigen::SparseMatrix<double> scaled = scale.asDiagonal() * M * scale.asDiagonal();
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(scaled);
  return factor.info() != Eigen::Success || (M.rows() > 0 && factor.vectorD().minCoeff() <= 1e-13);
}

}  // namespace

linalg::EigenPairs lowestModes(const model::SecondOrderModel& model, int count) {
  const Sparse K = reduction::symmetricPart(model.stiffnessAt(0.0) + model.pointStiffness(0.0, model.initialDisplacement, model.initialVelocity));
  const Sparse M = reduction::symmetricPart(model.mass);
  linalg::EigenOptions options;
  options.name = [&](int i) { return model::describe(model.dofs[static_cast<std::size_t>(i)], model.componentNames); };
  return isSingular(M) ? linalg::semidefiniteModes(K, M, count < model.size() ? count : -1, options) : linalg::lowestModes(K, M, count, options);
}

}  // namespace tooljoint::coupling
