// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/mud/AnnularFlow.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Text.hpp"
#include "common/report/EvaluationCounters.hpp"
#include "common/report/Log.hpp"
#include "deck/PrintedUnits.hpp"

namespace tooljoint::mud {
namespace {

using constants::pi;

/// Above this chi the annulus is a film (gap below 5 % of the radius), and the added-mass theory is
/// an extrapolation.
constexpr double filmConfinement = 20.0;

double square(double x) { return x * x; }

std::string metres(double value) { return deck::printed(value, "m"); }

/// Turns (u, v) into (v, -u) and (theta_x, theta_y) into (theta_y, -theta_x) at both ends. It
/// commutes with the isotropic lateral integrals. Its product with int N'N couples the two planes:
/// the u row holds +int N'N v, the v row -int N'N u.
beam::Matrix12 quarterTurn() {
  beam::Matrix12 turn = beam::Matrix12::Zero();
  for (int first : {0, 3, 6, 9}) {
    turn(first, first + 1) = 1.0;
    turn(first + 1, first) = -1.0;
  }
  return turn;
}

void addTerm(std::vector<MatrixTerm>& terms, const char* name, const char* law, double factor,
             const beam::Matrix12& matrix) {
  if (factor != 0.0) terms.push_back({name, law, factor * matrix});
}

const bool annularFlowRegistered = addMudModel<AnnularFlow>(
    "Annular flow",
    "flow down the string and up the annulus: added mass, damping, Coriolis and centrifugal "
    "forces, axial drag and buoyancy (Ritto, Soize and Sampaio 2009; Chen 1981; Fritz 1970).");

}  // namespace

AnnularFlow::AnnularFlow(const MudProperties& properties) : properties_(properties) {}

SectionFlow AnnularFlow::flow(double innerRadius, double outerRadius, double boreRadius) const {
  if (!(outerRadius < boreRadius)) {
    throw ModelError("The mud needs an annulus, but a body of outer radius " + metres(outerRadius) +
                     " does not fit a bore of radius " + metres(boreRadius) +
                     ": the added mass grows without bound as they meet. Check the bore radius and "
                     "the section (the "
                     "gauge radius of a stabiliser or bit is no body radius).");
  }
  const MudProperties& p = properties_;
  const double gamma = outerRadius / boreRadius;  // 0 in an unbounded fluid
  const double innerArea = pi * square(innerRadius);
  const double outerArea = pi * square(outerRadius);
  if (p.flowRate != 0.0 && !(innerArea > 0.0)) {
    throw ModelError("The mud has a flow rate, but a section of outer radius " +
                     metres(outerRadius) +
                     " is solid: nothing can be pumped through it. Give it an inner radius or set "
                     "Mud/Flow Rate to 0.");
  }
  SectionFlow f;
  // chi = (R_w^2 + R_e^2)/(R_w^2 - R_e^2) = (1 + gamma^2)/(1 - gamma^2)
  f.confinement = (1.0 + square(gamma)) / (1.0 - square(gamma));
  if (f.confinement > filmConfinement) {
    log::warn("The annulus around a body of outer radius " + metres(outerRadius) +
              " in a bore of radius " + metres(boreRadius) + " is a thin film; its added mass is " +
              formatNumber(std::round(f.confinement)) + " times that of an open fluid.");
  }
  f.innerMass = p.density * innerArea;
  f.annulusMass = f.confinement * p.density * outerArea;
  f.buoyantMass = p.density * (innerArea - outerArea);
  if (p.flowRate != 0.0) {
    f.innerSpeed = p.flowRate / innerArea;
    f.annulusSpeed = p.flowRate / (pi * (square(boreRadius) - square(outerRadius)));
  }
  // C_f rho_f D_o / 2, the common factor of axial-flow damping and drag
  const double friction = p.frictionCoefficient * p.density * outerRadius;
  f.axialFlowDamping = friction * std::abs(f.annulusSpeed);
  f.axialDrag = -friction * f.annulusSpeed * std::abs(f.annulusSpeed);
  if (p.annularThrust) f.axialDrag /= 1.0 - gamma;
  f.rotationDamping = 2.0 * std::sqrt(2.0) * pi * p.density * outerRadius *
                      std::sqrt(p.kinematicViscosity) * (1.0 + gamma * gamma * gamma) /
                      square(1.0 - square(gamma));
  return f;
}

ElementContribution AnnularFlow::element(const beam::Section& section, double boreRadius,
                                         double length, const Vector3& gravity) const {
  if (!(section.outerRadius() > 0.0)) {
    throw ModelError(
        "The mud needs the radii of a section, but an element has a general one that gives only "
        "areas. Leave out the list "
        "Mud or give the section its radii.");
  }
  count("mud matrices");
  const MudProperties& p = properties_;
  const SectionFlow f = flow(section.innerRadius(), section.outerRadius(), boreRadius);
  const beam::Matrix12 lateral = beam::lateralMass(length);  // int N'N
  ElementContribution out;
  out.mass = (f.innerMass + f.annulusMass) * lateral;
  addTerm(out.damping, "mud axial flow damping", "1", f.axialFlowDamping, lateral);
  addTerm(out.damping, "mud rotation damping", "sqrt|Omega|", f.rotationDamping, lateral);
  if (p.coriolis) {
    const beam::Matrix12 slope = beam::lateralSlope(length);  // int N'N_z
    addTerm(out.damping, "mud Coriolis", "1",
            f.innerMass * f.innerSpeed - f.annulusMass * f.annulusSpeed, slope - slope.transpose());
  }
  if (p.centrifugal) {
    addTerm(out.stiffness, "mud centrifugal", "1",
            -(f.innerMass * square(f.innerSpeed) + f.annulusMass * square(f.annulusSpeed)),
            beam::lateralSlopeSlope(length));
  }
  if (p.rotatingAnnulus) {
    // z = u + i v seen from a frame swirling at Omega/2: m_a z'' + (c - i m_a Omega) z' - (m_a
    // Omega^2/4 + i c Omega/2) z
    const beam::Matrix12 cross = lateral * quarterTurn();
    addTerm(out.damping, "mud swirl Coriolis", "Omega", f.annulusMass, cross);
    addTerm(out.stiffness, "mud swirl centrifugal", "Omega^2", -f.annulusMass / 4.0, lateral);
    addTerm(out.stiffness, "mud swirl circulatory, axial flow", "Omega", f.axialFlowDamping / 2.0,
            cross);
    addTerm(out.stiffness, "mud swirl circulatory, rotation", "Omega sqrt|Omega|",
            f.rotationDamping / 2.0, cross);
  }
  Vector3 distributed = f.buoyantMass * gravity;
  if (p.axialDrag) distributed.z() += f.axialDrag;
  out.load = beam::distributedLoad(distributed, length);
  return out;
}

}  // namespace tooljoint::mud
