// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Elements by name, their response at large displacements, and dofs of only some elements.
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "substructures/beam/Element.hpp"
#include "substructures/beam/Timoshenko.hpp"

namespace tooljoint::beam {
namespace ElementsTest {

const Section pipe = Section::hollow(0.06, 0.05, Material{});

/// A shaft: torsion alone.
class Shaft : public Timoshenko {
 public:
  using Timoshenko::Timoshenko;
  DofMap dofs() const override { return {false, false, false, false, false, true}; }
};

TEST(Elements, TheRegistryMakesTheElementOfTheDeck) {
  const auto element = ElementChoice().make(pipe, 2.5);
  EXPECT_EQ(element->length(), 2.5);
  EXPECT_EQ(element->section().outerRadius(), 0.06);
  EXPECT_EQ(element->stiffness(), stiffness(pipe, 2.5));
  EXPECT_EQ(element->mass(), mass(pipe, 2.5));
  EXPECT_EQ(element->damping(), Matrix12::Zero());
  ElementChoice unknown;
  unknown.name = "Timoshenk";
  EXPECT_THROW(unknown.make(pipe, 2.5), DeckError);
}

TEST(Elements, TheResponseAtRestIsTheStiffness) {
  const Timoshenko element(pipe, 1.5);
  const ElementPose rest{
      Vector3::Zero(), {0.0, 0.0, 1.5}, Matrix3::Identity(), Matrix3::Identity()};
  const CorotationalResponse response = element.response(rest, true);
  EXPECT_EQ(response.force, Vector12::Zero());
  EXPECT_LT((response.tangent - element.stiffness()).norm(), 1e-12 * element.stiffness().norm());
}

/// Possible errors of an element outside the library, one after the other.
struct Faulty : Timoshenko {
  static inline int fault = 0;
  using Timoshenko::Timoshenko;
  Matrix12 stiffness() const override {
    Matrix12 K = Timoshenko::stiffness();
    if (fault == 1) K(1, 3) *= 1.01;
    if (fault == 3) K(0, 0) += 1.0, K(6, 6) += 1.0;
    return K;
  }
  Matrix12 mass() const override {
    Matrix12 M = Timoshenko::mass();
    if (fault == 2) M(0, 4) += 1e-3;
    return M;
  }
};
const bool faultyRegistered = addElement<Faulty>("Faulty", "a beam with a fault.");

TEST(Elements, FaultyOnesAreRefused) {
  ElementChoice choice;
  choice.name = "Faulty";
  const char* said[] = {"", "a stiffness that is not symmetric", "a mass that is not symmetric",
                        "resists a rigid motion in u"};
  for (Faulty::fault = 0; Faulty::fault < 4; ++Faulty::fault) try {
      choice.make(pipe, 2.5);
      EXPECT_EQ(Faulty::fault, 0);
    } catch (const ModelError& error) {
      EXPECT_NE(std::string(error.what()).find(said[Faulty::fault]), std::string::npos)
          << error.what();
    }
}

TEST(Elements, NodesHaveTheDofsOfTheElementsTheyJoin) {
  const auto beam = std::make_shared<Timoshenko>(pipe, 1.0);
  const auto shaft = std::make_shared<Shaft>(pipe, 1.0);
  const auto nodes = nodalDofs({shaft, shaft, beam});
  const DofMap all = beam->dofs(), torsion = shaft->dofs();
  ASSERT_EQ(nodes.size(), 4U);
  EXPECT_EQ(nodes[0], torsion);
  EXPECT_EQ(nodes[1], torsion);
  EXPECT_EQ(nodes[2], all);
  EXPECT_EQ(nodes[3], all);
  EXPECT_EQ(nodalDofs({shaft})[1], torsion);
}

}  // namespace ElementsTest
}  // namespace tooljoint::beam
