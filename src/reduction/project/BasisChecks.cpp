// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/project/BasisChecks.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "common/report/Percent.hpp"
#include "common/report/StageTimes.hpp"
#include "linalg/DenseDecompositions.hpp"
#include "linalg/SparseProducts.hpp"
#include "linalg/factor/MumpsFactor.hpp"
#include "linalg/trilinos/DirectSolver.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "linalg/trilinos/SemidefiniteModes.hpp"
#include "model/DofNames.hpp"
#include "reduction/project/FullBasis.hpp"

namespace tooljoint::reduction {

namespace {

/// Energy below this fraction of |phi|' |K| |phi| is zero: the rounding of a sum of that size, with
/// a margin.
constexpr double zeroEnergy = 1e-12;
/// Number of modes of the unreduced part checked for zero energy: the six of a rigid body, and
/// two more.
constexpr int zeroEnergyCandidates = 8;

/// Number of shapes recovered at a time; limits the memory of a check.
constexpr int shapesAtATime = 2 * zeroEnergyCandidates;

/// Counts zero-energy modes among mass-normalised shapes phi with omega^2 = phi' K phi.
int countZeroEnergy(const Sparse& K, const Matrix& shapes, const Vector& eigenvalues) {
  const Vector size =
      shapes.cwiseAbs().cwiseProduct(linalg::absoluteProduct(K, shapes)).colwise().sum();
  return static_cast<int>((eigenvalues.array().abs() <= zeroEnergy * size.array()).count());
}

Matrix times(const Sparse& Phi, const Matrix& q) {
  return isLargeAndFull(Phi) ? timesByRows(Phi, q) : Matrix(Phi * q);
}

/// The same for the shapes Phi [q; 0], by increasing omega^2, until a group has none.
int countZeroEnergy(const Sparse& K, const Sparse& Phi, const Matrix& q,
                    const Vector& eigenvalues) {
  std::vector<int> order = range(q.cols());
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return std::abs(eigenvalues[a]) < std::abs(eigenvalues[b]);
  });
  int found = 0;
  for (std::size_t first = 0; first < order.size(); first += at(shapesAtATime)) {
    const std::vector<int> some(order.begin() + static_cast<std::ptrdiff_t>(first),
                                order.begin() + static_cast<std::ptrdiff_t>(std::min(
                                                    order.size(), first + at(shapesAtATime))));
    Matrix coordinates = Matrix::Zero(Phi.cols(), sizeOf(some));
    coordinates.topRows(q.rows()) = q(Eigen::all, some);
    const int here = countZeroEnergy(K, times(Phi, coordinates), eigenvalues(some));
    if (here == 0) break;
    found += here;
  }
  return found;
}

/// Zero-energy modes of the whole part. For a large part the number of eigenvalues between -omega^2
/// and omega^2, where omega^2 corresponds to zero energy for a motion with equal displacements, u'
/// |K| u / u' M u summed over the dofs.
int zeroEnergyOfWhole(const PartView& part) {
  const Sparse &K = part.symmetricStiffness(), &M = part.mass();
  if (!linalg::suitsMumps(K) || linalg::hasMasslessMotion(M)) {
    linalg::EigenOptions options;
    options.name = model::namer(part.model());
    const linalg::EigenPairs lowest = linalg::lowestFiniteModes(
        K, M, std::min(zeroEnergyCandidates, part.model().size()), options);
    return countZeroEnergy(K, lowest.vectors, lowest.values);
  }
  const double bound = zeroEnergy * K.cwiseAbs().sum() / M.diagonal().sum();
  const int below = linalg::eigenvaluesBelow(K, M, bound);
  return below == 0 ? 0 : below - linalg::eigenvaluesBelow(K, M, -bound);
}

