// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/ModeCount.hpp"

#include <Eigen/LU>
#include <numeric>
#include <utility>
#include <vector>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/report/StageTimes.hpp"
#include "coupling/CoupledModes.hpp"
#include "linalg/Scientific.hpp"
#include "linalg/trilinos/DirectSolver.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "reduction/project/SharedWork.hpp"
#include "reduction/vectors/ModalVectors.hpp"

namespace tooljoint::coupling {

namespace {

int counted(Sparse A, double bound, parallel::Ranks ranks = parallel::Ranks::Own) {
  if (const auto count = linalg::negativeEigenvalues(std::move(A), ranks)) return *count;
  throw ConvergenceError("The eigenvalues of the full model below " + linalg::scientific(bound) +
                         " could not be counted: K - lambda M of a part has no stable LDL' factors "
                         "there.");
}

/// Contribution of the interior of one part outside its basis.
struct Truncated {
  int negative = 0;   ///< n(A_II) - n(W' A_II W)
  Matrix correction;  ///< r' F r in `columns`; empty if the basis spans the whole interior

  template <class Archive>
  void serialize(Archive& archive) {
    archive(negative, correction);
  }
};

/// Columns of the basis that the interior outside it acts on, and the modal ones among them.
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
                        double bound, parallel::Ranks ranks) {
  const Columns columns(basis);
  const auto& interior = basis.partition.interior;
  if (columns.modes.size() >= interior.size()) return {};
  const model::SharedSparse A =
      undampedStiffness(part.model) - bound * reduction::symmetricPart(part.model.mass);
  const model::SharedSparse inner = reduction::interiorOf(basis.partition, A);
  const auto rows = [&](const Sparse& all, const std::vector<int>& wanted) {
    return Matrix(reduction::block(all, interior, wanted));
  };
  const Matrix W = rows(basis.vectors, columns.modes);
  const Matrix half = W.transpose() * (inner * W), projected = 0.5 * (half + half.transpose());
  Truncated result;
  result.negative = counted(inner, bound, ranks);
  if (W.cols() > 0) result.negative -= counted(Sparse(projected.sparseView()), bound);
  if (columns.others.empty()) return result;
  const Matrix r = rows(Sparse(A * basis.vectors), columns.others);
  linalg::DirectSolverOptions options;
  options.ranks = ranks;
  Matrix flexible = linalg::DirectSolver(inner, linalg::DofNamer(), options).solve(r);
  if (W.cols() > 0) flexible -= W * projected.partialPivLu().solve(W.transpose() * r);
  const Matrix correction = r.transpose() * flexible;
  result.correction = 0.5 * (correction + correction.transpose());
  return result;
}

}  // namespace

int fullEigenvaluesBelow(const std::vector<model::Substructure>& parts, const Synthesis& synthesis,
                         double bound) {
  const Stage stage("inertia counts");
  const auto truncated =
      reduction::shareOut<Truncated>(parts, [&](std::size_t p, parallel::Ranks ranks) {
        return truncatedPart(parts[p], *synthesis.parts[p].basis, bound, ranks);
      });
  const auto& coupled = synthesis.coupled;
  Sparse A =
      undampedStiffness(coupled.model) - bound * reduction::symmetricPart(coupled.model.mass);
  int negative = -2 * sizeOf(coupled.multipliers);
  std::vector<int> all(at(coupled.model.size()));
  std::iota(all.begin(), all.end(), 0);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    negative += truncated[p].negative;
    if (truncated[p].correction.size() == 0) continue;
    const Sparse L =
        reduction::block(coupled.maps[p], Columns(*synthesis.parts[p].basis).others, all);
    A -= Sparse(L.transpose() * Sparse(truncated[p].correction.sparseView()) * L);
  }
  return negative + counted(std::move(A), bound);
}

}  // namespace tooljoint::coupling
