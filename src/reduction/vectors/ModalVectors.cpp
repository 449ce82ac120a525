// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/vectors/ModalVectors.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "linalg/Deterministic.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "linalg/trilinos/SemidefiniteModes.hpp"

namespace tooljoint::reduction {

namespace {

/// v' M v below this part of |v|' |M| |v| is rounding: the vector moves no mass.
constexpr double massless = 1e-14;
/// Energy below this part of |phi|' |K| |phi| is rounding.
constexpr double zeroEnergy = 1e-12;
/// A rigid body has six ways to float; a link may be a body with joints inside, so more are looked
/// at when these are not all.
constexpr int floatingCandidates = 8;

}  // namespace

OrthonormalSet::OrthonormalSet(Sparse mass, double tolerance, std::string who)
    : mass_(std::move(mass)),
      absolute_(mass_.cwiseAbs()),
      tolerance_(tolerance),
      who_(std::move(who)),
      basis_(mass_.rows(), 0),
      weighted_(mass_.rows(), 0) {}

double OrthonormalSet::norm(const Vector& v) const {
  const double square = v.dot(mass_ * v);
  const Vector size = v.cwiseAbs();
  const double rounding = massless * size.dot(absolute_ * size);
  if (square < -rounding)
    throw ModelError(
        who_ + "its mass is indefinite: the kinetic energy of a vector of the basis is negative.");
  return square <= rounding ? 0.0 : std::sqrt(square);
}

bool OrthonormalSet::add(const Vector& vector) {
  Vector factor;
  return add(vector, factor);
}

bool OrthonormalSet::add(const Vector& vector, Vector& factor) {
  factor = Vector::Zero(size());
  const double before = norm(vector);
  if (before == 0.0) return false;
  // v <- v - Q (Q' M v), twice (Giraud, Langou and Rozloznik 2005)
  Vector v = vector;
  for (int pass = 0; pass < 2; ++pass) {
    const Vector overlap = weighted_.transpose() * v;
    v -= basis_ * overlap;
    factor += overlap;
  }
  const double after = norm(v);
  if (after <= tolerance_ * before) return false;
  v /= after;
  factor.conservativeResize(size() + 1);
  factor[size()] = after;
  basis_.conservativeResize(Eigen::NoChange, size() + 1);
  basis_.rightCols(1) = v;
  weighted_.conservativeResize(Eigen::NoChange, basis_.cols());
  weighted_.rightCols(1) = mass_ * v;
  return true;
}

std::vector<ModalVector> ritzVectors(const Sparse& symmetricK, const Sparse& M, const Matrix& Q,
                                     int group, const std::string& kind, double& defect) {
  std::vector<ModalVector> vectors;
  defect = 0;
  if (Q.cols() == 0) return vectors;
  // (Q' M Q) is the identity but for rounding; keeping it removes the rounding of Q.
  const Matrix k = Q.transpose() * (symmetricK * Q), m = Q.transpose() * (M * Q);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> solver(0.5 * (k + k.transpose()),
                                                                0.5 * (m + m.transpose()));
  if (solver.info() != Eigen::Success)
    throw ConvergenceError("The QR iteration for the Ritz vectors of a basis did not converge.");
  Matrix phi = Q * solver.eigenvectors();
  for (Eigen::Index j = 0; j < phi.cols(); ++j) {
    if (phi(linalg::largestEntry(phi.col(j)), j) < 0) phi.col(j) = -phi.col(j);
    ModalVector vector;
    vector.eigenvalue = solver.eigenvalues()[j];
    vector.group = group;
    vector.shape = phi.col(j);
    vector.kind = kind;
    vectors.push_back(vector);
  }
  defect = (phi.transpose() * (M * phi) - Matrix::Identity(phi.cols(), phi.cols()))
               .cwiseAbs()
               .maxCoeff();
  return vectors;
}

Matrix floatingModes(const Sparse& symmetricK, const Sparse& M, const linalg::DofNamer& name) {
  linalg::EigenOptions options;
  options.name = name;
  const Sparse absolute = symmetricK.cwiseAbs();
  const int size = static_cast<int>(M.rows());
  for (int count = std::min(floatingCandidates, size);; count = std::min(2 * count, size)) {
    const auto pairs = linalg::lowestFiniteModes(symmetricK, M, count, options);
    Matrix found(M.rows(), 0);
    for (Eigen::Index k = 0; k < pairs.values.size(); ++k) {
      const Vector shape = pairs.vectors.col(k).cwiseAbs();
      if (std::abs(pairs.values[k]) > zeroEnergy * shape.dot(absolute * shape)) continue;
      found.conservativeResize(Eigen::NoChange, found.cols() + 1);
      found.rightCols(1) = pairs.vectors.col(k);
    }
    if (found.cols() < count || count == size) return found;
  }
}

Basis fixedInterfaceBasis(const model::Substructure& part, const Partition& p,
                          const ConstraintModes& constraint,
                          const std::vector<std::vector<int>>& groups,
                          std::vector<ModalVector> vectors) {
  Basis basis;
  basis.partition = p;
  basis.orthonormal = true;
  basis.removable = false;
  basis.complete = vectors.size() == p.interior.size();
  for (std::size_t j = 0; j < p.kept.size(); ++j) {
    BasisRow row;
    row.kind = "constraint";
    row.name = model::describe(part.model.dofs[at(p.kept[j])], part.model.componentNames);
    row.residual = constraint.residuals[static_cast<Eigen::Index>(j)];
    row.why = j < p.interface.size() ? "interface dof" : "retained dof";
    basis.rows.push_back(row);
  }
  std::stable_sort(vectors.begin(), vectors.end(), [](const ModalVector& a, const ModalVector& b) {
    return a.eigenvalue < b.eigenvalue;
  });
  Triplets entries = constraint.entries;
  basis.eigenvalues.resize(static_cast<Eigen::Index>(vectors.size()));
  for (std::size_t k = 0; k < vectors.size(); ++k) {
    const ModalVector& vector = vectors[k];
    BasisRow row;
    row.kind = vector.kind;
    row.name = vector.name.empty() ? "vector " + std::to_string(k + 1) : vector.name;
    row.eigenvalue = vector.eigenvalue;
    row.residual = vector.residual;
    row.why = vector.why;
    basis.rows.push_back(row);
    basis.eigenvalues[static_cast<Eigen::Index>(k)] = vector.eigenvalue;
    basis.modeKind.push_back(vector.kind);
    const auto& group = groups[at(vector.group)];
    for (std::size_t i = 0; i < group.size(); ++i) {
      const double value = vector.shape[static_cast<Eigen::Index>(i)];
      if (value != 0.0)
        entries.emplace_back(p.interior[at(group[i])], static_cast<int>(p.kept.size() + k), value);
    }
  }
  basis.candidates = basis.eigenvalues;
  basis.vectors = Sparse(p.size, static_cast<Eigen::Index>(p.kept.size() + vectors.size()));
  basis.vectors.setFromTriplets(entries.begin(), entries.end());
  return basis;
}

Matrix modalColumns(const Basis& basis) {
  std::vector<int> columns;
  for (int k = 0; k < basis.modes(); ++k)
    columns.push_back(static_cast<int>(basis.partition.kept.size()) + k);
  return block(basis.vectors, basis.partition.interior, columns);
}

namespace {

/// The modal columns of a basis as they are, on the whole interior.
std::vector<ModalVector> modalVectors(const Basis& basis) {
  const Matrix V = modalColumns(basis);
  std::vector<const BasisRow*> rows;
  for (std::size_t k = basis.partition.kept.size(); k < basis.rows.size(); ++k)
    if (basis.rows[k].kept) rows.push_back(&basis.rows[k]);
  std::vector<ModalVector> vectors;
  for (Eigen::Index k = 0; k < V.cols(); ++k) {
    ModalVector vector;
    vector.eigenvalue = basis.eigenvalues[k];
    vector.shape = V.col(k);
    vector.kind = basis.modeKind[at(static_cast<int>(k))];
    if (static_cast<std::size_t>(k) < rows.size()) {
      const BasisRow& row = *rows[at(static_cast<int>(k))];
      vector.residual = row.residual;
      vector.why = row.why;
      vector.name = row.name;
    }
    vectors.push_back(vector);
  }
  return vectors;
}

/// `before` with these modal vectors in place of its own.
Basis withVectors(const model::Substructure& part, const Basis& before,
                  std::vector<ModalVector> vectors) {
  const Partition& p = before.partition;
  const int kept = static_cast<int>(p.kept.size());
  ConstraintModes constraint;
  constraint.residuals = Vector::Zero(kept);
  for (int j = 0; j < kept; ++j) constraint.residuals[j] = before.rows[at(j)].residual;
  for (int i = 0; i < before.vectors.outerSize(); ++i)
    for (Sparse::InnerIterator it(before.vectors, i); it; ++it)
      if (it.col() < kept)
        constraint.entries.emplace_back(i, static_cast<int>(it.col()), it.value());
  std::vector<int> all(p.interior.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
  Basis after = fixedInterfaceBasis(part, p, constraint, {all}, std::move(vectors));
  for (std::size_t k = at(kept); k < before.rows.size(); ++k)
    if (!before.rows[k].kept) after.rows.push_back(before.rows[k]);
  const auto left = before.candidates.size() - before.eigenvalues.size();
  after.candidates.conservativeResize(after.eigenvalues.size() + left);
  after.candidates.tail(left) = before.candidates.tail(left);
  after.orthonormal = before.orthonormal;
  after.orthogonality = before.orthogonality;
  after.method = before.method;
  after.remarks = before.remarks;
  return after;
}

}  // namespace

int appendVectors(const model::Substructure& part, const Matrix& X, const std::string& kind,
                  double tolerance, bool rotate, Basis& basis) {
  const Partition& p = basis.partition;
  const Sparse M = block(part.model.mass, p.interior, p.interior);
  const Sparse K = block(symmetricPart(constantStiffness(part.model)), p.interior, p.interior);
  const Matrix V = modalColumns(basis);
  OrthonormalSet set(M, tolerance, "Part \"" + part.name + "\", " + kind + " vectors: ");
  for (Eigen::Index k = 0; k < V.cols(); ++k)
    if (!set.add(V.col(k)))
      throw ModelError("Part \"" + part.name + "\": its modal vectors are dependent before its " +
                       kind + " vectors are added.");
  int added = 0;
  for (Eigen::Index j = 0; j < X.cols(); ++j) added += set.add(X.col(j)) ? 1 : 0;
  if (added == 0) return 0;
  const Matrix W = set.basis().rightCols(added);
  double defect = 0;
  std::vector<ModalVector> fresh = ritzVectors(K, M, W, 0, kind, defect);
  for (std::size_t k = 0; k < fresh.size(); ++k) {
    fresh[k].name = kind + " vector " + std::to_string(k + 1);
    fresh[k].why = "added";
  }
  // V' K W, measured by |V|' |K| |W|: the fixed-interface modes of K have none.
  const Matrix coupling = V.transpose() * (K * W),
               size = V.cwiseAbs().transpose() * (K.cwiseAbs() * W.cwiseAbs());
  const bool coupled = (coupling.cwiseAbs().array() > 1e-11 * size.array()).any();
  std::vector<ModalVector> vectors;
  if (coupled && rotate) {
    vectors = ritzVectors(K, M, set.basis(), 0,
                          basis.modeKind.empty() ? kind : basis.modeKind.front(), defect);
    for (auto& vector : vectors) vector.why = "with " + kind + " vectors";
  } else {
    vectors = modalVectors(basis);
    vectors.insert(vectors.end(), fresh.begin(), fresh.end());
  }
  basis = withVectors(part, basis, std::move(vectors));
  basis.orthogonality = std::max(basis.orthogonality, defect);
  if (coupled && !rotate) basis.orthonormal = false;
  return added;
}

std::vector<int> positionsOf(const Partition& partition, const std::vector<int>& interior) {
  std::vector<int> positions;
  for (int i : interior) positions.push_back(partition.interior[at(i)]);
  return positions;
}

linalg::DofNamer namer(const model::Substructure& part, std::vector<int> positions) {
  return [&part, positions = std::move(positions)](int i) {
    return model::describe(part.model.dofs[at(positions[at(i)])], part.model.componentNames);
  };
}

}  // namespace tooljoint::reduction
