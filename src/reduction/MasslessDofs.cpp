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

/// Of what is relative to the rows of a matrix, rounding.
constexpr double roundingOfRows = 1e-12;

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
    log::warn("Part \"" + part.name + "\" has " + std::to_string(found.size()) +
              " interior dofs without mass whose stiffness is not symmetric (first " +
              model::dofName(model, found.front()) +
              "). No basis holds how they follow, not even all modes. Retain them, or give them "
              "mass.");
}

void warnOfDampedMassless(const model::Substructure& part) {
  const auto& model = part.model;
  const Sparse C = model.dampingAt(0.0), K = model.stiffnessAt(0.0);
  const Vector mass = rowSizes(model.mass), damping = rowSizes(C);
  std::vector<int> damped;
  for (const int i : part.interior())
    if (mass[i] == 0.0 && damping[i] > 0.0) damped.push_back(i);
  if (damped.empty()) return;
  const int first = damped.front();
  const double stiffness = K.coeff(first, first);
  const double alpha = stiffness != 0.0 ? C.coeff(first, first) / stiffness : 0.0;
  const Vector apart = rowSizes(Sparse(C - alpha * K));
  if (std::all_of(damped.begin(), damped.end(),
                  [&](int i) { return apart[i] <= roundingOfRows * damping[i]; }))
    return;
  log::warn(
      "Part \"" + part.name + "\" has " + std::to_string(damped.size()) +
      " interior dofs with damping but no mass (first " + model::dofName(model, first) +
      "). No basis holds how they creep, not even all modes. Retain them, or give them mass.");
}

}  // namespace tooljoint::reduction
