// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/equilibrium/StaticElements.hpp"

#include "substructures/beam/NodalDofs.hpp"

namespace tooljoint::equilibrium {
namespace {

/// A component of the second end minus that of the first, in the frame of the element.
beam::Vector12 difference(const beam::Matrix12& rotation, int component) {
  return (rotation.row(beam::nodal::perNode + component) - rotation.row(component)).transpose();
}

}  // namespace

Vector pretensionForces(const StaticInput& input) {
  Vector forces = Vector::Zero(beam::nodal::perNode * input.nodes);
  for (std::size_t e = 0; e < input.elements.size(); ++e) {
    const StaticElement& element = input.elements[e];
    forces.segment<12>(beam::nodal::perNode * static_cast<int>(e)) -=
        element.pretension * difference(element.rotation, beam::nodal::w);
  }
  return forces;
}

StaticElements::StaticElements(const StaticInput& input) : input_(input) {
  units_.reserve(input.elements.size());
  for (const StaticElement& element : input.elements) {
    const beam::Matrix12 k = element.formulation->stiffness();
    const beam::Matrix12& r = element.slopes;
    units_.push_back({difference(element.rotation, beam::nodal::w),
                      difference(element.rotation, beam::nodal::thetaZ), k(8, 8), k(11, 11),
                      r.transpose() * element.formulation->geometricAxial() * r,
                      r.transpose() * element.formulation->geometricTorque() * r});
  }
}

beam::Vector12 StaticElements::motion(int element, const Vector& full) const {
  const beam::Vector12 d = full.segment<12>(beam::nodal::perNode * element);
  return input_.kinks.empty() ? d : beam::Vector12(d + input_.kinks[at(element)]);
}

double StaticElements::axialForce(int element, const Vector& full) const {
  const Unit& unit = units_[at(element)];
  return input_.elements[at(element)].pretension +
         unit.axialStiffness * unit.stretch.dot(motion(element, full));
}

double StaticElements::torque(int element, const Vector& full) const {
  const Unit& unit = units_[at(element)];
  return unit.torsionalStiffness * unit.twist.dot(motion(element, full));
}

beam::Matrix12 StaticElements::geometricStiffness(int element, const Vector& full) const {
  const Unit& unit = units_[at(element)];
  return axialForce(element, full) * unit.axial + torque(element, full) * unit.torque;
}

beam::Matrix12 StaticElements::geometricTangent(int element, const Vector& full) const {
  const Unit& unit = units_[at(element)];
  const beam::Vector12 d = motion(element, full);
  return unit.axialStiffness * (unit.axial * d) * unit.stretch.transpose() +
         unit.torsionalStiffness * (unit.torque * d) * unit.twist.transpose();
}

void StaticElements::addGeometric(int element, const beam::Vector12& d, bool exact,
                                  beam::Matrix12& k, beam::Vector12& force) const {
  const Unit& unit = units_[at(element)];
  const double axial =
      input_.elements[at(element)].pretension + unit.axialStiffness * unit.stretch.dot(d);
  const double torque = unit.torsionalStiffness * unit.twist.dot(d);
  const beam::Vector12 byAxial = unit.axial * d, byTorque = unit.torque * d;
  k += axial * unit.axial + torque * unit.torque;
  force += axial * byAxial + torque * byTorque;
  if (!exact) return;
  k += (unit.axialStiffness * byAxial) * unit.stretch.transpose() +
       (unit.torsionalStiffness * byTorque) * unit.twist.transpose();
}

}  // namespace tooljoint::equilibrium
