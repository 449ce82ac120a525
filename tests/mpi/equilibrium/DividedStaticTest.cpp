// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A static state divided among ranks equals that of one rank: rows, tangents, factors, solutions,
/// decisions and failures. On one rank nothing is divided, and the same must hold.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Parallel.hpp"
#include "linalg/chains/DividedChain.hpp"
#include "linalg/trilinos/TpetraConversion.hpp"
#include "statics/DividedProblem.hpp"
#include "statics/NoxSolver.hpp"
#include "substructures/beam/Timoshenko.hpp"
#include "substructures/contact/ContactLaw.hpp"
#include "substructures/equilibrium/Equilibrium.hpp"
#include "tests/support/NoxBinding.hpp"

namespace tooljoint::equilibrium {
namespace DividedStaticTest {

constexpr int elements = 700;
constexpr double length = 3.0;

/// Pipe in a straight hole inclined by 30 degrees that turns: it lies on the wall and is twisted by
/// the friction there; held at the top.
StaticInput string(bool held = true) {
  const auto section = beam::Section::hollow(0.0635, 0.054, {7850.0, 2.06e11, 0.3});
  const double weight = 7850.0 * section.area() * 9.81 * length;
  StaticInput input;
  input.nodes = elements + 1;
  contact::ContactPoints points;
  input.load = Vector::Zero(6 * input.nodes);
  for (int e = 0; e < elements; ++e) {
    StaticElement element;
    element.formulation = std::make_shared<beam::Timoshenko>(section, length);
    element.stiffness = element.formulation->stiffness();
    element.rotation.setIdentity();
    element.slopes.setIdentity();
    input.elements.push_back(element);
    for (const int node : {e, e + 1}) {
      input.load(6 * node) += 0.25 * weight;
      input.load(6 * node + 2) += 0.433 * weight;
    }
  }
  for (int node = 2; node <= input.nodes; ++node) {
    contact::ContactPoint p;
    p.node = node;
    p.clearance = 0.02 + (node % 5 == 0 ? 0.002 : 0.0);
    p.contactRadius = 0.08;
    p.stiffness = 1e6;
    p.lambdaK = p.lambdaC = 1e6;
    p.muStatic = 0.3;
    p.muDynamic = 0.2;
    points.add(p);
  }
  input.contact = contact::makeLaw("Clamped")->atRest(points);
  input.held.assign(at(6 * input.nodes), 0);
  for (std::size_t i = 0; i < 6; ++i) input.held[i] = held || i < 2 ? 1 : 0;
  return input;
}

model::NonlinearSolver divided() { return statics::noxSolver(Teuchos::ParameterList("Static")); }

/// Displacements of a spatial string, large enough for contact at many points.
Vector waves(int size) {
  Vector x(size);
  for (int i = 0; i < size; ++i) x[i] = (i % 6 < 2 ? 0.025 : 1e-3) * std::sin(0.37 * i);
  return x;
}

bool isSameOnAllRanks(const Vector& mine) {
  Vector first = mine;
  parallel::broadcast(first);
  return parallel::maximum(first == mine ? 0.0 : 1.0) == 0.0;
}
bool isSameOnAllRanks(const std::string& mine) {
  std::string first = mine;
  parallel::broadcast(first);
  return parallel::maximum(first == mine ? 0.0 : 1.0) == 0.0;
}

TEST(DividedStatic, rowsAreThoseOfTheWholeBitByBit) {
  const auto input = string();
  StaticProblem problem(input);
  const Vector x = waves(problem.size());
  Vector whole, some;
  Sparse wholeJacobian, someJacobian;
  problem.residual(x, whole);
  problem.jacobian(x, wholeJacobian);
  const auto first = problem.firstOfNodes();
  ASSERT_EQ(sizeOf(first), input.nodes);  // that at the top is held
  for (const auto& [begin, end] : {std::pair(0, 200), std::pair(200, 500), std::pair(500, 700)}) {
    const RowRange rows{first[at(begin)], first[at(end)]};
    problem.residualRows(x, rows, some);
    problem.jacobianRows(x, rows, someJacobian);
    for (int i = rows.begin; i < rows.end; ++i) {
      EXPECT_EQ(some[i], whole[i]) << i;
      EXPECT_EQ((someJacobian.row(i) - wholeJacobian.row(i)).norm(), 0.0) << i;
    }
    const int other = begin == 0 ? first[600] : first[at(begin)] - 12;
    EXPECT_NE(some[other], whole[other]) << "rows of others are not evaluated";
  }
}

TEST(DividedStatic, residualsTangentsAndSolutionsAreThoseOfOneRank) {
  const auto input = string();
  StaticProblem problem(input);
  const auto shared = statics::DividedProblem::of(problem);
  EXPECT_EQ(shared == nullptr, parallel::size() == 1);
  if (!shared) return;
  const Vector x = waves(problem.size());
  Vector one, all;
  problem.residual(x, one);
  shared->residual(x, all);
  EXPECT_EQ(one, all);
  Sparse J, mine;
  problem.jacobian(x, J);
  shared->jacobianRows(x, mine);
  linalg::DividedChain chain(shared->sharedShare(), mine);
  const auto map = linalg::serialMap(problem.size());
  const auto from = linalg::toTpetra(Matrix(x), map), to = linalg::toTpetra(Matrix(one), map);
  linalg::toTpetra(J, map)->apply(*from, *to);
  EXPECT_EQ(chain.multiply(mine, x), linalg::toEigen(*to)) << "bit by bit";
  EXPECT_TRUE(chain.suits());
  EXPECT_TRUE(chain.factor(mine));
  linalg::ChainFactor direct(J);
  EXPECT_TRUE(direct.factor(J));
  Matrix b(problem.size(), 2);
  b << x, one;
  const Matrix found = chain.solve(b);
  for (int j = 0; j < 2; ++j) {
    Vector expected = b.col(j);
    direct.solve(expected.data());
    EXPECT_EQ(Vector(found.col(j)), expected) << "bit by bit";
    EXPECT_TRUE(isSameOnAllRanks(found.col(j)));
  }
  EXPECT_GT(chain.resistance(mine), 1e-14);
  EXPECT_FALSE(chain.factor(mine, parallel::rank() == 1)) << "a failure on one rank is one of all";
  EXPECT_TRUE(chain.factor(mine));
  shared->share().gatherRows(mine);
  EXPECT_EQ((mine - J).norm(), 0.0);
}

TEST(DividedStatic, statesAreThoseOfOneRank) {
  const auto input = string();
  StaticOptions options;
  const auto one = solveStatic(input, options, testing_::noxNewton);
  const auto all = solveStatic(input, options, divided());
  EXPECT_EQ(all.report.iterations, one.report.iterations);
  ASSERT_EQ(all.report.stages.size(), one.report.stages.size());
  EXPECT_GT(one.contactNodes, elements / 2);
  EXPECT_EQ(all.contactNodes, one.contactNodes);
  EXPECT_GT(one.frictionTorque.cwiseAbs().sum(), 1e3);
  EXPECT_EQ(all.displacement, one.displacement) << "bit by bit";
  EXPECT_EQ(all.axialForce, one.axialForce);
  EXPECT_EQ(all.torque, one.torque);
  EXPECT_EQ(all.normalForce, one.normalForce);
  EXPECT_EQ(all.frictionTorque, one.frictionTorque);
  EXPECT_TRUE(isSameOnAllRanks(all.displacement));
}

TEST(DividedStatic, failuresEndOnAllRanksWithOneSentence) {
  const auto input = string();
  StaticOptions options;
  options.maxIterations = 2;
  const auto sentence = [&](const model::NonlinearSolver& solver) {
    try {
      solveStatic(input, options, solver);
    } catch (const ConvergenceError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto all = sentence(divided());
  EXPECT_NE(all.find("did not converge"), std::string::npos) << all;
  EXPECT_EQ(all, sentence(testing_::noxNewton));
  EXPECT_TRUE(isSameOnAllRanks(all));
}

/// A string without axial support: the factors of the whole report it, as on one rank.
TEST(DividedStatic, aFloatingStringIsNamedAsOnOneRank) {
  const auto input = string(false);
  StaticProblem problem(input);
  StaticSwitches switches;
  switches.contact = false;
  problem.set(switches);
  model::SolveRequest request;
  const auto solve = [&](const model::NonlinearSolver& solver) {
    Vector x = Vector::Zero(problem.size());
    return solver(problem, x, request);
  };
  const auto one = solve(testing_::noxNewton), all = solve(divided());
  EXPECT_FALSE(all.converged);
  EXPECT_NE(all.message.find("singular"), std::string::npos) << all.message;
  EXPECT_EQ(all.message, one.message);
}

/// An error in the rows of one rank is thrown on all.
class Refusing final : public model::ChainProblem {
 public:
  Refusing(const StaticProblem& problem, int unknown) : problem_(problem), unknown_(unknown) {}
  int size() const override { return problem_.size(); }
  void residual(const Vector& x, Vector& r) const override {
    refuse({0, size()}, x);
    problem_.residual(x, r);
  }
  void jacobian(const Vector& x, Sparse& J) const override { problem_.jacobian(x, J); }
  std::vector<int> firstOfNodes() const override { return problem_.firstOfNodes(); }
  void residualRows(const Vector& x, RowRange rows, Vector& r) const override {
    refuse(rows, x);
    problem_.residualRows(x, rows, r);
  }
  void jacobianRows(const Vector& x, RowRange rows, Sparse& J) const override {
    problem_.jacobianRows(x, rows, J);
  }
  Vector residualScale() const override { return problem_.residualScale(); }
  std::string unknownName(int i) const override { return problem_.unknownName(i); }

 private:
  void refuse(RowRange rows, const Vector& x) const {
    if (unknown_ >= rows.begin && unknown_ < rows.end && x.any())
      throw ModelError("Row " + std::to_string(unknown_) + " refuses.");
  }

  const StaticProblem& problem_;
  int unknown_;
};

TEST(DividedStatic, whatOneRankThrowsIsThrownOnAll) {
  const auto input = string();
  const StaticProblem problem(input);
  for (const int unknown : {5, problem.size() - 5}) {
    const Refusing refusing(problem, unknown);
    Vector x = Vector::Zero(problem.size());
    std::string sentence;
    try {
      divided()(refusing, x, {});
    } catch (const ModelError& error) {
      sentence = error.what();
    }
    EXPECT_EQ(sentence, "Row " + std::to_string(unknown) + " refuses.");
    EXPECT_TRUE(isSameOnAllRanks(sentence));
  }
}

TEST(DividedStatic, shortStringsAreNotDivided) {
  auto input = string();
  const int nodes = 100;
  input.nodes = nodes + 1;
  input.elements.resize(nodes);
  input.load = Vector(input.load.head(6 * input.nodes));
  input.held.resize(at(6 * input.nodes));
  input.contact = nullptr;
  const StaticProblem problem(input);
  EXPECT_EQ(statics::DividedProblem::of(problem), nullptr);
}

}  // namespace DividedStaticTest
}  // namespace tooljoint::equilibrium
