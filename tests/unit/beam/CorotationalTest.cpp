// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The corotational element against finite differences, rigid motions and its own linear element.
#include "substructures/beam/Corotational.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <random>

#include "substructures/beam/Rotation.hpp"
#include "substructures/beam/Section.hpp"

namespace tooljoint::beam {
namespace CorotationalTest {

Vector3 randomVector(std::mt19937& generator, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  const double x = uniform(generator);
  const double y = uniform(generator);
  return {x, y, uniform(generator)};
}

Section lopsided() { return Section::general(2.0, 1.3, 0.9, 1.7, Material{1.0, 10.0, 0.3}); }

CorotationalElement bentAtRest() {
  return CorotationalElement(stiffness(lopsided(), 1.2), 1.2, rotationExponential({0.1, 0.2, 0.3}),
                             rotationExponential({0.2, 0.2, 0.3}),
                             rotationExponential({0.1, 0.1, 0.5}));
}

ElementPose deformed(std::mt19937& generator, double amplitude) {
  ElementPose pose;
  pose.position1 = randomVector(generator, 1.0);
  pose.triad1 = rotationExponential(randomVector(generator, 1.5));
  pose.triad2 = pose.triad1 * rotationExponential(randomVector(generator, amplitude));
  pose.position2 =
      pose.position1 +
      1.4 * (pose.triad1 * (Vector3::UnitZ() + randomVector(generator, 0.5 * amplitude)));
  return pose;
}

ElementPose moved(ElementPose pose, int dof, double by) {
  const Vector3 step = by * Vector3::Unit(dof % 3);
  if (dof / 3 == 0) pose.position1 += step;
  if (dof / 3 == 1) pose.triad1 = rotationExponential(step) * pose.triad1;
  if (dof / 3 == 2) pose.position2 += step;
  if (dof / 3 == 3) pose.triad2 = rotationExponential(step) * pose.triad2;
  return pose;
}

TEST(Rotation, ExponentialAndLogarithmAreInverse) {
  std::mt19937 generator(1);
  for (const double size : {1e-9, 1e-4, 0.019, 0.021, 0.5, 1.7}) {
    const Vector3 theta = randomVector(generator, size);
    const Matrix3 r = rotationExponential(theta);
    EXPECT_LT((r * r.transpose() - Matrix3::Identity()).norm(), 1e-14);
    EXPECT_LT((rotationLogarithm(r) - theta).norm(), 1e-14 + 1e-14 * size) << size;
    EXPECT_LT((spinFromRotationVector(theta) * rotationVectorFromSpin(theta) - Matrix3::Identity())
                  .norm(),
              1e-13)
        << size;
  }
}

TEST(Rotation, SpinMapAndItsDerivativeAgreeWithDifferences) {
  std::mt19937 generator(2);
  for (const double size : {1e-3, 0.05, 0.09, 0.11, 1.0}) {
    const Vector3 theta = randomVector(generator, size);
    const Vector3 v = randomVector(generator, 1.0);
    const double h = 1e-6;
    Matrix3 spin;
    Matrix3 derivative;
    for (int j = 0; j < 3; ++j) {
      const Vector3 step = h * Vector3::Unit(j);
      const Matrix3 turn =
          rotationExponential(theta + step) * rotationExponential(theta - step).transpose();
      spin.col(j) = rotationLogarithm(turn) / (2.0 * h);
      derivative.col(j) = (rotationVectorFromSpin(theta + step).transpose() * v -
                           rotationVectorFromSpin(theta - step).transpose() * v) /
                          (2.0 * h);
    }
    EXPECT_LT((spin - spinFromRotationVector(theta)).norm(), 1e-9) << size;
    EXPECT_LT((derivative - inverseSpinTransposeDerivative(theta, v)).norm(), 1e-9) << size;
  }
}

// Central differences with h = 1e-6 have an error of about h^2 + 1e-16/h = 1e-10 of the stiffness.
TEST(Corotational, TangentIsExact) {
  std::mt19937 generator(3);
  const CorotationalElement element = bentAtRest();
  for (const double amplitude : {0.01, 0.3, 1.0}) {
    const ElementPose pose = deformed(generator, amplitude);
    const Matrix12 tangent = element.evaluate(pose, true).tangent;
    Matrix12 difference;
    const double h = 1e-6;
    for (int j = 0; j < 12; ++j)
      difference.col(j) = (element.evaluate(moved(pose, j, h), false).force -
                           element.evaluate(moved(pose, j, -h), false).force) /
                          (2.0 * h);
    EXPECT_LT((tangent - difference).cwiseAbs().maxCoeff(), 2e-9 * difference.cwiseAbs().maxCoeff())
        << amplitude;
  }
}

TEST(Corotational, RigidMotionLeavesTheElementUnstrained) {
  const Section steel = Section::hollow(0.06, 0.05, Material{});
  const CorotationalElement element(stiffness(steel, 0.7), 0.7);
  std::mt19937 generator(4);
  for (int i = 0; i < 5; ++i) {
    ElementPose pose;
    pose.triad1 = pose.triad2 = rotationExponential(randomVector(generator, 1.8));
    pose.position1 = randomVector(generator, 100.0);
    pose.position2 = pose.position1 + 0.7 * pose.triad1.col(2);
    // rounding of positions of 100 m: 1e-14 m of strain 0.7 m at E S/l of 1e9 N/m
    EXPECT_LT(element.evaluate(pose, false).force.norm(), 1e-4);
  }
}

TEST(Corotational, ForcesTurnWithTheElementAndBalance) {
  std::mt19937 generator(5);
  const CorotationalElement element = bentAtRest();
  const ElementPose pose = deformed(generator, 0.6);
  const Vector12 force = element.evaluate(pose, false).force;
  const Matrix3 turn = rotationExponential({2.0, -1.0, 0.7});
  const Vector3 shift(3.0, -4.0, 5.0);
  const ElementPose turned{turn * pose.position1 + shift, turn * pose.position2 + shift,
                           turn * pose.triad1, turn * pose.triad2};
  const Vector12 after = element.evaluate(turned, false).force;
  for (int b = 0; b < 4; ++b)
    EXPECT_LT((after.segment<3>(3 * b) - turn * force.segment<3>(3 * b)).norm(),
              1e-12 * force.norm());
  const Vector3 force2 = force.segment<3>(6);
  EXPECT_LT((force.segment<3>(0) + force2).norm(), 1e-13 * force.norm());
  const Vector3 moment =
      force.segment<3>(3) + force.segment<3>(9) + (pose.position2 - pose.position1).cross(force2);
  EXPECT_LT(moment.norm(), 1e-13 * force.norm());
}

TEST(Corotational, TangentAtRestIsTheLinearElement) {
  const Section steel = Section::hollow(0.08, 0.04, Material{});
  const CorotationalElement element(stiffness(steel, 1.1), 1.1);
  const ElementPose pose{
      Vector3::Zero(), {0.0, 0.0, 1.1}, Matrix3::Identity(), Matrix3::Identity()};
  const Matrix12 linear = stiffness(steel, 1.1);
  EXPECT_LT((element.evaluate(pose, true).tangent - linear).norm(), 1e-12 * linear.norm());
}

TEST(Corotational, TangentCarriesTheAxialForceAndTheTorque) {
  // A stretched and twisted straight element: the parts of the tangent that depend on N and T are
  // those of the geometric stiffness at leading order, compared on a rotation of the chord (the
  // Hermite matrix adds bending of the element, which the corotational one leaves to the mesh).
  const Section steel = Section::hollow(0.08, 0.04, Material{});
  const double l = 1.0;
  const CorotationalElement element(stiffness(steel, l), l);
  const double strain = 1e-4;
  const ElementPose pose{
      Vector3::Zero(), {0.0, 0.0, l * (1.0 + strain)}, Matrix3::Identity(), Matrix3::Identity()};
  const CorotationalResponse response = element.evaluate(pose, true);
  Vector12 rotation = Vector12::Zero();  // rigid rotation about y: u2 = l theta_y
  rotation(4) = rotation(10) = 1.0;
  rotation(6) = response.length;
  // K d = N at the ends: the force turns with the element
  const Vector12 result = response.tangent * rotation;
  EXPECT_NEAR(result(6), response.axialForce, 1e-6 * response.axialForce);
  EXPECT_NEAR(result(0), -response.axialForce, 1e-6 * response.axialForce);
}

TEST(Corotational, CoincidentNodesAreRefused) {
  const CorotationalElement element(stiffness(lopsided(), 1.0), 1.0);
  const ElementPose pose{Vector3::Zero(), Vector3::Zero(), Matrix3::Identity(),
                         Matrix3::Identity()};
  EXPECT_THROW(element.evaluate(pose, false), ModelError);
}

}  // namespace CorotationalTest
}  // namespace tooljoint::beam
