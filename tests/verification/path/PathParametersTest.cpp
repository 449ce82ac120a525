// SPDX-License-Identifier: BSD-3-Clause
#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <gtest/gtest.h>

#include "substructures/path/Path.hpp"

namespace tooljoint::path {
namespace PathParametersTest {

TEST(PathParameters, AreReadAsTheyStandInTheDeck) {
  Teuchos::ParameterList list;
  list.set("Mode", std::string("Imposed nodes"));
  list.set("Pre-stress", std::string("Axial and torque"));
  list.set("Increments", 7);
  list.set("Node Count", 5);
  list.set("Nodes", Teuchos::Array<int>(Teuchos::tuple(1, 4, 9)));
  list.set("Tolerance", 1e-8);
  list.set("Max Iterations", 33);
  const PathOptions options = optionsFrom(list);
  EXPECT_EQ(options.mode, Mode::ImposedNodes);
  EXPECT_EQ(options.prestress, Prestress::AxialAndTorque);
  EXPECT_EQ(options.increments, 7);
  EXPECT_EQ(options.nodeCount, 5);
  EXPECT_EQ(options.nodes, (std::vector<int>{1, 4, 9}));
  EXPECT_EQ(options.tolerance, 1e-8);
  EXPECT_EQ(options.maxIterations, 33);
  // all parameters read are registered
  const deck::ListSpec spec = parameters();
  for (auto it = list.begin(); it != list.end(); ++it)
    EXPECT_NE(spec.findParameter(list.name(it)), nullptr) << list.name(it);
}

}  // namespace PathParametersTest
}  // namespace tooljoint::path
