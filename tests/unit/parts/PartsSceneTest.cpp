// SPDX-License-Identifier: BSD-3-Clause
// Scenes of imported parts against closed forms: joints, turned parts, equilibrium, starts, laws of
// time.
#include "parts/PartsScene.hpp"

#include <Eigen/Geometry>
#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <cmath>
#include <gtest/gtest.h>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "coupling/CoupledModes.hpp"
#include "linalg/DenseDecompositions.hpp"
#include "linalg/trilinos/DirectSolver.hpp"
#include "model/SpeedLaw.hpp"
#include "model/laws/Connectors.hpp"
#include "parts/TimeLaw.hpp"
#include "tests/support/SampleParts.hpp"
#include "tests/unit/io/Scratch.hpp"

namespace tooljoint::parts {
namespace PartsSceneTest {

using model::DofLabel;

constexpr double k = 1e6, m = 2.0;

/// One Newton step with the direct solver: enough for linear parts.
model::SolveOutcome linearSolver(const model::NonlinearProblem& problem, Vector& x,
                                 const model::SolveRequest& request) {
  Vector r(problem.size());
  Sparse J;
  problem.residual(x, r);
  problem.jacobian(x, J);
  x -= linalg::DirectSolver(J).solve(r);
  problem.residual(x, r);
  const double left = r.cwiseProduct(problem.residualScale()).cwiseAbs().maxCoeff();
  return {left <= request.tolerance, 1, left, 0.0, ""};
}

class Files {
 public:
  std::string bar(const std::string& name, int elements) {
    PartContent content;
    content.part = samples::bar(name, 1, elements, k, m);
    content.interfaces = {{"left", {0}, {1}}, {"right", {elements}, {elements + 1}}};
    const auto path = scratch_ / (name + ".h5");
    writePart(content, path, FileKind::Hdf5);
    return path;
  }
  /// A mass point with components v, u, theta at node 1, on springs to the ground along u and
  /// theta; sets "all" and "pin" (u alone).
  std::string point(const std::string& name) {
    PartContent content;
    auto& part = content.part;
    part.name = name;
    part.model.componentNames = {"v", "u", "theta"};
    for (int c = 0; c < 3; ++c) part.model.dofs.push_back(DofLabel::physical(1, c));
    part.model.mass = samples::square(3, {{0, 0, 3.0}, {1, 1, 3.0}, {2, 2, 5.0}});
    part.model.stiffness.push_back({"ground", samples::square(3, {{1, 1, 4e5}, {2, 2, 2e5}}), 0});
    samples::complete(part);
    content.interfaces = {{"all", {0, 1, 2}, {1}}, {"pin", {1}, {1}}};
    return keep(content);
  }
  std::string keep(const PartContent& content) {
    const auto path = scratch_ / (content.part.name + ".h5");
    writePart(content, path, FileKind::Hdf5);
    return path;
  }

