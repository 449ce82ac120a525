// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/MasslessDofs.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "common/report/Log.hpp"
#include "model/DofNames.hpp"

namespace tooljoint::reduction {

namespace {

Vector rowSizes(const Sparse& A) { return A.cwiseAbs() * Vector::Ones(A.cols()); }

/// Relative size of rounding in the rows of a matrix.
constexpr double roundingOfRows = 1e-12;

/// Dofs of a part without mass, but with damping.
std::vector<int> dampedMassless(const model::SecondOrderModel& model,
                                const std::vector<int>& among) {
  const Vector mass = rowSizes(model.mass), damping = rowSizes(model.dampingAt(0.0));
  std::vector<int> found;
  for (const int i : among)
    if (mass[i] == 0.0 && damping[i] > 0.0) found.push_back(i);
  return found;
}

}  // namespace

void warnOfUnsymmetricMassless(const model::Substructure& part) {
  const auto& model = part.model;
  const Sparse K = model.stiffnessAt(0.0);
  const Vector mass = rowSizes(model.mass), stiffness = rowSizes(K),
               skew = rowSizes(Sparse(K - Sparse(K.transpose())));
  std::vector<int> found;
  for (const int i : part.interior())
    if (mass[i] == 0.0 && skew[i] > roundingOfRows * stiffness[i]) found.push_back(i);
  if (!found.empty())
    log::warn(
        "Part \"" + part.name + "\" has " + std::to_string(found.size()) +
        " interior dofs without mass whose stiffness is not symmetric (first " +
        model::dofName(model, found.front()) +
        "). No basis contains their motion, not even all modes. Retain them, or give them mass.");
}

void warnOfDampedMassless(const model::Substructure& part) {
  const auto& model = part.model;
  const Sparse C = model.dampingAt(0.0), K = model.stiffnessAt(0.0);
  const auto damped = dampedMassless(model, part.interior());
  if (damped.empty()) return;
  const int first = damped.front();
  const double stiffness = K.coeff(first, first);
  const double alpha = stiffness != 0.0 ? C.coeff(first, first) / stiffness : 0.0;
  const Vector damping = rowSizes(C), apart = rowSizes(Sparse(C - alpha * K));
  if (std::all_of(damped.begin(), damped.end(),
                  [&](int i) { return apart[i] <= roundingOfRows * damping[i]; }))
    return;
  log::warn(
      "Part \"" + part.name + "\" has " + std::to_string(damped.size()) +
      " interior dofs with damping but no mass (first " + model::dofName(model, first) +
      "). No basis holds how they creep, not even all modes. Retain them, or give them mass.");
}

void warnOfDampedMasslessBoundary(const model::Substructure& part) {
  auto boundary = part.interface;
  boundary.insert(boundary.end(), part.retained.begin(), part.retained.end());
  const auto damped = dampedMassless(part.model, boundary);
  if (!damped.empty())
    log::warn(
        "Part \"" + part.name + "\" has " + std::to_string(damped.size()) +
        " boundary dofs with damping but no mass (first " +
        model::dofName(part.model, damped.front()) +
        "). This basis damps its modes alone and leaves that out, with all modes, too. Choose "
        "\"Rubin\", which has the same modes, or give them mass.");
}

}  // namespace tooljoint::reduction
