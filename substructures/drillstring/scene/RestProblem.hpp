// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Input of the static equilibrium of a scene: the string bent into its well, its equations there,
/// and the problem that NOX solves.
#pragma once

#include <vector>

#include "model/NonlinearSolve.hpp"
#include "substructures/drillstring/EquationBuilder.hpp"
#include "substructures/drillstring/scene/Scene.hpp"
#include "substructures/equilibrium/StaticProblem.hpp"
#include "substructures/equilibrium/StaticState.hpp"
#include "substructures/path/PathState.hpp"

namespace tooljoint::drillstring {

/// The string on its path. ConvergenceError.
path::PathState bendIntoWell(const Scene& scene);

PathEquations equationsOnPath(const Scene& scene, const path::PathState& path);

/// Tension of a string that hangs from its first node without friction, per element [N]: loads
/// along w of all nodes below.
std::vector<double> hangingTension(const PathEquations& equations);

/// \param sliding  of the string on the wall
/// \param points   contact points of the scene, with mu_s set to the acting friction coefficient
equilibrium::StaticInput restProblem(const Scene& scene, const path::PathState& path,
                                     const PathEquations& equations,
                                     const contact::Sliding& sliding,
                                     const contact::ContactPoints& points,
                                     equilibrium::Reference reference);

/// Diagonal of the mass matrix, 6 entries per node [kg, kg m2].
Vector massDiagonal(const StringModel& model);

/// NOX with the parameters of the deck's list `Static`.
model::NonlinearSolver staticSolver(const Scene& scene);

/// The static state by the stages of its recipe. If one does not converge, for example at buckling,
/// by sliding (SlidingRest), then by more and smaller stages. ConvergenceError. \param mass
/// massDiagonal()
equilibrium::StaticState solveAtRest(const Scene& scene, const equilibrium::StaticInput& input,
                                     const Vector& mass, const model::NonlinearSolver& solver);

}  // namespace tooljoint::drillstring
