// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The meshed string: nodes with their clearance, finite elements, and the components they belong
/// to. Made by readDrillString (DrillstringReader.hpp) or buildDrillString (Mesh.hpp).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "substructures/beam/Element.hpp"

namespace tooljoint::drillstring {

/// A node of the mesh. Code numbers nodes from 0; output and decks number them from 1.
struct Node {
  double s = 0.0;          ///< distance from the surface along the hole [m]
  double clearance = 0.0;  ///< radial clearance j0 [m]: bore radius minus outer or gauge radius
  double contactRadius =
      0.0;  ///< R_c [m]: radius of the body that would touch, lever arm of the friction torque
  double frictionFactor = 1.0;  ///< of the body that would touch, on the friction coefficients of
                                ///< the wall
  bool gauge = false;           ///< a stabiliser blade or the bit is at this node
  std::string component;        ///< assembly component of the node (the upper one where two meet)
};

/// Element i joins nodes i and i+1.
struct Element {
  std::shared_ptr<const beam::Element> formulation;
  int instance = 0;             ///< index into DrillString::instances
  double frictionFactor = 1.0;  ///< on the friction coefficients of the wall

  double length() const { return formulation->length(); }  ///< [m]
  const beam::Section& section() const { return formulation->section(); }
};

/// A feature at a node that points to one side of the string, relative to the scribe line.
struct SidedNode {
  int node = 0;            ///< 0-based
  double size = 0.0;       ///< [rad] of a bend, [m] of an eccentric gauge, [N] of a pad
  double direction = 0.0;  ///< from the tool face, clockwise looking down the hole [rad]
};

/// One occurrence of a component in the string.
struct Instance {
  std::string component;  ///< name of the component
  std::string path;  ///< path in the assembly: "pipe 3", "stand 2/pipe 1"; the number counts equal
                     ///< names on one level
  int firstElement = 0;      ///< 0-based
  int lastElement = 0;       ///< 0-based, inclusive
  double gaugeRadius = 0.0;  ///< of the widest gauge in it, 0: none [m]
};

/// Straight chain of elements from the surface (node 0) to the bit (last node).
struct DrillString {
  std::vector<Node> nodes;  ///< elements.size() + 1
  std::vector<Element> elements;
  std::vector<Instance>
      instances;  ///< entries of the assembly, in order; every element belongs to exactly one
  std::vector<Instance>
      nested;  ///< the components inside them ("stand 2/pipe 1"), outer before inner

  std::vector<SidedNode> bends;            ///< the string below is bent to that side without stress
  std::vector<SidedNode> eccentricGauges;  ///< the centre of the gauge is offset to that side
  std::vector<SidedNode> pads;             ///< they press on the wall at that side
  double toolFace = 0.0;  ///< of the scribe line, from the high side at the bit, clockwise looking
                          ///< down the hole [rad]

  int nodeCount() const { return static_cast<int>(nodes.size()); }
  int elementCount() const { return static_cast<int>(elements.size()); }
  /// Length of the string [m].
  double length() const { return nodes.empty() ? 0.0 : nodes.back().s; }
  /// The elements from the surface down.
  std::vector<std::shared_ptr<const beam::Element>> formulations() const;
  /// Depths of the nodes [m].
  std::vector<double> depths() const;
};

}  // namespace tooljoint::drillstring
