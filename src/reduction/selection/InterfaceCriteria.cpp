// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/selection/InterfaceCriteria.hpp"

#include <vector>

#include "common/Error.hpp"
#include "reduction/vectors/ModalVectors.hpp"

namespace tooljoint::reduction {

namespace {

/// A total below this fraction of the largest one of its kind is rounding.
constexpr double negligible = 1e-14;

}  // namespace

Vector interfaceShares(const PartView& part, const Basis& basis, ModeRule::Kind kind) {
  const int boundary = sizeOf(basis.partition.boundary);
  const int modes = basis.modes();
  Vector shares = Vector::Zero(modes);
  if (modes == 0 || boundary == 0) return shares;
  const PartView view = viewOf(part, basis);
  const Matrix phi = modalColumns(basis), inertia = constraintInertia(part, basis);
  const bool mass = kind == ModeRule::Kind::InterfaceMass;
  const Matrix coupling = phi.transpose() * inertia;  // L_k, modes x boundary dofs
  Matrix response;
  try {
    response = mass ? linalg::DirectSolver(view.interiorMass()).solve(inertia)
                    : view.solveSymmetricInterior(inertia);
  } catch (const ModelError& error) {
    throw ModelError(part.who() + "the interface criterion needs a nonsingular interior " +
                     (mass ? "mass" : "stiffness") +
                     ". Select the modes by \"Modes\" or \"Cut-off Frequency\". " + error.what());
  }
  Vector total(boundary);
  for (int j = 0; j < boundary; ++j) total[j] = inertia.col(j).dot(response.col(j));
  Matrix parts = coupling.array().square();
  if (!mass)
    for (int k = 0; k < modes; ++k) parts.row(k) /= std::abs(basis.eigenvalues[k]);
  // A buckled mode reduces L' K^-1 L by its contribution; the sum of the magnitudes is used.
  for (int k = 0; k < modes && !mass; ++k)
    if (basis.eigenvalues[k] < 0) total += 2.0 * parts.row(k).transpose();
  // A dof without coupling is detected relative to the size of its own rows.
  int counted = 0;
  for (int j = 0; j < boundary; ++j) {
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
  std::vector<int> order = range(shares.size());
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return shares[a] > shares[b]; });
  std::vector<char> keep(order.size(), 0);
  double sum = 0;
  for (int k = 0; k < sizeOf(order); ++k)
    if (eigenvalues[k] <= 0) sum += shares[k], keep[at(k)] = 1;
  for (int k : order) {
    if (sum >= fraction - 1e-12) break;
    if (!keep[at(k)]) sum += shares[k], keep[at(k)] = 1;
  }
  if (sum < fraction - 1e-12) return {};
  return wholePairs(eigenvalues, keep, pairTolerance);
}

}  // namespace tooljoint::reduction
