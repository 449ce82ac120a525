// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A motion divided among ranks equals the motion of one rank: shares, factors, steps, energy,
/// errors, checkpoints. On one rank nothing is divided, and the same must hold.
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "tests/support/ErrorText.hpp"
#include "tests/unit/transient/StatefulModels.hpp"
#include "transient/compiled/MassFactor.hpp"
#include "transient/ranks/RankShare.hpp"

namespace tooljoint::transient::testing {
namespace DividedMotionTest {

using Edges = std::vector<std::pair<int, int>>;

/// Nodes of two masses each, joined by springs along edges, with damping, loads and floors.
model::SecondOrderModel nodes(int count, const Edges& edges) {
  const int n = 2 * count;
  Matrix K = 50.0 * Matrix::Identity(n, n), M = 5.0 * Matrix::Identity(n, n);
  for (const auto& [a, b] : edges)
    for (int c = 0; c < 2; ++c) {
      const int i = 2 * a + c, j = 2 * b + c, k = 2 * b + 1 - c;
      K(i, i) += 2e4, K(j, j) += 2e4, K(i, j) -= 2e4, K(j, i) -= 2e4;
      K(i, i) += 3e3, K(k, k) += 3e3, K(i, k) += 3e3, K(k, i) += 3e3;
      M(i, j) += 0.3, M(j, i) += 0.3;
    }
  auto model = denseModel(M, 0.5 * Matrix::Identity(n, n) + 1e-4 * K, K, 2);
  model.loads.push_back({"weight", Vector::Constant(n, -49.0), 0});
  const int law = model.lawIndex({"swell", [](double t) { return 1 + 0.5 * std::sin(40 * t); }});
  model.damping.push_back({"swelling", (3.0 * Matrix::Identity(n, n)).sparseView(), law});
  for (int i = 0; i < n; ++i) model.initialDisplacement[i] = 0.005 + 0.001 * std::sin(3.0 * i);
  addFloor(model, 1e6, 2e3, 7e11);
  return model;
}

Edges chain(int n) {
  Edges edges;
  for (int i = 0; i + 1 < n; ++i) edges.emplace_back(i, i + 1);
  return edges;
}
Edges loop(int n) {
  auto edges = chain(n);
  edges.emplace_back(n - 1, 0);
  return edges;
}
/// Arms of a third of the nodes each from node 0.
Edges star(int n) {
  const int arm = (n - 1) / 3;
  Edges edges;
  for (int a = 0; a < 3; ++a)
    for (int i = 0; i < arm; ++i) edges.emplace_back(i == 0 ? 0 : a * arm + i, a * arm + i + 1);
  return edges;
}

/// Two chains, by leaving out the edge in the middle of one.
Edges apart(int n) {
  auto edges = chain(n);
  edges.erase(edges.begin() + n / 2);
  return edges;
}

const std::vector<std::pair<std::string, model::SecondOrderModel>>& shapes() {
  static const std::vector<std::pair<std::string, model::SecondOrderModel>> all{
      {"chain", nodes(40, chain(40))},
      {"loop", nodes(40, loop(40))},
      {"star", nodes(40, star(40))},
      {"two chains", nodes(40, apart(40))}};
  return all;
}

TransientOptions divided(RankUse ranks = RankUse::Divide) {
  auto o = options("Generalized-alpha", 0.04, 1e-3, 5e-3);
  o.ranks = ranks;
  acceptCoarseSteps(o);
  return o;
}

void expectNear(const Vector& a, const Vector& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_LE((a - b).cwiseAbs().maxCoeff(), tolerance * b.cwiseAbs().maxCoeff());
}

TEST(RankShare, SharesAddUpToTheWhole) {
  if (parallel::size() == 1) GTEST_SKIP() << "one rank has the whole model";
  for (const auto& [name, whole] : shapes()) {
    SCOPED_TRACE(name);
    const auto share = RankShare::of(whole);
    ASSERT_NE(share, nullptr);
    const auto& mine = share->model();
    const Vector x = Vector::LinSpaced(whole.size(), -1.0, 2.0);
    const auto expectSum = [&](const Vector& partial, const Vector& expected) {
      Vector sum = partial, all;
      share->pattern().cut().complete(sum.data());
      share->gather(sum, all);
      expectNear(all, expected, 1e-14);
    };
    expectSum(mine.mass * share->pick(x), whole.mass * x);
    expectSum(mine.dampingAt(0.3) * share->pick(x), whole.dampingAt(0.3) * x);
    expectSum(mine.stiffnessAt(0.3) * share->pick(x), whole.stiffnessAt(0.3) * x);
    expectSum(mine.loadAt(0.3), whole.loadAt(0.3));
    EXPECT_EQ(parallel::sum(static_cast<double>(share->points()[0].size())), whole.size());
    EXPECT_GT(share->pattern().cut().interior(mine.size()), 0);
    EXPECT_LT(mine.size(), whole.size()) << "nobody holds everything";
  }
}

TEST(RankShare, FactorsSolveAndInvertTheWholeMatrix) {
  for (const auto& [name, whole] : shapes()) {
    SCOPED_TRACE(name);
    const auto share = parallel::size() > 1 ? RankShare::of(whole) : nullptr;
    const CompiledModel compiled = share ? CompiledModel(*share) : CompiledModel(whole);
    linalg::BlockFactor factor(compiled.pattern());
    compiled.combine(3.0, 0.0, 1.0, factor.values());
    ASSERT_EQ(factor.factor(), -1);
    const Matrix dense = Matrix(whole.mass) * 3.0 + Matrix(whole.stiffnessAt(0.0));
    const Vector x = Vector::LinSpaced(whole.size(), -1.0, 2.0), b = dense * x;
    Vector right, solution;
    compiled.toPositions(b, right);
    compiled.cut().divide(right.data());
    factor.solve(right.data());
    compiled.toDofs(right, solution);
    expectNear(solution, x, 1e-11);

    factor.invert(std::vector<char>(static_cast<std::size_t>(compiled.pattern().blocks()), 1));
    const Matrix inverse = dense.inverse();
    const Vector numbers = Vector::LinSpaced(whole.size(), 0.0, whole.size() - 1.0);
    Vector dof;
    compiled.toPositions(numbers, dof);
    for (int p = 0; p < compiled.size(); ++p) {
      const auto i = static_cast<Eigen::Index>(std::lround(dof[p]));
      EXPECT_NEAR(factor.inverse()[compiled.pattern().address(p, p)], inverse(i, i),
                  1e-11 * inverse(i, i))
          << i;
    }
  }
}

TEST(RankShare, APivotThatVanishesOnOneRankIsKnownToAll) {
  auto whole = shapes()[0].second;
  whole.mass.coeffRef(1, 1) = 0.0;
  whole.mass.coeffRef(1, 3) = whole.mass.coeffRef(3, 1) = 0.0;
  whole.mass.coeffRef(0, 0) = 0.0;  // and a column of its neighbours that it couples to
  const auto share = parallel::size() > 1 ? RankShare::of(whole) : nullptr;
  const CompiledModel compiled = share ? CompiledModel(*share) : CompiledModel(whole);
  linalg::BlockFactor factor(compiled.pattern());
  compiled.combine(1.0, 0.0, 0.0, factor.values());
  EXPECT_GE(factor.factor(), 0);
}

/// A free chain moves as a whole: its last pivot is rounding, on several ranks at the cut.
TEST(RankShare, AMatrixThatIsSingularAsAWholeIsSoOnAnyNumberOfRanks) {
  auto whole = springChain(41, 1.0, 0.0, 3e7);
  for (int end : {0, 40}) whole.stiffness.own()[0].matrix.coeffRef(end, end) = 3e7;
  const auto share = parallel::size() > 1 ? RankShare::of(whole) : nullptr;
  const CompiledModel compiled = share ? CompiledModel(*share) : CompiledModel(whole);
  linalg::BlockFactor factor(compiled.pattern());
  compiled.combine(0.0, 0.0, 1.0, factor.values());
  EXPECT_GE(factor.factor(), 0);
  compiled.combine(1e-3, 0.0, 1.0, factor.values());  // no longer singular with a weak ground
                                                      // spring
  EXPECT_EQ(factor.factor(), -1);
}

TEST(DividedMotion, IsTheMotionOfOneRank) {
  for (const auto& [name, whole] : shapes()) {
    SCOPED_TRACE(name);
    Keep apart, alike;
    const auto one = integrate(whole, divided(RankUse::Alike), alike);
    const auto many = integrate(whole, divided(), apart);
    EXPECT_EQ(one.ranks, 1);
    EXPECT_EQ(many.ranks, parallel::size());
    EXPECT_EQ(many.size, whole.size());
    ASSERT_EQ(apart.q.size(), alike.q.size());
    for (std::size_t i = 0; i < apart.q.size(); ++i) {
      expectNear(apart.q[i], alike.q[i], 1e-9);
      expectNear(apart.v[i], alike.v[i], 1e-9);
      expectNear(apart.a[i], alike.a[i], 1e-8);
    }
    EXPECT_EQ(many.counters.steps, one.counters.steps);
    EXPECT_EQ(many.counters.newtonIterations, one.counters.newtonIterations);
    EXPECT_EQ(many.counters.strategies, one.counters.strategies);
    // an impact at its bound may be evaluated once more, depending on rounding
    EXPECT_NEAR(static_cast<double>(many.contactEvaluations),
                static_cast<double>(one.contactEvaluations),
                1e-4 * static_cast<double>(one.contactEvaluations));
    EXPECT_GT(one.contactEvaluations, 0);
    EXPECT_NEAR(many.stepError, one.stepError, 1e-6 * one.stepError);
    EXPECT_NEAR(many.energy.kinetic, one.energy.kinetic, 1e-9 * one.energy.exchanged);
    EXPECT_NEAR(many.energy.contactDamping, one.energy.contactDamping, 1e-9 * one.energy.exchanged);
    EXPECT_NEAR(many.energy.exchanged, one.energy.exchanged, 1e-9 * one.energy.exchanged);
    EXPECT_EQ(many.energy.dampingNames, one.energy.dampingNames);
  }
}

/// Steps controlled by their error, and impacts on a wall too stiff for the step.
TEST(DividedMotion, TakesTheSameSteps) {
  auto hard = nodes(40, chain(40));
  hard.points.clear();
  addFloor(hard, 1e9, 0.0, 7e11);
  for (const bool controlled : {false, true}) {
    auto o = divided(RankUse::Alike);
    o.end = 0.045;
    if (controlled) o.own.set("Step Tolerance", 1e-6);
    Keep apart, alike;
    const auto one = integrate(hard, o, alike);
    o.ranks = RankUse::Divide;
    const auto many = integrate(hard, o, apart);
    EXPECT_GT(one.counters.rejected, 0);
    EXPECT_EQ(many.counters.steps, one.counters.steps);
    EXPECT_EQ(many.counters.rejected, one.counters.rejected);
    expectNear(apart.q.back(), alike.q.back(), 1e-7);
  }
}

/// The default step too is that of one rank.
TEST(DividedMotion, IsThatOfOneRankInExplicitSteps) {
  for (const char* integrator : {"RK4", "RK4 adaptive"}) {
    SCOPED_TRACE(integrator);
    auto o = divided(RankUse::Alike);
    o.integrator = integrator;
    o.step = 0;
    o.end = 0.01;
    Keep apart, alike;
    const auto one = integrate(shapes()[1].second, o, alike);
    o.ranks = RankUse::Divide;
    const auto many = integrate(shapes()[1].second, o, apart);
    EXPECT_EQ(many.ranks, parallel::size());
    EXPECT_EQ(many.counters.steps, one.counters.steps);
    EXPECT_EQ(many.counters.rejected, one.counters.rejected);
    EXPECT_NEAR(many.counters.maxStep, one.counters.maxStep, 1e-9 * one.counters.maxStep);
    expectNear(apart.q.back(), alike.q.back(), 1e-9);
    expectNear(apart.v.back(), alike.v.back(), 1e-9);
  }
}

/// The first shape with rated and held states of point laws at all dofs.
model::SecondOrderModel withStates() {
  auto model = shapes()[0].second;
  addStatefulLaws(model);
  return model;
}

TEST(DividedMotion, IsThatOfOneRankWithStatesOfPointLaws) {
  const auto whole = withStates();
  for (const char* integrator : {"Generalized-alpha", "RK4", "RK4 adaptive"}) {
    SCOPED_TRACE(integrator);
    auto o = divided(RankUse::Alike);
    o.integrator = integrator;
    if (o.integrator != "Generalized-alpha") o.step = 0, o.end = 0.01;
    Keep apart, alike;
    const auto one = integrate(whole, o, alike);
    o.ranks = RankUse::Divide;
    const auto many = integrate(whole, o, apart);
    EXPECT_EQ(many.ranks, parallel::size());
    EXPECT_EQ(many.counters.steps, one.counters.steps);
    EXPECT_EQ(many.counters.rejected, one.counters.rejected);
    EXPECT_NEAR(many.counters.maxStep, one.counters.maxStep, 1e-9 * one.counters.maxStep);
    EXPECT_NEAR(many.energy.friction, one.energy.friction, 1e-9 * one.energy.exchanged);
    EXPECT_NEAR(many.energy.contact, one.energy.contact, 1e-9 * one.energy.exchanged);
    expectNear(apart.q.back(), alike.q.back(), 1e-9);
    expectNear(apart.v.back(), alike.v.back(), 1e-9);
    expectNear(apart.x.back(), alike.x.back(), 1e-9);
    EXPECT_GT(alike.x.back().tail(whole.size()).cwiseAbs().maxCoeff(), 1e-6) << "some have yielded";
  }
}

/// Message of the error on this rank.
std::string errorOf(const model::SecondOrderModel& model, const TransientOptions& options,
                    SampleSink& sink) {
  try {
    integrate(model, options, sink);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

class FullDisk final : public SampleSink {
 public:
  void sample(double t, const Vector&, const Vector&, const Vector&) override {
    if (parallel::rank() == 0 && t > 0.02) throw FileError("No space is left on the disk.");
  }
};

TEST(DividedMotion, AnErrorOfOneRankIsThrownOnAll) {
  FullDisk disk;
  EXPECT_EQ(errorOf(shapes()[0].second, divided(), disk), "No space is left on the disk.");
}

TEST(DividedMotion, ABlowUpIsNamedAlikeOnAllRanks) {
  auto model = shapes()[0].second;
  model.points.clear();
  model.stiffness.push_back(
      {"repulsion", (-1e7 * Matrix::Identity(model.size(), model.size())).sparseView(), 0});
  Keep samples;
  auto o = divided();
  o.end = 1.0;
  std::string mine = errorOf(model, o, samples), first = mine;
  parallel::broadcast(first, 0);
  EXPECT_EQ(mine, first);
  EXPECT_NE(mine.find("blew up"), std::string::npos) << mine;
}

/// Stopped after some steps; the checkpoint.
Checkpoint stopped(const model::SecondOrderModel& model, const TransientOptions& o, long steps) {
  Checkpoint kept;
  RunHooks hooks;
  long calls = 0;
  hooks.stop = [&] { return ++calls > steps; };
  hooks.keep = [&](const Checkpoint& point) { kept = point; };
  Keep samples;
  EXPECT_TRUE(integrate(model, o, samples, hooks).interrupted);
  return Checkpoint::decode(kept.encode(), "kept");
}

TEST(DividedMotion, GoesOnFromACheckpointBitByBit) {
  const auto model = withStates();
  Keep whole, rest;
  integrate(model, divided(), whole);
  const auto point = stopped(model, divided(), 21);
  EXPECT_EQ(point.shares.size(),
            parallel::size() > 1 ? static_cast<std::size_t>(parallel::size()) : 0U);
  RunHooks hooks;
  hooks.resume = &point;
  integrate(model, divided(), rest, hooks);
  EXPECT_EQ(rest.q.back(), whole.q.back());
  EXPECT_EQ(rest.v.back(), whole.v.back());
  EXPECT_EQ(rest.x.back(), whole.x.back());
}

/// With the memory carried by the integrator the motion takes the steps of an uninterrupted one, to
/// rounding if the matrices are constant. The factor is different: with laws whose tangents change,
/// iterations must converge to rounding, and the phase correction would differ.
TEST(DividedMotion, GoesOnFromACheckpointOfOtherRanks) {
  auto smooth = shapes()[0].second;
  smooth.points.clear();
  smooth.damping.own().pop_back();  // it grows
  auto lawful = smooth;
  addStatefulLaws(lawful);
  for (const auto* model : {&smooth, &lawful})
    for (const std::string integrator : {"Generalized-alpha", "RK4", "RK4 adaptive"})
      for (const auto& [wrote, goesOn] : {std::make_pair(RankUse::Divide, RankUse::Alike),
                                          std::make_pair(RankUse::Alike, RankUse::Divide)}) {
        SCOPED_TRACE(integrator);
        const auto with = [&, &name = integrator](RankUse ranks) {
          auto o = divided(ranks);
          o.integrator = name;
          if (name != "Generalized-alpha")
            o.step = 0;
          else if (model == &lawful)
            o.own.set("Tolerance", 1e-13).set("Phase Correction", false);
          return o;
        };
        Keep whole, rest;
        const auto all = integrate(*model, with(RankUse::Alike), whole);
        const auto point = stopped(*model, with(wrote), all.counters.steps / 2);
        RunHooks hooks;
        hooks.resume = &point;
        const auto report = integrate(*model, with(goesOn), rest, hooks);
        EXPECT_EQ(report.counters.steps, all.counters.steps);
        EXPECT_EQ(report.samples, static_cast<long>(whole.q.size()));
        expectNear(rest.q.back(), whole.q.back(), 1e-10);
        expectNear(rest.v.back(), whole.v.back(), 1e-10);
        if (model == &lawful) expectNear(rest.x.back(), whole.x.back(), 1e-10);
      }
}

/// Contact, and growing damping, before and after the stop: the factor of the matrix differs, and
/// steps agree to the tolerance of their iterations, 1e-5 of the forces.
TEST(DividedMotion, GoesOnInContactFromACheckpointOfOtherRanks) {
  for (const auto& [name, model] : shapes()) {
    SCOPED_TRACE(name);
    Keep whole, rest;
    integrate(model, divided(RankUse::Alike), whole);
    const auto point = stopped(model, divided(RankUse::Alike), 21);
    RunHooks hooks;
    hooks.resume = &point;
    integrate(model, divided(), rest, hooks);
    expectNear(rest.q.back(), whole.q.back(), 1e-6);
    expectNear(rest.v.back(), whole.v.back(), 1e-5);
  }
}

TEST(DividedMotion, IsComputedByAllAlikeWhereItCannotBeDivided) {
  const auto dense = nodes(4, {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}});
  Keep samples;
  EXPECT_EQ(integrate(dense, divided(), samples).ranks, 1);
}

TEST(DividedMotion, IsRefusedByIntegratorsThatCannot) {
  if (parallel::size() == 1) GTEST_SKIP() << "nothing is divided";
  auto wanted = divided();
  wanted.integrator = "SUNDIALS CVODE";
  Keep samples;
  const auto text = errorText([&] { integrate(shapes()[0].second, wanted, samples); });
  if (text.find("built without SUNDIALS") != std::string::npos) GTEST_SKIP() << text;
  EXPECT_NE(text.find("does not divide a motion among ranks"), std::string::npos) << text;
}

}  // namespace DividedMotionTest
}  // namespace tooljoint::transient::testing
