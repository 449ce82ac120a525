// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Dense>
#include <Teuchos_ParameterList.hpp>
#include <functional>
#include <gtest/gtest.h>

#include "model/laws/Friction.hpp"
#include "tests/unit/contact/Samples.hpp"

namespace tooljoint::contact::testing {

std::shared_ptr<const ContactLaw> law(const std::string& name) {
  Teuchos::ParameterList own;
  if (name == "Hunt-Crossley") own.set("Exponent", 1.5).set("Dissipation", 2.0);
  return LawRegistry::instance().make(name, own);
}

}  // namespace tooljoint::contact::testing

namespace TangentsTest {

using namespace tooljoint::contact;
using namespace tooljoint::contact::testing;

double speed(double t) { return 12.0 + t; }

/// Largest difference between a tangent and central differences of the force, over the largest
/// entry of its row.
void expectTangents(const tooljoint::model::PointLaw& contact, const State& state,
                    const std::string& what) {
  const Answer exact = answer(contact, 0.5, state.d, state.v);
  const auto alone = force(contact, 0.5, state.d, state.v);
  const int n = contact.width();
  for (std::size_t i = 0; i < alone.size(); ++i)
    EXPECT_NEAR(exact.f[i], alone[i], 1e-13 * std::abs(alone[i])) << what;
  for (int column = 0; column < n; ++column) {
    for (const bool velocity : {false, true}) {
      const double h = velocity ? 1e-5 : 1e-8;
      State plus = state, minus = state;
      (velocity ? plus.v : plus.d)[static_cast<std::size_t>(column)] += h;
      (velocity ? minus.v : minus.d)[static_cast<std::size_t>(column)] -= h;
      const auto fp = force(contact, 0.5, plus.d, plus.v);
      const auto fm = force(contact, 0.5, minus.d, minus.v);
      const auto& tangent = velocity ? exact.dfdv : exact.dfdd;
      for (int row = 0; row < n; ++row) {
        double scale = 0.0;
        for (int c = 0; c < n; ++c)
          scale = std::max(scale, std::abs(tangent[static_cast<std::size_t>(n * row + c)]));
        const double difference =
            (fp[static_cast<std::size_t>(row)] - fm[static_cast<std::size_t>(row)]) / (2.0 * h);
        EXPECT_NEAR(tangent[static_cast<std::size_t>(n * row + column)], difference,
                    2e-7 * scale + 1e-5)
            << what << " row " << row << " column " << column
            << (velocity ? " velocity" : " position");
      }
    }
  }
}

class Tangents : public ::testing::TestWithParam<const char*> {};

TEST_P(Tangents, AgreeWithDifferencesInsideOnAndBeyondTheWall) {
  for (const double mu : {0.0, 0.2}) {
    ContactPoint point = steelOnRock();
    point.muStatic = mu;
    point.muDynamic = 0.5 * mu;
    const auto contact = law(GetParam())->inMotion(batch({point}), speed);
    const auto both = law(GetParam())->inMotion(batch({point}), speed, along(0.4));
    for (const double penetration : {-0.02, -1e-3, -2e-5, 2e-5, 3e-4, 5e-3})
      for (const double angle : {0.0, 1.1, 2.5, -2.0}) {
        const State state(point.clearance + penetration, angle);
        const std::string what = std::string(GetParam()) + " mu " + std::to_string(mu) + " G " +
                                 std::to_string(penetration) + " at " + std::to_string(angle);
        expectTangents(*contact, state, what);
        expectTangents(*both, state.with(0.2, -0.15), what + ", along the hole too");
      }
  }
}

// The tangent of a sliding contact is not symmetric, and its symmetric part is indefinite; without
// friction it is symmetric and never negative, and the normal stiffness is the same.
TEST_P(Tangents, WithoutFrictionAreSymmetricAndNotNegative) {
  const auto contact = law(GetParam())->inMotion(batch({steelOnRock(), steelOnRock()}), speed);
  const auto smooth = tooljoint::model::withoutFriction(contact);
  ASSERT_NE(smooth, contact);
  EXPECT_EQ(smooth->size(), 2);
  EXPECT_EQ(tooljoint::model::withoutFriction(smooth), smooth) << "nothing is left to leave out";
  for (const double angle : {0.0, 1.1, -2.0}) {
    State state(steelOnRock().clearance + 3e-4, angle), two = state;
    two.d.insert(two.d.end(), state.d.begin(), state.d.end());
    two.v.assign(6, 0.0);
    const Answer rough = answer(*contact, 0.5, two.d, two.v),
                 plain = answer(*smooth, 0.5, two.d, two.v);
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> k(plain.dfdd.data() + 9),
        r(rough.dfdd.data() + 9);
    const Eigen::Matrix3d K = -k, R = -0.5 * (r + r.transpose());
    EXPECT_LT((K - K.transpose()).cwiseAbs().maxCoeff(), 1e-12 * K.cwiseAbs().maxCoeff());
    const auto least = [](const Eigen::Matrix3d& A) {
      return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(A).eigenvalues().minCoeff();
    };
    EXPECT_GT(least(K), -1e-9 * K.cwiseAbs().maxCoeff());
    EXPECT_LT(least(R), -1e-5 * R.cwiseAbs().maxCoeff())
        << "with friction: -(mu R_c)^2 / 4 of the normal stiffness at least";
    const Eigen::Vector3d n(std::cos(angle), std::sin(angle), 0.0);
    EXPECT_NEAR(n.dot(K * n), n.dot(R * n), 1e-9 * K.cwiseAbs().maxCoeff()) << "normal stiffness";
    EXPECT_EQ(plain.f[5], 0.0) << "no torque";
  }
}

TEST_P(Tangents, AgreeWithDifferencesWithoutClearance) {
  ContactPoint gauge = steelOnRock();
  gauge.clearance = 0.0;
  const auto contact = law(GetParam())->inMotion(batch({gauge}), speed);
  expectTangents(*contact, State(2e-3, 0.7), GetParam());
}

TEST_P(Tangents, StaticOnesAgreeWithDifferences) {
  const ContactPoint point = steelOnRock();
  const auto contact = law(GetParam())->atRest(batch({point}));
  StaticContact::Options options;
  options.lambda = 3e3;
  options.frictionScale = 0.75;
  options.sliding = {0.4, -8.0};  // v_c = -0.64 m/s
  options.stiffnessScale = 0.5;
  options.pull = 0.25;
  for (const double penetration : {-1e-3, 2e-5, 3e-4, 5e-3}) {
    const double r = point.clearance + penetration;
    const double uv[2] = {r * std::cos(2.0), r * std::sin(2.0)};
    double f[StaticContact::kForces], tangent[2 * StaticContact::kForces];
    contact->evaluate(options, uv, f, tangent);
    for (int column = 0; column < 2; ++column) {
      const double h = 1e-7;
      double plus[2] = {uv[0], uv[1]}, minus[2] = {uv[0], uv[1]};
      double fp[StaticContact::kForces], fm[StaticContact::kForces];
      plus[column] += h;
      minus[column] -= h;
      contact->evaluate(options, plus, fp);
      contact->evaluate(options, minus, fm);
      for (int row = 0; row < StaticContact::kForces; ++row)
        EXPECT_NEAR(tangent[2 * row + column], (fp[row] - fm[row]) / (2.0 * h),
                    2e-7 * 1e7 * (row == 3 ? 0.08 : 1.0))
            << penetration << row << column;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, Tangents, ::testing::Values("Nguyen", "Clamped", "Hunt-Crossley"),
                         testName);

}  // namespace TangentsTest
