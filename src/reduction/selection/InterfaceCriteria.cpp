// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/selection/InterfaceCriteria.hpp"

#include <algorithm>
#include <numeric>

#include "common/Error.hpp"
#include "linalg/trilinos/DirectSolver.hpp"

namespace tooljoint::reduction {

namespace {

/// Totals below this fraction of the largest one of their kind are no coupling but rounding.
constexpr double negligible = 1e-14;

}  // namespace

Vector interfaceShares(const model::Substructure& part, const Basis& basis, ModeRule::Kind kind) {
  const Partition& p = basis.partition;
  const auto kept = static_cast<int>(p.kept.size());
  const int modes = basis.modes();
  Vector shares = Vector::Zero(modes);
  if (modes == 0 || kept == 0) return shares;
  std::vector<int> constraint(p.kept.size()), modal(static_cast<std::size_t>(modes)),
      all(static_cast<std::size_t>(part.model.size()));
  std::iota(constraint.begin(), constraint.end(), 0);
  std::iota(modal.begin(), modal.end(), kept);
  std::iota(all.begin(), all.end(), 0);
  const Matrix phi = block(basis.vectors, p.interior, modal);
  // L = (M Phi_C)_I
  const Matrix inertia =
      block(part.model.mass, p.interior, all) * Matrix(block(basis.vectors, all, constraint));
  const bool mass = kind == ModeRule::Kind::InterfaceMass;
  const Sparse metric =
      mass ? block(part.model.mass, p.interior, p.interior)
           : block(symmetricPart(constantStiffness(part.model)), p.interior, p.interior);
  const Matrix coupling = phi.transpose() * inertia;  // L_k, modes x kept
  Matrix response;
  try {
    response = linalg::DirectSolver(metric).solve(inertia);
  } catch (const ModelError& error) {
    throw ModelError("Part \"" + part.name +
                     "\": the interface criterion needs a regular interior " +
                     (mass ? "mass" : "stiffness") +
                     ". Choose the modes by number or cut-off frequency. " + error.what());
  }
  Vector total(kept);
  for (int j = 0; j < kept; ++j) total[j] = inertia.col(j).dot(response.col(j));
  Matrix parts = coupling.array().square();
  if (!mass)
    for (int k = 0; k < modes; ++k) parts.row(k) /= std::abs(basis.eigenvalues[k]);
  // A buckled mode lowers L' K^-1 L by what it has: measured by the sum of the sizes.
  for (int k = 0; k < modes && !mass; ++k)
    if (basis.eigenvalues[k] < 0) total += 2.0 * parts.row(k).transpose();
  // A dof without coupling is told by the size of its own rows.
  int counted = 0;
  for (int j = 0; j < kept; ++j) {
    const double size = inertia.col(j).cwiseAbs().dot(response.col(j).cwiseAbs());
    if (total[j] <= negligible * size || total[j] <= 0) continue;
    shares += parts.col(j) / total[j];
    ++counted;
  }
  if (counted > 0) shares /= counted;
  return shares;
}

std::vector<char> keepByShare(const Vector& shares, const Vector& eigenvalues, double fraction,
                              double pairTolerance) {
  const auto size = static_cast<std::size_t>(shares.size());
  std::vector<std::size_t> order(size);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto share = [&](std::size_t k) { return shares[static_cast<Eigen::Index>(k)]; };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return share(a) > share(b); });
  std::vector<char> keep(size, 0);
  double sum = 0;
  for (std::size_t k = 0; k < size; ++k)
    if (eigenvalues[static_cast<Eigen::Index>(k)] <= 0) sum += share(k), keep[k] = 1;
  for (std::size_t k : order) {
    if (sum >= fraction - 1e-12) break;
    if (!keep[k]) sum += share(k), keep[k] = 1;
  }
  if (sum < fraction - 1e-12) return {};
  return wholePairs(eigenvalues, keep, pairTolerance);
}

}  // namespace tooljoint::reduction
