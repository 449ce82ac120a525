// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Every element matrix as the bilinear form it discretises, on motions the element represents
/// exactly. The forms are those of Nguyen et al. 2020, section 2.1, equations (4) and (5), with u'
/// = theta_y, v' = -theta_x.
#include <Eigen/Cholesky>
#include <cmath>
#include <gtest/gtest.h>

#include "substructures/beam/BeamMatrices.hpp"
#include "tests/support/PolynomialMotion.hpp"

namespace tooljoint::beam {
namespace ElementFormsTest {

using testing_::firstMotion;
using testing_::integral;
using testing_::PolynomialMotion;
using testing_::secondMotion;

constexpr double kLength = 1.7;
constexpr double kDensity = 7.0, kYoung = 11.0, kPoisson = 0.25;
constexpr double kShear = kYoung / 2.5;

/// Axis-dependent second moments, no shear deformation.
Section unequal() {
  return Section::general(1.3, 2.0, 5.0, 3.0, Material{kDensity, kYoung, kPoisson});
}

/// virtual' X real for the first and the second motion.
double form(const Matrix12& x) {
  const Vector12 real = secondMotion().dofs({0.0, kLength});
  return firstMotion().dofs({0.0, kLength}).dot(x * real);
}

/// int_0^l f(virtual, real, z) dz.
template <class Integrand>
double expected(const Integrand& f) {
  const PolynomialMotion a = firstMotion(), b = secondMotion();
  return integral(0.0, kLength, [&](double z) { return f(a, b, z); });
}

void expectForm(const Matrix12& x, double value) {
  EXPECT_NEAR(form(x), value, 1e-12 * (std::abs(value) + 1.0));
}

TEST(ElementForms, StiffnessIsTheStrainEnergy) {
  const Section s = unequal();
  expectForm(stiffness(s, kLength), expected([&](const auto& a, const auto& b, double z) {
               return kYoung * s.area() * a.w.slope(z) * b.w.slope(z) +
                      kShear * s.torsion() * a.twist.slope(z) * b.twist.slope(z) +
                      kYoung * s.inertiaY() * a.u.curvature(z) * b.u.curvature(z) +
                      kYoung * s.inertiaX() * a.v.curvature(z) * b.v.curvature(z);
             }));
}

/// A cantilever of one Timoshenko element under a tip force P: P l^3/(3 E I) + P l/(beta G S), its
/// slope P l^2/(2 E I), and the reactions P and P l at the clamped end, whichever of the two ends
/// that is.
TEST(ElementForms, ShearDeformsACantileverByItsOwnShare) {
  const Section s = Section::hollow(0.08, 0.03, Material{7900.0, 2.0e11, 0.3});
  const double l = 0.4, force = 1e3;
  const Matrix12 k = stiffness(s, l);
  const double bending = force * l * l * l / (3.0 * 2.0e11 * s.inertiaX());
  const double shear = force * l / (0.9 * 2.0e11 / 2.6 * s.area());
  const double slope = force * l * l / (2.0 * 2.0e11 * s.inertiaX());
  EXPECT_GT(shear, 0.05 * bending);
  for (const int tip : {0, 6}) {
    const int clamp = 6 - tip;
    const double way = tip == 6 ? 1.0 : -1.0;  // from the clamp to the tip along z
    for (const int plane : {0, 1}) {           // u with theta_y, v with -theta_x
      const int turn = plane == 0 ? 4 : 3;
      const double sign = plane == 0 ? 1.0 : -1.0;
      Eigen::Matrix<double, 6, 1> load = Eigen::Matrix<double, 6, 1>::Zero();
      load(plane) = force;
      Vector12 d = Vector12::Zero();
      d.segment<6>(tip) = k.block<6, 6>(tip, tip).ldlt().solve(load);
      EXPECT_NEAR(d(tip + plane), bending + shear, 1e-10 * bending);
      EXPECT_NEAR(d(tip + turn), sign * way * slope, 1e-10 * slope);
      const Vector12 reaction = k * d;
      EXPECT_NEAR(reaction(clamp + plane), -force, 1e-9 * force);
      EXPECT_NEAR(reaction(clamp + turn), -sign * way * force * l, 1e-9 * force * l);
    }
  }
}

TEST(ElementForms, MassIsTheKineticEnergy) {
  const Section s = unequal();
  expectForm(mass(s, kLength), expected([&](const auto& a, const auto& b, double z) {
               return kDensity *
                      (s.area() * (a.u.value(z) * b.u.value(z) + a.v.value(z) * b.v.value(z) +
                                   a.w.value(z) * b.w.value(z)) +
                       s.inertiaY() * a.u.slope(z) * b.u.slope(z) +
                       s.inertiaX() * a.v.slope(z) * b.v.slope(z) +
                       s.polar() * a.twist.value(z) * b.twist.value(z));
             }));
}

/// D' C_ac dD/dt = rho I_p int theta_y dtheta_x/dt dz.
TEST(ElementForms, GyroscopicCouplingIsThatOfTheSpinningDiscs) {
  const Section s = unequal();
  expectForm(gyroscopic(s, kLength), expected([&](const auto& a, const auto& b, double z) {
               return kDensity * s.polar() * a.u.slope(z) * -b.v.slope(z);
             }));
}

/// rho I_p int theta_z dz for a theta_z linear along the element.
TEST(ElementForms, SpinLoadIsThePolarInertiaAlongTheElement) {
  const Section s = unequal();
  const double sum = integral(
      0.0, kLength, [&](double z) { return kDensity * s.polar() * firstMotion().twist.value(z); });
  EXPECT_NEAR(firstMotion().dofs({0.0, kLength}).dot(spinLoad(s, kLength)), sum, 1e-12);
}

TEST(ElementForms, GeometricStiffnessOfAxialForceAndTorque) {
  expectForm(geometricAxial(kLength), expected([](const auto& a, const auto& b, double z) {
               return a.u.slope(z) * b.u.slope(z) + a.v.slope(z) * b.v.slope(z);
             }));
  // int (v' du'' - u' dv'') dz: the virtual motion carries the curvature
  expectForm(geometricTorque(kLength), expected([](const auto& a, const auto& b, double z) {
               return b.v.slope(z) * a.u.curvature(z) - b.u.slope(z) * a.v.curvature(z);
             }));
}

TEST(ElementForms, IntegralsOfTheShapeFunctions) {
  expectForm(lateralMass(kLength), expected([](const auto& a, const auto& b, double z) {
               return a.u.value(z) * b.u.value(z) + a.v.value(z) * b.v.value(z);
             }));
  expectForm(lateralSlope(kLength), expected([](const auto& a, const auto& b, double z) {
               return a.u.value(z) * b.u.slope(z) + a.v.value(z) * b.v.slope(z);
             }));
  expectForm(lateralSlopeSlope(kLength), expected([](const auto& a, const auto& b, double z) {
               return a.u.slope(z) * b.u.slope(z) + a.v.slope(z) * b.v.slope(z);
             }));
  expectForm(axialMass(kLength), expected([](const auto& a, const auto& b, double z) {
               return a.w.value(z) * b.w.value(z);
             }));
}

/// A constant distributed force does the work int q . d dz on every motion of the element.
TEST(ElementForms, DistributedLoadDoesTheWorkOfTheForce) {
  const Vector3 q(3.0, -4.0, 5.0);
  const PolynomialMotion a = firstMotion();
  const double work = integral(0.0, kLength, [&](double z) {
    return q.x() * a.u.value(z) + q.y() * a.v.value(z) + q.z() * a.w.value(z);
  });
  EXPECT_NEAR(a.dofs({0.0, kLength}).dot(distributedLoad(q, kLength)), work, 1e-12);
}

/// A shaft whose sections all carry the moment T e_z: its component across the tangent (u', v', 1)
/// bends it, E I u'' = -T v', E I v'' = T u'. The helix u = cos(k z), v = sin(k z), k = T/(E I),
/// needs no force between its ends; its mirror image does.
TEST(ElementForms, TorqueBendsAStraightShaftIntoAHelixOfItsOwnHand) {
  const double rigidity = 3.0, torque = 2.0, k = torque / rigidity;
  const int elements = 40;
  const double length = 4.0, l = length / elements;
  const Section s = Section::general(1.0, rigidity, rigidity, 1.0, Material{1.0, 1.0, 0.25});
  const Matrix12 matrix = stiffness(s, l) + torque * geometricTorque(l);
  Matrix whole = Matrix::Zero(6 * (elements + 1), 6 * (elements + 1));
  for (int e = 0; e < elements; ++e) whole.block<12, 12>(6 * e, 6 * e) += matrix;
  const auto residual = [&](double hand) {
    Vector d = Vector::Zero(6 * (elements + 1));
    for (int n = 0; n <= elements; ++n) {
      const double z = n * l;
      d.segment<6>(6 * n) << std::cos(k * z), hand * std::sin(k * z), 0.0,
          -hand * k * std::cos(k * z), -k * std::sin(k * z), 0.0;
    }
    const Vector force = whole * d;
    return force.segment(6, 6 * (elements - 1)).norm() /
           (stiffness(s, l) * d.segment<12>(0)).norm();
  };
  EXPECT_LT(residual(1.0), 1e-4);
  EXPECT_GT(residual(-1.0), 1e-2);
}

}  // namespace ElementFormsTest
}  // namespace tooljoint::beam
