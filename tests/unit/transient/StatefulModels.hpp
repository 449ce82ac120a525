// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Masses on registered laws with states, and their closed forms.
#pragma once

#include <Eigen/Eigenvalues>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <string>

#include "Models.hpp"
#include "model/laws/PointLawRegistry.hpp"

namespace tooljoint::transient::testing {

/// The registered law on every dof of a model, which is its coordinate.
inline void addLaw(model::SecondOrderModel& model, const std::string& name,
                   const Teuchos::ParameterList& own) {
  const int n = model.size();
  model::PointSet set;
  set.name = name;
  set.law = model::PointLawRegistry::instance().make(name, own, {n, 1});
  set.rows.resize(n, n);
  set.rows.setIdentity();
  set.offset = Vector::Zero(n);
  for (int i = 0; i < n; ++i) set.entities.push_back(i + 1);
  model.points.push_back(set);
}

/// A Maxwell element and an elastic-plastic spring that yields on every dof.
inline void addStatefulLaws(model::SecondOrderModel& model) {
  Teuchos::ParameterList yielding, plastic;
  yielding.set("Stiffness", 4e3).set("Damping", 90.0);
  plastic.set("Stiffness", 3e4).set("Yield Force", 11.0);
  addLaw(model, "Maxwell", yielding);
  addLaw(model, "Elastic-Plastic", plastic);
}

/// A mass on a Maxwell element, relaxed at the start, thrown off.
struct MaxwellMass {
  double m = 2.0, k = 800.0, c = 40.0, speed = 1.0;

  model::SecondOrderModel model(int masses = 1) const {
    auto model = denseModel(m * Matrix::Identity(masses, masses), Matrix(), Matrix());
    model.initialVelocity.setConstant(speed);
    Teuchos::ParameterList own;
    own.set("Stiffness", k).set("Damping", c);
    addLaw(model, "Maxwell", own);
    return model;
  }

  /// (q, v, x) at time t: the exponential of m q'' = -k (q - x), x' = k/c (q - x).
  Vector3 exact(double t) const {
    Matrix3 A;
    A << 0, 1, 0, -k / m, 0, k / m, k / c, 0, -k / c;
    const Eigen::EigenSolver<Matrix3> modes(A);
    const Eigen::Vector3cd start =
        modes.eigenvectors().inverse() * Vector3(0, speed, 0).cast<std::complex<double>>();
    const Eigen::Vector3cd grown = (modes.eigenvalues() * t).array().exp() * start.array();
    return (modes.eigenvectors() * grown).real();
  }
};

/// Largest error of the displacement of the first mass.
inline double largestError(const Keep& samples, const MaxwellMass& mass) {
  double error = 0;
  for (std::size_t i = 0; i < samples.time.size(); ++i)
    error = std::max(error, std::abs(samples.q[i][0] - mass.exact(samples.time[i])[0]));
  return error;
}

}  // namespace tooljoint::transient::testing
