// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The string bent into straight, arced and helical wells, against the theory of a bent elastic
/// rod.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "common/Constants.hpp"
#include "substructures/beam/Timoshenko.hpp"
#include "substructures/path/PathProblem.hpp"
#include "substructures/well/Frames.hpp"
#include "tests/support/DirectNewton.hpp"
#include "tests/support/JacobianDifference.hpp"
#include "tests/support/NoxBinding.hpp"

namespace tooljoint::path {
namespace PathTest {

using constants::pi;

beam::Section pipe() {
  return beam::Section::hollow(0.0635, 0.054, beam::Material{7900.0, 2.03e11, 0.3}).withoutShear();
}
beam::Section collar() {
  return beam::Section::hollow(0.0795, 0.0355, beam::Material{7900.0, 2.03e11, 0.3}).withoutShear();
}

std::vector<std::shared_ptr<const beam::Element>> chain(int elements, double length,
                                                        const beam::Section& section) {
  return {static_cast<std::size_t>(elements), std::make_shared<beam::Timoshenko>(section, length)};
}

PathInput uniform(const well::Trajectory& well, int elements, double length) {
  PathInput input;
  input.elements = chain(elements, length / elements, pipe());
  input.trajectory = &well;
  return input;
}

std::unique_ptr<well::Trajectory> quarterArc(double radius) {
  well::ArcShape shape;
  shape.radius = radius;
  shape.endInclination = 0.5 * pi;
  return well::arc(shape);
}

beam::Section thick() {
  return beam::Section::general(1.0, 0.3, 0.5, 0.4, beam::Material{1.0, 10.0, 0.2});
}

PathOptions options(Mode mode, Prestress prestress = Prestress::FullTangent) {
  PathOptions out;
  out.mode = mode;
  out.prestress = prestress;
  return out;
}

TEST(Path, StraightWellNeedsNoForces) {
  // rounding of positions of 100 m strains an element of E S/l = 7e8 N/m by 1e-5 N
  const auto inclined = well::straight(100.0, 0.6, 0.4);
  const PathState centre =
      computePath(uniform(*inclined, 50, 100.0), options(Mode::CentreLine), testing_::directNewton);
  EXPECT_LT(centre.reaction.cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_LT(centre.axialForce.cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_LT(centre.torque.cwiseAbs().maxCoeff(), 1e-6);
  const auto vertical = well::straight(100.0);
  const PathState imposed = computePath(uniform(*vertical, 50, 100.0), options(Mode::ImposedNodes),
                                        testing_::directNewton);
  EXPECT_LT(imposed.reaction.cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT(imposed.report.maxPositionError, 1e-12);
}

TEST(Path, PlanarArcAwayFromItsEnds) {
  // M = E I kappa, F = -E I kappa^2, guide reaction E I kappa^3 per length towards the centre; h
  // kappa = 0.01, so the polygon deviates by (h kappa)^2 ~ 1e-4
  const double radius = 100.0;
  const auto well = quarterArc(radius);
  const PathInput input = uniform(*well, 100, 100.0);
  const std::vector<Matrix3> frames = well::bishopFrames(*well, [] {
    std::vector<double> s;
    for (int i = 0; i <= 100; ++i) s.push_back(i);
    return s;
  }());
  std::vector<double> depths;
  for (int i = 0; i <= 100; ++i) depths.push_back(i);
  const CentreLineProblem problem(input, depths, frames);
  Vector x = problem.start();
  model::SolveRequest request;
  request.search = model::LineSearch::None;
  ASSERT_TRUE(testing_::directNewton(problem, x, request).converged);
  const double rigidity = pipe().youngModulus() * pipe().inertiaX();
  const double kappa = 1.0 / radius;

  const auto responses = problem.responses(x, false);
  const auto moment = [&](int e) {
    const auto& r = responses[static_cast<std::size_t>(e)];
    return rigidity * (r.rotation2 - r.rotation1).norm() / input.elements[0]->length();
  };
  EXPECT_NEAR(moment(50) / (rigidity * kappa), 1.0, 1e-4);
  const PathState state = computePath(input, options(Mode::CentreLine), testing_::directNewton);
  EXPECT_NEAR(state.axialForce(50) / (-rigidity * kappa * kappa), 1.0, 5e-4);
  EXPECT_LT(state.torque.cwiseAbs().maxCoeff(), 1e-6);
  // R_ipa is minus the guide's force: away from the centre
  const Vector3 towardsCentre =
      state.frame[50].transpose() * well->at(state.arcLength[50]).curvature.normalized();
  EXPECT_NEAR(state.reaction.col(50).head<3>().dot(towardsCentre) /
                  (-rigidity * std::pow(kappa, 3) * input.elements[0]->length()),
              1.0, 5e-3);
  EXPECT_LT(state.reaction.col(50).tail<3>().norm(), 1e-3);
  EXPECT_LT(state.report.maxPositionError, 1e-10);
}

TEST(Path, EndCouplesAlternateAndDecay) {
  // three-moment equation M_{i-1} + 4 M_i + M_{i+1} = 6 E I kappa with M_0 = 0: the deviation from
  // E I kappa goes down by
  // -(2 - sqrt 3) = -0.268 from node to node
  const auto well = quarterArc(100.0);
  const PathInput input = uniform(*well, 60, 60.0);
  std::vector<double> depths;
  for (int i = 0; i <= 60; ++i) depths.push_back(i);
  const CentreLineProblem problem(input, depths, well::bishopFrames(*well, depths));
  Vector x = problem.start();
  model::SolveRequest request;
  request.search = model::LineSearch::None;
  ASSERT_TRUE(testing_::directNewton(problem, x, request).converged);
  const auto responses = problem.responses(x, false);
  const double whole = pipe().youngModulus() * pipe().inertiaX() / 100.0;
  const auto deviation = [&](std::size_t node) {
    return responses[node].force.segment<3>(3).norm() -
           whole;  // moment at the upper end of the element below the node
  };
  EXPECT_NEAR(deviation(0) / whole, -1.0, 1e-6);
  for (std::size_t node = 1; node < 4; ++node)
    EXPECT_NEAR(deviation(node) / deviation(node - 1), -(2.0 - std::sqrt(3.0)), 0.01) << node;
}

TEST(Path, ReactionsFormACoupleWhereTheStiffnessJumps) {
  // the bending moment jumps from E I_1 kappa to E I_2 kappa, so the guide exerts a couple of the
  // difference there
  const auto well = quarterArc(100.0);
  PathInput input = uniform(*well, 80, 80.0);
  const auto lower = chain(40, 1.0, collar());
  std::copy(lower.begin(), lower.end(), input.elements.begin() + 40);
  const PathState state = computePath(input, options(Mode::CentreLine), testing_::directNewton);
  double couple = 0.0;
  for (int node = 28; node <= 52; ++node) {
    const Vector3 normal =
        state.frame[static_cast<std::size_t>(node)].transpose() *
        well->at(state.arcLength[static_cast<std::size_t>(node)]).curvature.normalized();
    couple += (node - 40) * state.reaction.col(node).head<3>().dot(normal);
  }
  const double jump = (collar().inertiaX() - pipe().inertiaX()) * pipe().youngModulus() / 100.0;
  EXPECT_NEAR(std::abs(couple) / jump, 1.0, 0.02);
  EXPECT_GT(state.reaction.col(40).norm() + state.reaction.col(41).norm(),
            100.0 * state.reaction.col(20).norm());
}

TEST(Path, OnlyTheFullTangentLetsACurvedStringTurnAboutItsAxis) {
  // theta_z = 1 at all nodes: the energy of a straight rod bent into an arc does not change, while
  // K_a + K_g gives E I kappa^2 L
  const double kappa = 0.01;
  const auto well = quarterArc(1.0 / kappa);
  const double length = 100.0;
  const PathInput input = uniform(*well, 100, length);
  const PathState state = computePath(input, options(Mode::CentreLine), testing_::directNewton);
  beam::Vector12 turn = beam::Vector12::Zero();
  turn(5) = turn(11) = 1.0;
  double full = 0.0;
  double geometric = 0.0;
  for (std::size_t e = 0; e < 100; ++e) {
    const auto n = static_cast<int>(e);
    full += turn.dot(state.tangent[e] * turn);
    const beam::Matrix12 r =
        beam::rotation12(state.elementFrame[e], state.frame[e], state.frame[e + 1]);
    const beam::Matrix12 k = beam::stiffness(pipe(), 1.0) +
                             state.axialForce(n) * beam::geometricAxial(1.0) +
                             state.torque(n) * beam::geometricTorque(1.0);
    geometric += (r * turn).dot(k * (r * turn));
  }
  const double charge = pipe().youngModulus() * pipe().inertiaX() * kappa * kappa * length;
  EXPECT_NEAR(geometric / charge, 1.0, 0.02);
  EXPECT_LT(std::abs(full), 0.02 * charge);
  EXPECT_TRUE(computePath(input, options(Mode::CentreLine, Prestress::AxialAndTorque),
                          testing_::directNewton)
                  .tangent.empty());
}

TEST(Path, HelixIsFreeOfTorque) {
  const auto well = well::helix(85.1, 0.5 * pi, 170.2);
  const PathState state =
      computePath(uniform(*well, 170, 170.2), options(Mode::CentreLine), testing_::noxNewton);
  const double rigidity = pipe().youngModulus() * pipe().inertiaX();
  const double kappa = well->at(50.0).curvature.norm();
  EXPECT_NEAR(state.axialForce(85) / (-rigidity * kappa * kappa), 1.0, 0.01);
  EXPECT_LT(state.torque.cwiseAbs().maxCoeff(), 1e-4 * rigidity * kappa);
  EXPECT_LE(state.report.iterations, 6);
}

TEST(Path, JacobianOfTheCentreLineIsExact) {
  const auto well = well::helix(8.0, 1.2, 14.0);
  PathInput input = uniform(*well, 6, 12.0);
  input.elements = chain(6, 2.0, thick());
  std::vector<double> depths{0, 2, 4, 6, 8, 10, 12};
  const CentreLineProblem problem(input, depths, well::bishopFrames(*well, depths));
  std::srand(7);
  const Vector x = problem.start() + 0.2 * Vector::Random(problem.size());
  EXPECT_LT(testing_::jacobianError(problem, x, 1e-6), 1e-7);
  EXPECT_EQ(problem.unknownName(0), "theta_x of node 1");
  EXPECT_EQ(problem.unknownName(2), "depth of node 2");
}

TEST(Path, JacobianOfImposedNodesIsExact) {
  const auto well = well::helix(8.0, 1.2, 14.0);
  PathInput input = uniform(*well, 6, 12.0);
  input.elements = chain(6, 2.0, thick());
  std::srand(8);
  ImposedNodesProblem problem(input, {3, 6});
  problem.accept(problem.start() + 0.2 * Vector::Random(problem.size()));
  const Vector x = problem.start() + 0.2 * Vector::Random(problem.size());
  EXPECT_LT(testing_::jacobianError(problem, x, 1e-6), 1e-7);
  EXPECT_EQ(problem.unknownName(2), "X of node 2");
}

TEST(Path, ImposedNodesReachTheWellAndStrayBetween) {
  const auto well = well::helix(85.1, 0.5 * pi, 170.2);
  const PathInput input = uniform(*well, 170, 170.2);
  PathOptions asked = options(Mode::ImposedNodes);
  const PathState nine = computePath(input, asked, testing_::noxNewton);
  EXPECT_GE(nine.report.increments, 10);
  EXPECT_GT(nine.report.maxPositionError, 0.1);
  EXPECT_LT(nine.report.maxPositionError, 0.4);
  EXPECT_LT((nine.position[0] - well->at(0.0).position).norm(), 1e-12);
  const Vector3 target = well->at(170.2).position;
  EXPECT_LT((nine.position.back() - target).head<2>().norm(), 1e-8);
  EXPECT_LT(std::abs(nine.position.back().z() - target.z()), 0.1);  // Z is free

  // more imposed nodes keep the string closer, and other increments do not change the result
  asked.nodeCount = 18;
  asked.increments = 20;
  EXPECT_LT(computePath(input, asked, testing_::noxNewton).report.maxPositionError,
            0.5 * nine.report.maxPositionError);
  asked.nodeCount = 9;
  const PathState slower = computePath(input, asked, testing_::noxNewton);
  EXPECT_GE(slower.report.increments, 20);
  EXPECT_LT((slower.position[100] - nine.position[100]).norm(), 1e-6);
  asked.nodes = {1, 60, 120, 171};
  EXPECT_GT(computePath(input, asked, testing_::noxNewton).report.maxPositionError,
            nine.report.maxPositionError);
}

TEST(Path, ImpossibleRequestsAreRefused) {
  const auto well = well::straight(100.0);
  PathOptions asked = options(Mode::ImposedNodes);
  asked.nodes = {1, 52};
  EXPECT_THROW(computePath(uniform(*well, 50, 100.0), asked, testing_::directNewton), ModelError);
  EXPECT_THROW(computePath(PathInput{}, asked, testing_::directNewton), ModelError);
  const auto helix = well::helix(85.1, 0.5 * pi, 170.2);
  PathOptions hasty = options(Mode::CentreLine);
  hasty.maxIterations = 1;
  hasty.tolerance = 1e-14;
  EXPECT_THROW(computePath(uniform(*helix, 170, 170.2), hasty, testing_::directNewton),
               ConvergenceError);
}

}  // namespace PathTest
}  // namespace tooljoint::path
