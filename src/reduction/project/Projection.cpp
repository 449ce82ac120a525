// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/project/Projection.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "common/Error.hpp"

namespace tooljoint::reduction {

namespace {

/// Defects up to this are rounding and are removed; larger ones are left and reported.
constexpr double enforceBelow = 1e-10;
/// Entries below this times |Phi|' |A| |Phi| are rounding of the projection itself.
constexpr double roundingLevel = 1e-14;

Sparse withoutExactZeros(Sparse A) {
  A.prune([](Eigen::Index, Eigen::Index, double value) { return value != 0.0; });
  return A;
}

double norm(const Sparse& A) { return A.norm(); }
double product(const Sparse& A, const Sparse& B) { return A.cwiseProduct(B).sum(); }

/// A = a M + b K to rounding, or nothing.
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
  // Least squares in the unit matrices M / |M|, K / |K|.
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

/// Natural size of phi_i' A phi_j: s_i s_j with s_i^2 = |phi_i|' |A| |phi_i|.
Vector naturalSize(const Sparse& A, const Sparse& Phi) {
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

/// Removes the rounding of m_DD: the identity when it is one to enforceBelow.
void tidyMass(Sparse& m, Eigen::Index kept, ProjectedMatrices& out) {
  double defect = 0;
  Vector seen = Vector::Zero(m.rows());
  for (int i = static_cast<int>(kept); i < m.rows(); ++i)
    for (Sparse::InnerIterator it(m, i); it; ++it) {
      if (it.col() < kept) continue;
      if (it.col() == i) seen[i] = 1;
      defect = std::max(defect, std::abs(it.value() - (it.col() == i ? 1.0 : 0.0)));
    }
  for (Eigen::Index i = kept; i < m.rows(); ++i)
    if (seen[i] == 0) defect = 1.0;
  out.massDefect = defect;
  if (defect > enforceBelow) return;
  for (int i = static_cast<int>(kept); i < m.rows(); ++i)
    for (Sparse::InnerIterator it(m, i); it; ++it)
      if (it.col() >= kept) it.valueRef() = it.col() == i ? 1.0 : 0.0;
  m = withoutExactZeros(m);
}

bool isRounding(double value, Eigen::Index i, Eigen::Index j, const Vector& size) {
  return std::abs(value) <= roundingLevel * size[i] * size[j];
}

/// Without the entries that are rounding of the projection: rigid-body motion has no stiffness at
/// all.
Sparse withoutRounding(const Sparse& k, const Vector& size) {
  Sparse out = k;
  out.prune(
      [&](Eigen::Index i, Eigen::Index j, double value) { return !isRounding(value, i, j, size); });
  return out;
}

/// Rows of interface forces that say u_b = Phi_b p + Psi_b g and nothing of the residual forces of
/// skew or time-dependent stiffness, which without mass would drive the forces: k_gp = 0, k_gg =
/// Psi_b' of the constant stiffness.
Sparse withExactInterfaces(const Sparse& k, const Basis& basis, bool constant) {
  const auto first = static_cast<int>(k.rows()) - basis.forces();
  Triplets entries;
  for (int i = 0; i < first; ++i)
    for (Sparse::InnerIterator it(k, i); it; ++it)
      entries.emplace_back(i, static_cast<int>(it.col()), it.value());
  for (int j = 0; constant && j < basis.forces(); ++j)
    for (Sparse::InnerIterator it(basis.vectors, basis.boundary[static_cast<std::size_t>(j)]); it;
         ++it)
      if (it.col() >= first)
        entries.emplace_back(static_cast<int>(it.col()), first + j, it.value());
  Sparse out(k.rows(), k.cols());
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

/// Largest off-diagonal of sym(k_DD) relative to max(sqrt(k_ii k_jj), rounding level).
double offDiagonal(const Sparse& k, Eigen::Index kept, const Vector& size) {
  const Vector diagonal = k.diagonal().cwiseAbs();
  const Sparse symmetric = symmetricPart(k);
  double defect = 0;
  for (int i = static_cast<int>(kept); i < k.rows(); ++i)
    for (Sparse::InnerIterator it(symmetric, i); it; ++it) {
      const auto j = it.col();
      if (j < kept || j == i) continue;
      const double rounding = roundingLevel * size[i] * size[j];
      if (std::abs(it.value()) <= rounding) continue;
      const double scale = std::max(std::sqrt(diagonal[i] * diagonal[j]), rounding / enforceBelow);
      defect = std::max(defect, std::abs(it.value()) / scale);
    }
  return defect;
}

/// Removes the rounding of the constant stiffness: sym(k_DD) diagonal, k_DC = 0, and for symmetric
/// K also k_CD = 0.
void tidyStiffness(Sparse& k, const Sparse& K, Eigen::Index kept, const Vector& size,
                   ProjectedMatrices& out) {
  out.stiffnessDefect = offDiagonal(k, kept, size);
  if (out.stiffnessDefect > enforceBelow || out.massDefect > enforceBelow) return;
  const bool symmetric = nearlySymmetric(K, 1e-13);
  const Sparse transposed = k.transpose();
  const Vector diagonal = k.diagonal().cwiseAbs();
  Sparse tidy = 0.5 * (k - transposed);  // the skew part
  Triplets entries;
  const auto negligible = [&](double value, Eigen::Index i, Eigen::Index j) {
    return std::abs(value) <= std::max(enforceBelow * std::sqrt(diagonal[i] * diagonal[j]),
                                       roundingLevel * size[i] * size[j]);
  };
  for (int i = 0; i < k.rows(); ++i)
    for (Sparse::InnerIterator it(k, i); it; ++it) {
      const auto j = it.col();
      const bool modalRow = i >= kept;
      const bool modalColumn = j >= kept;
      const bool zeroInTheory = modalRow != modalColumn && (modalRow || symmetric);
      if (modalRow && modalColumn && j != i) continue;
      if (zeroInTheory && negligible(it.value(), i, j)) continue;
      if (isRounding(it.value(), i, j, size)) continue;
      entries.emplace_back(i, static_cast<int>(j), it.value());
    }
  if (!symmetric)
    for (int i = static_cast<int>(kept); i < tidy.rows(); ++i)
      for (Sparse::InnerIterator it(tidy, i); it; ++it)
        if (it.col() >= kept && it.col() != i && it.value() != 0.0)
          entries.emplace_back(i, static_cast<int>(it.col()), it.value());
  k = Sparse(k.rows(), k.cols());
  k.setFromTriplets(entries.begin(), entries.end());
  out.structureEnforced = true;
}

}  // namespace

std::vector<model::MatrixTerm> stiffnessTerms(const model::SecondOrderModel& model) {
  std::vector<model::MatrixTerm> terms;
  const auto lawName = [&](const model::MatrixTerm& term) {
    return model.laws[static_cast<std::size_t>(term.law)].name;
  };
  for (const auto& term : model.stiffness) {
    if (lawName(term) != "1") continue;
    if (terms.empty()) {
      terms.push_back(term);
    } else {
      terms.front().name += " + " + term.name;
      terms.front().matrix = terms.front().matrix + term.matrix;
    }
  }
  for (const auto& term : model.stiffness)
    if (lawName(term) != "1") terms.push_back(term);
  return terms;
}

Sparse project(const Sparse& A, const Sparse& Phi) {
  const double filling =
      static_cast<double>(Phi.nonZeros()) /
      std::max(1.0, static_cast<double>(Phi.rows()) * static_cast<double>(Phi.cols()));
  if (filling < 0.1) {
    const Sparse transposed = Phi.transpose();
    const Sparse right = A * Phi;
    return withoutExactZeros(transposed * right);
  }
  const Matrix dense = Phi;
  const Matrix right = A * dense;
  const Matrix projected = dense.transpose() * right;
  Triplets entries;  // products of structural zeros are exact zeros
  for (int i = 0; i < projected.rows(); ++i)
    for (int j = 0; j < projected.cols(); ++j)
      if (projected(i, j) != 0.0) entries.emplace_back(i, j, projected(i, j));
  Sparse out(projected.rows(), projected.cols());
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

ProjectedMatrices projectMatrices(const model::Substructure& part, const Basis& basis) {
  const Sparse& Phi = basis.vectors;
  const auto kept = static_cast<Eigen::Index>(basis.partition.kept.size());
  ProjectedMatrices out;
  const bool masslessFlexibility = basis.inertial.size() > 0;
  Sparse mass = symmetricPart(project(part.model.mass, masslessFlexibility ? basis.inertial : Phi));
  if (basis.orthonormal || masslessFlexibility) tidyMass(mass, kept, out);
  out.mass = mass;

  const Sparse K = constantStiffness(part.model);
  out.constantStiffness = Sparse(Phi.cols(), Phi.cols());
  for (const auto& term : stiffnessTerms(part.model)) {
    Sparse reduced = project(term.matrix, Phi);
    const bool constant = part.model.laws[static_cast<std::size_t>(term.law)].name == "1";
    if (basis.forces() > 0 && masslessFlexibility)
      reduced = withExactInterfaces(reduced, basis, constant);
    if (constant) {
      if (nearlySymmetric(K, 1e-13)) reduced = symmetricPart(reduced);
      const Vector size = naturalSize(K, Phi);
      if (basis.orthonormal)
        tidyStiffness(reduced, K, kept, size, out);
      else
        reduced = withoutRounding(reduced, size);
      out.constantStiffness = reduced;
    }
    out.stiffness.push_back({term.name, reduced, term.law});
  }
  for (const auto& term : part.model.damping) {
    if (masslessFlexibility) {
      out.damping.push_back({term.name, project(term.matrix, basis.inertial), term.law});
      continue;
    }
    const auto rayleigh = rayleighCoefficients(term.matrix, part.model.mass, K);
    Sparse reduced = rayleigh ? withoutExactZeros(rayleigh->first * out.mass +
                                                  rayleigh->second * out.constantStiffness)
                              : project(term.matrix, Phi);
    out.damping.push_back({term.name, reduced, term.law});
  }
  return out;
}

}  // namespace tooljoint::reduction
