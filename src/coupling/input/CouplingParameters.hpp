// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The deck list `Coupling`: connections of parts in addition to equal labels. It is read before
/// the parts exist and resolved into connections afterwards.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "coupling/input/Connections.hpp"
#include "deck/ListSpec.hpp"

namespace Teuchos {
class ParameterList;
}

namespace tooljoint::coupling {

/// An entry of one of the lists: its name, and its path in the deck for messages.
struct InputEntry {
  std::string name;
  std::string path;
};

struct JointInput : InputEntry {
  std::vector<PartNode> nodes;
};
struct FrameInput : InputEntry {
  Frame frame;
};
struct ReleaseInput : InputEntry {
  PartNode node;
  std::vector<std::string> components;
};
struct ConstraintInput : InputEntry {
  Constraint constraint;
};
struct LinkInput : InputEntry {
  PartNode from, to;
  Vector3 arm = Vector3::Zero();
};
struct HingeInput : InputEntry {
  PartNode first, second;
  Vector3 axis = Vector3::UnitZ();
};
/// A point law along a direction, on a component, or along a direction and across it.
struct PointInput : InputEntry {
  PartNode first;
  std::optional<PartNode> second;  ///< none: the ground
  std::optional<Vector3> direction;
  std::string component;  ///< in place of a direction
  /// Makes the law for the available coordinates: the separation and, with a direction, one (in a
  /// plane) or two displacements normal to it.
  std::function<std::shared_ptr<const model::PointLaw>(int coordinates)> law;
};

struct CouplingInput {
  Assembly assembly = Assembly::Primal;
  bool ownNumbers = false;  ///< every part has its own node numbers, and parts are connected by
                            ///< joints
  bool keepStaticForces = true;
  std::vector<JointInput> joints;
  std::vector<FrameInput> frames;
  std::vector<ReleaseInput> releases;
  std::vector<ConstraintInput> constraints;
  std::vector<LinkInput> links;
  std::vector<HingeInput> hinges;
  std::vector<PointInput> points;
};

/// Description of the list `Coupling`.
deck::ListSpec parameters();

/// Throws DeckError: a node not in the form PART:NODE, not exactly one of Direction and Component,
/// axes that are not perpendicular, different numbers of factors and terms, joints of parts with
/// shared numbers.
CouplingInput readCoupling(const Teuchos::ParameterList& list);

/// Data of a part before it is built.
struct PartOutline {
  std::string name;
  std::vector<std::int64_t> nodes;  ///< empty: not known yet
};
/// Throws DeckError, one line each, for unknown parts, nodes and components of the list, with path
/// and suggestion.
void checkNames(const CouplingInput& input, const std::vector<PartOutline>& parts,
                const model::ComponentNames& names);

/// "4 springs, 1 hinge": for the log.
std::string describe(const CouplingInput& input);

}  // namespace tooljoint::coupling
