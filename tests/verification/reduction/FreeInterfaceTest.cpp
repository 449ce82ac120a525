// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Guyan, Rubin, Craig-Chang, Herting, MacNeal and dual Craig-Bampton on coupled models: all modes,
/// rigid-body modes, statics, bounds, printed references and the order of accuracy.
#include <Eigen/Dense>
#include <algorithm>
#include <complex>
#include <gtest/gtest.h>
#include <set>

#include "common/Error.hpp"
#include "coupling/assembly/Assembler.hpp"
#include "linalg/trilinos/DirectSolver.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "tests/support/BasisFamilies.hpp"
#include "tests/support/SpaceFrame.hpp"

namespace FreeInterfaceTest {

using namespace tooljoint;
using namespace tooljoint::reduction;
using samples::eigenvalues;
using samples::Family;
using samples::freeFamilies;
using samples::isRitz;
using samples::synthesised;

void expectSame(const Vector& full, const Vector& small, const std::string& what,
                double rounding = 1e-15) {
  ASSERT_EQ(full.size(), small.size()) << what;
  const double largest = full[full.size() - 1];
  for (Eigen::Index i = 0; i < full.size(); ++i)
    EXPECT_LE(std::abs(full[i] - small[i]), 1e-9 * std::abs(full[i]) + rounding * largest)
        << what << ", mode " << i + 1;
}

TEST(AllModes, EveryFamilyKeepsTheEigenvaluesOfAFrame) {
  for (const bool retain : {false, true}) {
    const auto parts = samples::loopFrame(6, false, retain);
    const Vector full = eigenvalues(coupling::couple(parts));
    for (const auto& family : freeFamilies())
      expectSame(full, eigenvalues(synthesised(parts, family, -1).coupled.model), family.name());
  }
}

TEST(AllModes, EveryFamilyKeepsTheEigenvaluesOfFloatingPartsInSpace) {
  const samples::FiveMembers frame{4};
  const auto parts = frame.parts();
  const Vector full = eigenvalues(coupling::couple(parts));
  for (const auto& family : freeFamilies())
    expectSame(full, eigenvalues(synthesised(parts, family, -1).coupled.model), family.name());
}

std::vector<std::complex<double>> complexEigenvalues(const model::SecondOrderModel& m, double t) {
  const auto modes =
      linalg::dampedModes(Matrix(m.mass), Matrix(m.dampingAt(t)), Matrix(m.stiffnessAt(t)));
  return {modes.values.data(), modes.values.data() + modes.values.size()};
}

TEST(AllModes, GyroscopicUnsymmetricFrameKeepsItsComplexEigenvalues) {
  const auto parts = samples::loopFrame(6, true, true);
  const auto full = complexEigenvalues(coupling::couple(parts), 0.5);
  double largest = 0;
  for (const auto& s : full) largest = std::max(largest, std::norm(s));
  for (const auto& family : freeFamilies()) {
    if (family.basis == "Dual Craig-Bampton")
      continue;  // multipliers have no mass; other tests cover its motion
    const auto small = complexEigenvalues(synthesised(parts, family, -1).coupled.model, 0.5);
    ASSERT_EQ(full.size(), small.size()) << family.name();
    for (const auto& s : full) {
      double nearest = 1e300;
      for (const auto& other : small) nearest = std::min(nearest, std::abs(s * s - other * other));
      EXPECT_LE(nearest, 1e-9 * std::norm(s) + 1e-13 * largest) << family.name() << " " << s;
    }
  }
}

/// A free frame in space of two members, 1 - 2 - 3, both floating; node 2 is the interface, and one
/// node of each part is retained.
std::vector<model::Substructure> floatingPair(int elements, bool retain) {
  std::vector<model::Substructure> parts;
  const std::vector<Vector3> corner{{0, 0, 0}, {3, 0.4, 0}, {4, 2, 1.5}};
  for (int p = 0; p < 2; ++p) {
    samples::SpaceMember member{p == 0 ? "first" : "second",
                                {p + 1},
                                corner[static_cast<std::size_t>(p)],
                                corner[static_cast<std::size_t>(p + 1)]};
    for (int i = 1; i < elements; ++i) member.nodes.push_back(100 * (p + 1) + i);
    member.nodes.push_back(p + 2);
    parts.push_back(samples::spacePart(member.name, {member}, {}));
    samples::classify(parts.back(), {2},
                      retain ? std::vector<int>{100 * (p + 1) + 1} : std::vector<int>{});
  }
  return parts;
}

TEST(RigidBodyModes, AreExactAndCounted) {
  for (const bool retain : {false, true}) {
    const auto parts = floatingPair(6, retain);
    const Vector full = eigenvalues(coupling::couple(parts));
    for (const auto& family : freeFamilies())
      for (const int modes : {0, 3, 10}) {
        if ((family.basis == "Guyan" && modes == 0) ||
            (family.basis == "Herting" && !family.parameter.empty() && family.text.empty() &&
             modes < 10 && !retain))
          continue;  // one rigid node
        const auto small = synthesised(parts, family, modes);
        const Vector values = eigenvalues(small.coupled.model, 1e-3 * full[6]);
        for (int k = 0; k < 6; ++k)
          EXPECT_LE(std::abs(values[k]), 1e-8 * full[6])
              << family.name() << ", " << modes << " modes";
        ASSERT_GT(values.size(), 6) << family.name();
        EXPECT_GT(values[6], 0.5 * full[6]) << family.name();
        for (const auto& part : small.parts) {
          EXPECT_EQ(part.report.zeroEnergyFull, 6);
          EXPECT_EQ(part.report.zeroEnergyReduced, 6) << family.name() << ", " << modes << " modes";
        }
      }
  }
}

TEST(RigidBodyModes, AreKeptWhateverIsAskedForAndSaid) {
  const auto parts = floatingPair(6, false);
  const auto rubin = synthesised(parts, {"Rubin", "", ""}, 0).parts[0];
  EXPECT_EQ(rubin.modes, 6) << "inertia relief";
  const auto& remarks = rubin.report.remarks;
  EXPECT_TRUE(std::any_of(remarks.begin(), remarks.end(), [](const auto& text) {
    return text.find("all 6 rigid-body modes") != std::string::npos;
  }));
}

// One end pinned in space: the part can still rotate about its interface, which no constraint mode
// contains.
TEST(RigidBodyModes, AnInteriorThatSwingsAboutItsInterface) {
  auto parts = floatingPair(5, false);
  parts.pop_back();
  auto& pendulum = parts[0];
  pendulum.retained.assign(pendulum.interface.begin(), pendulum.interface.begin() + 3);
  pendulum.interface.clear();
  EXPECT_THROW(synthesised(parts, {"Craig-Bampton", "", ""}, 4), ModelError);
  const Vector full = eigenvalues(pendulum.model);
  for (const auto& family : freeFamilies()) {
    if (family.basis == "Guyan") continue;
    expectSame(full, eigenvalues(synthesised(parts, family, -1).coupled.model), family.name());
    const auto few = synthesised(parts, family, 8);
    const Vector values = eigenvalues(few.coupled.model, 1e-3 * full[6]);
    for (int k = 0; k < 6; ++k) EXPECT_LE(std::abs(values[k]), 1e-8 * full[6]) << family.name();
    EXPECT_EQ(few.parts[0].report.zeroEnergyReduced, 6) << family.name();
  }
}

/// Static displacement of the recovered nodes under unit loads on `dofs` of the full model.
TEST(Statics, LoadsOnInterfaceAndRetainedDofsAreAnsweredExactly) {
  for (const bool spinning : {false, true}) {  // with a skew constant stiffness
    const auto parts = samples::loopFrame(6, spinning, true);
    const auto full = coupling::couple(parts);
    const Sparse K = constantStiffness(full);
    for (const auto& family : freeFamilies()) {
      if (spinning && family.basis == "Dual Craig-Bampton")
        continue;  // residual flexibility of the symmetric part
      const auto small = synthesised(parts, family, 3);
      for (const auto& part : small.parts)
        EXPECT_LT(part.report.staticDefect, 1e-8) << family.name() << " " << part.name;
      const auto& m = small.coupled.model;
      for (const auto& label :
           {model::DofLabel::physical(3, 0), model::DofLabel::physical(4, 2),
            model::DofLabel::physical(303, 1), model::DofLabel::physical(5, 1)}) {
        // Forces between parts are equal and opposite: the residual response of one part to a load
        // on an interface dof is not among its motions.
        if (family.basis == "Dual Craig-Bampton" && label.entity < 5) continue;
        Vector load = Vector::Zero(full.size());
        load[samples::find(full, label)] = 1;
        const Vector exact = full.recovery * linalg::DirectSolver(K).solve(load);
        // the same load through the recovery of the reduced model: f = (rows of that dof)'
        const auto node = std::find(m.recoveryNodes.begin(), m.recoveryNodes.end(), label.entity) -
                          m.recoveryNodes.begin();
        const Vector force = Matrix(m.recovery).row(3 * node + label.component);
        const Vector answer = m.recovery * linalg::DirectSolver(constantStiffness(m)).solve(force);
        double error = 0;
        for (std::size_t n = 0; n < m.recoveryNodes.size(); ++n)
          for (std::size_t o = 0; o < full.recoveryNodes.size(); ++o)
            if (m.recoveryNodes[n] == full.recoveryNodes[o])
              error = std::max(error, (answer.segment<3>(static_cast<Eigen::Index>(3 * n)) -
                                       exact.segment<3>(static_cast<Eigen::Index>(3 * o)))
                                          .cwiseAbs()
                                          .maxCoeff());
        EXPECT_LT(error, 1e-8 * exact.cwiseAbs().maxCoeff())
            << family.name() << (spinning ? " spinning " : " ") << label.entity;
      }
    }
  }
}

TEST(Bounds, RayleighRitzFamiliesAreAboveAndMonotone) {
  const auto parts = samples::loopFrame(8, false, true);
  const Vector full = eigenvalues(coupling::couple(parts));
  for (const auto& family : freeFamilies()) {
    if (!isRitz(family)) continue;
    Vector before;
    for (const int modes : {0, 1, 2, 4, 8}) {
      const Vector values = eigenvalues(synthesised(parts, family, modes).coupled.model);
      for (Eigen::Index i = 0; i < values.size(); ++i) {
        EXPECT_GE(values[i], full[i] * (1 - 1e-9)) << family.name();
        if (i < before.size()) {
          EXPECT_LE(values[i], before[i] * (1 + 1e-9))
              << family.name() << ", " << modes << " modes";
        }
      }
      before = values;
    }
  }
}

// Craig and Chang (1976) showed their space to be Rubin's; Herting (1985) contains both, and Craig
// and Bampton's.
TEST(Equivalence, OfSpaces) {
  for (const auto& parts : {samples::loopFrame(8, false), floatingPair(6, false)})
    for (const int modes : {6, 9}) {
      const Vector rubin = eigenvalues(synthesised(parts, {"Rubin", "", ""}, modes).coupled.model);
      expectSame(rubin,
                 eigenvalues(synthesised(parts, {"Craig-Chang", "", ""}, modes).coupled.model),
                 "Craig-Chang");
      expectSame(rubin, eigenvalues(synthesised(parts, {"Herting", "", ""}, modes).coupled.model),
                 "Herting");
      const Vector macNeal =
          eigenvalues(synthesised(parts, {"MacNeal", "", ""}, modes).coupled.model);
      const Vector dual =
          eigenvalues(synthesised(parts, {"Dual Craig-Bampton", "", ""}, modes).coupled.model);
      // Without residual mass the dual method is MacNeal's (D. J. Rixen 2011, interface reduction
      // in the dual Craig-Bampton method, remark 4)
      expectSame(macNeal, dual, "dual", 1e-13);
    }
}

// The bar of Humar, Dynamics of Structures, example 19.1 (see PublishedTest): two components of
// four elements, clamped on the left. The frequencies of every family were computed with
// numpy/scipy from the textbook formulas: residual flexibility by differences, f = F^-1 (u_b -
// Phi_b p).
TEST(Humar, EveryFamilyHasTheFrequenciesOfItsFormulas) {
  const double l = 1.0 / 8;
  std::vector<model::Substructure> parts{samples::bar("component 1", 0, 4, 1 / l, l, {0}),
                                         samples::bar("component 2", 4, 4, 1 / l, l)};
  samples::classify(parts[0], {4});
  samples::classify(parts[1], {4});
  struct Reference {
    Family family;
    int modes;
    std::vector<double> omega;
  };
  const std::vector<double> rubin2{1.57332179, 4.78109816, 8.1803458, 12.20865106, 18.8231174};
  const std::vector<double> rubin3{1.57332084,  4.78078367,  8.17197301, 11.86696595,
                                   15.95322996, 20.56193774, 25.34412715};
  const std::vector<double> macNeal2{1.57391632, 4.79963427, 8.30012998, 14.78138378},
      macNeal3{1.57345806, 4.78487788, 8.19520101, 11.95437307, 16.24657483, 29.26344835};
  const std::vector<double> dual2{1.57332658, 4.7824668, 8.20587728, 12.95278289},
      dual3{1.5733214, 4.78093916, 8.17453942, 11.88720647, 16.07634438, 23.48657563};
  for (const auto& reference :
       {Reference{{"Rubin", "", ""}, 2, rubin2}, Reference{{"Rubin", "", ""}, 3, rubin3},
        Reference{{"Craig-Chang", "", ""}, 2, rubin2},
        Reference{{"Craig-Chang", "", ""}, 3, rubin3}, Reference{{"Herting", "", ""}, 3, rubin3},
        Reference{{"MacNeal", "", ""}, 2, macNeal2}, Reference{{"MacNeal", "", ""}, 3, macNeal3},
        Reference{{"Dual Craig-Bampton", "Residual Mass", "", true}, 2, dual2},
        Reference{{"Dual Craig-Bampton", "Residual Mass", "", true}, 3, dual3},
        Reference{{"Dual Craig-Bampton", "", ""}, 3, macNeal3}}) {
    const Vector values =
        eigenvalues(synthesised(parts, reference.family, reference.modes).coupled.model, 1.0);
    ASSERT_EQ(values.size(), static_cast<Eigen::Index>(reference.omega.size()))
        << reference.family.name();
    for (Eigen::Index i = 0; i < values.size(); ++i)
      EXPECT_NEAR(std::sqrt(values[i]), reference.omega[static_cast<std::size_t>(i)], 1e-8 * 8)
          << reference.family.name() << ", " << reference.modes << " modes";
  }
}

// The order in S. Rubin (1975), D. J. Rixen (2004) and F. M. Gruber and D. J. Rixen, Evaluation of
// substructure reduction techniques with fixed and free interfaces, Strojniski vestnik 62 (2016)
// 452-462: at equal modes Rubin and the dual method are more accurate than Craig-Bampton by orders,
// MacNeal's without residual mass is not.
TEST(Accuracy, OrderOfTheFamilies) {
  const samples::FiveMembers frame{8};
  const auto parts = frame.parts();
  const Vector full = eigenvalues(coupling::couple(parts));
  const std::vector<Family> families{{"Guyan", "Masters", "None"},
                                     {"Craig-Bampton", "", ""},
                                     {"MacNeal", "", ""},
                                     {"Dual Craig-Bampton", "Residual Mass", "", true},
                                     {"Rubin", "", ""}};
  for (const int modes : {8, 12}) {
    std::vector<double> mean;
    std::printf(
        "space frame, %d modes a part: relative error of the frequencies 1, 2, 4, 8, 12 and "
        "geometric mean of 1 to 12\n",
        modes);
    for (const auto& family : families) {
      const Vector values = eigenvalues(synthesised(parts, family, modes).coupled.model, 1.0);
      double sum = 0;
      std::printf("  %-45s", family.name().c_str());
      for (int k = 0; k < 12; ++k) {
        const double error = std::abs(std::sqrt(values[k] / full[k]) - 1);
        sum += std::log(std::max(error, 1e-15)) / 12;
        if (k == 0 || k == 1 || k == 3 || k == 7 || k == 11) std::printf(" %.2e", error);
      }
      mean.push_back(std::exp(sum));
      std::printf("   %.2e\n", mean.back());
    }
    EXPECT_LT(mean[1], 0.1 * mean[0]) << "modes help";
    EXPECT_LT(mean[4], 0.1 * mean[1]) << "Rubin beats Craig-Bampton";
    EXPECT_LT(mean[3], mean[2]) << "residual mass helps the dual method";
    EXPECT_LT(mean[4], 0.1 * mean[2]) << "and the primal one";
  }
}

}  // namespace FreeInterfaceTest
