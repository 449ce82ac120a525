// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Every single term of the equations of motion against its integral along a straight inclined
/// string of two sections in two bores: M D'' + C(Omega) D' + (K + dOmega/dt C_ac') D = F -
/// dOmega/dt F_thetaz + R_ipa (Nguyen et al. 2020, equations 19, 26-28; mud after its section 2.3
/// with the coefficients of Chen 1981 and Fritz 1970).
#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <string>

#include "common/Index.hpp"
#include "substructures/mud/AnnularFlow.hpp"
#include "tests/unit/drillstring/InclinedString.hpp"

namespace tooljoint::drillstring {
namespace EquationsTest {

using namespace testing_;
using constants::pi;
using Scene = InclinedString;

const model::MatrixTerm* find(const model::SharedList<model::MatrixTerm>& terms,
                              const std::string& name) {
  for (const auto& term : terms)
    if (term.name == name) return &term;
  return nullptr;
}

/// The form of the term of this name and its law.
void expectTerm(const Scene& scene, const model::SecondOrderModel& model,
                const model::SharedList<model::MatrixTerm>& terms, const std::string& name,
                const std::string& law, double value) {
  const auto* term = find(terms, name);
  ASSERT_NE(term, nullptr) << name;
  EXPECT_EQ(model.laws[at(term->law)].name, law) << name;
  EXPECT_NEAR(scene.form(term->matrix), value, 1e-10 * std::abs(value)) << name;
}

void expectLoad(const Scene& scene, const model::SecondOrderModel& model, const std::string& name,
                const std::string& law, double value) {
  for (const auto& load : model.loads) {
    if (load.name != name) continue;
    EXPECT_EQ(model.laws[at(load.law)].name, law) << name;
    EXPECT_NEAR(scene.work(load.vector), value, 1e-10 * std::abs(value)) << name;
    return;
  }
  FAIL() << "no load " << name;
}

double strain(const PolynomialMotion& a, const PolynomialMotion& b, double z, std::size_t e) {
  return youngModulus * area(e) * a.w.slope(z) * b.w.slope(z) +
         shearModulus * 2.0 * inertia(e) * a.twist.slope(z) * b.twist.slope(z) +
         youngModulus * inertia(e) *
             (a.u.curvature(z) * b.u.curvature(z) + a.v.curvature(z) * b.v.curvature(z));
}

double kinetic(const PolynomialMotion& a, const PolynomialMotion& b, double z, std::size_t e) {
  return density * (area(e) * (a.u.value(z) * b.u.value(z) + a.v.value(z) * b.v.value(z) +
                               a.w.value(z) * b.w.value(z)) +
                    inertia(e) * (a.u.slope(z) * b.u.slope(z) + a.v.slope(z) * b.v.slope(z)) +
                    2.0 * inertia(e) * a.twist.value(z) * b.twist.value(z));
}

/// F (u' du' + v' dv') + T (v' du'' - u' dv'').
double geometric(const PolynomialMotion& a, const PolynomialMotion& b, double z, double force,
                 double moment) {
  return force * (a.u.slope(z) * b.u.slope(z) + a.v.slope(z) * b.v.slope(z)) +
         moment * (b.v.slope(z) * a.u.curvature(z) - b.u.slope(z) * a.v.curvature(z));
}

double lateral(const PolynomialMotion& a, const PolynomialMotion& b, double z) {
  return a.u.value(z) * b.u.value(z) + a.v.value(z) * b.v.value(z);
}

// -------------------------------------------------------------------------------------------------
// structure

TEST(Equations, MassAndStiffnessOfTheBareString) {
  const Scene scene;
  const auto model = assemble(scene.equations());
  ASSERT_EQ(model.size(), 18);
  const double m = alongString(kinetic);
  EXPECT_NEAR(scene.form(model.mass), m, 1e-11 * std::abs(m));
  ASSERT_EQ(model.stiffness.size(), 1u);
  expectTerm(scene, model, model.stiffness, "structure", "1", alongString(strain));
  EXPECT_TRUE(model.damping.empty());
  EXPECT_TRUE(model.loads.empty());
}

TEST(Equations, PrestressAddsTheGeometricStiffnessOfTheForcesOfThePath) {
  Scene scene;
  scene.prestress();
  const auto model = assemble(scene.equations());
  expectTerm(scene, model, model.stiffness, "structure", "1",
             alongString([](const auto& a, const auto& b, double z, std::size_t e) {
               return strain(a, b, z, e) + geometric(a, b, z, axialForce[e], torque[e]);
             }));
}

TEST(Equations, TheTangentOfThePathTakesThePlaceOfStiffnessAndPrestress) {
  Scene scene;
  scene.prestress();
  for (int e = 0; e < 2; ++e) scene.path.tangent.push_back(beam::Matrix12::Random());
  const StringModel model = scene.equations();
  ASSERT_EQ(model.stiffness.size(), 1u);
  for (std::size_t e = 0; e < 2; ++e)
    EXPECT_EQ(model.stiffness[0].matrices[e], scene.path.tangent[e]);
}

TEST(Equations, WeightActsDownwardsAlongTheWholeString) {
  Scene scene;
  scene.loads = acting(gravity, 0.0, 0.0);
  const Vector3 down = scene.axes.transpose() * Vector3(0.0, 0.0, gravity);
  EXPECT_GT(std::abs(down.x()), 3.0);
  expectLoad(scene, assemble(scene.equations()), "weight", "1",
             alongString([&](const auto& a, const auto&, double z, std::size_t e) {
               return density * area(e) *
                      (down.x() * a.u.value(z) + down.y() * a.v.value(z) + down.z() * a.w.value(z));
             }));
}

// -------------------------------------------------------------------------------------------------
// rotation

/// Left-hand side: +rho I_p Omega dtheta_y/dt in the row of theta_x, -rho I_p Omega dtheta_x/dt in
/// that of theta_y.
TEST(Equations, GyroscopicMomentsTurnWithTheSpeed) {
  Scene scene;
  scene.turn();
  const auto model = assemble(scene.equations());
  expectTerm(scene, model, model.damping, "gyroscopic", "Omega",
             alongString([](const auto& a, const auto& b, double z, std::size_t e) {
               const double thetaX = -a.v.slope(z), thetaY = a.u.slope(z), rateX = -b.v.slope(z),
                            rateY = b.u.slope(z);
               return density * 2.0 * inertia(e) * (thetaX * rateY - thetaY * rateX);
             }));
}

/// dOmega/dt C_ac' D: the kinetic energy Omega rho I_p int theta_y dtheta_x/dt gives only the row
/// of theta_x.
TEST(Equations, SpinUpCouplesTheSlopesWithTheAngularAcceleration) {
  Scene scene;
  scene.turn();
  const auto model = assemble(scene.equations());
  expectTerm(scene, model, model.stiffness, "spin-up", "dOmega/dt",
             alongString([](const auto& a, const auto& b, double z, std::size_t e) {
               return density * 2.0 * inertia(e) * -a.v.slope(z) * b.u.slope(z);
             }));
  expectLoad(scene, model, "spin-up", "dOmega/dt",
             alongString([](const auto& a, const auto&, double z, std::size_t e) {
               return -density * 2.0 * inertia(e) * a.twist.value(z);
             }));
}

/// At a time, the terms enter with the value of their law: Omega(0.5 s) = 4 rad/s, dOmega/dt = 2
/// rad/s2.
TEST(Equations, LawsAreThoseOfTheRotarySpeed) {
  Scene scene;
  scene.turn();
  const auto model = assemble(scene.equations());
  const double gyroscopic = scene.form(find(model.damping, "gyroscopic")->matrix);
  EXPECT_NEAR(scene.form(model.dampingAt(0.5)), 4.0 * gyroscopic, 1e-10 * std::abs(gyroscopic));
  const double spinUp = scene.form(find(model.stiffness, "spin-up")->matrix),
               structure = alongString(strain);
  EXPECT_NEAR(scene.form(model.stiffnessAt(0.5)) - structure, 2.0 * spinUp,
              1e-9 * std::abs(structure));
}

// -------------------------------------------------------------------------------------------------
// Rayleigh damping

/// c_M M_a + c_K (K_a + K_gpa + K_gpo(D_s)), equation (28): without the mass of the mud.
TEST(Equations, RayleighDampingHasTheMassOfTheSteelAndTheWholeStaticStiffness) {
  Scene scene;
  const mud::AnnularFlow mud(fluid());
  scene.mud = &mud;
  scene.prestress();
  scene.damping = {0.3, 2e-4};
  const PathEquations equations = scene.atPath();
  const auto rayleigh = [](const PolynomialMotion& a, const PolynomialMotion& b, double z,
                           std::size_t e) {
    return 0.3 * kinetic(a, b, z, e) +
           2e-4 * (strain(a, b, z, e) + geometric(a, b, z, axialForce[e], torque[e]));
  };
  const auto before = assemble(equations.model);
  expectTerm(scene, before, before.damping, "Rayleigh damping", "1", alongString(rayleigh));

  // K_gpo(D_s) = F_apo K_gF + T_apo K_gT in the nodal frames
  const std::vector<double> force{5e6, -4e6}, moment{2e6, 3e6};
  std::vector<beam::Matrix12> still;
  for (std::size_t e = 0; e < 2; ++e) {
    const beam::Matrix12 turn =
        beam::rotation12(scene.axes, scene.path.frame[e], scene.path.frame[e + 1]);
    const double l = depths[e + 1] - depths[e];
    still.push_back(turn.transpose() *
                    (force[e] * beam::geometricAxial(l) + moment[e] * beam::geometricTorque(l)) *
                    turn);
  }
  const Vector state = Vector::LinSpaced(18, 0.1, 1.8);
  const StringModel model = linearise(equations, still, state, scene.damping);
  EXPECT_EQ(model.state, state);
  EXPECT_EQ(equations.model.state, Vector::Zero(18)) << "the equations at the path state stay";
  const auto after = assemble(model);
  const double added = alongString([&](const auto& a, const auto& b, double z, std::size_t e) {
    return geometric(a, b, z, force[e], moment[e]);
  });
  expectTerm(scene, after, after.stiffness, "static geometric", "1", added);
  expectTerm(scene, after, after.damping, "Rayleigh damping", "1",
             alongString(rayleigh) + 2e-4 * added);
  EXPECT_GT(std::abs(2e-4 * added), 1e-3 * std::abs(alongString(rayleigh)))
      << "too small to be seen";
}

/// Damped by a thousandth of its stiffness.
class Lossy : public beam::Timoshenko {
 public:
  using Timoshenko::Timoshenko;
  beam::Matrix12 damping() const override { return 1e-3 * stiffness(); }
};

TEST(Equations, AnElementHasDampingOfItsOwn) {
  Scene scene;
  for (Element& element : scene.string.elements)
    element.formulation = std::make_shared<Lossy>(element.section(), element.length());
  const auto model = assemble(scene.equations());
  ASSERT_EQ(model.damping.size(), 1u);
  expectTerm(scene, model, model.damping, "element damping", "1", 1e-3 * alongString(strain));
}

// -------------------------------------------------------------------------------------------------
// mud

double annulus(std::size_t e) { return pi * (square(bore[e]) - square(outer[e])); }
double innerSpeed(std::size_t e) { return 0.02 / (pi * square(inner[e])); }
double annulusSpeed(std::size_t e) { return 0.02 / annulus(e); }
double innerMass(std::size_t e) { return 1200.0 * pi * square(inner[e]); }
double annulusMass(std::size_t e) {
  return 1200.0 * pi * square(outer[e]) * (square(bore[e]) + square(outer[e])) /
         (square(bore[e]) - square(outer[e]));
}

TEST(Equations, MudAddsItsMassAndItsBuoyancyInTheBoreOfEachElement) {
  Scene scene;
  scene.loads = acting(gravity, 0.0, 0.0);
  const mud::AnnularFlow mud(fluid());
  scene.mud = &mud;
  const auto model = assemble(scene.equations());
  const double m = alongString([](const auto& a, const auto& b, double z, std::size_t e) {
    return kinetic(a, b, z, e) + (innerMass(e) + annulusMass(e)) * lateral(a, b, z);
  });
  EXPECT_NEAR(scene.form(model.mass), m, 1e-11 * std::abs(m));
  const Vector3 down = scene.axes.transpose() * Vector3(0.0, 0.0, gravity);
  expectLoad(scene, model, "mud", "1",
             alongString([&](const auto& a, const auto&, double z, std::size_t e) {
               const double buoyancy = 1200.0 * pi * (square(inner[e]) - square(outer[e]));
               const double drag = -0.013 * 1200.0 * 2.0 * outer[e] * square(annulusSpeed(e)) / 2.0;
               return buoyancy * (down.x() * a.u.value(z) + down.y() * a.v.value(z) +
                                  down.z() * a.w.value(z)) +
                      drag * a.w.value(z);
             }));
}

TEST(Equations, MudDampsBendsAndCarriesTheFlowOfEachElement) {
  Scene scene;
  scene.turn();
  const mud::AnnularFlow mud(fluid());
  scene.mud = &mud;
  const auto model = assemble(scene.equations());
  expectTerm(scene, model, model.damping, "mud axial flow damping", "1",
             alongString([](const auto& a, const auto& b, double z, std::size_t e) {
               return 0.013 * 1200.0 * 2.0 * outer[e] * annulusSpeed(e) / 2.0 * lateral(a, b, z);
             }));
  expectTerm(scene, model, model.damping, "mud rotation damping", "sqrt|Omega|",
             alongString([](const auto& a, const auto& b, double z, std::size_t e) {
               const double gamma = outer[e] / bore[e];
               return 2.0 * std::sqrt(2.0) * pi * 1200.0 * outer[e] * std::sqrt(3e-6) *
                      (1.0 + std::pow(gamma, 3)) / square(1.0 - square(gamma)) * lateral(a, b, z);
             }));
  expectTerm(scene, model, model.damping, "mud Coriolis", "1",
             alongString([](const auto& a, const auto& b, double z, std::size_t e) {
               return (innerMass(e) * innerSpeed(e) - annulusMass(e) * annulusSpeed(e)) *
                      (a.u.value(z) * b.u.slope(z) + a.v.value(z) * b.v.slope(z) -
                       a.u.slope(z) * b.u.value(z) - a.v.slope(z) * b.v.value(z));
             }));
  expectTerm(
      scene, model, model.stiffness, "mud centrifugal", "1",
      alongString([](const auto& a, const auto& b, double z, std::size_t e) {
        return -(innerMass(e) * square(innerSpeed(e)) + annulusMass(e) * square(annulusSpeed(e))) *
               (a.u.slope(z) * b.u.slope(z) + a.v.slope(z) * b.v.slope(z));
      }));
}

// -------------------------------------------------------------------------------------------------
// loads

TEST(Equations, PathReactionAndBitLoadsActOnTheirNodesAsTheyAre) {
  Scene scene;
  scene.path.reaction = Matrix::Random(6, 3);
  scene.loads = acting(0.0, 1e4, 5e3);
  const auto model = assemble(scene.equations());
  const Vector d = scene.dofs(firstMotion());
  const Matrix nodes = Eigen::Map<const Matrix>(d.data(), 6, 3);
  expectLoad(scene, model, "path reaction", "1",
             (nodes.array() * scene.path.reaction.array()).sum());
  expectLoad(scene, model, "weight on bit", "1", -1e4 * d(14));
  expectLoad(scene, model, "torque on bit", "1", -5e3 * d(17));
}

/// F_s and K_pa contain the constant terms and none of the rotation; R_ipa is separate.
TEST(Equations, StaticStateBalancesWhatIsConstantInTime) {
  Scene scene;
  const mud::AnnularFlow mud(fluid());
  scene.mud = &mud;
  scene.turn();
  scene.prestress();
  scene.loads = acting(gravity, 1e4, 0.0);
  scene.path.reaction = Matrix::Random(6, 3);
  const PathEquations turning = scene.atPath();
  const std::set<std::string> constant{"weight", "mud", "weight on bit"};
  Vector load = Vector::Zero(18);
  std::size_t found = 0;
  for (const auto& one : turning.model.loads)
    if (constant.count(one.name) > 0) {
      load += one.vector;
      ++found;
    }
  EXPECT_EQ(found, constant.size());
  EXPECT_LT(found + 1, turning.model.loads.size()) << "there are loads of the rotation too";
  EXPECT_EQ(turning.load, load);
  EXPECT_EQ(turning.pathReaction, Vector(Eigen::Map<const Vector>(scene.path.reaction.data(), 18)));
  for (std::size_t e = 0; e < 2; ++e) {
    beam::Matrix12 stiffness = beam::Matrix12::Zero();
    for (const auto& term : turning.model.stiffness)
      if (turning.model.laws[at(term.law)].name == "1") stiffness += term.matrices[e];
    EXPECT_EQ(turning.stiffness[e], stiffness);
  }
  scene.path.reaction.setZero();
  EXPECT_EQ(scene.atPath().pathReaction.size(), 0);
}

/// Held dofs are omitted; the matrices and loads of two parts add up to those of the whole, with
/// each node's load once.
TEST(Equations, PartsAddUpToTheWhole) {
  Scene scene;
  scene.turn();
  scene.prestress();
  scene.loads = acting(gravity, 1e4, 0.0);
  scene.path.reaction = Matrix::Random(6, 3);
  for (const int dof : {0, 1, 2, 5, 12, 13}) scene.held[at(dof)] = 1;
  StringModel equations = scene.equations();
  equations.state = Vector::LinSpaced(18, 0.1, 1.8);
  const auto whole = assemble(equations);
  ASSERT_EQ(whole.size(), equations.freeDofs());
  ASSERT_EQ(whole.size(), 12);
  Matrix mass = Matrix::Zero(12, 12), stiffness = mass, damping = mass;
  Vector load = Vector::Zero(12);
  for (int e = 0; e < 2; ++e) {
    const auto part = assemblePart(equations, {"part", e, e}, {}, nullptr);
    EXPECT_EQ(part.interface.size(), 6u);
    Matrix take = Matrix::Zero(part.model.size(), 12);
    for (int i = 0; i < part.model.size(); ++i)
      for (int j = 0; j < 12; ++j)
        if (part.model.dofs[at(i)] == whole.dofs[at(j)]) take(i, j) = 1.0;
    ASSERT_EQ(take.sum(), part.model.size());
    EXPECT_EQ(part.reference, take * whole.initialDisplacement);
    EXPECT_EQ(part.model.initialDisplacement, part.reference);
    mass += take.transpose() * (part.model.mass * take);
    stiffness += take.transpose() * (part.model.stiffnessAt(0.5) * take);
    damping += take.transpose() * (part.model.dampingAt(0.5) * take);
    load += take.transpose() * part.model.loadAt(0.5);
  }
  EXPECT_LT((mass - Matrix(whole.mass)).norm(), 1e-13 * mass.norm());
  EXPECT_LT((stiffness - Matrix(whole.stiffnessAt(0.5))).norm(), 1e-13 * stiffness.norm());
  EXPECT_LT((damping - Matrix(whole.dampingAt(0.5))).norm(), 1e-13 * damping.norm());
  EXPECT_LT((load - whole.loadAt(0.5)).norm(), 1e-13 * load.norm());
  EXPECT_GT(load.norm(), 1.0);
}

/// Recovery returns all six dofs of a node, zero for held dofs.
TEST(Equations, RecoveryPutsHeldDofsBack) {
  Scene scene;
  for (const int dof : {0, 1, 2, 5, 12, 13}) scene.held[at(dof)] = 1;
  const auto model = assemble(scene.equations());
  const Vector q = Vector::LinSpaced(12, 1.0, 12.0);
  const Vector d = model.recoveryOffset + model.recovery * q;
  int next = 0;
  ASSERT_EQ(d.size(), 18);
  for (int dof = 0; dof < 18; ++dof)
    EXPECT_EQ(d(dof), scene.held[at(dof)] != 0 ? 0.0 : q(next++)) << dof;
}

}  // namespace EquationsTest
}  // namespace tooljoint::drillstring
