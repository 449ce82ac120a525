// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A straight inclined string of two sections in two bores, whose equations have closed forms.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "common/Constants.hpp"
#include "substructures/beam/Rotation.hpp"
#include "substructures/beam/Timoshenko.hpp"
#include "substructures/drillstring/EquationBuilder.hpp"
#include "tests/support/PolynomialMotion.hpp"

namespace tooljoint::testing_ {

using constants::pi;
inline const std::vector<double> depths{0.0, 2.0, 5.0};
inline const std::vector<double> bore{0.15, 0.108};      // of the two elements [m]
inline const std::vector<double> outer{0.0795, 0.0635};  // [m]
inline const std::vector<double> inner{0.0355, 0.054};   // [m]
inline const std::vector<double> axialForce{3e4, -2e4};  // of the path state [N]
inline const std::vector<double> torque{-4e3, 7e3};      // [N m]
constexpr double density = 7900.0, youngModulus = 2.03e11, shearModulus = youngModulus / 2.6,
                 gravity = 9.81;

inline double square(double x) { return x * x; }

/// Omega = 3 + 2 t: all laws have different values.
class Rising final : public loads::SpeedLaw {
 public:
  double speed(double t) const override { return 3.0 + 2.0 * t; }
  double acceleration(double) const override { return 2.0; }
  double angle(double t) const override { return 3.0 * t + t * t; }
};

inline mud::MudProperties fluid() {
  mud::MudProperties p;
  p.density = 1200.0;
  p.frictionCoefficient = 0.013;
  p.kinematicViscosity = 3e-6;
  p.flowRate = 0.02;
  return p;
}

/// Gravity [m/s2], weight on bit [N] and torque on bit [N m].
inline loads::Loads acting(double g, double weightOnBit, double torqueOnBit) {
  Teuchos::ParameterList list("Loads");
  list.set("Gravity", g).set("Weight On Bit", weightOnBit).set("Torque On Bit", torqueOnBit);
  return loads::readLoads(list);
}

/// Element axes lie along a well of 40 degrees inclination; the nodal axes are those of
/// the elements turned about the tangent by 0.3 rad times the number of the node.
struct InclinedString {
  well::Well well{well::straight(20.0, 0.7, 0.4),
                  0.108,
                  {{"casing", 0.0, 1.5, 0.15}, {"liner", 1.5, 3.0, 0.13}}};
  drillstring::DrillString string;
  path::PathState path;
  std::vector<char> held = std::vector<char>(18, 0);
  loads::RotarySpeed rotary;
  loads::Loads loads;
  loads::RayleighDamping damping;
  const mud::MudModel* mud = nullptr;
  Matrix3 axes;

  InclinedString() {
    const Vector3 tangent = well.at(1.0).tangent;
    axes.col(2) = tangent;
    axes.col(0) = Vector3(0.0, 1.0, 0.0).cross(tangent).normalized();
    axes.col(1) = tangent.cross(axes.col(0));
    const beam::Material steel{density, youngModulus, 0.3};
    for (std::size_t n = 0; n < 3; ++n) {
      drillstring::Node node;
      node.s = depths[n];
      string.nodes.push_back(node);
      path.frame.push_back(
          axes * beam::rotationExponential(Vector3(0.0, 0.0, 0.3 * static_cast<double>(n))));
      path.sectionAxis.push_back(path.frame.back().col(2));
    }
    for (std::size_t e = 0; e < 2; ++e) {
      const double length = depths[e + 1] - depths[e];
      string.elements.push_back(
          {std::make_shared<beam::Timoshenko>(
               beam::Section::hollow(outer[e], inner[e], steel).withoutShear(), length),
           0});
      path.elementFrame.push_back(axes);
      path.chordLength.push_back(length);
    }
    path.reaction = Matrix::Zero(6, 3);
    path.axialForce = Vector::Zero(2);
    path.torque = Vector::Zero(2);
  }

  void prestress() {
    path.axialForce << axialForce[0], axialForce[1];
    path.torque << torque[0], torque[1];
  }
  void turn() { rotary = loads::RotarySpeed(std::make_shared<Rising>()); }

  drillstring::PathEquations atPath() const {
    return drillstring::buildEquations({string, well, path, held, mud, rotary, loads, damping});
  }
  drillstring::StringModel equations() const { return atPath().model; }

  /// Nodal dofs of a motion given in element axes.
  Vector dofs(const PolynomialMotion& motion) const {
    Vector d = motion.dofs(depths);
    for (std::size_t n = 0; n < 3; ++n) {
      const Matrix3 toNode = path.frame[n].transpose() * axes;
      for (const int first : {0, 3}) {
        const auto at = 6 * static_cast<Eigen::Index>(n) + first;
        d.segment<3>(at) = (toNode * d.segment<3>(at)).eval();
      }
    }
    return d;
  }

  double form(const Sparse& matrix) const {
    return dofs(firstMotion()).dot(matrix * dofs(secondMotion()));
  }
  double work(const Vector& load) const { return dofs(firstMotion()).dot(load); }
};

/// Sum over the elements of the integral of f(virtual, real, z, element).
template <class Integrand>
double alongString(const Integrand& f) {
  double sum = 0.0;
  const PolynomialMotion a = firstMotion(), b = secondMotion();
  for (std::size_t e = 0; e < 2; ++e)
    sum += integral(depths[e], depths[e + 1], [&](double z) { return f(a, b, z, e); });
  return sum;
}

inline double area(std::size_t e) { return pi * (square(outer[e]) - square(inner[e])); }
inline double inertia(std::size_t e) {
  return pi / 4.0 * (std::pow(outer[e], 4) - std::pow(inner[e], 4));
}

}  // namespace tooljoint::testing_