/// Products of the columns of a basis, scaled to unit length.
Matrix scaledGram(const Sparse& Phi) {
  if (!isLargeAndFull(Phi)) {
    Matrix scaled = Phi;
    for (Eigen::Index j = 0; j < scaled.cols(); ++j)
      if (const double length = scaled.col(j).norm(); length > 0) scaled.col(j) /= length;
    return scaled.transpose() * scaled;
  }
  const Matrix gram = gramByRows(Phi);
  const Vector scale = gram.diagonal().unaryExpr(
      [](double square) { return square > 0 ? 1.0 / std::sqrt(square) : 1.0; });
  return scale.asDiagonal() * gram * scale.asDiagonal();
}

void checkRank(const Basis& basis, BasisReport& report) {
  const Stage stage("check of the rank");
  // without residual flexibility, which may be zero
  const Eigen::Index size = basis.vectors.cols() - basis.forces();
  if (size == 0) {
    report.rank = 0;
    report.conditioning = 1;
    return;
  }
  const Vector gram = linalg::symmetricValues(scaledGram(basis.vectors).topLeftCorner(size, size));
  const double largest = gram.maxCoeff();
  report.rank = static_cast<int>((gram.array() > 1e-14 * largest).count());
  report.conditioning = std::sqrt(largest / std::max(gram.minCoeff(), 1e-16 * largest));
}

/// Sets of coupled dofs without any of the basis' interface dofs.
std::vector<std::vector<int>> floatingBlocks(const PartView& part, const Basis& basis) {
  std::vector<std::vector<int>> floating;
  for (const auto& dofs : part.unsupported().partition().blocks)
    if (std::none_of(basis.forceDofs.begin(), basis.forceDofs.end(),
                     [&](int i) { return std::binary_search(dofs.begin(), dofs.end(), i); }))
      floating.push_back(dofs);
  return floating;
}

/// Adds `spring` to the diagonal at `dofs`; afterwards all diagonal entries exist.
void addSprings(Sparse& K, const std::vector<int>& dofs, double spring) {
  Triplets ground;
  for (int i : dofs) ground.emplace_back(i, i, spring);
  for (int i = 0; i < K.rows(); ++i) ground.emplace_back(i, i, 0.0);
  K = Sparse(K + sparse(K.rows(), K.cols(), ground));
}

/// Mean stiffness of some dofs; 1 if they have none.
double meanStiffness(const Sparse& K, const std::vector<int>& dofs) {
  double mean = 0;
  for (int i : dofs) mean += std::abs(K.coeff(i, i)) / sizeOf(dofs);
  return mean == 0 ? 1 : mean;
}

/// Compares full and reduced responses to unit loads on some boundary dofs, with the same springs
/// to ground on all boundary dofs (they change no constraint mode and support a free part). Blocks
/// that touch no boundary dof do not move and are omitted.
void checkStatics(const PartView& part, const Basis& basis, const ProjectedMatrices& reduced,
                  BasisReport& report) {
  const Stage stage("check of the statics");
  const Partition& p = basis.partition;
  const int boundary = sizeOf(p.boundary);
  if (boundary == 0) return;
  std::vector<int> positions = p.boundary;
  for (std::size_t b = 0; b < p.blocks.size(); ++b)
    if (!p.touched[b].empty())
      for (int i : p.blocks[b]) positions.push_back(p.interior[at(i)]);
  Sparse K = block(part.stiffness(), positions, positions);
  Matrix k = reduced.constantStiffness;
  const double spring = meanStiffness(K, range(boundary));
  addSprings(K, range(boundary), spring);
  k.diagonal().head(boundary).array() += spring;

  std::set<int> loaded{0, boundary / 3, 2 * boundary / 3, boundary - 1};
  Matrix full = Matrix::Zero(K.rows(), sizeOf(loaded));
  Matrix small = Matrix::Zero(k.rows(), full.cols());
  Eigen::Index column = 0;
  for (int j : loaded) {
    full(j, column) = 1;
    small(j, column++) = 1;
  }
  // modes of omitted blocks are not excited; any stiffness keeps the reduced matrix regular
  for (Eigen::Index i = boundary; i < k.rows(); ++i)
    if (k.row(i).cwiseAbs().maxCoeff() == 0) k(i, i) = 1;
  Matrix exact;
  try {
    exact = linalg::DirectSolver(K).solve(full);
  } catch (const ModelError&) {
    report.remarks.push_back(
        "static exactness was not checked: the part has a free motion even with springs on all "
        "boundary dofs");
    return;
  }
  const Matrix recovered = times(basis.vectors, linalg::DenseLu(k).solve(small));
  report.staticDefect = 0;
  for (Eigen::Index c = 0; c < exact.cols(); ++c) {
    const Vector error = Vector(recovered.col(c))(positions) - exact.col(c);
    report.staticDefect = std::max(
        report.staticDefect, error.cwiseAbs().maxCoeff() / exact.col(c).cwiseAbs().maxCoeff());
  }
}

