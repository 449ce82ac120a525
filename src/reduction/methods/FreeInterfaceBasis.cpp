// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/methods/FreeInterfaceBasis.hpp"

#include <Eigen/Dense>

namespace tooljoint::reduction {

namespace {

/// Least share of a combination of modes in motions with held kept dofs for it to be a coordinate.
constexpr double leastShare = 0.1;

Sparse sparse(const Matrix& A) {
  Triplets entries;
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    for (Eigen::Index j = 0; j < A.cols(); ++j)
      if (A(i, j) != 0.0) entries.emplace_back(static_cast<int>(i), static_cast<int>(j), A(i, j));
  Sparse out(A.rows(), A.cols());
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

/// Rows of kept dofs are the identity and zero, to the last digit.
void tidyKeptRows(const Partition& p, Matrix& vectors) {
  for (std::size_t j = 0; j < p.kept.size(); ++j) {
    vectors.row(p.kept[j]).setZero();
    vectors(p.kept[j], static_cast<Eigen::Index>(j)) = 1.0;
  }
}

}  // namespace

FreeInterfaceBasis freeInterfaceBasis(const model::Substructure& part, const ModeRequest& request) {
  FreeInterfaceBasis free;
  Basis& basis = free.basis;
  basis.partition = partition(part);
  const Sparse K = constantStiffness(part.model);
  free.modes = freeInterfaceModes(part, K, request);
  free.shapes = free.modes.columns(free.modes.kept, basis.partition.size);
  free.statics = std::make_unique<InteriorStatics>(part, basis.partition, K, free.modes);
  const ConstraintModes constraint = free.statics->constraintModes();
  addConstraintRows(part, constraint, basis);
  report(free.modes, basis);
  completeWithRitzModes(part, symmetricPart(K), constraint,
                        freeInterfaceVectors(part, K, basis.partition, free.modes, *free.statics),
                        "free-interface", basis);
  return free;
}

/// With Phi = [X Y] in (u_b, w):  p = A_C u_b + A_D w.  A_D = U S V' and w = V_1 S_1^-1 (p_1 - U_1'
/// A_C u_b) + V_2 w_2.
Matrix toModeAmplitudes(const model::Substructure& part, FreeInterfaceBasis& free) {
  Basis& basis = free.basis;
  const auto kept = static_cast<Eigen::Index>(basis.partition.kept.size());
  const Eigen::Index modes = free.shapes.cols(), ritz = basis.vectors.cols() - kept;
  const Matrix vectors = basis.vectors;
  const Matrix amplitudes = free.shapes.transpose() * (part.model.mass * vectors);
  const auto AC = amplitudes.leftCols(kept);
  const Matrix AD = amplitudes.rightCols(ritz);
  basis.orthonormal = false;
  if (ritz == 0) return amplitudes;
  const Eigen::BDCSVD<Matrix> svd(AD, Eigen::ComputeThinU | Eigen::ComputeFullV);
  Eigen::Index rank = 0;
  while (rank < svd.singularValues().size() && svd.singularValues()[rank] >= leastShare) ++rank;
  Matrix changed = vectors, p = Matrix::Zero(modes, kept + ritz);
  if (rank == modes &&
      rank == ritz) {  // p are the amplitudes of the modes themselves; decoupled ones stay apart
    changed.rightCols(ritz) =
        AD.transpose().partialPivLu().solve(vectors.rightCols(ritz).transpose()).transpose();
    changed.leftCols(kept) -= changed.rightCols(ritz) * AC;
    p.rightCols(modes).setIdentity();
    for (Eigen::Index k = 0; k < modes; ++k)
      basis.eigenvalues[k] = free.modes.modes[static_cast<std::size_t>(k)].eigenvalue;
  } else {
    const Matrix U1 = svd.matrixU().leftCols(rank);
    const Matrix toW =
        svd.matrixV().leftCols(rank) * svd.singularValues().head(rank).cwiseInverse().asDiagonal();
    changed.middleCols(kept, rank) = vectors.rightCols(ritz) * toW;
    changed.rightCols(ritz - rank) = vectors.rightCols(ritz) * svd.matrixV().rightCols(ritz - rank);
    changed.leftCols(kept) -= changed.middleCols(kept, rank) * (U1.transpose() * AC);
    p.leftCols(kept) = AC - U1 * (U1.transpose() * AC);
    p.middleCols(kept, rank) = U1;
    p.rightCols(ritz - rank) = AD * svd.matrixV().rightCols(ritz - rank);
    const Sparse K = symmetricPart(constantStiffness(part.model));
    for (Eigen::Index k = 0; k < ritz; ++k) {
      const auto y = changed.col(kept + k);
      basis.eigenvalues[k] = y.dot(K * y) / y.dot(part.model.mass * y);
    }
    basis.remarks.push_back("the " + std::to_string(modes) +
                            " modes leave residual flexibility for " + std::to_string(rank) +
                            " modal amplitudes only: the other coordinates are Ritz modes");
  }
  tidyKeptRows(basis.partition, changed);
  basis.vectors = sparse(changed);
  return p;
}

}  // namespace tooljoint::reduction
