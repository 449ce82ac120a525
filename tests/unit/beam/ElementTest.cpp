// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Signs, symmetries and totals of the element matrices.
#include <Eigen/Eigenvalues>
#include <cmath>
#include <gtest/gtest.h>

#include "common/Constants.hpp"
#include "substructures/beam/BeamMatrices.hpp"
#include "substructures/beam/Rotation.hpp"

namespace tooljoint::beam {
namespace ElementTest {

Section pipe() { return Section::hollow(0.0635, 0.054, Material{7900.0, 2.03e11, 0.3}); }

/// The rigid motions of an element: three translations, and rotations about x, y, z through node 1.
Eigen::Matrix<double, 12, 6> rigidMotions(double l) {
  Eigen::Matrix<double, 12, 6> r = Eigen::Matrix<double, 12, 6>::Zero();
  r.topRows<6>().setIdentity();
  r.bottomRows<6>().setIdentity();
  r(7, 3) = -l;  // theta_x moves node 2 along -v: v' = -theta_x
  r(6, 4) = l;   // theta_y moves node 2 along +u: u' = +theta_y
  return r;
}

TEST(Section, HollowCircle) {
  using constants::pi;
  const Section s = pipe();
  EXPECT_NEAR(s.area(), pi * (0.0635 * 0.0635 - 0.054 * 0.054), 1e-18);
  EXPECT_DOUBLE_EQ(s.polar(), 2.0 * s.inertiaX());
  EXPECT_DOUBLE_EQ(s.torsion(), s.polar());
  EXPECT_NEAR(s.shearFactor(1.8),
              12 * 2.03e11 * s.inertiaX() / (2.03e11 / 2.6 * s.area() * 0.9 * 1.8 * 1.8), 1e-15);
  EXPECT_EQ(s.withoutShear().shearFactor(1.8), 0.0);
  EXPECT_THROW(Section::hollow(0.05, 0.06, Material{}), ModelError);
  EXPECT_THROW(Section::general(1.0, 1.0, 0.0, 1.0, Material{}), ModelError);
}

TEST(Element, StiffnessHasExactlyTheSixRigidMotions) {
  const Matrix12 k = stiffness(pipe(), 1.8);
  EXPECT_LT((k - k.transpose()).norm(), 1e-12 * k.norm());
  EXPECT_LT((k * rigidMotions(1.8)).norm(), 1e-12 * k.norm());
  const Eigen::SelfAdjointEigenSolver<Matrix12> eigen(k);
  EXPECT_LT(std::abs(eigen.eigenvalues()(5)), 1e-12 * eigen.eigenvalues()(11));
  EXPECT_GT(eigen.eigenvalues()(6), 1e-6 * eigen.eigenvalues()(11));
}

TEST(Element, GeneralSectionBendsAboutTheRightAxis) {
  const Section s = Section::general(1.0, 2.0, 5.0, 1.0, Material{1.0, 7.0, 0.25});
  const Matrix12 k = stiffness(s, 2.0);
  EXPECT_NEAR(k(0, 0), 12.0 * 7.0 * 5.0 / 8.0, 1e-12);  // u bends about y
  EXPECT_NEAR(k(1, 1), 12.0 * 7.0 * 2.0 / 8.0, 1e-12);  // v bends about x
  EXPECT_NEAR(k(0, 4), 6.0 * 7.0 * 5.0 / 4.0, 1e-12);
  EXPECT_NEAR(k(1, 3), -6.0 * 7.0 * 2.0 / 4.0, 1e-12);
  EXPECT_NEAR(k(5, 5), 7.0 / 2.5 * 1.0 / 2.0, 1e-12);
}

TEST(Element, MassOfRigidMotionsIsThatOfARod) {
  const Section s = pipe();
  const double l = 1.8;
  const double rho = 7900.0;
  const auto r = rigidMotions(l);
  const Eigen::Matrix<double, 6, 6> m = r.transpose() * mass(s, l) * r;
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(m(i, i), rho * s.area() * l, 1e-12 * m(i, i));
  const double about1 = rho * s.area() * l * l * l / 3.0 + rho * s.inertiaX() * l;
  EXPECT_NEAR(m(3, 3), about1, 1e-12 * about1);
  EXPECT_NEAR(m(4, 4), about1, 1e-12 * about1);
  EXPECT_NEAR(m(5, 5), rho * s.polar() * l, 1e-12 * m(5, 5));
  EXPECT_NEAR(m(0, 4), rho * s.area() * l * l / 2.0, 1e-12 * about1);
}

TEST(Element, GyroscopicMomentsHaveTheStatedSigns) {
  // left-hand side: I_d ddtheta_x + I_p Omega dtheta_y, I_d ddtheta_y - I_p Omega dtheta_x
  const Section s = pipe();
  const double l = 1.8;
  const Matrix12 c = gyroscopic(s, l);
  const Matrix12 g = c.transpose() - c;
  EXPECT_LT((g + g.transpose()).norm(), 1e-15);
  const auto r = rigidMotions(l);
  const double ip = 7900.0 * s.polar() * l;
  EXPECT_NEAR(r.col(3).dot(g * r.col(4)), ip, 1e-12 * ip);
  EXPECT_NEAR(r.col(4).dot(g * r.col(3)), -ip, 1e-12 * ip);
  // kinetic energy term rho I_p theta_y dtheta_x/dt
  EXPECT_NEAR(r.col(4).dot(c * r.col(3)), ip, 1e-12 * ip);
  EXPECT_NEAR(r.col(5).dot(spinLoad(s, l)), ip, 1e-12 * ip);
}

TEST(Element, AxialForceAndTorqueOnARotatedChord) {
  const double l = 1.3;
  const Vector12 about_y = rigidMotions(l).col(4);
  EXPECT_NEAR(about_y.dot(geometricAxial(l) * about_y), l, 1e-13);  // int u'^2 dz
  EXPECT_LT((geometricAxial(l) - lateralSlopeSlope(l)).norm(), 1e-15);
  const Matrix12 t = geometricTorque(l);
  EXPECT_GT((t - t.transpose()).norm(), 1e-3);
  // u = z^2/2 against v = z: int v' du'' dz = l, and with the roles swapped the opposite sign
  Vector12 parabola = Vector12::Zero();
  parabola(6) = 0.5 * l * l;
  parabola(10) = l;
  Vector12 line = Vector12::Zero();
  line(7) = l;
  line(3) = line(9) = -1.0;
  EXPECT_NEAR(parabola.dot(t * line), l, 1e-13);
  EXPECT_NEAR(line.dot(t * parabola), 0.0, 1e-13);  // line has no curvature
  Vector12 parabola_v = Vector12::Zero();
  parabola_v(7) = 0.5 * l * l;
  parabola_v(9) = -l;
  Vector12 line_u = Vector12::Zero();
  line_u(6) = l;
  line_u(4) = line_u(10) = 1.0;
  EXPECT_NEAR(parabola_v.dot(t * line_u), -l, 1e-13);
}

TEST(Element, LateralIntegrals) {
  const double l = 0.9;
  const auto r = rigidMotions(l);
  EXPECT_NEAR(r.col(0).dot(lateralMass(l) * r.col(0)), l, 1e-14);
  EXPECT_NEAR(r.col(2).dot(lateralMass(l) * r.col(2)), 0.0, 1e-14);
  EXPECT_NEAR(r.col(2).dot(axialMass(l) * r.col(2)), l, 1e-14);
  EXPECT_NEAR(r.col(0).dot(lateralSlope(l) * r.col(4)), l, 1e-14);   // int 1 u' dz, u' = theta_y
  EXPECT_NEAR(r.col(1).dot(lateralSlope(l) * r.col(3)), -l, 1e-14);  // v' = -theta_x
}

TEST(Element, DistributedLoadIsStaticallyEquivalent) {
  const double l = 1.7;
  const Vector3 q(3.0, -4.0, 5.0);
  const Vector12 f = distributedLoad(q, l);
  const auto r = rigidMotions(l);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(f.dot(r.col(i)), q(i) * l, 1e-13);
  EXPECT_NEAR(f.dot(r.col(4)), q.x() * l * l / 2.0, 1e-13);
  EXPECT_NEAR(f.dot(r.col(3)), -q.y() * l * l / 2.0, 1e-13);
  EXPECT_NEAR(f(4), q.x() * l * l / 12.0, 1e-13);
  EXPECT_NEAR(f(3), -q.y() * l * l / 12.0, 1e-13);
}

TEST(Element, RotationMovesARigidTranslationIntoTheElementFrame) {
  const Matrix3 e = rotationExponential({0.3, -0.2, 0.5});
  const Matrix3 q1 = rotationExponential({0.1, 0.4, -0.2});
  const Matrix3 q2 = rotationExponential({-0.3, 0.2, 0.6});
  const Vector3 move(1.0, 2.0, 3.0);
  Vector12 nodal = Vector12::Zero();
  nodal.segment<3>(0) = q1.transpose() * move;
  nodal.segment<3>(6) = q2.transpose() * move;
  const Vector12 local = rotation12(e, q1, q2) * nodal;
  EXPECT_LT((local.segment<3>(0) - e.transpose() * move).norm(), 1e-14);
  EXPECT_LT((local.segment<3>(6) - e.transpose() * move).norm(), 1e-14);
}

/// On a curved element the spin of a node about its own tangent, theta = t, does not rotate the
/// tangent: it has no slope. All other motions are as in the element frame. Without it the spin
/// tilts the ends of the chord by -+kappa l/2, and K_g of a tension F resists it.
TEST(Element, SlopesDoNotKnowTheSpin) {
  const double l = 9.0, kappa = 1.745e-3;
  const auto tilted = [&](double angle) {
    return rotationExponential(Vector3(0.0, angle, 0.0));
  };  // about y, in the plane of the arc
  const Matrix12 r =
      rotation12(Matrix3::Identity(), tilted(-0.5 * kappa * l), tilted(0.5 * kappa * l));
  const Matrix12 slopes = slopeRotation(r, Vector3::UnitZ(), Vector3::UnitZ());
  Vector12 spin = Vector12::Zero();
  spin(5) = spin(11) = 1.0;
  for (const Matrix12& k : {geometricAxial(l), geometricTorque(l)}) {
    const Matrix12 nodal = slopes.transpose() * k * slopes;
    EXPECT_EQ((nodal * spin).norm(), 0.0);
    EXPECT_EQ((nodal.transpose() * spin).norm(), 0.0);
    Matrix12 same = r.transpose() * k * r - nodal;
    for (const int dof : {5, 11}) {
      same.row(dof).setZero();
      same.col(dof).setZero();
    }
    EXPECT_EQ(same.norm(), 0.0);
  }
  // F kappa^2 l^2/12 per length, twice the energy of the parabola with slopes -+kappa l/2
  EXPECT_NEAR(spin.dot(r.transpose() * geometricAxial(l) * r * spin),
              kappa * kappa * l * l / 12.0 * l, 1e-3 * kappa * kappa * l * l * l);
}

/// The same about the axis of a cross section that is not the z axis of its node.
TEST(Element, SlopesDoNotKnowTheSpinAboutASection) {
  const Matrix12 r = rotation12(Matrix3::Identity(), rotationExponential(Vector3(0.1, 0.2, 0.3)),
                                rotationExponential(Vector3(-0.2, 0.1, 0.4)));
  const Vector3 upper = Vector3(0.05, -0.02, 1.0).normalized(),
                lower = Vector3(-0.04, 0.03, 1.0).normalized();
  const Matrix12 slopes = slopeRotation(r, upper, lower);
  Vector12 spin = Vector12::Zero();
  spin.segment<3>(3) = upper;
  spin.segment<3>(9) = lower;
  EXPECT_LT((slopes * spin).norm(), 1e-15);
  Vector12 bent = Vector12::Zero();  // across the axes
  bent.segment<3>(3) = upper.cross(Vector3::UnitX());
  bent.segment<3>(9) = lower.cross(Vector3::UnitY());
  EXPECT_LT(((slopes - r) * bent).norm(), 1e-15);
}

TEST(Element, TriadHasItsZOnTheChord) {
  const Matrix3 q1 = rotationExponential({0.02, 0.03, 0.4});
  const Matrix3 q2 = rotationExponential({-0.02, 0.01, 0.5});
  const Vector3 chord(0.02, 0.01, 1.0);
  const Matrix3 e = elementTriad(Vector3::Zero(), chord, q1, q2);
  EXPECT_LT((e.transpose() * e - Matrix3::Identity()).norm(), 1e-14);
  EXPECT_NEAR(e.determinant(), 1.0, 1e-14);
  EXPECT_LT((e.col(2) - chord.normalized()).norm(), 1e-15);
  EXPECT_NEAR(std::atan2(-e(0, 1), e(1, 1)), 0.45, 0.01);  // turned by the mean of 0.4 and 0.5
  EXPECT_THROW(elementTriad(chord, chord, q1, q2), ModelError);
}

}  // namespace ElementTest
}  // namespace tooljoint::beam