/// The same for interface forces as coordinates: unit loads f on interface dofs supported by
/// springs s, g = f - s u_b, with the other coordinates a in equilibrium with g:
///
///     [k_aa  k_ag - B_a'; s B_a  1 + s B_g] (a, g) = (0, f),   u_b = B_a a + B_g g
void checkDualStatics(const PartView& part, const Basis& basis, const ProjectedMatrices& reduced,
                      BasisReport& report) {
  const Stage stage("check of the statics");
  const Eigen::Index forces = basis.forces(), others = basis.vectors.cols() - forces;
  Sparse K = part.stiffness();
  const double spring = meanStiffness(K, basis.forceDofs);
  addSprings(K, basis.forceDofs, spring);
  // dofs uncoupled from the interface are free: a stiffness without effect on the loads fixes them
  for (const auto& dofs : floatingBlocks(part, basis)) addSprings(K, dofs, spring);

  const Matrix Phi = basis.vectors, k = reduced.constantStiffness;
  const Matrix B = Phi(basis.forceDofs, Eigen::all);
  Matrix system(Phi.cols(), Phi.cols());
  system.topRows(others) = k.topRows(others);
  system.topRightCorner(others, forces) -= B.leftCols(others).transpose();
  system.bottomRows(forces) = spring * B;
  system.bottomRightCorner(forces, forces) += Matrix::Identity(forces, forces);
  for (Eigen::Index i = 0; i < others; ++i)
    if (system.row(i).cwiseAbs().maxCoeff() == 0) system(i, i) = 1;
  const std::set<Eigen::Index> loaded{0, forces / 3, 2 * forces / 3, forces - 1};
  const linalg::DirectSolver solver(K, model::namer(part.model()));
  const Eigen::FullPivLU<Matrix> factor(system);
  report.staticDefect = 0;
  for (Eigen::Index j : loaded) {
    Vector full = Vector::Zero(K.rows()), small = Vector::Zero(Phi.cols());
    full[basis.forceDofs[at(j)]] = 1;
    small[others + j] = 1;
    const Vector exact = solver.solve(full), recovered = Phi * factor.solve(small);
    report.staticDefect = std::max(report.staticDefect, (recovered - exact).cwiseAbs().maxCoeff() /
                                                            exact.cwiseAbs().maxCoeff());
  }
}

/// True if massless dofs of the part leave some coordinates, or combinations of them, without mass.
/// If all dofs have mass, a singular reduced mass means dependent vectors.
bool lacksMass(const PartView& part, const ProjectedMatrices& reduced) {
  return linalg::hasSingularMass(reduced.mass) && linalg::hasSingularMass(part.mass());
}

/// Modes of such a part; implicit schemes condense the massless coordinates.
linalg::EigenPairs modesWithoutMass(const PartView& part, const ProjectedMatrices& reduced) {
  try {
    return linalg::semidefiniteModes(symmetricPart(reduced.constantStiffness), reduced.mass, -1);
  } catch (const linalg::SingularPencil&) {
    throw;
  } catch (const ModelError& error) {
    throw ModelError(part.who() + "its reduced mass matrix is not positive semidefinite. " +
                     error.what());
  }
}

