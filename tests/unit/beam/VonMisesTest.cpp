// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/beam/VonMises.hpp"

#include <cmath>
#include <gtest/gtest.h>

using namespace tooljoint::beam;

namespace {

TEST(VonMises, IsTheAxialStressTheBendingStressOrTheShearOfAPipe) {
  const Section pipe = Section::hollow(0.0635, 0.0543, Material{});
  EXPECT_DOUBLE_EQ(vonMises(pipe, -1e5, 0.0, 0.0), 1e5 / pipe.area());
  EXPECT_DOUBLE_EQ(vonMises(pipe, 0.0, 0.0, 1e-3), 2.1e11 * 1e-3 * 0.0635) << "at the outer wall";
  EXPECT_NEAR(vonMises(pipe, 0.0, 5e3, 0.0), std::sqrt(3.0) * 5e3 * 0.0635 / pipe.torsion(), 1e-6);
  EXPECT_DOUBLE_EQ(vonMises(pipe, 1e5, 5e3, 1e-3),
                   std::hypot(1e5 / pipe.area() + 2.1e11 * 1e-3 * 0.0635,
                              std::sqrt(3.0) * 5e3 * 0.0635 / pipe.torsion()));
}

}  // namespace
