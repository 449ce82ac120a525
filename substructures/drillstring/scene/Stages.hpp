// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The stages of a run as calls, each with typed input and output: scene -> path -> equations and
/// static state -> parts -> reduced parts -> coupled model.
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

/// Components (2: w, 5: theta_z) that are free at every node, so that only walls and bending hold
/// the string.
std::vector<int> freeDirections(const Scene& scene);

/// Bends the string into the well, computes its static equilibrium and assesses its stability. With
/// Static/Unstable State "Perturb" it leaves unstable states until one is stable. ConvergenceError,
/// ModelError.
StaticStage findEquilibrium(const Scene& scene);
/// Compares the torque at the top with that of loads, friction and supports below: above 2 % of the
/// scale of StaticState a warning, above 10 % a ConvergenceError. With the pre-stress "Axial and
/// torque", or sections that are not round, always a warning: such a model resists a spin
/// about the curved axis.
void judgeTorqueBalance(const Scene& scene, const StaticStage& stage);
/// Warns if displacement along a well that turns changes the direction by more than 0.01 rad.
void judgeStretch(const Scene& scene, const StaticStage& stage);
/// These two checks and judgeStability().
void judgeStatic(const Scene& scene, const StaticStage& stage);
/// findEquilibrium() with these checks.
StaticStage solveStatic(const Scene& scene);

/// The full model of the string alone, in total displacements.
model::SecondOrderModel fullModel(const StaticStage& stage);
/// The full model with the connections of the list Coupling, always in primal assembly.
model::SecondOrderModel fullModel(const Scene& scene, const StaticStage& stage);

/// The parts of the deck's Substructures list.
std::vector<model::Substructure> cut(const Scene& scene, const StaticStage& stage);

/// These parts prepared for the list Coupling, and their connections.
coupling::ResolvedCoupling resolvedParts(const Scene& scene, const StaticStage& stage);
/// Elements (0-based, increasing) below joints with dofs released by Coupling/Releases or Hinges.
/// At the joint, results contain the motion of the part above, so strain and curvature of such an
/// element are taken from the next one.
std::vector<int> elementsBelowReleases(const Scene& scene, const StaticStage& stage);
/// Unreduced parts joined, in primal assembly.
coupling::Coupling joinUnreduced(const coupling::ResolvedCoupling& resolved);

/// Nodes (0-based, increasing) where contact is evaluated in the reduced model.
std::vector<int> contactNodes(const Scene& scene, const StaticStage& stage);

}  // namespace tooljoint::drillstring
