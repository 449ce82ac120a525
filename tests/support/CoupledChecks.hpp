// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Comparisons of a coupled reduced model with the full one, for any basis.
#pragma once

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <complex>
#include <functional>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "coupling/Synthesis.hpp"
#include "linalg/DenseDecompositions.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "tests/support/SampleParts.hpp"

namespace tooljoint::checks {

/// Reduces (all modes for -1) and couples with the parameters `set` gives to the basis.
inline coupling::Synthesis synthesise(
    const std::vector<model::Substructure>& parts, const std::string& basis, int modes,
    const std::function<void(Teuchos::ParameterList&)>& set = {}) {
  Teuchos::ParameterList list("Reduction");
  if (set) set(list.sublist(basis));
  reduction::ReductionOptions options;
  options.basis = basis;
  if (modes >= 0) {
    options.modes.kind = reduction::ModeRule::Kind::PerPart;
    options.modes.counts = {modes};
  }
  return coupling::synthesise(parts, *reduction::makeBasis(basis, list), options);
}

/// All omega^2 of M and sym(K) at t = 0.
inline Vector eigenvalues(const model::SecondOrderModel& m) {
  const Matrix K = m.stiffnessAt(0);
  return linalg::symmetricModes(0.5 * (K + K.transpose()), Matrix(m.mass)).values;
}

/// |d lambda| <= 1e-9 lambda + 1e-15 lambda_max for every eigenvalue.
inline void expectSameEigenvalues(const model::SecondOrderModel& full,
                                  const model::SecondOrderModel& small) {
  ASSERT_EQ(full.size(), small.size());
  const Vector expected = eigenvalues(full), found = eigenvalues(small);
  const double largest = expected.cwiseAbs().maxCoeff();
  for (Eigen::Index k = 0; k < expected.size(); ++k)
    EXPECT_NEAR(found[k], expected[k], 1e-9 * std::abs(expected[k]) + 1e-15 * largest)
        << "eigenvalue " << k;
}

/// Eigenvalues s of the first-order form at time t, by increasing |s|.
inline Eigen::VectorXcd dampedEigenvalues(const model::SecondOrderModel& m, double t) {
  auto values =
      linalg::dampedModes(Matrix(m.mass), Matrix(m.dampingAt(t)), Matrix(m.stiffnessAt(t))).values;
  std::stable_sort(values.data(), values.data() + values.size(),
                   [](auto a, auto b) { return std::abs(a) < std::abs(b); });
  return values;
}

/// Every s of the full model has its own nearest one within 1e-8 |s| and the rounding of an
/// unsymmetric eigenproblem, 1e-11 of the largest.
inline void expectSameDampedEigenvalues(const model::SecondOrderModel& full,
                                        const model::SecondOrderModel& small, double t) {
  ASSERT_EQ(full.size(), small.size());
  const Eigen::VectorXcd expected = dampedEigenvalues(full, t);
  Eigen::VectorXcd found = dampedEigenvalues(small, t);
  const double largest = expected.cwiseAbs().maxCoeff();
  for (const auto& s : expected) {
    Eigen::Index nearest = 0;
    const double distance = (found.array() - s).abs().minCoeff(&nearest);
    EXPECT_LE(distance, 1e-8 * std::abs(s) + 1e-11 * largest) << s;
    found[nearest] = 1e300;
  }
}

/// Modes of a floating model with |omega^2| <= 1e-12 of what its stiffness would give the same
/// shape without cancellation.
inline int zeroEnergyModes(const model::SecondOrderModel& m) {
  const Matrix K = m.stiffnessAt(0);
  const auto pairs = linalg::symmetricModes(0.5 * (K + K.transpose()), Matrix(m.mass));
  int found = 0;
  for (Eigen::Index k = 0; k < pairs.values.size(); ++k) {
    const Vector size = pairs.vectors.col(k).cwiseAbs();
    if (std::abs(pairs.values[k]) <= 1e-12 * size.dot(K.cwiseAbs() * size)) ++found;
  }
  return found;
}

/// Constant stiffness: largest relative difference of the displacements of all nodes for unit loads
/// on every physical dof of `small`, which `full` has too.
inline double staticError(const model::SecondOrderModel& full,
                          const model::SecondOrderModel& small) {
  const linalg::DenseLu fullFactor{Matrix(reduction::constantStiffness(full))},
      smallFactor{Matrix(reduction::constantStiffness(small))};
  double worst = 0;
  for (int j = 0; j < small.size(); ++j) {
    const auto& label = small.dofs[static_cast<std::size_t>(j)];
    if (label.kind != model::DofLabel::Kind::Physical) continue;
    const int i = samples::find(full, label);
    if (i < 0) continue;
    const Vector expected = full.recovery * fullFactor.solve(Vector(Vector::Unit(full.size(), i)));
    const Vector found = small.recovery * smallFactor.solve(Vector(Vector::Unit(small.size(), j)));
    Vector ordered(expected.size());  // recovery rows of one model may stand in another order
    const auto width = static_cast<Eigen::Index>(full.componentNames.size());
    for (std::size_t n = 0; n < full.recoveryNodes.size(); ++n) {
      const auto at =
          std::find(small.recoveryNodes.begin(), small.recoveryNodes.end(), full.recoveryNodes[n]) -
          small.recoveryNodes.begin();
      ordered.segment(static_cast<Eigen::Index>(n) * width, width) =
          found.segment(at * width, width);
    }
    worst = std::max(worst,
                     (ordered - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff());
  }
  return worst;
}

/// Two members joined at a corner that nothing holds.
inline std::vector<model::Substructure> floatingFrame(int elements) {
  samples::Frame frame;
  frame.corners = {{1, {0, 0}}, {2, {2, 0.4}}, {3, {2.5, 2.5}}};
  const auto inner = [&](int base) {
    std::vector<int> nodes;
    for (int i = 1; i < elements; ++i) nodes.push_back(base + i);
    return nodes;
  };
  std::vector<model::Substructure> parts{samples::framePart("arm", frame, {{1, 2, inner(100)}}),
                                         samples::framePart("mast", frame, {{2, 3, inner(200)}})};
  samples::classify(parts[0], {2});
  samples::classify(parts[1], {2}, {3});
  return parts;
}

}  // namespace tooljoint::checks
