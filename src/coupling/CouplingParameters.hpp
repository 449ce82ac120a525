// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The deck list `Coupling`: how parts are joined beyond equal labels. Read without any part, then
/// turned into connections when the parts are there, wherever they came from.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coupling/Connections.hpp"
#include "coupling/PointLaws.hpp"
#include "deck/ListSpec.hpp"

namespace Teuchos {
class ParameterList;
}

namespace tooljoint::coupling {

/// An entry of one of the lists: its name, and its path in the deck for messages.
struct PlanEntry {
  std::string name;
  std::string path;
};

struct JointPlan : PlanEntry {
  std::vector<PartNode> nodes;
};
struct FramePlan : PlanEntry {
  Frame frame;
};
struct ReleasePlan : PlanEntry {
  PartNode node;
  std::vector<std::string> components;
};
struct ConstraintPlan : PlanEntry {
  Constraint constraint;
};
struct LinkPlan : PlanEntry {
  PartNode from, to;
  Vector3 arm = Vector3::Zero();
};
struct HingePlan : PlanEntry {
  PartNode first, second;
  Vector3 axis = Vector3::UnitZ();
};
/// A point law of width 1, or of width 1 + tangents for a stop with friction.
struct PointPlan : PlanEntry {
  PartNode first;
  std::optional<PartNode> second;  ///< none: the ground
  std::optional<Vector3> direction;
  std::string component;  ///< instead of a direction
  std::shared_ptr<const model::PointLaw> law;
  std::optional<StopParameters> sliding;  ///< friction of a stop: the law is made when it is known
                                          ///< how many tangents there are
};

struct CouplingPlan {
  Assembly assembly = Assembly::Primal;
  bool ownNumbers = false;  ///< every part numbers its nodes for itself, and joints join them
  bool keepStaticForces = true;
  std::vector<JointPlan> joints;
  std::vector<FramePlan> frames;
  std::vector<ReleasePlan> releases;
  std::vector<ConstraintPlan> constraints;
  std::vector<LinkPlan> links;
  std::vector<HingePlan> hinges;
  std::vector<PointPlan> points;
};

/// Description of the list `Coupling`.
deck::ListSpec parameters();

/// Throws DeckError: a node that is not written PART:NODE, not exactly one of Direction and
/// Component, axes that are not perpendicular, factors that are not as many as terms, joints of
/// parts whose numbers are shared.
CouplingPlan readCoupling(const Teuchos::ParameterList& list);

/// What is known of a part before it is made.
struct PartOutline {
  std::string name;
  std::vector<std::int64_t> nodes;  ///< empty: not known yet
};
/// Throws DeckError, one line each, for parts, nodes and components that the plan names and that do
/// not exist, with path and suggestion.
void checkNames(const CouplingPlan& plan, const std::vector<PartOutline>& parts,
                const model::ComponentNames& names);

/// "4 springs, 1 hinge": for people.
std::string describe(const CouplingPlan& plan);

}  // namespace tooljoint::coupling
