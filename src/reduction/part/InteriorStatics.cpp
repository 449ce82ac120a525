// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/part/InteriorStatics.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "linalg/DenseDecompositions.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "linalg/trilinos/SemidefiniteModes.hpp"

namespace tooljoint::reduction {

namespace {

/// A rigid-body mode does not move the boundary dofs if their share in it (in the root of the mass)
/// is smaller than this.
constexpr double notMoved = 1e-6;
/// Energy below this fraction of |phi|' |K| |phi| is rounding.
constexpr double zeroEnergy = 1e-12;
/// A rigid body has six floating modes. A block may also be a body with internal joints, so more
/// are computed if six are not all.
constexpr int floatingCandidates = 8;

}  // namespace

Matrix floatingModes(const InteriorBlock& block) {
  linalg::EigenOptions options;
  options.name = block.name;
  const Sparse absolute = block.symmetricStiffness.cwiseAbs();
  for (int count = std::min(floatingCandidates, block.size());;
       count = std::min(2 * count, block.size())) {
    const auto pairs =
        linalg::lowestFiniteModes(block.symmetricStiffness, block.mass, count, options);
    std::vector<int> found;
    for (int k = 0; k < pairs.count(); ++k) {
      const Vector shape = pairs.vectors.col(k).cwiseAbs();
      if (std::abs(pairs.values[k]) <= zeroEnergy * shape.dot(absolute * shape)) found.push_back(k);
    }
    if (sizeOf(found) < count || count == block.size()) return pairs.vectors(Eigen::all, found);
  }
}

Sparse bordered(const Sparse& A, const Matrix& U, const Matrix& W) {
  const double largest = largestEntry(A), size = largest > 0 ? largest : 1.0;
  const auto n = static_cast<int>(A.rows());
  Triplets entries;
  forEachEntry(A, [&](int i, int j, double value) { entries.emplace_back(i, j, value); });
  for (int k = 0; k < U.cols(); ++k) {
    const double u = size / U.col(k).cwiseAbs().maxCoeff(),
                 w = size / W.col(k).cwiseAbs().maxCoeff();
    for (int i = 0; i < n; ++i) {
      if (U(i, k) != 0.0) entries.emplace_back(i, n + k, u * U(i, k));
      if (W(i, k) != 0.0) entries.emplace_back(n + k, i, w * W(i, k));
    }
  }
  return sparse(n + U.cols(), n + U.cols(), entries);
}

InteriorStatics::InteriorStatics(const PartView& part, const InteriorVectors& modes) : part_(part) {
  findMechanisms(modes);
  if (mechanisms_.cols() > 0) factor();
}

/// Combinations of the rigid-body modes of each free block that vanish on its boundary dofs: right
/// singular vectors of the boundary rows.
void InteriorStatics::findMechanisms(const InteriorVectors& modes) {
  const Partition& p = part_.partition();
  const Vector mass = part_.mass().diagonal();
  const Vector boundaryMass = mass(p.boundary).cwiseSqrt();
  mechanisms_.resize(sizeOf(p.interior), 0);
  carriers_.resize(p.size, 0);
  for (int group = 0; group < sizeOf(modes.groups); ++group) {
    std::vector<int> own;
    for (int k = 0; k < sizeOf(modes.vectors); ++k)
      if (modes.vectors[at(k)].rigid && modes.vectors[at(k)].group == group) own.push_back(k);
    if (own.empty()) continue;
    const Matrix all = modes.columns(own, p.size);
    Matrix combined = all(p.interior, Eigen::all);
    if (!p.boundary.empty()) {
      const Matrix moved = boundaryMass.asDiagonal() * all(p.boundary, Eigen::all);
      const auto svd = linalg::singularValues(moved, linalg::SingularVectors::None,
                                              linalg::SingularVectors::Full);
      Eigen::Index rank = 0;
      while (rank < svd.values.size() && svd.values[rank] > notMoved) ++rank;
      combined = (combined * svd.V.rightCols(all.cols() - rank)).eval();
      carriers_.conservativeResize(p.size, carriers_.cols() + rank);
      carriers_.rightCols(rank) = all * svd.V.leftCols(rank);
    }
    mechanisms_.conservativeResize(combined.rows(), mechanisms_.cols() + combined.cols());
    mechanisms_.rightCols(combined.cols()) = combined;
  }
}

void InteriorStatics::factor() {
  const Sparse &K = part_.interiorStiffness(), &M = part_.interiorMass();
  const Matrix MN = M * mechanisms_;
  const auto& interior = part_.partition().interior;
  const auto name = [&](int i) {
    return i < sizeOf(interior) ? part_.dofName(interior[at(i)])
                                : std::string("a rigid-body motion of the interior");
  };
  try {
    solver_ = std::make_unique<linalg::DirectSolver>(bordered(K, MN, MN), name);
    // improves N from the accuracy of the eigensolver to that of K_II
    mechanisms_ -= solve(K * mechanisms_);
    const Eigen::LLT<Matrix> gram(mechanisms_.transpose() * (M * mechanisms_));
    mechanisms_ = gram.matrixU().solve<Eigen::OnTheRight>(mechanisms_).eval();
  } catch (const ModelError& error) {
    throw ModelError(part_.who() + "the interior stiffness is singular with its " +
                     std::to_string(part_.partition().boundary.size()) +
                     " interface and retained dofs fixed, and the null vector is not a rigid-body "
                     "motion. Retain a dof that moves in it, or check the part's stiffness. " +
                     error.what());
  }
}

Matrix InteriorStatics::solve(const Matrix& loads) const {
  if (loads.rows() == 0 || loads.cols() == 0) return loads;
  if (!solver_) return part_.solveInterior(loads);
  Matrix extended = Matrix::Zero(solver_->size(), loads.cols());
  extended.topRows(loads.rows()) = loads;
  return solver_->solve(extended).topRows(loads.rows());
}

ConstraintModes InteriorStatics::constraintModes() const {
  const Partition& p = part_.partition();
  if (!solver_) return part_.constraintModes();
  ConstraintModeBuilder modes(p);
  if (!p.boundary.empty()) {
    const Matrix KIC = block(part_.stiffness(), p.interior, p.boundary);
    modes.add(part_.interiorStiffness(), KIC, solve(-KIC), p.interior, range(sizeOf(p.boundary)));
  }
  return modes.result();
}

}  // namespace tooljoint::reduction
