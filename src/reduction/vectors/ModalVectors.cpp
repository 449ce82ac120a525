// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/vectors/ModalVectors.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "linalg/DenseDecompositions.hpp"
#include "linalg/Deterministic.hpp"
#include "reduction/methods/BasisBuilder.hpp"

namespace tooljoint::reduction {

namespace {

/// v' M v below this fraction of |v|' |M| |v| is rounding: the vector has no mass.
constexpr double massless = 1e-14;

}  // namespace

OrthonormalSet::OrthonormalSet(const Sparse& mass, double tolerance, std::string who)
    : mass_(mass),
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
        who_ + "its mass matrix is indefinite: a vector of the basis has negative kinetic energy.");
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

void addRitzVectors(const Sparse& symmetricK, const Sparse& M, const Matrix& Q, int group,
                    const std::string& kind, InteriorVectors& to) {
  if (Q.cols() == 0) return;
  // (Q' M Q) is the identity up to rounding; including it removes the rounding of Q.
  const Matrix k = Q.transpose() * (symmetricK * Q), m = Q.transpose() * (M * Q);
  const auto pairs = linalg::symmetricPairs(0.5 * (k + k.transpose()), 0.5 * (m + m.transpose()));
  if (!pairs.converged)
    throw ConvergenceError("The QR iteration for the Ritz vectors of a basis did not converge.");
  Matrix phi = Q * pairs.vectors;
  for (Eigen::Index j = 0; j < phi.cols(); ++j) {
    if (phi(linalg::largestEntry(phi.col(j)), j) < 0) phi.col(j) = -phi.col(j);
    to.vectors.push_back({pairs.values[j], group, phi.col(j), 0, kind});
  }
  const Matrix gram = phi.transpose() * (M * phi);
  to.orthogonality = std::max(
      to.orthogonality, (gram - Matrix::Identity(phi.cols(), phi.cols())).cwiseAbs().maxCoeff());
}

PartView viewOf(const PartView& part, const Basis& basis) {
  return part.withBoundary(basis.partition.interface, basis.partition.retained);
}

Sparse constraintColumns(const Basis& basis) {
  return block(basis.vectors, range(basis.vectors.rows()), range(sizeOf(basis.partition.boundary)));
}

Matrix constraintInertia(const PartView& part, const Basis& basis) {
  return block(part.mass(), basis.partition.interior, range(basis.vectors.rows())) *
         Matrix(constraintColumns(basis));
}

Sparse modalColumns(const Basis& basis) {
  return block(basis.vectors, basis.partition.interior,
               range(basis.modes(), sizeOf(basis.partition.boundary)));
}

namespace {

/// Adds the modal columns of a basis unchanged, on the whole interior.
void addModalVectors(const Basis& basis, const Matrix& V, InteriorVectors& to) {
  std::vector<const BasisRow*> rows;
  for (std::size_t k = basis.partition.boundary.size(); k < basis.rows.size(); ++k)
    if (basis.rows[k].kept) rows.push_back(&basis.rows[k]);
  for (int k = 0; k < basis.modes(); ++k) {
    ModalVector vector{basis.eigenvalues[k], 0, V.col(k), 0, basis.modeKind[at(k)]};
    if (k < sizeOf(rows)) {
      vector.residual = rows[at(k)]->residual;
      vector.why = rows[at(k)]->why;
      vector.name = rows[at(k)]->name;
    }
    to.vectors.push_back(std::move(vector));
  }
}

/// `before` with its modal vectors replaced by these.
Basis withVectors(const Basis& before, InteriorVectors vectors) {
  const int boundary = sizeOf(before.partition.boundary);
  vectors.keepAll();
  Basis after = before;
  after.rows.resize(at(boundary));
  setVectors(before.partition, constraintColumns(before), vectors, after);
  report(vectors, after);
  for (std::size_t k = at(boundary); k < before.rows.size(); ++k)
    if (!before.rows[k].kept) after.rows.push_back(before.rows[k]);
  const auto left = before.candidates.size() - before.eigenvalues.size();
  after.candidates.conservativeResize(after.eigenvalues.size() + left);
  after.candidates.tail(left) = before.candidates.tail(left);
  after.complete = vectors.kept == sizeOf(before.partition.interior);
  after.removable = false;
  after.method = before.method;
  return after;
}

}  // namespace

int appendVectors(const PartView& part, const Matrix& X, const std::string& kind, double tolerance,
                  bool rotate, Basis& basis) {
  const PartView view = viewOf(part, basis);
  const Sparse &M = view.interiorMass(), &K = view.symmetricInteriorStiffness();
  const Matrix V = modalColumns(basis);
  OrthonormalSet set(M, tolerance, part.who(kind + " vectors"));
  for (Eigen::Index k = 0; k < V.cols(); ++k)
    if (!set.add(V.col(k)))
      throw ModelError(part.who() + "its modal vectors are linearly dependent before its " + kind +
                       " vectors are added.");
  int added = 0;
  for (Eigen::Index j = 0; j < X.cols(); ++j) added += set.add(X.col(j)) ? 1 : 0;
  if (added == 0) return 0;
  const Matrix W = set.basis().rightCols(added);
  InteriorVectors vectors, fresh;
  vectors.groups = {basis.partition.interior};
  addRitzVectors(K, M, W, 0, kind, fresh);
  // V' K W, relative to |V|' |K| |W|; zero for the fixed-interface modes of K
  const Matrix coupling = V.transpose() * (K * W),
               size = V.cwiseAbs().transpose() * (K.cwiseAbs() * W.cwiseAbs());
  const bool coupled = (coupling.cwiseAbs().array() > 1e-11 * size.array()).any();
  if (coupled && rotate) {
    addRitzVectors(K, M, set.basis(), 0, basis.modeKind.empty() ? kind : basis.modeKind.front(),
                   vectors);
    for (auto& vector : vectors.vectors) vector.why = "with " + kind + " vectors";
  } else {
    addModalVectors(basis, V, vectors);
    for (int k = 0; k < added; ++k) {
      ModalVector& vector = fresh.vectors[at(k)];
      vector.name = kind + " vector " + std::to_string(k + 1);
      vector.why = "added";
      vectors.vectors.push_back(std::move(vector));
    }
    vectors.orthogonality = fresh.orthogonality;
  }
  basis = withVectors(basis, vectors);
  basis.orthogonality = std::max(basis.orthogonality, vectors.orthogonality);
  if (coupled && !rotate) basis.orthonormal = false;
  return added;
}

}  // namespace tooljoint::reduction
