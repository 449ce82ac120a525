// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A hinged column in a bore under an increasing load: derivatives, pivots, and its path.
#include "substructures/equilibrium/LoadPath.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "statics/PathContinuation.hpp"
#include "substructures/beam/NodalDofs.hpp"
#include "substructures/beam/Timoshenko.hpp"
#include "substructures/contact/ContactLaw.hpp"

namespace tooljoint::equilibrium {
namespace LoadPathTest {

namespace nodal = beam::nodal;

constexpr int elements = 20, nodes = elements + 1;
constexpr double length = 10.0, clearance = 0.01;

/// 2 N across the middle, hinges at both ends, the last node loaded along the column.
struct Column {
  StaticInput input;
  GrowingLoad load;
  double stiffness = 0.0;  ///< E I [N m2]

  Column() {
    const auto section = beam::Section::hollow(0.05, 0.04, {7850.0, 2.1e11, 0.3}).withoutShear();
    stiffness = section.youngModulus() * section.inertiaX();
    input.nodes = nodes;
    for (int e = 0; e < elements; ++e) {
      StaticElement element;
      element.formulation = std::make_shared<beam::Timoshenko>(section, length / elements);
      element.stiffness = element.formulation->stiffness();
      element.rotation.setIdentity();
      element.slopes.setIdentity();
      input.elements.push_back(element);
    }
    input.held.assign(6 * nodes, 0);
    for (const int dof : {nodal::u, nodal::v, nodal::w, nodal::thetaZ})
      input.held[static_cast<std::size_t>(dof)] = 1;
    for (const int dof : {nodal::u, nodal::v})
      input.held[static_cast<std::size_t>(6 * elements + dof)] = 1;
    contact::ContactPoints points;
    for (int n = 2; n < nodes; ++n) {
      contact::ContactPoint point;
      point.node = n;
      point.clearance = clearance;
      point.contactRadius = 0.05;
      point.stiffness = 1e8;
      point.lambdaK = point.lambdaC = 1e5;
      points.add(point);
    }
    input.contact = contact::makeLaw("Clamped")->atRest(points);
    load.direction = Vector::Zero(6 * nodes);
    load.direction(6 * elements + nodal::w) = -1.0;
    load.contained = load.scale = 3.0 * euler();
    load.pathWeights = Vector::Zero(6 * nodes);
    for (int n = 0; n < nodes; ++n)
      load.pathWeights.segment<2>(6 * n).setConstant(1.0 / (nodes * clearance * clearance));
    input.load = load.contained * load.direction;
    input.load(6 * (elements / 2) + nodal::u) = 2.0;
  }
  double euler() const { return stiffness * std::pow(constants::pi / length, 2); }
};

TEST(LoadPath, DerivativesAgreeWithDifferences) {
  const Column column;
  const LoadPath path(column.input, column.load);
  Vector x(path.size());
  for (int i = 0; i < path.size(); ++i) x(i) = 5e-3 * std::sin(1.7 * i);
  const double p = 1.3e4, dp = 1.0;
  Vector low, high, derivative;
  path.residual(x, p - dp, low);
  path.residual(x, p + dp, high);
  path.parameterDerivative(x, p, derivative);
  EXPECT_LT((derivative - (high - low) / (2.0 * dp)).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_NEAR(derivative.cwiseAbs().maxCoeff(), 1.0, 1e-12);
  Sparse J;
  path.jacobian(x, p, J);
  const Vector direction = Vector::Random(path.size());
  const double step = 1e-8;
  path.residual(x - step * direction, p, low);
  path.residual(x + step * direction, p, high);
  const Vector difference = (high - low) / (2.0 * step), exact = J * direction;
  EXPECT_LT((exact - difference).norm(), 1e-5 * exact.norm());
}

TEST(LoadPath, CountsAPairOfPivotsAtTheEulerLoad) {
  const Column column;
  const LoadPath path(column.input, column.load);
  // axial force P all along: w = -P s/(E S)
  const auto& section = column.input.elements.front().formulation->section();
  const auto under = [&](double P) {
    Vector full = Vector::Zero(6 * nodes);
    for (int n = 0; n < nodes; ++n)
      full(6 * n + nodal::w) = -P * n * (length / elements) / section.axialRigidity();
    return path.problem().restrict(full);
  };
  EXPECT_EQ(path.negativePivots(under(0.999 * column.euler()), 0.0), 0);
  EXPECT_EQ(path.negativePivots(under(1.001 * column.euler()), 0.0), 2);
}

// Beyond the Euler load the column leans on the wall in its middle with, for u = L/2 sqrt(P/E I),
// N = 4 u P y/(L (u - tan u)): the deflection by a force Q in the middle is Q (tan u - u) L/(4 u
// P).
TEST(LoadPath, LeansOnTheWallBeyondTheEulerLoad) {
  const Column column;
  const LoadPath path(column.input, column.load);
  statics::PathOptions options;
  options.to = 3.0 * column.euler();
  int leaning = 0;
  const auto report = statics::followPath(
      path, Vector::Zero(path.size()), options, [&](const statics::PathPoint& point) {
        const Vector full = path.problem().expand(point.x);
        Vector forces, normal;
        path.problem().contactForces(full, forces, normal);
        const double P = point.parameter, y = full(6 * (elements / 2) + nodal::u);
        EXPECT_EQ(point.negativePivots, 0);
        if (normal.sum() == 0.0) {
          EXPECT_LT(P, 1.01 * column.euler());
        } else if (P > 1.2 * column.euler()) {
          const double u = 0.5 * length * std::sqrt(P / column.stiffness);
          const double force = 4.0 * u * P * y / (length * (u - std::tan(u))) + 2.0;
          EXPECT_NEAR(normal.sum(), force, 3e-3 * force) << P / column.euler();
          EXPECT_NEAR(y, clearance, 2e-2 * clearance);
          ++leaning;
        }
        return true;
      });
  EXPECT_EQ(report.end, statics::PathEnd::Reached) << report.explanation;
  EXPECT_GT(leaning, 5);
}

TEST(LoadPath, RefusesALoadOnHeldDofs) {
  Column column;
  column.load.direction.setZero();
  column.load.direction(nodal::w) = -1.0;
  EXPECT_THROW(LoadPath(column.input, column.load), ModelError);
}

}  // namespace LoadPathTest
}  // namespace tooljoint::equilibrium
