// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Input of the static equilibrium: elements, loads, supports and contact of a string.
#pragma once

#include <memory>
#include <vector>

#include "substructures/beam/Element.hpp"
#include "substructures/contact/StaticContact.hpp"

namespace tooljoint::equilibrium {

/// Element e joins nodes e and e + 1.
struct StaticElement {
  std::shared_ptr<const beam::Element> formulation;
  beam::Matrix12 stiffness;  ///< all linear terms, K_pa of the element, in nodal frames
  beam::Matrix12 rotation;   ///< nodal dofs to the element frame (beam::rotation12)
  /// The rotation for K_gpo: beam::slopeRotation, so that geometric stiffness does not resist the
  /// spin of a section about its axis, or `rotation` as in the source.
  beam::Matrix12 slopes;
  /// Axial force of the undeformed element [N]: 0 if the nodes have the positions of an unloaded
  /// string.
  double pretension = 0.0;
  double bendingMoment = 0.0;  ///< E I kappa of the well [N m], the scale of the torque balance
};

/// Input of the static problem; 6 dofs per node in nodal frames, relative to the path
/// state.
struct StaticInput {
  int nodes = 0;
  std::vector<StaticElement> elements;
  /// Stress-free rotations of elements relative to their nodes (bends of the string), added to D of
  /// each element [rad]; empty means none.
  std::vector<beam::Vector12> kinks;
  Vector load;             ///< F_s: weight, mud, WOB, TOB [N, N m]
  Vector pathReaction;     ///< R_ipa; empty means zero
  std::vector<char> held;  ///< 1 where a support (or the choice of dof families) holds the dof
  std::shared_ptr<const contact::StaticContact> contact;  ///< null: no contact in this scene
  contact::Sliding sliding{0.0, 1.0};  ///< of the string on the wall; zero: no friction
  bool geometricStiffness = true;      ///< K_gpo(D)
};

}  // namespace tooljoint::equilibrium
