// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The way of the data as calls, each with a typed value in and a typed value out:
/// scene -> path -> equations and static state -> parts -> reduced parts -> coupled model.
#pragma once

#include <string>
#include <vector>

#include "coupling/assembly/Assembler.hpp"
#include "coupling/input/ResolvedCoupling.hpp"
#include "model/SecondOrderModel.hpp"
#include "model/Substructure.hpp"
#include "stability/StateStability.hpp"
#include "substructures/drillstring/StringModel.hpp"
#include "substructures/drillstring/scene/Scene.hpp"
#include "substructures/drillstring/scene/StaticFriction.hpp"
#include "substructures/equilibrium/StaticState.hpp"
#include "substructures/path/PathState.hpp"

namespace tooljoint::drillstring {

/// The string at rest in its well, and its equations of motion about that state.
struct StaticStage {
  path::PathState path;
  StringModel equations;
  equilibrium::StaticState state;
  StaticFriction friction;
  stability::StateStability stability;
  int perturbations = 0;  ///< unstable states left on the way (Static/Unstable State "Perturb")
};

/// Components (2: w, 5: theta_z) that are free at every node, so that nothing but walls and bending
/// holds the string.
std::vector<int> freeDirections(const Scene& scene);

/// Bends the string into the well, finds its static equilibrium and assesses its stability; with
/// Static/Unstable State "Perturb" it goes on from unstable states until one is stable.
/// ConvergenceError, ModelError.
StaticStage findEquilibrium(const Scene& scene);
/// Torque at the top against what loads, friction and supports below give: above 2 % of the
/// scale of StaticState a warning, above 10 % a ConvergenceError. With the pre-stress "Axial and
/// torque", or sections that are not round, always a warning: there the model itself resists a spin
/// about the curved axis.
void judgeTorqueBalance(const Scene& scene, const StaticStage& stage);
/// Where the string has moved along a well that turns: a warning above 0.02 rad of turn.
void judgeStretch(const Scene& scene, const StaticStage& stage);
/// These two and judgeStability().
void judgeStatic(const Scene& scene, const StaticStage& stage);
/// findEquilibrium(), judged.
StaticStage solveStatic(const Scene& scene);

/// The full model of the string alone, in total displacements.
model::SecondOrderModel fullModel(const StaticStage& stage);
/// The full model with what the list Coupling adds, always in primal assembly.
model::SecondOrderModel fullModel(const Scene& scene, const StaticStage& stage);

/// The parts of the deck's Substructures list.
std::vector<model::Substructure> cut(const Scene& scene, const StaticStage& stage);

/// These parts as the list Coupling wants them, and what joins them.
coupling::ResolvedCoupling resolvedParts(const Scene& scene, const StaticStage& stage);
/// Elements (0-based, increasing) below joints that Coupling/Releases or Hinges set free in part:
/// results have the motion of the part above there, so what they say of strain and curvature is
/// that of the next element.
std::vector<int> elementsBelowReleases(const Scene& scene, const StaticStage& stage);
/// Unreduced parts joined, in primal assembly.
coupling::Coupling joinUnreduced(const coupling::ResolvedCoupling& resolved);

/// Nodes (0-based, increasing) where contact is evaluated in the reduced model.
std::vector<int> contactNodes(const Scene& scene, const StaticStage& stage);

}  // namespace tooljoint::drillstring
