// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/methods/FreeInterfaceBasis.hpp"

#include "linalg/DenseDecompositions.hpp"
#include "reduction/methods/BasisBuilder.hpp"
#include "reduction/vectors/FreeInterfaceModes.hpp"

namespace tooljoint::reduction {

namespace {

/// A combination of modes becomes a coordinate only if its share in motions with held boundary dofs
/// is at least this.
constexpr double leastShare = 0.1;

}  // namespace

FreeInterfaceBasis freeInterfaceBasis(const PartView& part, const ModeRequest& request) {
  FreeInterfaceBasis free;
  free.modes = freeInterfaceModes(part, request);
  free.shapes = free.modes.columns(range(free.modes.kept), part.model().size());
  free.statics = std::make_unique<InteriorStatics>(part, free.modes);
  const ConstraintModes constraint = free.statics->constraintModes();
  addConstraintRows(part, part.partition(), constraint.residuals, free.basis);
  report(free.modes, free.basis);
  completeWithRitzModes(part, constraint, freeInterfaceVectors(part, free.modes, *free.statics),
                        "free-interface", free.basis);
  return free;
}

/// With Phi = [X Y] in (u_b, w):  p = A_C u_b + A_D w.  A_D = U S V' and w = V_1 S_1^-1 (p_1 - U_1'
/// A_C u_b) + V_2 w_2.
Matrix toModeAmplitudes(const PartView& part, FreeInterfaceBasis& free) {
  Basis& basis = free.basis;
  const Eigen::Index boundary = sizeOf(basis.partition.boundary);
  const Eigen::Index modes = free.shapes.cols(), ritz = basis.vectors.cols() - boundary;
  const Matrix vectors = basis.vectors;
  Matrix amplitudes = free.shapes.transpose() * (part.mass() * vectors);
  const auto AC = amplitudes.leftCols(boundary);
  const Matrix AD = amplitudes.rightCols(ritz);
  basis.orthonormal = false;
  if (ritz == 0) return amplitudes;
  const auto svd =
      linalg::singularValues(AD, linalg::SingularVectors::Thin, linalg::SingularVectors::Full);
  Eigen::Index rank = 0;
  while (rank < svd.values.size() && svd.values[rank] >= leastShare) ++rank;
  Matrix changed = vectors, p = Matrix::Zero(modes, boundary + ritz);
  if (rank == modes &&
      rank == ritz) {  // p are the amplitudes of the modes; decoupled modes stay decoupled
    changed.rightCols(ritz) = linalg::DenseLu(AD.transpose())
                                  .solve(Matrix(vectors.rightCols(ritz).transpose()))
                                  .transpose();
    changed.leftCols(boundary) -= changed.rightCols(ritz) * AC;
    p.rightCols(modes).setIdentity();
    for (Eigen::Index k = 0; k < modes; ++k)
      basis.eigenvalues[k] = free.modes.vectors[at(k)].eigenvalue;
  } else {
    const Matrix U1 = svd.U.leftCols(rank);
    const Matrix toW = svd.V.leftCols(rank) * svd.values.head(rank).cwiseInverse().asDiagonal();
    changed.middleCols(boundary, rank) = vectors.rightCols(ritz) * toW;
    changed.rightCols(ritz - rank) = vectors.rightCols(ritz) * svd.V.rightCols(ritz - rank);
    changed.leftCols(boundary) -= changed.middleCols(boundary, rank) * (U1.transpose() * AC);
    p.leftCols(boundary) = AC - U1 * (U1.transpose() * AC);
    p.middleCols(boundary, rank) = U1;
    p.rightCols(ritz - rank) = AD * svd.V.rightCols(ritz - rank);
    const Sparse& K = part.symmetricStiffness();
    for (Eigen::Index k = 0; k < ritz; ++k) {
      const auto y = changed.col(boundary + k);
      basis.eigenvalues[k] = y.dot(K * y) / y.dot(part.mass() * y);
    }
    basis.remarks.push_back("the " + std::to_string(modes) +
                            " modes span residual flexibility for " + std::to_string(rank) +
                            " modal amplitudes only: the other coordinates are Ritz modes");
  }
  // Rows of boundary dofs are exactly the identity and zero.
  for (int j = 0; j < boundary; ++j) {
    changed.row(basis.partition.boundary[at(j)]).setZero();
    changed(basis.partition.boundary[at(j)], j) = 1.0;
  }
  basis.vectors = changed.sparseView();
  return p;
}

}  // namespace tooljoint::reduction
