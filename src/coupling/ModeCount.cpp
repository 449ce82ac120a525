// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/ModeCount.hpp"

#include <Eigen/LU>
#include <numeric>
#include <vector>

#include "common/Index.hpp"
#include "common/Message.hpp"
#include "common/report/StageTimes.hpp"
#include "coupling/CoupledModes.hpp"
#include "linalg/trilinos/DirectSolver.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "reduction/project/Distribution.hpp"
#include "reduction/vectors/ModalVectors.hpp"

namespace tooljoint::coupling {

namespace {

int negativeEigenvalues(const Sparse& A) {
  Sparse unit(A.rows(), A.cols());
  unit.setIdentity();
  return linalg::eigenvaluesBelow(A, unit, 0.0);
}

/// What the interior outside the basis of one part adds.
struct Truncated {
  int negative = 0;   ///< n(A_II) - n(W' A_II W)
  Matrix correction;  ///< r' F r in `columns`; empty where the basis has all of the interior

  template <class Archive>
  void serialize(Archive& archive) {
    archive(negative, correction);
  }
};

/// Columns of the basis on which the interior outside of it acts, and those that are modes.
struct Columns {
  std::vector<int> others, modes;
  explicit Columns(const reduction::Basis& basis) {
    const int boundary = sizeOf(basis.partition.boundary);
    for (int j = 0; j < basis.vectors.cols(); ++j) {
      const bool mode = j >= boundary && j < boundary + basis.modes() &&
                        basis.modeKind[at(j - boundary)] != reduction::followingKind;
      (mode ? modes : others).push_back(j);
    }
  }
};

Truncated truncatedPart(const model::Substructure& part, const reduction::Basis& basis,
                        double bound) {
  const Columns columns(basis);
  const auto& interior = basis.partition.interior;
  if (columns.modes.size() >= interior.size()) return {};
  const Sparse K = undampedStiffness(part.model);
  const Sparse M = reduction::symmetricPart(part.model.mass);
  const Sparse A = K - bound * M;
  const Sparse inner = reduction::block(A, interior, interior);
  Truncated result;
  result.negative = linalg::eigenvaluesBelow(reduction::block(K, interior, interior),
                                             reduction::block(M, interior, interior), bound);
  const auto rows = [&](const Sparse& all, const std::vector<int>& wanted) {
    return Matrix(reduction::block(all, interior, wanted));
  };
  const Matrix W = rows(basis.vectors, columns.modes);
  const Matrix projected = W.transpose() * (inner * W);
  if (W.cols() > 0)
    result.negative -=
        negativeEigenvalues(Sparse(0.5 * (projected + projected.transpose()).sparseView()));
  if (columns.others.empty()) return result;
  const Matrix r = rows(Sparse(A * basis.vectors), columns.others);
  Matrix flexible = linalg::DirectSolver(inner).solve(r);
  if (W.cols() > 0) flexible -= W * projected.partialPivLu().solve(W.transpose() * r);
  const Matrix correction = r.transpose() * flexible;
  result.correction = 0.5 * (correction + correction.transpose());
  return result;
}

}  // namespace

int fullEigenvaluesBelow(const std::vector<model::Substructure>& parts, const Synthesis& synthesis,
                         double bound) {
  const Stage stage("inertia counts");
  std::vector<int> weights;
  for (const auto& part : parts) weights.push_back(part.model.size());
  const auto owners = reduction::assignOwners(weights, parallel::size());
  std::vector<Truncated> truncated(parts.size());
  parallel::agree([&] {
    for (std::size_t p = 0; p < parts.size(); ++p)
      if (owners[p] == parallel::rank())
        truncated[p] = truncatedPart(parts[p], *synthesis.parts[p].basis, bound);
  });
  const auto& coupled = synthesis.coupled;
  Sparse A =
      undampedStiffness(coupled.model) - bound * reduction::symmetricPart(coupled.model.mass);
  int negative = -2 * sizeOf(coupled.multipliers);
  std::vector<int> all(at(coupled.model.size()));
  std::iota(all.begin(), all.end(), 0);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    parallel::broadcast(truncated[p], owners[p]);
    negative += truncated[p].negative;
    if (truncated[p].correction.size() == 0) continue;
    const Sparse L =
        reduction::block(coupled.maps[p], Columns(*synthesis.parts[p].basis).others, all);
    A -= Sparse(L.transpose() * Sparse(truncated[p].correction.sparseView()) * L);
  }
  return negative + negativeEigenvalues(A);
}

}  // namespace tooljoint::coupling
