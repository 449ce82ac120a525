// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Full and coupled modes matched by shape; errors of damped modes estimated and true.
#include <Teuchos_ParameterList.hpp>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "coupling/Assembler.hpp"
#include "estimate/ModeComparison.hpp"
#include "tests/support/SampleParts.hpp"

namespace {

using namespace tooljoint;

coupling::Synthesis reduced(const std::vector<model::Substructure>& parts, int modes) {
  reduction::ReductionOptions options;
  options.modes.kind = reduction::ModeRule::Kind::PerPart;
  options.modes.counts = {modes};
  return coupling::synthesise(parts, *reduction::makeBasis("Craig-Bampton", Teuchos::ParameterList()), options);
}

TEST(ModeComparison, WithAllModesShapesAreTheSame) {
  for (bool spinning : {false, true}) {
    const auto parts = samples::loopFrame(8, spinning);
    const auto synthesis = reduced(parts, 1000);
    const auto full = coupling::couple(parts);
    for (const auto& mode : estimate::compareModes(full, parts, synthesis, 6)) {
      EXPECT_NEAR(mode.mac, 1.0, 1e-8);
      EXPECT_LT(std::abs(mode.error), 1e-8);
    }
    for (const auto& mode : estimate::compareDampedModes(full, parts, synthesis, 6, 0.5)) {
      EXPECT_NEAR(mode.mac, 1.0, 1e-6);
      EXPECT_LT(mode.error, 1e-6);  // QR of the linearised problem: rounding of (omega_max / omega)^2
      EXPECT_LT(mode.estimate, 1e-6);
    }
  }
}

TEST(ModeComparison, EstimatesOfDampedModesAreWithinAFactorOfThree) {
  int counted = 0;
  for (int modes : {2, 4, 6}) {
    const auto parts = samples::loopFrame(10, true, modes == 4);
    const auto compared = estimate::compareDampedModes(coupling::couple(parts), parts, reduced(parts, modes), 6, 0.5);
    std::printf("%d modes of each part\n%s", modes, estimate::comparisonTable(compared, true).c_str());
    for (const auto& mode : compared) {
      if (mode.error < 1e-9 || mode.mac < 0.9) continue;
      EXPECT_GT(mode.estimate, mode.error / 3.0);
      EXPECT_LT(mode.estimate, mode.error * 3.0);
      ++counted;
    }
  }
  EXPECT_GT(counted, 12);
}

TEST(ModeComparison, ModalAssuranceIsOneForTheSameShapeAndZeroForOthers) {
  const Matrix shapes = (Matrix(3, 2) << 1, 0, 0, 2, 0, 0).finished();
  Sparse M(3, 3);
  M.setIdentity();
  const Eigen::MatrixXcd a = shapes.cast<std::complex<double>>();
  const Matrix mac = estimate::modalAssurance(M, a, std::complex<double>(0, 3) * a);
  EXPECT_NEAR((mac - Matrix::Identity(2, 2)).norm(), 0.0, 1e-14);
}

TEST(ModeComparison, NamesADofThatIsInNoPart) {
  const auto parts = samples::loopFrame(6, false);
  auto full = coupling::couple(parts);
  full.dofs[0] = model::DofLabel::physical(9999, 1);
  try {
    estimate::compareModes(full, parts, reduced(parts, 2), 2);
    FAIL() << "no error";
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find("v of node 9999"), std::string::npos) << error.what();
  }
}

}  // namespace