void checkFrequencies(const PartView& part, const Basis& basis, const ProjectedMatrices& reduced,
                      BasisReport& report) {
  const Stage stage("check of the frequencies");
  report.zeroEnergyFull = zeroEnergyOfWhole(part);
  // without forces on the interface, whose coordinates are then zero
  const Eigen::Index size = basis.vectors.cols() - basis.forces();
  const Matrix m = Matrix(reduced.mass).topLeftCorner(size, size);
  const Sparse& K = part.symmetricStiffness();
  const Matrix k = Matrix(symmetricPart(reduced.constantStiffness)).topLeftCorner(size, size);
  if (m.rows() == 0) {
    report.largestOmega = 0;
    report.explicitStep = 0;
    report.zeroEnergyReduced = 0;
  } else if (basis.forces() == 0 && (basis.inertial.size() > 0 || lacksMass(part, reduced))) {
    const linalg::EigenPairs pairs = modesWithoutMass(part, reduced);
    report.largestOmega = pairs.count() > 0 ? std::sqrt(std::max(0.0, pairs.values.maxCoeff())) : 0;
    if (pairs.count() < size)
      report.remarks.push_back("its mass matrix is singular for " +
                               std::to_string(size - pairs.count()) + " of " +
                               std::to_string(size) + " coordinates: implicit integrators only");
    else
      report.explicitStep = report.largestOmega > 0 ? rk4StabilityLimit / report.largestOmega : 0;
    report.zeroEnergyReduced = countZeroEnergy(K, basis.vectors, pairs.vectors, pairs.values);
  } else {
    const Eigen::LLT<Matrix> factor(m);
    if (factor.info() != Eigen::Success)
      throw ModelError(part.who() +
                       "its reduced mass matrix is not positive definite. Give every dof of the "
                       "part a mass, or retain fewer massless dofs.");
    const auto pairs = linalg::symmetricPairs(k, m);
    if (!pairs.converged)
      throw ConvergenceError(
          part.who() +
          "the QR iteration for the eigenvalues of the reduced part did not converge.");
    const Matrix& shapes = pairs.vectors;
    report.largestOmega = std::sqrt(std::max(0.0, pairs.values.maxCoeff()));
    report.explicitStep = report.largestOmega > 0 ? rk4StabilityLimit / report.largestOmega : 0;
    report.zeroEnergyReduced = countZeroEnergy(K, basis.vectors, shapes, pairs.values);
  }
}

}  // namespace

void checkBasis(const PartView& part, const Basis& basis, const ProjectedMatrices& reduced,
                BasisReport& report) {
  checkRank(basis, report);
  if (report.rank < static_cast<int>(basis.vectors.cols()) - basis.forces())
    report.remarks.push_back("the basis has rank " + std::to_string(report.rank) + " for " +
                             std::to_string(basis.vectors.cols() - basis.forces()) +
                             " coordinates");
  if (basis.forces() > 0)
    checkDualStatics(part, basis, reduced, report);
  else
    checkStatics(part, basis, reduced, report);
  if (report.staticDefect > 1e-6)
    report.remarks.push_back(
        "static response to loads on boundary dofs is not exact: largest relative difference " +
        percent(report.staticDefect));
  try {
    checkFrequencies(part, basis, reduced, report);
  } catch (const linalg::SingularPencil& singular) {
    report.remarks.push_back("its frequencies alone were not checked: a motion in which " +
                             singular.dof +
                             " moves most has neither mass nor stiffness. Its neighbours have to "
                             "hold it, or give it mass");
  }
  if (report.zeroEnergyFull >= 0 && report.zeroEnergyReduced < report.zeroEnergyFull)
    report.remarks.push_back("the part has " + std::to_string(report.zeroEnergyFull) +
                             " zero-energy modes and the reduced part " +
                             std::to_string(report.zeroEnergyReduced) +
                             ": rigid-body motion is not preserved");
  report.checked = true;
}

}  // namespace tooljoint::reduction
