// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Interior dofs without mass, with every registered basis: it has exact statics and finite
/// frequencies, or refuses with a message that names the part and a remedy.
#include <fstream>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "coupling/CoupledModes.hpp"
#include "io/MatrixMarket.hpp"
#include "linalg/Deterministic.hpp"
#include "reduction/ReductionMethod.hpp"
#include "tests/support/CoupledChecks.hpp"
#include "tests/support/SampleParts.hpp"

namespace MasslessInteriorTest {

using namespace tooljoint;

/// Bars in a chain held at its far end; three inner nodes of the second have no mass and no
/// coupling to the mass of their neighbours.
std::vector<model::Substructure> chain() {
  std::vector<model::Substructure> parts{samples::bar("upper", 1, 8, 3000.0, 2.0, {1}),
                                         samples::bar("middle", 9, 8, 3000.0, 2.0),
                                         samples::bar("lower", 17, 8, 3000.0, 2.0)};
  samples::classify(parts[0], {9});
  samples::classify(parts[1], {9, 17});
  samples::classify(parts[2], {17});
  auto& m = parts[1].model;
  Triplets entries;
  const auto massless = [&](Eigen::Index i) { return i >= 3 && i <= 5; };
  for (int i = 0; i < m.size(); ++i)
    for (model::SharedSparse::InnerIterator it(m.mass, i); it; ++it)
      if (!massless(i) && !massless(it.col()))
        entries.emplace_back(i, static_cast<int>(it.col()), it.value());
  m.mass = samples::square(m.size(), entries);
  return parts;
}

/// Complex modes need the mass of every interior dof.
bool works(const std::string& basis) { return basis != "Complex Craig-Bampton"; }

void expectExact(const std::string& basis, int modes, const std::vector<model::Substructure>& parts,
                 const model::SecondOrderModel& small) {
  const auto full = coupling::couple(parts);
  EXPECT_TRUE(Matrix(small.mass).allFinite() && Matrix(small.stiffnessAt(0)).allFinite());
  // Tied coordinates of Enhanced Craig-Bampton do not give exact statics.
  const bool promised = basis != "Enhanced Craig-Bampton" || modes < 0;
  EXPECT_LE(checks::staticError(full, small), promised ? 1e-9 : 0.05);
  const Vector exact = coupling::lowestModes(full, 3).values,
               found = coupling::lowestModes(small, 3).values;
  ASSERT_EQ(found.size(), 3);
  // With four arbitrary vectors, or four masters instead of modes, frequencies are only bounded
  // from above.
  const bool all = modes < 0 && basis != "User Vectors";
  const double room = all ? 1e-9 : basis == "Guyan" || basis == "User Vectors" ? 10.0 : 0.01;
  for (Eigen::Index k = 0; k < 3; ++k) {
    EXPECT_LE(found[k], (1 + room) * exact[k]) << "frequency " << k + 1;
    EXPECT_GE(found[k], (1 - 1e-9) * exact[k]) << "frequency " << k + 1;
  }
}

class MasslessInterior : public testing::TestWithParam<std::string> {};

TEST_P(MasslessInterior, WorksOrIsRefusedWithASentence) {
  const auto parts = chain();
  for (const auto& part : parts)
    std::ofstream("massless " + part.name + ".mtx")
        << io::matrixMarketText(linalg::scatteredNumbers(part.model.size(), 4, 5));
  for (const int modes : {4, -1}) {
    std::string refusal;
    try {
      const auto synthesis =
          checks::synthesise(parts, GetParam(), modes, [](Teuchos::ParameterList& list) {
            if (GetParam() == "User Vectors") list.set("File", "massless %.mtx");
          });
      expectExact(GetParam(), modes, parts, synthesis.coupled.model);
    } catch (const ModelError& error) {
      refusal = error.what();
      EXPECT_NE(refusal.find("Part \"middle\""), std::string::npos) << refusal;
      EXPECT_NE(refusal.find("mass"), std::string::npos) << refusal;
    }
    EXPECT_EQ(refusal.empty(), works(GetParam()))
        << GetParam() << ", " << modes << " modes: " << refusal;
  }
}

/// The finite modes are complete; the reduced model is not singular.
TEST(MasslessInteriorModes, FiniteOnesAreComplete) {
  const auto parts = chain();
  const auto synthesis = checks::synthesise(parts, "Craig-Bampton", -1);
  EXPECT_EQ(synthesis.parts[1].modes, 4) << "seven interior dofs, three of them without mass";
  EXPECT_TRUE(synthesis.parts[1].basis->complete);
  EXPECT_GT(synthesis.parts[1].report.explicitStep, 0);
  EXPECT_EQ(synthesis.parts[0].modes, 7);
}

/// Frame members whose middle nodes have no mass: the modes contain the full response to interface
/// forces, and a residual flexibility of rounding must not affect a frequency.
TEST(MasslessInteriorModes, OfForcesBetweenPartsLeaveNoFlexibility) {
  auto parts = samples::loopFrame(6, false);
  for (auto& part : parts) {
    auto& m = part.model;
    const auto middle = [&](Eigen::Index i) {
      return m.dofs[static_cast<std::size_t>(i)].entity % 100 == 3 &&
             m.dofs[static_cast<std::size_t>(i)].entity > 100;
    };
    Triplets entries;
    for (int i = 0; i < m.size(); ++i)
      for (model::SharedSparse::InnerIterator it(m.mass, i); it; ++it)
        if (!middle(i) && !middle(it.col()))
          entries.emplace_back(i, static_cast<int>(it.col()), it.value());
    m.mass = samples::square(m.size(), entries);
  }
  const auto full = coupling::couple(parts);
  const auto synthesis = checks::synthesise(parts, "Dual Craig-Bampton", -1);
  const Vector exact = coupling::lowestModes(full, 20).values,
               found = coupling::lowestModes(synthesis.coupled.model, 20).values;
  ASSERT_EQ(found.size(), exact.size());
  EXPECT_LT((found - exact).cwiseQuotient(exact).cwiseAbs().maxCoeff(), 1e-10);
}

/// A part with boundary dofs only, one of them without mass: its reduced mass is singular, and
/// implicit integrators condense it.
TEST(MasslessBoundary, PassesThrough) {
  std::vector<model::Substructure> parts{samples::bar("upper", 1, 8, 3000.0, 2.0, {1}),
                                         samples::bar("joint", 9, 2, 3000.0, 2.0)};
  samples::classify(parts[0], {9});
  samples::classify(parts[1], {9}, {10, 11});
  auto& m = parts[1].model;
  Triplets entries;
  for (int i = 0; i < m.size(); ++i)
    for (model::SharedSparse::InnerIterator it(m.mass, i); it; ++it)
      if (m.dofs[static_cast<std::size_t>(i)].entity != 10 &&
          m.dofs[static_cast<std::size_t>(it.col())].entity != 10)
        entries.emplace_back(i, static_cast<int>(it.col()), it.value());
  m.mass = samples::square(m.size(), entries);
  const auto synthesis = checks::synthesise(parts, "Craig-Bampton", -1);
  const auto& report = synthesis.parts[1].report;
  ASSERT_EQ(report.remarks.size(), 1u);
  EXPECT_NE(report.remarks[0].find("implicit integrators only"), std::string::npos)
      << report.remarks[0];
  const auto full = coupling::couple(parts);
  const Vector exact = coupling::lowestModes(full, 5).values,
               found = coupling::lowestModes(synthesis.coupled.model, 5).values;
  EXPECT_LT((found - exact).cwiseAbs().maxCoeff(), 1e-9 * exact.maxCoeff());
}

/// The bar with a second component at every node, the twist of a shaft: stiffness as the bar, and
/// `inertia` times its mass.
model::Substructure withTwist(const model::Substructure& bar, double inertia) {
  auto out = bar;
  auto& m = out.model;
  m.componentNames = {"u", "theta_x"};
  m.dofs.clear();
  for (const auto& label : bar.model.dofs)
    for (int c = 0; c < 2; ++c) m.dofs.push_back(model::DofLabel::physical(label.entity, c));
  const auto twice = [](const Sparse& A, double factor) {
    Triplets entries;
    for (int i = 0; i < A.rows(); ++i)
      for (Sparse::InnerIterator it(A, i); it; ++it) {
        entries.emplace_back(2 * i, 2 * it.col(), it.value());
        if (factor > 0) entries.emplace_back(2 * i + 1, 2 * it.col() + 1, factor * it.value());
      }
    return samples::square(2 * static_cast<int>(A.rows()), entries);
  };
  m.mass = twice(Sparse(bar.model.mass), inertia);
  m.stiffness = {{"elastic", twice(bar.model.stiffnessAt(0), 1.0), 0}};
  samples::complete(out);
  return out;
}

/// A free bar without inertia about its axis twists as a whole without mass and stiffness: singular
/// alone, regular with a neighbour, and without effect on the torsional frequencies of the
/// neighbour.
TEST(MasslessPart, AFreeMotionWithoutMassIsForTheNeighboursToHold) {
  const auto upper = samples::bar("upper", 1, 8, 3000.0, 2.0, {1});
  std::vector<model::Substructure> parts{withTwist(upper, 0.5),
                                         withTwist(samples::bar("light", 9, 4, 3000.0, 2.0), 0.0)};
  for (auto& part : parts) samples::classify(part, {9});
  for (const int modes : {2, -1}) {
    const auto synthesis = checks::synthesise(parts, "Craig-Bampton", modes);
    const auto& remarks = synthesis.parts[1].report.remarks;
    ASSERT_EQ(remarks.size(), 1u);
    EXPECT_NE(remarks[0].find("theta_x of node "), std::string::npos) << remarks[0];
    EXPECT_NE(remarks[0].find("has neither mass nor stiffness. Its neighbours"), std::string::npos)
        << remarks[0];
    EXPECT_EQ(synthesis.parts[1].report.zeroEnergyFull, -1) << "not counted";
    EXPECT_TRUE(synthesis.parts[0].report.remarks.empty());
    if (modes > 0) continue;
    const auto full = coupling::couple(parts);
    const Vector exact = coupling::lowestModes(full, 12).values,
                 found = coupling::lowestModes(synthesis.coupled.model, 12).values;
    EXPECT_LT((found - exact).cwiseAbs().maxCoeff(), 1e-9 * exact.maxCoeff());
    const Vector twist = checks::eigenvalues(upper.model) / 0.5;
    for (Eigen::Index k = 0; k < 3; ++k)
      EXPECT_LT((found.array() / twist[k] - 1.0).abs().minCoeff(), 1e-9) << "twist " << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Reduction, MasslessInterior,
                         testing::ValuesIn(reduction::MethodRegistry::instance().names()),
                         [](const auto& basis) {
                           std::string name;
                           for (const char c : basis.param)
                             if (std::isalnum(static_cast<unsigned char>(c))) name += c;
                           return name;
                         });

TEST(MasslessInteriorLoad, ALoadThatNoBasisFollowsIsRefused) {
  for (bool damped : {false, true}) {
    auto parts = chain();
    auto& m = parts[1].model;
    const int size = m.size();
    Matrix M = m.mass, K = m.stiffnessAt(0), C = Matrix::Zero(size, size);
    K.row(4).setZero(), K.col(4).setZero();
    if (damped) C(4, 4) = 7.0;
    m.mass = Sparse(M.sparseView());
    m.stiffness = {{"elastic", Sparse(K.sparseView()), 0}};
    m.damping = {{"dampers", Sparse(C.sparseView()), 0}};
    m.loads = {{"push", Vector::Unit(size, 4), 0}};
    try {
      checks::synthesise(parts, "Craig-Bampton", 2);
      ADD_FAILURE() << "the load is lost";
    } catch (const ModelError& error) {
      const std::string said = error.what();
      EXPECT_NE(said.find("middle"), std::string::npos) << said;
      EXPECT_NE(said.find("neither mass nor stiffness"), std::string::npos) << said;
    }
  }
}

}  // namespace MasslessInteriorTest
