// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Halves of complex modes against real modes on rotors with discs and dampers, where real modes do
/// not diagonalise the damping.
#include <Eigen/Dense>
#include <Teuchos_ParameterList.hpp>
#include <gtest/gtest.h>

#include "tests/support/CoupledChecks.hpp"
#include "tests/support/SampleParts.hpp"

namespace ComplexModesTest {

using namespace tooljoint;
using namespace tooljoint::reduction;

/// A shaft as a string in two planes u, v between nodes first .. first + elements: gyroscopic discs
/// on every third inner node turn u into v, a dashpot on one node acts on u alone, a follower
/// stiffness couples the planes.
model::Substructure rotor(const std::string& name, int first, int elements, double gyro,
                          double dashpot) {
  const auto line = samples::bar(name, first, elements, 400.0, 0.1);
  model::Substructure part;
  part.name = name;
  auto& m = part.model;
  m.componentNames = {"u", "v"};
  const int n = 2 * (elements + 1);
  Triplets mass, stiffness, skew, damping, follower;
  const auto twice = [](const Sparse& A, Triplets& entries) {
    for (int i = 0; i < A.outerSize(); ++i)
      for (Sparse::InnerIterator it(A, i); it; ++it)
        for (int plane : {0, 1})
          entries.emplace_back(2 * i + plane, 2 * static_cast<int>(it.col()) + plane, it.value());
  };
  twice(line.model.mass, mass);
  twice(line.model.stiffness[0].matrix, stiffness);
  for (int i = 0; i <= elements; ++i) {
    m.dofs.push_back(model::DofLabel::physical(first + i, 0));
    m.dofs.push_back(model::DofLabel::physical(first + i, 1));
    if (i % 3 != 1) continue;
    skew.emplace_back(2 * i, 2 * i + 1, gyro);
    skew.emplace_back(2 * i + 1, 2 * i, -gyro);
    follower.emplace_back(2 * i, 2 * i + 1, 2.0);
    follower.emplace_back(2 * i + 1, 2 * i, -2.0);
  }
  const int at = 2 * (elements / 3);
  damping.emplace_back(at, at, dashpot);
  m.mass = samples::square(n, mass);
  m.stiffness.push_back({"elastic", samples::square(n, stiffness), 0});
  m.stiffness.push_back({"follower", samples::square(n, follower), 0});
  m.damping.push_back({"gyroscopic", samples::square(n, skew), m.lawIndex(samples::spin())});
  m.damping.push_back({"dashpot", samples::square(n, damping), 0});
  samples::complete(part);
  return part;
}

std::vector<model::Substructure> shaft() {
  std::vector<model::Substructure> parts{rotor("left", 1, 20, 1.2, 4.0),
                                         rotor("right", 21, 16, 0.8, 2.5)};
  samples::classify(parts[0], {21}, {1});
  samples::classify(parts[1], {21}, {37});
  return parts;
}

/// Root of the mean square relative error of the `count` eigenvalues s of smallest size.
double error(const std::string& basis, int modes, int count) {
  const double time = 1.0;  // Omega = 3
  const auto parts = shaft();
  const auto small = checks::synthesise(parts, basis, modes, [&](Teuchos::ParameterList& list) {
    if (basis != "Craig-Bampton") list.set("Time", time);
  });
  const Eigen::VectorXcd full = checks::dampedEigenvalues(coupling::couple(parts), time),
                         found = checks::dampedEigenvalues(small.coupled.model, time);
  double sum = 0;
  int counted = 0;
  for (Eigen::Index k = 0; counted < count; ++k) {
    if (std::abs(full[k]) < 1e-6) continue;  // the free shaft: four of them are zero
    sum += std::pow((found.array() - full[k]).abs().minCoeff() / std::abs(full[k]), 2);
    ++counted;
  }
  return std::sqrt(sum / count);
}

// With 4 vectors there are only two complex modes for eight eigenvalues, and real modes are equally
// accurate.
TEST(ComplexModes, GiveBetterDampedEigenvaluesThanRealOnes) {
  for (const int modes : {6, 8, 12}) {
    const double complex = error("Complex Craig-Bampton", modes, 8),
                 real = error("Craig-Bampton", modes, 8);
    EXPECT_LT(complex, 0.75 * real) << modes;
  }
}

// With the boundary dofs held and no others, an eigenvalue of the part is one of the reduced part
// as long as both halves of its mode are in the basis (Galerkin with an exact vector in the span):
// the fixed-interface s are exact, which real modes do not give.
TEST(ComplexModes, HoldTheFixedInterfaceEigenvalues) {
  auto part = rotor("left", 1, 20, 1.2, 4.0);
  samples::classify(part, {}, {1, 21});
  Teuchos::ParameterList list("Reduction");
  list.sublist("Complex Craig-Bampton").set("Time", 1.0);
  ModeRequest request;
  request.kind = ModeRequest::Kind::Count;
  request.count = 8;
  const Basis basis = makeBasis("Complex Craig-Bampton", list)->build(part, request);
  const Partition& p = basis.partition;
  std::vector<int> modal;
  for (int k = 0; k < basis.modes(); ++k) modal.push_back(static_cast<int>(p.boundary.size()) + k);
  const Matrix V = block(basis.vectors, p.interior, modal);
  const auto inner = [&](const Sparse& A) { return Matrix(block(A, p.interior, p.interior)); };
  const Matrix M = inner(part.model.mass), C = inner(part.model.dampingAt(1.0)),
               K = inner(part.model.stiffnessAt(1.0));
  Eigen::VectorXcd full = linalg::dampedModes(M, C, K).values;
  std::stable_sort(full.data(), full.data() + full.size(),
                   [](auto a, auto b) { return std::abs(a) < std::abs(b); });
  const Eigen::VectorXcd small =
      linalg::dampedModes(V.transpose() * M * V, V.transpose() * C * V, V.transpose() * K * V)
          .values;
  for (int k = 0; k < 8; ++k)
    EXPECT_LT((small.array() - full[k]).abs().minCoeff(), 1e-8 * std::abs(full[k])) << full[k];
}

}  // namespace ComplexModesTest
