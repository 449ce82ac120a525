// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The helical well of Nguyen et al. 2020 (section 5.1) put together in C++: string, well, mud,
/// contact and loads, up to the input of the static equilibrium.
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "common/Constants.hpp"
#include "substructures/contact/ContactParameters.hpp"
#include "substructures/drillstring/ContactNodes.hpp"
#include "substructures/drillstring/EquationBuilder.hpp"
#include "substructures/drillstring/Mesh.hpp"
#include "substructures/equilibrium/Equilibrium.hpp"
#include "substructures/mud/Mud.hpp"
#include "substructures/path/Path.hpp"

namespace tooljoint::testing_ {

class HelicalScene {
 public:
  HelicalScene()
      : well_(
            std::shared_ptr<const well::Trajectory>(well::helix(85.1, 0.5 * constants::pi, 170.2)),
            0.108),
        drillstring(drillstring::buildDrillString(library(), assembly(), well_)) {}

  const drillstring::DrillString& string() const { return drillstring; }
  const well::Well& well() const { return well_; }

  path::PathInput pathInput() const {
    path::PathInput input;
    for (const auto& element : drillstring.elements) {
      input.sections.push_back(element.section);
      input.lengths.push_back(element.length);
    }
    input.trajectory = &well_.trajectory();
    return input;
  }

  /// Static problem about a path state.
  equilibrium::StaticInput staticInput(const path::PathState& path, double lambda = 7e11) const {
    equilibrium::StaticInput input;
    input.nodes = drillstring.nodeCount();
    input.held.assign(static_cast<std::size_t>(6 * input.nodes), 0);
    for (const int dof : {0, 1, 2, 5, 6 * input.nodes - 6, 6 * input.nodes - 5})
      input.held[static_cast<std::size_t>(dof)] = 1;
    const mud::Mud fluid(mudProperties());
    const loads::RotarySpeed rotary;
    const loads::RayleighDamping damping;
    loads::LoadsData loads;
    loads.gravity = 9.81;
    loads.weightOnBit = 1e4;
    loads.torqueOnBit = 5e3;
    const auto equations = drillstring::buildEquations(
        {drillstring, well_, path, input.held, &fluid, rotary, loads, damping});
    input.load = Vector::Zero(6 * input.nodes);
    for (const auto& load : equations.loads)
      if (load.name != "path reaction") input.load += load.vector;
    input.pathReaction = Eigen::Map<const Vector>(path.reaction.data(), path.reaction.size());
    for (std::size_t e = 0; e < drillstring.elements.size(); ++e) {
      const auto& element = drillstring.elements[e];
      beam::Matrix12 stiffness = beam::Matrix12::Zero();
      for (const auto& term : equations.stiffness) stiffness += term.matrices[e];
      input.elements.push_back(
          {stiffness, beam::rotation12(path.elementFrame[e], path.frame[e], path.frame[e + 1]),
           element.length, element.section.axialRigidity(), element.section.torsionalRigidity()});
    }
    input.chordSlopes =
        path.tangent.empty();  // pre-stress "Axial and torque": the source's matrices
    input.contact = contact::makeLaw("Nguyen")->atRest(contactPoints(input.held, lambda));
    return input;
  }

 private:
  static drillstring::ComponentLibrary library() {
    const beam::Material steel{7900.0, 2.03e11, 0.3};
    const auto body = beam::Section::hollow(0.0635, 0.054, steel);
    const auto joint = beam::Section::hollow(0.081, 0.048, steel);
    const auto heavy = beam::Section::hollow(0.0795, 0.0355, steel);
    drillstring::ComponentLibrary out;
    const auto add =
        [&out](const std::string& name,
               const std::vector<drillstring::Segment>& segments) -> drillstring::Component& {
      drillstring::Component& component = out[name];
      component.name = component.where = name;
      component.segments = segments;
      return component;
    };
    add("body", {{9.0, 5, body}});
    add("upset", {{0.2, 1, body}});
    add("joint half", {{0.3, 1, joint}});
    add("collar", {{10.0, 10, heavy}});
    drillstring::Component& stabiliser = add("stabiliser", {{5.0, 4, heavy}});
    stabiliser.gaugePosition = 2.5;
    stabiliser.gaugeRadius = 0.108;
    drillstring::Component& bit = add("bit", {{0.5, 1, heavy}});
    bit.gaugePosition = 0.5;
    bit.gaugeRadius = 0.108;
    return out;
  }

  static std::vector<drillstring::AssemblyEntry> assembly() {
    std::vector<drillstring::AssemblyEntry> out;
    for (int i = 0; i < 5; ++i)
      for (const auto& [count, name] :
           {std::pair{1, "body"}, {1, "upset"}, {2, "joint half"}, {1, "upset"}})
        out.push_back({count, name});
    for (const auto& [count, name] : {std::pair{1, "body"},
                                      {1, "upset"},
                                      {1, "joint half"},
                                      {1, "upset"},
                                      {3, "collar"},
                                      {1, "stabiliser"},
                                      {4, "collar"},
                                      {1, "stabiliser"},
                                      {3, "collar"},
                                      {1, "bit"}})
      out.push_back({count, name});
    return out;
  }

  static mud::MudProperties mudProperties() {
    mud::MudProperties mud;
    mud.density = 1200.0;
    mud.frictionCoefficient = 0.013;
    mud.kinematicViscosity = 1e-6;
    mud.flowRate = 0.01;
    return mud;
  }

  contact::ContactPoints contactPoints(const std::vector<char>& held, double lambda) const {
    contact::ContactSettings settings;
    settings.lawName = "Nguyen";
    settings.law = contact::makeLaw("Nguyen");
    settings.friction = true;
    settings.values.stiffness = 1e7;
    settings.values.damping = 1e4;
    settings.values.lambdaK = settings.values.lambdaC = lambda;
    settings.values.muStatic = 0.2;
    settings.values.muDynamic = 0.1;
    return drillstring::contactPoints(settings, drillstring, held);
  }

  well::Well well_;
  drillstring::DrillString drillstring;
};

}  // namespace tooljoint::testing_
