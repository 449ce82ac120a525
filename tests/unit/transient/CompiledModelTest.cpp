// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The compiled model agrees with the model: laws, products, loads, point forces and their
/// tangents.
#include "transient/compiled/CompiledModel.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>
#include <random>

#include "Models.hpp"
#include "common/Error.hpp"
#include "linalg/DenseDecompositions.hpp"
#include "linalg/blocks/BlockFactor.hpp"
#include "substructures/contact/ContactLaw.hpp"

namespace tooljoint::transient::testing {
namespace CompiledModelTest {

Vector sampleVector(int n, double phase) {
  Vector x(n);
  for (int i = 0; i < n; ++i) x[i] = std::sin(phase + 1.7 * i);
  return x;
}

/// Chain of six nodes, three dofs each, with several terms on several laws, some of one name.
model::SecondOrderModel rich() {
  const int n = 18;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto banded = [&](double diagonal) {
    Matrix a = Matrix::Zero(n, n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        if (std::abs(i / 3 - j / 3) <= 1) a(i, j) = uniform(random) + (i == j ? diagonal : 0.0);
    return a;
  };
  Matrix M = banded(8.0);
  M = 0.5 * (M + M.transpose()).eval();
  auto model = denseModel(M, banded(0), banded(20), 3);
  const int omega = model.lawIndex({"Omega", [](double t) { return 3 * t; }});
  const int root = model.lawIndex({"sqrt|Omega|", [](double t) { return std::sqrt(3 * t); }});
  model.laws.push_back({"Omega", [](double t) {
                          return 3 * t;
                        }});  // the same law once more, as couplings may leave it
  const int again = static_cast<int>(model.laws.size()) - 1;
  model.damping.push_back({"gyroscopic", banded(0).sparseView(), omega});
  model.damping.push_back({"drag", banded(0).sparseView(), root});
  model.damping.push_back({"more damping", banded(0).sparseView(), 0});
  model.damping.push_back({"swirl", banded(0).sparseView(), again});
  model.stiffness.push_back({"circulatory", banded(0).sparseView(), omega});
  model.loads.push_back({"weight", sampleVector(n, 0.3), 0});
  model.loads.push_back({"unbalance", sampleVector(n, 1.3), omega});
  model.loads.push_back({"push", sampleVector(n, 2.3), 0});
  return model;
}

TEST(CompiledModel, mergesTermsOfOneLaw) {
  const auto source = rich();
  const CompiledModel model(source);
  ASSERT_EQ(model.timed().damping().terms().size(), 3u);
  EXPECT_EQ(model.timed().damping().terms()[0].name, "damping + more damping");
  EXPECT_EQ(model.timed().damping().terms()[1].name, "gyroscopic + swirl");
  EXPECT_EQ(model.timed().stiffness().terms().size(), 2u);
}

TEST(CompiledModel, productsAndLoadsAreThoseOfTheModelAtEveryTime) {
  const auto source = rich();
  CompiledModel model(source);
  const int n = source.size();
  const Vector x = sampleVector(n, 0.7);
  Vector xp, y(n), back;
  model.toPositions(x, xp);
  for (double t : {0.0, 0.5, 2.0, 0.5}) {
    model.setTime(t);
    const auto expectProduct = [&](const auto& add, const Matrix& a) {
      // whole, and block by block in any order
      for (const bool whole : {true, false}) {
        y.setZero();
        const int blocks = model.pattern().blocks();
        if (whole) add(linalg::BlockRange{0, blocks});
        for (int b = blocks - 1; !whole && b >= 0; --b) add(linalg::BlockRange{b, b + 1});
        model.toDofs(y, back);
        EXPECT_LT((back - a * x).cwiseAbs().maxCoeff(), 1e-13) << "t = " << t;
      }
    };
    expectProduct([&](linalg::BlockRange rows) { model.addMass(xp.data(), y.data(), rows); },
                  Matrix(source.mass));
    expectProduct([&](linalg::BlockRange rows) { model.addMass(xp.data(), y.data(), rows, -3.0); },
                  -3.0 * Matrix(source.mass));
    expectProduct([&](linalg::BlockRange rows) { model.addDamping(xp.data(), y.data(), rows); },
                  Matrix(source.dampingAt(t)));
    expectProduct([&](linalg::BlockRange rows) { model.addStiffness(xp.data(), y.data(), rows); },
                  Matrix(source.stiffnessAt(t)));
    model.toDofs(Eigen::Map<const Vector>(model.timed().load(), n), back);
    EXPECT_LT((back - source.loadAt(t)).cwiseAbs().maxCoeff(), 1e-14);
  }
}

TEST(CompiledModel, runsCoverEveryBlockOnce) {
  const auto source = rich();
  const CompiledModel model(source);
  int next = 0;
  for (const auto& run : model.runs()) {
    EXPECT_EQ(run.begin, next);
    EXPECT_GT(run.end, run.begin);
    next = run.end;
  }
  EXPECT_EQ(next, model.pattern().blocks());
  for (const int positions : {1, 7, 1000}) {
    int covered = 0;
    for (const auto& run : linalg::blockRuns(model.pattern(), positions)) {
      const int length = model.pattern().start(run.end) - model.pattern().start(run.begin);
      EXPECT_TRUE(length <= positions || run.end == run.begin + 1);
      covered += length;
    }
    EXPECT_EQ(covered, source.size());
  }
}

TEST(CompiledModel, combinesAnEffectiveMatrix) {
  const auto source = rich();
  CompiledModel model(source);
  model.setTime(1.5);
  linalg::BlockFactor factor(model.pattern());
  model.combine(3.0, 0.5, 2.0, factor.values());
  ASSERT_EQ(factor.factor(), -1);
  const Vector x = sampleVector(source.size(), 0.1);
  const Vector b =
      (3.0 * source.mass + 0.5 * source.dampingAt(1.5) + 2.0 * source.stiffnessAt(1.5)) * x;
  Vector bp, back;
  model.toPositions(b, bp);
  factor.solve(bp.data());
  model.toDofs(bp, back);
  EXPECT_LT((back - x).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(CompiledModel, constantLawsCostNothing) {
  auto source = rich();
  source.laws.own()[1].value =
      source.laws.own()[3].value = [](double t) { return t < 1 ? t : 1.0; };
  source.laws.own()[2].value = [](double t) { return t < 1 ? std::sqrt(t) : 1.0; };
  CompiledModel model(source);
  model.setTime(0.5);
  const long changing = model.timed().matrixStamp();
  model.setTime(1.5);
  EXPECT_GT(model.timed().matrixStamp(), changing);
  const long steady = model.timed().matrixStamp();
  model.setTime(2.5);
  EXPECT_EQ(model.timed().matrixStamp(), steady);
}

TEST(CompiledModel, changeSinceAnotherTime) {
  const auto source = rich();
  CompiledModel model(source);
  const int n = source.size();
  model.setTime(0.5);
  const auto then = model.timed().lawValues();
  model.setTime(2.0);
  const Vector x = sampleVector(n, 0.7);
  Vector xp, y = Vector::Zero(n), back;
  model.toPositions(x, xp);
  model.timed().addChangeSince(then, 4.0, xp.data(), y.data());
  model.toDofs(y, back);
  const Vector expected = 4.0 * ((source.dampingAt(2.0) - source.dampingAt(0.5)) * x) +
                          (source.stiffnessAt(2.0) - source.stiffnessAt(0.5)) * x;
  EXPECT_LT((back - expected).cwiseAbs().maxCoeff(), 1e-12);
}

/// Bitwise: the order of sums depends on the formed matrices.
TEST(CompiledModel, comesBackFromOtherTimes) {
  const auto source = rich();
  CompiledModel model(source);
  const int n = source.size();
  Vector x;
  model.toPositions(sampleVector(n, 0.7), x);
  const auto products = [&] {
    Vector y = Eigen::Map<const Vector>(model.timed().load(), n);
    model.addDamping(x.data(), y.data());
    model.addStiffness(x.data(), y.data());
    return y;
  };
  for (const bool formed : {false, true}) {
    model.setTime(0.5);
    model.setTime(0.75);
    if (formed) model.timed().damping().current();
    const Vector before = products();
    const long stamp = model.timed().matrixStamp();
    TimedTerms::Snapshot snapshot;
    model.timed().remember(snapshot);
    model.setTime(2.0);
    model.timed().damping().current();
    EXPECT_NE(products(), before);
    model.setTime(0.75);  // not formed
    model.timed().comeBack(snapshot);
    EXPECT_EQ(products(), before);
    model.setTime(2.0);
    model.timed().damping().current();
    model.timed().comeBack(snapshot);
    EXPECT_EQ(products(), before);
    EXPECT_EQ(model.timed().matrixStamp(), stamp);
    EXPECT_EQ(model.timed().time(), 0.75);
  }
}

TEST(CompiledModel, recognisesTermsThatDoNoWork) {
  auto source = denseModel(Matrix::Identity(2, 2), Matrix(), Matrix::Identity(2, 2), 2);
  Matrix G(2, 2);
  G << 0, 3, -3, 0;
  source.damping.push_back({"gyroscopic", G.sparseView(), 0});
  EXPECT_TRUE(CompiledModel(source).timed().damping().terms()[0].skew);
  G(0, 0) = 0.1;
  source.damping.own()[0].matrix = G.sparseView();
  EXPECT_FALSE(CompiledModel(source).timed().damping().terms()[0].skew);
}

TEST(CompiledModel, nodesStayTogetherAndNamesAreKept) {
  const auto source = rich();
  const CompiledModel model(source);
  EXPECT_EQ(model.pattern().blocks(), 6);
  EXPECT_EQ(model.dofName(model.pattern().partition().position[4]), "v of node 2");
}

TEST(CompiledModel, refusesAnInconsistentModel) {
  auto source = rich();
  source.initialVelocity.resize(3);
  EXPECT_THROW(CompiledModel{source}, ModelError);
}

// Point laws
// -------------------------------------------------------------------------------------------------

/// Contact with friction at the nodes of `source` (three dofs u, v, theta_z each); with `general`
/// every row mixes several dofs, as the rows of a reduced model do.
void addBore(model::SecondOrderModel& source, bool general, double lambda = 2e3) {
  const int n = source.size();
  contact::ContactPoints points;
  for (int i = 0; i < n / 3; ++i)
    points.add({i + 1, 0.3, 0.1, 1e4, 1e2, lambda, lambda, 0.3, 0.2, 0.1});
  model::PointSet set;
  set.name = "contact";
  set.law = contact::makeLaw("Nguyen")->inMotion(points, [](double t) { return 2 + t; });
  Matrix rows = Matrix::Identity(n, n);
  if (general)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        if (std::abs(i / 3 - j / 3) <= 1) rows(i, j) += 0.2 * std::sin(3.0 * i + j);
  set.rows = rows.sparseView();
  set.offset = 0.1 * sampleVector(n, 5.0);
  for (int i = 0; i < n / 3; ++i) set.entities.push_back(i + 1);
  source.points.push_back(set);
}

TEST(PointBatch, forcesAreThoseOfTheModel) {
  for (bool general : {false, true}) {
    auto source = rich();
    addBore(source, general);
    CompiledModel model(source);
    const Vector q = sampleVector(18, 0.2), v = sampleVector(18, 1.2);
    Vector qp, vp, f = Vector::Zero(18), back;
    model.toPositions(q, qp);
    model.toPositions(v, vp);
    for (auto& batch : model.points()) {
      batch.look(0.4, 0.0, qp.data());
      const Vector away = Vector::Constant(18, 100.0);
      batch.addMissed(away.data());  // everything far out: all points are active
    }
    model.addPointForces(0.4, qp.data(), vp.data(), f.data());
    model.toDofs(f, back);
    const Vector expected = source.pointForce(0.4, q, v);
    EXPECT_GT(expected.cwiseAbs().maxCoeff(), 100.0);
    EXPECT_LT((back - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.cwiseAbs().maxCoeff());
  }
}

// After the removal of destabilising parts, a tangent supplies no energy to any motion of its
// point; other tangents do not change.
TEST(PointBatch, takesOutWhatPushesOn) {
  auto source = rich();
  addBore(source, false);
  CompiledModel model(source);
  const int n = 18;
  int taken = 0;
  for (int trial = 0; trial < 40; ++trial) {
    Vector qp, vp;
    model.toPositions(sampleVector(n, 0.1 * trial), qp);
    model.toPositions(sampleVector(n, 1.0 + 0.3 * trial), vp);
    for (auto& batch : model.points()) {
      batch.look(0.4, 0.0, qp.data());
      batch.addMissed(Vector::Constant(n, 100.0).eval().data());
      batch.evaluateWithTangent(0.4, qp.data(), vp.data());
      batch.freezeTangent(1.0, 300.0);
      const int w = batch.width();
      const std::vector<double> before(batch.frozen(), batch.frozen() + batch.points() * w * w);
      batch.takeOutPush();
      for (int p : batch.active()) {
        const Matrix P = Eigen::Map<const Matrix>(batch.frozen() + p * w * w, w, w);
        const Matrix old = Eigen::Map<const Matrix>(before.data() + p * w * w, w, w);
        const double size = old.cwiseAbs().maxCoeff();
        if (old.diagonal().maxCoeff() > 0) {
          ++taken;
          const Matrix symmetric = 0.5 * (P + P.transpose());
          EXPECT_LE(linalg::symmetricValues(symmetric).maxCoeff(), 1e-12 * size);
          EXPECT_LT(((P - P.transpose()) - (old - old.transpose())).cwiseAbs().maxCoeff(),
                    1e-12 * size);
        } else {
          EXPECT_EQ(P, old);
        }
      }
    }
  }
  EXPECT_GT(taken, 3);
}

/// The matrix with these values on the pattern.
Matrix onPattern(const linalg::BlockPattern& pattern, const std::vector<double>& values) {
  Matrix A = Matrix::Zero(pattern.start(pattern.blocks()), pattern.start(pattern.blocks()));
  for (int b = 0; b < pattern.blocks(); ++b)
    for (int e = pattern.rowBegin(b); e < pattern.rowBegin(b + 1); ++e) {
      const int width = pattern.width(b), c = pattern.column(e);
      A.block(pattern.start(b), pattern.start(c), width, pattern.width(c)) =
          Eigen::Map<const Matrix>(&values[pattern.offset(e)], width, pattern.width(c));
    }
  return A;
}

// The filter of the phase correction is a positive matrix only if contact adds symmetric, restoring
// stiffness to it: friction depends on the normal force and would make vibration grow.
TEST(PointBatch, whatResistsByPositionIsSymmetric) {
  for (bool general : {false, true}) {
    auto source = rich();
    addBore(source, general);
    CompiledModel model(source);
    const int n = 18;
    bool closed = false;
    for (int trial = 0; trial < 40; ++trial) {
      Vector qp, vp;
      model.toPositions(sampleVector(n, 0.1 * trial), qp);
      model.toPositions(sampleVector(n, 1.0 + 0.3 * trial), vp);
      std::vector<double> values(model.pattern().storage(), 0.0);
      for (auto& batch : model.points()) {
        batch.look(0.4, 0.0, qp.data());
        batch.evaluateWithTangent(0.4, qp.data(), vp.data());
        batch.freezeTangent(1.0, 300.0);
        batch.takeOutPush();
        batch.subtractPositionTangent(values.data());
      }
      const Matrix A = onPattern(model.pattern(), values);
      const double size = A.cwiseAbs().maxCoeff();
      closed = closed || size > 1e3;
      EXPECT_LE((A - A.transpose()).cwiseAbs().maxCoeff(), 1e-12 * size);
      EXPECT_GE(linalg::symmetricValues(A).minCoeff(), -1e-10 * size);
    }
    EXPECT_TRUE(closed);
  }
}

TEST(PointBatch, tangentsMatchDifferences) {
  for (bool general : {false, true}) {
    auto source = rich();
    addBore(source, general);
    CompiledModel model(source);
    const int n = 18;
    const Vector q = sampleVector(n, 0.2), v = sampleVector(n, 1.2), x = sampleVector(n, 2.2);
    const double cd = 1.0, cv = 0.3, eps = 1e-6;
    // Directional derivative of the forces along (cd x, cv x).
    const Vector expected = (source.pointForce(0.4, q + eps * cd * x, v + eps * cv * x) -
                             source.pointForce(0.4, q - eps * cd * x, v - eps * cv * x)) /
                            (2 * eps);
    Vector qp, vp, xp, back;
    model.toPositions(q, qp);
    model.toPositions(v, vp);
    model.toPositions(x, xp);
    linalg::BlockValues values(model.pattern().storage(), 0.0);
    Vector y = Vector::Zero(n);
    for (auto& batch : model.points()) {
      batch.look(0.4, 0.0, qp.data());
      const Vector away = Vector::Constant(n, 100.0);
      batch.addMissed(away.data());
      batch.evaluateWithTangent(0.4, qp.data(), vp.data());
      batch.freezeTangent(cd, cv);
      batch.addTangentTimes(xp.data(), y.data());
      batch.subtractTangent(values.data());
    }
    model.toDofs(y, back);
    const double scale = expected.cwiseAbs().maxCoeff();
    EXPECT_LT((back - expected).cwiseAbs().maxCoeff(), 1e-6 * scale) << "general rows: " << general;
    Vector z = Vector::Zero(n);
    linalg::BlockProduct(model.pattern(), {&values}).addTo(values.data(), xp.data(), z.data());
    EXPECT_LT((y + z).cwiseAbs().maxCoeff(), 1e-12 * scale)
        << "assembled and applied tangents differ; general rows: " << general;
  }
}

TEST(PointBatch, looksOnlyAtPointsThatCanTouchBeforeTheNextLook) {
  auto source = droppedBalls(4, 1e6, 0, 1e6);
  CompiledModel model(source);
  auto& batch = model.points()[0];
  Vector q(4);
  q << 0.5, 0.2, 0.05, -0.01;
  batch.look(0.0, 0.1, q.data());
  EXPECT_EQ(batch.active(), (std::vector<int>{3}))
      << "without a rate only what touches is looked at";
  q << 0.4, 0.15, 0.00, 0.01;  // closing at 1, 0.5, 0.5 m/s; the last one opens
  batch.look(0.1, 0.1, q.data());
  EXPECT_EQ(batch.active(), (std::vector<int>{2}));
  q << 0.3, 0.10, -0.05, 0.03;
  batch.look(0.2, 0.16, q.data());  // reach 0.32 m, 0.16 m
  EXPECT_EQ(batch.active(), (std::vector<int>{0, 1, 2}));
  const long before = batch.evaluations();
  Vector v = Vector::Zero(4), f = Vector::Zero(4);
  model.addPointForces(0.2, q.data(), v.data(), f.data());
  EXPECT_EQ(batch.evaluations() - before, 3);
  q[3] = -0.001;
  EXPECT_TRUE(batch.addMissed(q.data()));
  EXPECT_EQ(batch.active(), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_FALSE(batch.addMissed(q.data()));
}

}  // namespace CompiledModelTest
}  // namespace tooljoint::transient::testing
