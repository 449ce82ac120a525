// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/part/ConstraintModes.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/report/StageTimes.hpp"
#include "reduction/part/PartView.hpp"

namespace tooljoint::reduction {

ConstraintModeBuilder::ConstraintModeBuilder(const Partition& partition)
    : partition_(partition), residuals_(Vector::Zero(sizeOf(partition.boundary))) {
  for (int j = 0; j < sizeOf(partition.boundary); ++j)
    entries_.emplace_back(partition.boundary[at(j)], j, 1.0);
}

void ConstraintModeBuilder::add(const Sparse& KII, const Matrix& KIC, const Matrix& phi,
                                const std::vector<int>& inner, const std::vector<int>& touched) {
  const Matrix defect = KII * phi + KIC;
  double norm = 0;
  for (int i = 0; i < KII.outerSize(); ++i) {
    double row = 0;
    forEachInRow(KII, i, [&](int, double value) { row += std::abs(value); });
    norm = std::max(norm, row);
  }
  for (int j = 0; j < sizeOf(touched); ++j) {
    const double scale = norm * phi.col(j).cwiseAbs().maxCoeff() + KIC.col(j).cwiseAbs().maxCoeff();
    double& residual = residuals_[touched[at(j)]];
    if (scale > 0.0) residual = std::max(residual, defect.col(j).cwiseAbs().maxCoeff() / scale);
    for (int i = 0; i < sizeOf(inner); ++i)
      if (phi(i, j) != 0.0) entries_.emplace_back(inner[at(i)], touched[at(j)], phi(i, j));
  }
}

ConstraintModes ConstraintModeBuilder::result() const {
  return {sparse(partition_.size, residuals_.size(), entries_), residuals_};
}

ConstraintModes constraintModes(const PartView& part) {
  const Stage stage("constraint modes");
  ConstraintModeBuilder modes(part.partition());
  for (int i = 0; i < part.blocks(); ++i) {
    const InteriorBlock& b = part.interiorBlock(i);
    if (b.floats()) continue;  // no motion of a boundary dof reaches it
    std::vector<int> outer;
    for (int j : b.touched) outer.push_back(part.partition().boundary[at(j)]);
    const Matrix KIC = block(part.stiffness(), b.positions, outer);
    const Matrix phi = part.solveBlock(i, -KIC);  // K_II phi_C = -K_IC
    modes.add(b.stiffness, KIC, phi, b.positions, b.touched);
  }
  return modes.result();
}

}  // namespace tooljoint::reduction
