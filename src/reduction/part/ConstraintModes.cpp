// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/part/ConstraintModes.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/report/StageTimes.hpp"
#include "linalg/SparseProducts.hpp"
#include "reduction/part/PartView.hpp"
#include "reduction/part/RowFiller.hpp"

namespace tooljoint::reduction {

namespace {

/// Number of shapes solved at a time; limits the memory in addition to the result.
constexpr int columnsAtATime = 64;

}  // namespace

ConstraintModeBuilder::ConstraintModeBuilder(const Partition& partition)
    : partition_(partition), residuals_(Vector::Zero(sizeOf(partition.boundary))) {}

void ConstraintModeBuilder::add(const Sparse& KII, const Matrix& KIC, Matrix phi,
                                const std::vector<int>& inner, const std::vector<int>& touched) {
  const Matrix defect = linalg::product(KII, phi) + KIC;
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
  }
  blocks_.push_back({inner, touched, std::move(phi)});
}

ConstraintModes ConstraintModeBuilder::result() const {
  RowFiller vectors(partition_.size, residuals_.size());
  for (int i : partition_.boundary) vectors.expect(i, 1);
  for (const InteriorBlock& block : blocks_) vectors.expect(block.inner, block.shapes);
  vectors.start();
  for (int j = 0; j < sizeOf(partition_.boundary); ++j)
    vectors.put(partition_.boundary[at(j)], j, 1.0);
  for (const InteriorBlock& block : blocks_) vectors.put(block.inner, block.touched, block.shapes);
  return {vectors.result(), residuals_};
}

ConstraintModes constraintModes(const PartView& part) {
  const Stage stage("constraint modes");
  ConstraintModeBuilder modes(part.partition());
  for (int i = 0; i < part.blocks(); ++i) {
    const InteriorBlock& b = part.interiorBlock(i);
    if (b.floats()) continue;  // motions of the boundary do not reach it
    for (std::size_t first = 0; first < b.touched.size(); first += columnsAtATime) {
      const auto begin = b.touched.begin() + static_cast<std::ptrdiff_t>(first);
      const std::vector<int> touched(
          begin, begin + std::min<std::ptrdiff_t>(columnsAtATime, b.touched.end() - begin));
      std::vector<int> outer;
      for (int j : touched) outer.push_back(part.partition().boundary[at(j)]);
      const Matrix KIC = block(part.stiffness(), b.positions, outer);
      modes.add(b.stiffness, KIC, part.solveBlock(i, -KIC), b.positions,
                touched);  // K_II phi_C = -K_IC
    }
  }
  return modes.result();
}

}  // namespace tooljoint::reduction