 private:
  test::Scratch scratch_;
};

ImportedPart imported(const std::string& name, const std::string& file,
                      const std::vector<std::string>& fixed = {}) {
  ImportedPart part;
  part.name = name;
  part.where = "Parts/Imported/" + name;
  part.file = file;
  part.fixed = fixed;
  return part;
}

PartsScene build(const PartsSettings& settings, const coupling::CouplingInput& plan = {}) {
  return buildScene(settings, plan, [](const std::string& name) { return name; });
}

coupling::Coupling whole(const PartsScene& scene) {
  return coupling::coupleWithPositions(scene.parts, scene.coupling);
}

Vector omegaSquared(const PartsScene& scene) {
  const auto full = whole(scene);
  return coupling::lowestModes(full.model, full.model.size()).values;
}

TEST(PartsScene, BarsOfOneFileInARowAreTheLongBar) {
  Files files;
  PartsSettings settings;
  const auto file = files.bar("bar", 4);
  settings.imported = {imported("a", file, {"left"}), imported("b", file), imported("c", file)};
  settings.joints = {"a:right = b:left", "b:5 = c:1"};
  const auto scene = build(settings);
  const Vector found = omegaSquared(scene);
  ASSERT_EQ(found.size(), 12);
  const auto one = samples::bar("one", 1, 12, k, m, {1});
  const Vector expected =
      linalg::lowestModes(one.model.stiffnessAt(0.0), one.model.mass, 12).values;
  for (int i = 0; i < 12; ++i) EXPECT_NEAR(found[i], expected[i], 1e-11 * expected[11]);
  // consistent bar, exact: omega^2 = 6 k/m (1 - cos x)/(2 + cos x), x = pi / 24
  const double x = constants::pi / 24;
  EXPECT_NEAR(found[0], 6 * k / m * (1 - std::cos(x)) / (2 + std::cos(x)), 1e-9 * found[0]);
  // joined nodes have both names, the others one; sets without a joint are retained
  int shared = 0;
  for (const auto& [number, names] : scene.nodes) shared += names.size() == 2 ? 1 : 0;
  EXPECT_EQ(shared, 2);
  EXPECT_EQ(scene.parts[2].retained, std::vector<int>{4});
  EXPECT_EQ(scene.parts[2].interface, std::vector<int>{0});
}

TEST(PartsScene, SetsJoinOnlyTheirComponents) {
  Files files;
  PartsSettings settings;
  settings.imported = {imported("p", files.point("p")), imported("q", files.point("q"))};
  settings.joints = {"p:pin = q:pin"};
  auto scene = build(settings);
  EXPECT_EQ(whole(scene).model.size(), 5);  // u is shared, v and theta are not
  const Vector found = omegaSquared(scene);
  EXPECT_NEAR(found[2], 2e5 / 5.0, 1e-6);
  EXPECT_NEAR(found[4], 8e5 / 6.0, 1e-6);
  settings.joints = {"p:all = q:pin"};
  EXPECT_EQ(whole(build(settings)).model.size(), 5);
  settings.joints = {"p:1 = q:all"};
  EXPECT_EQ(whole(build(settings)).model.size(), 3);
}

TEST(PartsScene, PartsOfDifferentComponentsMeet) {
  Files files;
  PartsSettings settings;
  settings.imported = {imported("bar", files.bar("bar", 1), {"left"}),
                       imported("p", files.point("p"), {"1 v theta"})};
  settings.joints = {"bar:right = p:pin"};
  const Vector found = omegaSquared(build(settings));
  ASSERT_EQ(found.size(), 1);
  EXPECT_NEAR(found[0], (k + 4e5) / (m / 3 + 3.0), 1e-6);
}

/// A cantilever with a mass point of three translations at its tip: the beam has six rotations and
/// translations, the point three of them. With mass at the tip alone the frequencies are those of
/// three springs, in any frame of the point.
struct PointOnABeam {
  Files files;
  PartsSettings settings;
  Matrix K = Matrix::Zero(6, 6);
  PointOnABeam() {
    const double l = 2.0, ea = 3e5, ei = 4e3, gj = 5e3;
    K.diagonal() << 12 * ei / (l * l * l), 24 * ei / (l * l * l), ea / l, 8 * ei / l, 4 * ei / l,
        gj / l;
    K(0, 4) = K(4, 0) = -6 * ei / (l * l);
    K(1, 3) = K(3, 1) = 12 * ei / (l * l);
    settings.imported = {
        imported("beam", write("beam", 6, K, Matrix::Identity(6, 6) * 1e-9)),
        imported("point", write("point", 3, Matrix::Zero(3, 3), Matrix::Identity(3, 3) * 7.0))};
    settings.joints = {"beam:1 = point:1"};
  }
  /// The stiffness of the translations with free rotations.
  static Matrix translations(const Matrix& K) {
    return linalg::inverseOf(linalg::inverseOf(K).topLeftCorner(3, 3));
  }
  std::string write(const std::string& name, int dofs, const Matrix& stiffness,
                    const Matrix& mass) {
    PartContent content;
    auto& part = content.part;
    part.name = name;
    part.model.componentNames = {"u", "v", "w", "theta_x", "theta_y", "theta_z"};
    for (int c = 0; c < dofs; ++c) part.model.dofs.push_back(DofLabel::physical(1, c));
    part.model.mass = mass.sparseView();
    part.model.stiffness.push_back({"K", stiffness.sparseView(), 0});
    samples::complete(part);
    return files.keep(content);
  }
};

TEST(PartsScene, APointOfTranslationsMeetsABeamOfSixDofs) {
  PointOnABeam one;
  for (const bool turned : {false, true}) {
    one.settings.imported[1].turned = turned;
    one.settings.imported[1].axes =
        Eigen::AngleAxisd(0.7, Vector3(1, 2, -0.5).normalized()).toRotationMatrix();
    const auto scene = build(one.settings);
    const auto full = whole(scene).model;
    ASSERT_EQ(full.size(), 6);
    EXPECT_EQ(Matrix(full.recovery).cwiseAbs().sum(), 6.0) << "rotations come from the beam";
    const Vector found = omegaSquared(scene),
                 expected = linalg::symmetricValues(PointOnABeam::translations(one.K)) / 7.0;
    for (Eigen::Index i = 0; i < 3; ++i) EXPECT_NEAR(found[i] / expected[i], 1.0, 1e-6);
  }
}

/// A joint of three parts couples their common components: the rotations of two beams stay separate
/// if the third part has none, also in turned parts. Single components of a turned part cannot be
/// joined.
TEST(PartsScene, WholeTriplesOfTurnedPartsStayApart) {
  PointOnABeam one;
  one.settings.imported.push_back(one.settings.imported[0]);
  auto& second = one.settings.imported.back();
  second.name = "second";
  second.turned = true;
  second.axes = Eigen::AngleAxisd(0.7, Vector3(1, 2, -0.5).normalized()).toRotationMatrix();
  one.settings.joints = {"beam:1 = point:1 = second:1"};
  const auto full = whole(build(one.settings)).model;
  EXPECT_EQ(full.size(), 9);
  Matrix R = Matrix::Identity(6, 6);
  R.topLeftCorner(3, 3) = R.bottomRightCorner(3, 3) = second.axes;
  const Matrix springs =
      PointOnABeam::translations(one.K) + PointOnABeam::translations(R * one.K * R.transpose());
  const Vector found = omegaSquared(build(one.settings)),
               expected = linalg::symmetricValues(springs) / 7.0;
  for (Eigen::Index i = 0; i < 3; ++i) EXPECT_NEAR(found[i] / expected[i], 1.0, 1e-6);

  one.settings.imported[0] = imported("p", one.files.point("p"));
  one.settings.joints = {"p:pin = second:1"};
  try {
    build(one.settings);
    FAIL() << "u alone of a turned part";
  } catch (const DeckError& error) {
    EXPECT_NE(std::string(error.what()).find("its rotation mixes them with others"),
              std::string::npos)
        << error.what();
  }
}

TEST(PartsScene, TurnedPartsAreSeenInTheCommonFrame) {
  Files files;
  PartsSettings settings;
  settings.imported = {imported("p", files.point("p"))};
  settings.imported[0].turned = true;
  settings.imported[0].axes << 0, -1, 0, 1, 0, 0, 0, 0, 1;  // a quarter turn: u of the part is v
  settings.starts = {{"Parts/Starts/kick", "p", 1, "u", 0.25, 2.0}};
  auto scene = build(settings);
  findStart(settings, 0.0, linearSolver, scene);
  EXPECT_EQ(scene.parts[0].model.initialVelocity,
            Vector3(0, 2.0, 0));  // in the frame of the part: v, u, theta
  const auto full = whole(scene);
  const Vector D = full.model.recoveryOffset + full.model.recovery * full.model.initialDisplacement;
  EXPECT_NEAR(D[0], 0.25, 1e-16);  // v of the common frame
  EXPECT_NEAR(D[1], 0.0, 1e-16);
}

TEST(PartsScene, EquilibriumIsTheReferenceOfTheParts) {
  Files files;
  PartsSettings settings;
  const auto file = files.bar("bar", 5);
  settings.imported = {imported("a", file, {"left"}), imported("b", file)};
  settings.joints = {"a:right = b:left"};
  settings.loads = {{"pull", "Parts/Loads/pull", "b", 6, "u", 300.0, "pulse"}};
  settings.laws = {{"pulse", [](double t) { return t < 1.0 ? 1.0 : 0.5; }}};
  settings.atRest = true;
  auto scene = build(settings);
  findStart(settings, 2.0, linearSolver, scene);
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(scene.parts[0].reference[i], 150.0 / k * (i + 1), 1e-15);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(scene.parts[1].reference[i], 150.0 / k * (i + 5), 1e-15);
  EXPECT_EQ(scene.parts[1].model.initialDisplacement, scene.parts[1].reference);
}

TEST(PartsScene, ConnectionsNamePartsAndTheirOwnNodes) {
  Files files;
  PartsSettings settings;
  const auto file = files.bar("bar", 1);
  settings.imported = {imported("a", file, {"left"}), imported("b", file, {"right"})};
  coupling::CouplingInput plan;
  plan.ownNumbers = true;
  coupling::PointInput spring;
  spring.name = spring.path = "spring";
  spring.first = {"a", 2};
  spring.second = coupling::PartNode{"b", 1};
  spring.component = "u";
  spring.law = [](int) { return model::springs({{5e5, 0, 0}}); };
  plan.points = {spring};
  // two masses m/3 on springs k, a spring s between them: k and k + 2 s
  const Vector found = omegaSquared(build(settings, plan));
  ASSERT_EQ(found.size(), 2);
  EXPECT_NEAR(found[0], k / (m / 3), 1e-5);
  EXPECT_NEAR(found[1], (k + 1e6) / (m / 3), 1e-5);
}

TEST(PartsScene, RefusesWhatDoesNotFit) {
  Files files;
  PartsSettings settings;
  const auto file = files.bar("bar", 2), longer = files.bar("longer", 3);
  settings.imported = {imported("a", file), imported("b", longer)};
  const auto refused = [&](const std::string& joint, const std::string& sentence) {
    settings.joints = {joint};
    try {
      build(settings);
      FAIL() << joint;
    } catch (const DeckError& error) {
      EXPECT_NE(std::string(error.what()).find(sentence), std::string::npos) << error.what();
    }
  };
  refused("a:right", "a joint needs two or more places");
  refused("a right = b:left", "a place is written PART:NODE or PART:SET");
  refused("a:9 = b:left", "has no node 9");
  settings.imported[0].fixed = {"right"};
  refused("a:right = b:left", "u of node 3 is fixed in part \"a\" and free in part \"b\"");
  settings.joints.clear();
  try {
    build(settings);
    FAIL() << "node 3 is held and free";
  } catch (const DeckError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("Parts/Imported/a/Fixed fixes u of node 3, which is free in part \"b\""),
              std::string::npos)
        << error.what();
  }
}

TEST(PartsScene, AReleaseOfWhatNothingJoinsNamesTheNodeOfThePart) {
  PointOnABeam one;
  coupling::CouplingInput plan;
  auto& release = plan.releases.emplace_back();
  release.name = "free";
  release.path = "Coupling/Releases/free";
  release.node.part = "beam";
  release.node.node = 1;
  release.components = {"theta_x"};
  plan.ownNumbers = true;
  try {
    whole(build(one.settings, plan));
    FAIL() << "nothing is joined there";
  } catch (const ModelError& error) {
    EXPECT_EQ(std::string(error.what())
                  .find("A release names theta_x of node 1 of part \"beam\", "
                        "which no other part has"),
              0u)
        << error.what();
  }
}

Teuchos::Array<double> numbers(const std::vector<double>& values) {
  return Teuchos::Array<double>(values);
}
double at(const std::string& form, const Teuchos::ParameterList& list, double t) {
  return TimeLaws::instance().make(form, list)->value(t);
}

TEST(TimeLaw, FormsAreTheirFormulas) {
  Teuchos::ParameterList harmonic;
  harmonic.set("Mean", 1.0)
      .set("Amplitude", 2.0)
      .set("Frequency", 0.25)
      .set("Phase", 0.5)
      .set("Start Time", 1.0)
      .set("End Time", 3.0);
  EXPECT_EQ(at("Harmonic", harmonic, 0.5), 1.0);
  EXPECT_NEAR(at("Harmonic", harmonic, 2.0), 1.0 + 2.0 * std::sin(constants::pi + 0.5), 1e-15);
  EXPECT_EQ(at("Harmonic", harmonic, 3.0), 1.0);
  Teuchos::ParameterList ramp;
  ramp.set("From", 1.0).set("To", 3.0).set("Start Time", 2.0).set("Duration", 4.0);
  EXPECT_EQ(at("Ramp", ramp, 1.0), 1.0);
  EXPECT_EQ(at("Ramp", ramp, 3.0), 1.5);
  EXPECT_EQ(at("Ramp", ramp, 9.0), 3.0);
  Teuchos::ParameterList table;
  table.set("Times", numbers({1.0, 2.0, 4.0})).set("Values", numbers({5.0, 7.0, 6.0}));
  EXPECT_EQ(at("Table", table, 0.0), 5.0);
  EXPECT_EQ(at("Table", table, 1.5), 6.0);
  EXPECT_EQ(at("Table", table, 3.0), 6.5);
  EXPECT_EQ(at("Table", table, 5.0), 6.0);
}

TEST(TimeLaw, FormsOfTheSpeedFollowIt) {
  Teuchos::ParameterList power("square"), table("bearing");
  power.set("Form", "Speed Power")
      .sublist("Speed Power")
      .set("Factor", 3.0)
      .set("Exponent", 2.0)
      .set("Odd", true);
  table.set("Form", "Speed Table")
      .sublist("Speed Table")
      .set("Speeds", numbers({0.0, 10.0}))
      .set("Values", numbers({5.0, 7.0}));
  const model::ScalarLaw speed{"Omega", [](double t) { return -2.0 * t; }, {3.0}},
      rising{"Omega", [](double t) { return 2.0 * t; }};
  const auto square = readTimeLaw("square", power, speed),
             bearing = readTimeLaw("bearing", table, rising);
  EXPECT_EQ(square.corners, speed.corners);
  EXPECT_EQ(square.value(1.0), -12.0);
  EXPECT_EQ(bearing.value(2.5), 6.0);
  EXPECT_EQ(model::speedLaw(square)->steady(4.0), 48.0);
  EXPECT_EQ(model::speedLaw(bearing)->steady(5.0), 6.0);
  EXPECT_THROW(readTimeLaw("square", power, {}), DeckError);
}

TEST(TimeLaw, OmegaIsTheSpeedAndItsRateIsZeroWhereItIsConstant) {
  Teuchos::ParameterList ramp("ramp");
  ramp.set("Form", "Ramp")
      .sublist("Ramp")
      .set("From", 0.0)
      .set("To", 8.0)
      .set("Start Time", 0.0)
      .set("Duration", 2.0);
  EXPECT_EQ(readTimeLaw("Omega", ramp, {}).value(1.0), 4.0);
  EXPECT_EQ(model::speedLaw(readTimeLaw("Omega", ramp, {}))->steady(6.0), 6.0);
  EXPECT_EQ(model::speedLaw(readTimeLaw("dOmega/dt", ramp, {}))->steady(6.0), 0.0);
  EXPECT_EQ(model::speedLaw(readTimeLaw("wave", ramp, {})), nullptr);
}

TEST(TimeLaw, RefusesNumbersThatMakeNoSense) {
  Teuchos::ParameterList table;
  table.set("Times", numbers({1.0, 1.0})).set("Values", numbers({5.0, 7.0}));
  EXPECT_THROW(at("Table", table, 0.0), DeckError);
  table.set("Times", numbers({1.0}));
  EXPECT_THROW(at("Table", table, 0.0), DeckError);
}

}  // namespace PartsSceneTest
}  // namespace tooljoint::parts
