// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The coupled reduced model against the full one: chains, a frame with a loop, gyroscopic and
/// unsymmetric matrices.
#include <Eigen/Eigenvalues>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <complex>
#include <gtest/gtest.h>

#include "coupling/assembly/Assembler.hpp"
#include "linalg/trilinos/DirectSolver.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "reduction/Reduce.hpp"
#include "tests/support/SampleParts.hpp"

namespace CoupledModelTest {

using namespace tooljoint;
using namespace tooljoint::reduction;

ReductionOptions allModes() { return {}; }

ReductionOptions someModes(int count) {
  ReductionOptions options;
  options.modes.kind = ModeRule::Kind::PerPart;
  options.modes.counts = {count};
  return options;
}

std::vector<ReducedSubstructure> reduced(const std::vector<model::Substructure>& parts,
                                         const ReductionOptions& options) {
  return reduceAll(parts, *makeBasis("Craig-Bampton", Teuchos::ParameterList()), options);
}

/// `count` bars of different stiffness in a chain, clamped at node 1, with a retained node in every
/// second one.
std::vector<model::Substructure> chain(int count, int elements) {
  std::vector<model::Substructure> parts;
  for (int p = 0; p < count; ++p) {
    const int first = 1 + elements * p;
    parts.push_back(samples::bar("part " + std::to_string(p + 1), first, elements, 100.0 + 7 * p,
                                 2.0 - 0.01 * p,
                                 p == 0 ? std::vector<int>{1} : std::vector<int>{}));
    std::vector<int> ends;
    if (p > 0) ends.push_back(first);
    if (p + 1 < count) ends.push_back(first + elements);
    samples::classify(parts.back(), ends,
                      p % 2 == 1 ? std::vector<int>{first + elements / 2} : std::vector<int>{});
  }
  return parts;
}

Vector frequenciesSquared(const model::SecondOrderModel& m) {
  return linalg::symmetricModes(Matrix(symmetricPart(m.stiffnessAt(0))), Matrix(m.mass)).values;
}

void expectSameEigenvalues(const model::SecondOrderModel& full,
                           const model::SecondOrderModel& small) {
  ASSERT_EQ(full.size(), small.size());
  const Vector a = frequenciesSquared(full);
  const Vector b = frequenciesSquared(small);
  const double largest = a[a.size() - 1];
  for (Eigen::Index i = 0; i < a.size(); ++i)
    EXPECT_LE(std::abs(a[i] - b[i]), 1e-9 * a[i] + 1e-15 * largest) << i;
}

TEST(AllModes, ChainOfBarsKeepsItsEigenvalues) {
  for (int count : {1, 3, 20}) {
    const auto parts = chain(count, 8);
    expectSameEigenvalues(coupling::couple(parts), coupling::couple(reduced(parts, allModes())));
  }
}

TEST(AllModes, FrameWithALoopKeepsItsEigenvalues) {
  for (bool retain : {false, true}) {
    const auto parts = samples::loopFrame(8, false, retain);
    expectSameEigenvalues(coupling::couple(parts), coupling::couple(reduced(parts, allModes())));
  }
}

/// Eigenvalues s of s^2 M + s C + K, with positive imaginary part first, sorted by it.
std::vector<std::complex<double>> complexEigenvalues(const model::SecondOrderModel& m, double t) {
  const auto modes =
      linalg::dampedModes(Matrix(m.mass), Matrix(m.dampingAt(t)), Matrix(m.stiffnessAt(t)));
  std::vector<std::complex<double>> values;
  for (Eigen::Index i = 0; i < modes.values.size(); ++i)
    if (modes.values[i].imag() >= 0) values.push_back(modes.values[i]);
  return values;
}

TEST(AllModes, GyroscopicUnsymmetricFrameKeepsItsComplexEigenvalues) {
  const auto parts = samples::loopFrame(6, true, true);
  const auto full = complexEigenvalues(coupling::couple(parts), 0.5);
  const auto small = complexEigenvalues(coupling::couple(reduced(parts, allModes())), 0.5);
  ASSERT_EQ(full.size(), small.size());
  const double largest = std::abs(full.back());
  // lambda = s^2: |dlambda| <= 1e-9 |lambda| + 1e-13 lambda_max (the unsymmetric problem is worse
  // conditioned than a symmetric one)
  for (const auto& s : full) {
    double nearest = 1e300;
    for (const auto& other : small) nearest = std::min(nearest, std::abs(s * s - other * other));
    EXPECT_LE(nearest, 1e-9 * std::norm(s) + 1e-13 * largest * largest) << s;
  }
}

/// q'' of a model, everything included.
Vector acceleration(const model::SecondOrderModel& m, double t, const Vector& q, const Vector& v) {
  const Vector force =
      m.loadAt(t) + m.pointForce(t, q, v) - m.dampingAt(t) * v - m.stiffnessAt(t) * q;
  return linalg::DirectSolver(m.mass).solve(force);
}

TEST(AllModes, AccelerationIsThatOfTheFullModel) {
  for (const auto state : {InitialState::KeepStatic, InitialState::LeastSquares}) {
    auto parts = samples::loopFrame(4, true, true);
    for (std::size_t p = 0; p < parts.size(); ++p) {
      auto& m = parts[p].model;
      const int base = 100 * (static_cast<int>(p) + 1);
      samples::addCubicSprings(parts[p], {base + 1, base + 3});
      Vector load = Vector::Zero(m.size());
      for (int i = 0; i < m.size(); ++i)
        load[i] = m.dofs[static_cast<std::size_t>(i)].entity > 100 ? 1e3 * (i + 1) : 0.0;
      m.loads.push_back({"weight", load, 0});
      m.loads.push_back({"spin load", 0.1 * load, m.lawIndex(samples::spinRate())});
      // A reference state and an initial state that agree where parts meet.
      Vector reference(m.size()), start(m.size()), velocity(m.size());
      for (int i = 0; i < m.size(); ++i) {
        const auto& label = m.dofs[static_cast<std::size_t>(i)];
        const double x = 0.37 * static_cast<double>(label.entity) + label.component;
        reference[i] = 1e-2 * std::sin(x);
        start[i] = reference[i] + 1e-3 * std::cos(2 * x);
        velocity[i] = 0.1 * std::cos(x);
      }
      parts[p].reference = reference;
      m.initialDisplacement = start;
      m.initialVelocity = velocity;
    }
    const auto full = coupling::couple(parts);
    auto options = allModes();
    options.initialState = state;
    const auto small = coupling::couple(reduced(parts, options));
    const Vector& q = small.initialDisplacement;
    const Vector& v = small.initialVelocity;
    const Vector D = small.recoveryOffset + small.recovery * q;
    const Vector expected = full.recoveryOffset + full.recovery * full.initialDisplacement;
    EXPECT_LT((D - expected).norm(), 1e-11 * expected.norm());
    EXPECT_LT((small.recovery * v - full.recovery * full.initialVelocity).norm(), 1e-10);
    const Vector a = small.recovery * acceleration(small, 0.4, q, v);
    const Vector b =
        full.recovery * acceleration(full, 0.4, full.initialDisplacement, full.initialVelocity);
    EXPECT_LT((a - b).norm(), 1e-8 * b.norm());
    EXPECT_GT(full.pointForce(0.4, full.initialDisplacement, full.initialVelocity).norm(), 1e4)
        << "the points take part";
  }
}

TEST(NoModes, IsGuyanOfTheWholeModel) {
  // Static condensation is transitive: part by part and then coupled, or all at once.
  const auto parts = samples::loopFrame(6, false);
  const auto coupled = coupling::couple(reduced(parts, someModes(0)));
  model::Substructure whole;
  whole.name = "whole";
  whole.model = coupling::couple(parts);
  for (int i = 0; i < whole.model.size(); ++i) {
    const auto node = whole.model.dofs[static_cast<std::size_t>(i)].entity;
    if (node == 3 || node == 4) whole.retained.push_back(i);
  }
  const auto guyan = reduced({whole}, someModes(0))[0];
  const Vector a = frequenciesSquared(coupled);
  const Vector b = frequenciesSquared(guyan.model);
  ASSERT_EQ(a.size(), 6);
  for (Eigen::Index i = 0; i < 6; ++i) EXPECT_NEAR(a[i], b[i], 1e-10 * b[i]);
}

TEST(SomeModes, FrequenciesComeFromAboveAndConverge) {
  const auto parts = samples::loopFrame(10, false);
  const Vector exact = frequenciesSquared(coupling::couple(parts));
  Vector before;
  for (int count : {0, 2, 4, 8, 16}) {
    const Vector now = frequenciesSquared(coupling::couple(reduced(parts, someModes(count))));
    for (Eigen::Index i = 0; i < 6; ++i) {
      EXPECT_GE(now[i], exact[i] * (1 - 1e-9));
      if (before.size() > 0) {
        EXPECT_LE(now[i], before[i] * (1 + 1e-9)) << "nested spaces";
      }
    }
    before = now;
  }
  for (Eigen::Index i = 0; i < 6; ++i) EXPECT_LT(before[i] / exact[i] - 1, 1e-4);
}

TEST(SomeModes, StaticResponseToLoadsOnKeptDofsIsExactWhateverTheModes) {
  for (bool spinning : {false, true}) {
    auto parts = samples::loopFrame(6, spinning, true);
    for (auto& part : parts) {
      Vector load = Vector::Zero(part.model.size());
      for (int i : part.retained) load[i] = 1.0 + i;
      for (int i : part.interface) load[i] = 3.0;
      part.model.loads = {{"kept", load, 0}};
    }
    const auto full = coupling::couple(parts);
    // The constant stiffness: the law dOmega/dt of the samples is 1, so it is taken out.
    const Vector D = linalg::DirectSolver(constantStiffness(full)).solve(full.loadAt(0));
    for (int count : {0, 3}) {
      const auto small = coupling::couple(reduced(parts, someModes(count)));
      const Vector q = linalg::DirectSolver(constantStiffness(small)).solve(small.loadAt(0));
      const Vector error = small.recovery * q - full.recovery * D;
      EXPECT_LT(error.norm(), 1e-10 * D.norm());
    }
  }
}

TEST(SomeModes, RetainedNodesSplitThePartIntoLinks) {
  const auto parts = samples::loopFrame(10, false, true);
  for (const auto& part : reduced(parts, someModes(4))) {
    // The columns are straight: their axial and bending motions are separate blocks.
    const std::size_t links = part.name == "cantilever" ? 1 : part.name == "beam" ? 2 : 4;
    EXPECT_EQ(part.basis->partition.blocks.size(), links) << part.name;
    EXPECT_LT(part.report.staticDefect, 1e-10);
  }
}

}  // namespace CoupledModelTest
