// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/project/Projection.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "common/Error.hpp"
#include "reduction/project/FullBasis.hpp"

namespace tooljoint::reduction {

namespace {

/// Defects up to this are rounding and are removed; larger ones remain and are reported.
constexpr double enforceBelow = 1e-10;
/// Entries below this times |Phi|' |A| |Phi| are rounding of the projection itself.
constexpr double roundingLevel = 1e-14;

double norm(const Sparse& A) { return A.norm(); }
double product(const Sparse& A, const Sparse& B) { return A.cwiseProduct(B).sum(); }

/// A = a M + b K to rounding, or none.
std::optional<std::pair<double, double>> rayleighCoefficients(const Sparse& A, const Sparse& M,
                                                              const Sparse& K) {
  const double size = norm(A);
  if (size == 0.0) return std::pair{0.0, 0.0};
  const double mm = norm(M), kk = norm(K);
  if (mm == 0.0) return std::nullopt;
  if (kk == 0.0) {
    const double a = product(A, M) / (mm * mm);
    if (norm(A - a * M) <= 1e-14 * size) return std::pair{a, 0.0};
    return std::nullopt;
  }
  // least squares in the unit matrices M / |M|, K / |K|
  const double c = product(M, K) / (mm * kk);
  const double am = product(A, M) / mm;
  const double ak = product(A, K) / kk;
  const double determinant = 1.0 - c * c;
  if (determinant < 1e-8) return std::nullopt;
  double a = (am - c * ak) / determinant / mm;
  double b = (ak - c * am) / determinant / kk;
  if (std::abs(a) * mm <= 1e-13 * size) a = 0.0;
  if (std::abs(b) * kk <= 1e-13 * size) b = 0.0;
  if (norm(A - a * M - b * K) <= 1e-12 * size) return std::pair{a, b};
  return std::nullopt;
}

/// True if dense columns need no more memory than sparse ones.
bool isFull(const Sparse& Phi) {
  return static_cast<double>(Phi.nonZeros()) >=
         fullFrom *
             std::max(1.0, static_cast<double>(Phi.rows()) * static_cast<double>(Phi.cols()));
}

/// Natural size of phi_i' A phi_j: s_i s_j with s_i^2 = |phi_i|' |A| |phi_i|.
Vector naturalSize(const Sparse& A, const Sparse& Phi) {
  if (isLargeAndFull(Phi)) return absoluteEnergiesByRows(A, Phi).cwiseSqrt();
  const Sparse absolute = A.cwiseAbs();
  const Sparse shapes = Phi.cwiseAbs();
  const Sparse product = absolute * shapes;
  Vector sizes = Vector::Zero(Phi.cols());
  for (int i = 0; i < shapes.outerSize(); ++i) {
    Sparse::InnerIterator a(shapes, i);
    Sparse::InnerIterator b(product, i);
    while (a && b) {
      if (a.col() == b.col()) {
        sizes[a.col()] += a.value() * b.value();
        ++a;
        ++b;
      } else if (a.col() < b.col()) {
        ++a;
      } else {
        ++b;
      }
    }
  }
  return sizes.cwiseSqrt();
}

/// Removes the rounding of m_DD: sets it to the identity if it equals it to enforceBelow.
void tidyMass(Sparse& m, Eigen::Index boundary, ProjectedMatrices& out) {
  double defect = 0;
  Vector seen = Vector::Zero(m.rows());
  forEachEntry(m, [&](int i, int j, double value) {
    if (i < boundary || j < boundary) return;
    if (j == i) seen[i] = 1;
    defect = std::max(defect, std::abs(value - (j == i ? 1.0 : 0.0)));
  });
  if ((seen.tail(m.rows() - boundary).array() == 0).any()) defect = 1.0;
  out.massDefect = defect;
  if (defect > enforceBelow) return;
  for (int i = static_cast<int>(boundary); i < m.rows(); ++i)
    for (Sparse::InnerIterator it(m, i); it; ++it)
      if (it.col() >= boundary) it.valueRef() = it.col() == i ? 1.0 : 0.0;
  m = withoutZeros(m);
}

bool isRounding(double value, Eigen::Index i, Eigen::Index j, const Vector& size) {
  return std::abs(value) <= roundingLevel * size[i] * size[j];
}

/// Removes entries that are rounding of the projection: rigid-body motion has exactly zero
/// stiffness.
Sparse withoutRounding(const Sparse& k, const Vector& size) {
  Sparse out = k;
  out.prune(
      [&](Eigen::Index i, Eigen::Index j, double value) { return !isRounding(value, i, j, size); });
  return out;
}

/// Rows of interface forces that state u_b = Phi_b p + Psi_b g exactly: k_gp = 0, k_gg = Psi_b' of
/// the constant stiffness. Residual forces of skew or time-dependent stiffness are omitted; they
/// would drive the massless force coordinates.
Sparse withExactInterfaces(const Sparse& k, const Basis& basis, bool constant) {
  const auto first = static_cast<int>(k.rows()) - basis.forces();
  Triplets entries;
  forEachEntry(k, [&](int i, int j, double value) {
    if (i < first) entries.emplace_back(i, j, value);
  });
  for (int j = 0; constant && j < basis.forces(); ++j)
    forEachInRow(basis.vectors, basis.forceDofs[at(j)], [&](int column, double value) {
      if (column >= first) entries.emplace_back(column, first + j, value);
    });
  return sparse(k.rows(), k.cols(), entries);
}

/// Largest off-diagonal of sym(k_DD) relative to max(sqrt(k_ii k_jj), rounding level).
double offDiagonal(const Sparse& k, Eigen::Index boundary, const Vector& size) {
  const Vector diagonal = k.diagonal().cwiseAbs();
  double defect = 0;
  forEachEntry(symmetricPart(k), [&](int i, int j, double value) {
    if (i < boundary || j < boundary || j == i) return;
    const double rounding = roundingLevel * size[i] * size[j];
    if (std::abs(value) <= rounding) return;
    const double scale = std::max(std::sqrt(diagonal[i] * diagonal[j]), rounding / enforceBelow);
    defect = std::max(defect, std::abs(value) / scale);
  });
  return defect;
}

/// Removes the rounding of the constant stiffness: sym(k_DD) diagonal, k_DC = 0, and for symmetric
/// K also k_CD = 0.
void tidyStiffness(Sparse& k, bool symmetric, Eigen::Index boundary, const Vector& size,
                   ProjectedMatrices& out) {
  out.stiffnessDefect = offDiagonal(k, boundary, size);
  if (out.stiffnessDefect > enforceBelow || out.massDefect > enforceBelow) return;
  const Sparse transposed = k.transpose();
  const Vector diagonal = k.diagonal().cwiseAbs();
  Triplets entries;
  forEachEntry(k, [&](int i, int j, double value) {
    const bool modalRow = i >= boundary, modalColumn = j >= boundary;
    const bool zeroInTheory = modalRow != modalColumn && (modalRow || symmetric);
    const double negligible = std::max(enforceBelow * std::sqrt(diagonal[i] * diagonal[j]),
                                       roundingLevel * size[i] * size[j]);
    if (modalRow && modalColumn && j != i) return;
    if (zeroInTheory && std::abs(value) <= negligible) return;
    if (!isRounding(value, i, j, size)) entries.emplace_back(i, j, value);
  });
  if (!symmetric)
    forEachEntry(Sparse(0.5 * (k - transposed)), [&](int i, int j, double value) {  // skew part
      if (i >= boundary && j >= boundary && j != i && value != 0.0)
        entries.emplace_back(i, j, value);
    });
  k = sparse(k.rows(), k.cols(), entries);
  out.structureEnforced = true;
}

}  // namespace

std::vector<model::MatrixTerm> stiffnessTerms(const model::SecondOrderModel& model) {
  std::vector<model::MatrixTerm> terms, varying;
  for (const auto& term : model.stiffness) {
    if (!model.laws[at(term.law)].isOne()) {
      varying.push_back(term);
    } else if (terms.empty()) {
      terms.push_back(term);
    } else {
      terms.front().name += " + " + term.name;
      terms.front().matrix = terms.front().matrix + term.matrix;
    }
  }
  terms.insert(terms.end(), varying.begin(), varying.end());
  return terms;
}

Sparse project(const Sparse& A, const Sparse& Phi) {
  if (isLargeAndFull(Phi)) return projectByRows(A, Phi).sparseView();
  if (!isFull(Phi)) {
    const Sparse transposed = Phi.transpose();
    const Sparse right = A * Phi;
    return withoutZeros(transposed * right);
  }
  const Matrix dense = Phi;
  const Matrix right = A * dense;
  const Matrix projected = dense.transpose() * right;
  return projected.sparseView();  // products of structural zeros are exact zeros
}

ProjectedMatrices projectMatrices(const PartView& part, const Basis& basis) {
  const Sparse& Phi = basis.vectors;
  const auto& laws = part.model().laws;
  const Eigen::Index boundary = sizeOf(basis.partition.boundary);
  ProjectedMatrices out;
  const bool masslessFlexibility = basis.inertial.size() > 0;
  Sparse mass = symmetricPart(project(part.mass(), masslessFlexibility ? basis.inertial : Phi));
  if (basis.orthonormal || masslessFlexibility) tidyMass(mass, boundary, out);
  out.mass = mass;

  const Sparse& K = part.stiffness();
  out.constantStiffness = Sparse(Phi.cols(), Phi.cols());
  for (const auto& term : stiffnessTerms(part.model())) {
    Sparse reduced = project(term.matrix, Phi);
    const bool constant = laws[at(term.law)].isOne();
    if (basis.forces() > 0 && masslessFlexibility)
      reduced = withExactInterfaces(reduced, basis, constant);
    if (constant) {
      if (part.symmetric()) reduced = symmetricPart(reduced);
      const Vector size = naturalSize(K, Phi);
      if (basis.orthonormal)
        tidyStiffness(reduced, part.symmetric(), boundary, size, out);
      else
        reduced = withoutRounding(reduced, size);
      out.constantStiffness = reduced;
    }
    out.stiffness.push_back({term.name, reduced, term.law});
  }
  for (const auto& term : part.model().damping) {
    if (masslessFlexibility) {
      out.damping.push_back({term.name, project(term.matrix, basis.inertial), term.law});
      continue;
    }
    const auto rayleigh = rayleighCoefficients(term.matrix, part.mass(), K);
    Sparse reduced =
        rayleigh
            ? withoutZeros(rayleigh->first * out.mass + rayleigh->second * out.constantStiffness)
            : project(term.matrix, Phi);
    out.damping.push_back({term.name, reduced, term.law});
  }
  return out;
}

}  // namespace tooljoint::reduction
