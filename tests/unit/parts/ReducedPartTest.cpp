// SPDX-License-Identifier: BSD-3-Clause
// A reduced part is the same after writing, reading and reuse.
#include "parts/ReducedPart.hpp"

#include <Teuchos_ParameterList.hpp>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "coupling/CoupledModes.hpp"
#include "coupling/assembly/Assembler.hpp"
#include "linalg/DenseDecompositions.hpp"
#include "parts/file/PartFile.hpp"
#include "reduction/Reduce.hpp"
#include "tests/support/SampleParts.hpp"
#include "tests/unit/io/Scratch.hpp"

namespace tooljoint::parts {
namespace ReducedPartTest {

using model::Substructure;

/// Two bars in a row, the first held at node 1, about a state that is not zero, with loads.
std::vector<Substructure> bars() {
  std::vector<Substructure> parts{samples::bar("a", 1, 12, 3e6, 2.0, {1}),
                                  samples::bar("b", 13, 9, 2e6, 1.0)};
  samples::classify(parts[0], {13}, {5});
  samples::classify(parts[1], {13}, {22});
  for (auto& part : parts) {
    auto& m = part.model;
    part.reference = Vector::Zero(m.size());
    for (int i = 0; i < m.size(); ++i)
      part.reference[i] = 1e-4 * static_cast<double>(m.dofs[static_cast<std::size_t>(i)].entity);
    m.initialDisplacement = 1.5 * part.reference;
    m.loads.push_back({"pull", Vector::LinSpaced(m.size(), 1.0, 2.0), 0});
    m.damping.push_back({"damping", Sparse(1e-4 * m.stiffness.front().matrix), 0});
  }
  return parts;
}

reduction::ReductionOptions fourModes() {
  reduction::ReductionOptions options;
  options.modes.kind = reduction::ModeRule::Kind::PerPart;
  options.modes.counts = {4};
  return options;
}

std::vector<reduction::ReducedSubstructure> reduced(const std::vector<Substructure>& parts) {
  return reduction::reduceAll(
      parts, *reduction::makeBasis("Craig-Bampton", Teuchos::ParameterList("Reduction")),
      fourModes());
}

/// A held node is not part of the file: with its position the file would be refused.
TEST(ReducedPart, KeepsThePositionsOfItsNodesAlone) {
  const test::Scratch scratch;
  const auto parts = bars();
  auto original = contentOf(parts[0]);
  for (int node = 1; node <= 13; ++node) original.positions[node] = Vector3(0.1 * node, 0.0, 0.0);
  const auto path = scratch / "a.h5";
  writePart(reducedContent(original, reduced(parts)[0]), path, FileKind::Hdf5);
  const auto positions = readPart(path, "a").positions;
  EXPECT_EQ(positions.size(), 12U);
  EXPECT_EQ(positions.count(1), 0U);
  EXPECT_EQ(positions.at(13), Vector3(1.3, 0.0, 0.0));
}

TEST(ReducedPart, HasTheFrequenciesAndForcesOfTheOneReducedInPlace) {
  const test::Scratch scratch;
  const auto parts = bars();
  const auto small = reduced(parts);
  const auto coupled = coupling::coupleWithPositions(small);
  for (const auto kind : {FileKind::Hdf5, FileKind::MatrixMarket}) {
    std::vector<Substructure> back;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      const auto path = scratch / (parts[p].name + (kind == FileKind::Hdf5 ? ".h5" : ""));
      writePart(reducedContent(contentOf(parts[p]), small[p]), path, kind);
      back.push_back(readPart(path, parts[p].name).part);
    }
    const auto again = coupling::coupleWithPositions(back);
    const int n = coupled.model.size();
    ASSERT_EQ(again.model.size(), n);
    const Vector f = coupling::lowestModes(coupled.model, n).values,
                 g = coupling::lowestModes(again.model, n).values;
    for (int i = 0; i < n; ++i) EXPECT_NEAR(g[i], f[i], 1e-12 * f[i] + 1e-15 * f[n - 1]);
    // the same recovered state and the same recovered acceleration M q'' = F - K q - C q' at the
    // start
    const auto start = [](const model::SecondOrderModel& m) {
      const Vector force = m.loadAt(0.0) - m.stiffnessAt(0.0) * m.initialDisplacement -
                           m.dampingAt(0.0) * m.initialVelocity;
      return Vector(m.recovery * linalg::solveSymmetric(Matrix(m.mass), force));
    };
    const Vector D =
        coupled.model.recoveryOffset + coupled.model.recovery * coupled.model.initialDisplacement;
    const Vector E =
        again.model.recoveryOffset + again.model.recovery * again.model.initialDisplacement;
    const Vector a = start(coupled.model), b = start(again.model);
    ASSERT_EQ(coupled.model.recoveryNodes, again.model.recoveryNodes);
    EXPECT_LT((D - E).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_LT((a - b).norm(), 1e-11 * a.norm());
    EXPECT_GT(a.norm(), 0.0);
  }
}

TEST(ReducedPart, FitsAPartWithAnotherReferenceState) {
  // Only "a" is exported; "b" has another reference state: total displacements agree at the joint.
  auto parts = bars();
  const auto small = reduced(parts);
  std::vector<Substructure> mixed{reducedContent(contentOf(parts[0]), small[0]).part, parts[1]};
  mixed[1].reference.setZero();
  const auto model = coupling::couple(mixed);
  const Vector D = model.recoveryOffset + model.recovery * model.initialDisplacement;
  int kept = 0;
  for (std::size_t i = 0; i < model.recoveryNodes.size(); ++i)
    for (const int node : {5, 13, 22})  // retained in "a", the joint, retained in "b"
      if (model.recoveryNodes[i] == node) {
        EXPECT_NEAR(D[static_cast<Eigen::Index>(i)], 1.5e-4 * node, 1e-15) << "node " << node;
        ++kept;
      }
  EXPECT_EQ(kept, 3);
}

TEST(ReducedPart, ReducedAgainKeepsTheFirstOriginal) {
  const test::Scratch scratch;
  auto parts = bars();
  writePart(reducedContent(contentOf(parts[0]), reduced(parts)[0]), scratch / "once.h5",
            FileKind::Hdf5);
  const auto once = readPart(scratch / "once.h5", "a");
  auto options = fourModes();
  options.modes.counts = {1};
  const auto basis = reduction::makeBasis("Craig-Bampton", Teuchos::ParameterList("Reduction"));
  const auto twice =
      reducedContent(once, reduction::reduceAll({once.part}, *basis, options).front());
  EXPECT_EQ(twice.basis.dofs, parts[0].model.dofs);
  EXPECT_EQ(twice.part.model.size(), 3);  // two kept dofs, one of four modes
  // D of the start is that of the original at kept dofs
  const Vector D = twice.basis.offset + twice.basis.vectors * twice.part.model.initialDisplacement;
  for (int i = 0; i < parts[0].model.size(); ++i) {
    const auto node = parts[0].model.dofs[static_cast<std::size_t>(i)].entity;
    if (node == 5 || node == 13) {
      EXPECT_NEAR(D[i], parts[0].model.initialDisplacement[i], 1e-16);
    }
  }
}

TEST(ReducedPart, WithoutInterfaceDofsIsRefused) {
  auto parts = bars();
  auto small = reduced(parts)[0];
  small.derivedInterface.emplace();
  EXPECT_THROW(reducedContent(contentOf(parts[0]), small), ModelError);
}

}  // namespace ReducedPartTest
}  // namespace tooljoint::parts
