// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A part kept whole beside reduced parts: exact, sparse, with any basis.
#include "reduction/methods/WholePart.hpp"

#include <Teuchos_ParameterList.hpp>
#include <gtest/gtest.h>

#include "reduction/Reduce.hpp"
#include "tests/support/SampleParts.hpp"

namespace WholePartTest {

using namespace tooljoint;

TEST(WholePart, HasTheMatricesOfThePartInTheOrderOfItsKeptDofs) {
  const auto parts = samples::loopFrame(6, true);
  for (const char* name : {"Craig-Bampton", "Rubin", "Enhanced Craig-Bampton"}) {
    reduction::ReductionOptions options;
    options.basis = name;
    options.modes.kind = reduction::ModeRule::Kind::PerPart;
    options.modes.counts.assign(parts.size(), 2);
    options.modes.counts[1] = reduction::ModeRule::whole;
    const auto reduced =
        reduction::reduceAll(parts, *reduction::makeBasis(name, Teuchos::ParameterList()), options);
    const auto& part = parts[1].model;
    const auto& whole = reduced[1];
    ASSERT_TRUE(reduction::isWhole(*whole.basis)) << name;
    EXPECT_FALSE(reduction::isWhole(*reduced[0].basis)) << name;
    EXPECT_EQ(whole.size(), part.size());
    EXPECT_EQ(whole.modes, 0);
    EXPECT_EQ(whole.interface, static_cast<int>(parts[1].interface.size()));
    const auto& order = whole.basis->partition.boundary;
    const Sparse K = reduction::block(reduction::constantStiffness(part), order, order);
    EXPECT_EQ(Matrix(whole.model.mass), Matrix(reduction::block(part.mass, order, order))) << name;
    EXPECT_LE((Matrix(reduction::constantStiffness(whole.model)) - Matrix(K)).cwiseAbs().maxCoeff(),
              1e-12 * Matrix(K).cwiseAbs().maxCoeff());
    EXPECT_LE(reduction::constantStiffness(whole.model).nonZeros(), K.nonZeros())
        << "no entries are added";
    for (std::size_t i = 0; i < order.size(); ++i)
      EXPECT_TRUE(whole.model.dofs[i] == part.dofs[static_cast<std::size_t>(order[i])]);
  }
}

}  // namespace WholePartTest
