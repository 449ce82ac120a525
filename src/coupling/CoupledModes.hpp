// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Undamped modes of a coupled model, primal or dual.
#pragma once

#include <complex>
#include <vector>

#include "coupling/assembly/Assembler.hpp"
#include "linalg/trilinos/EigenSolver.hpp"

namespace tooljoint::coupling {

/// Symmetric part of the stiffness at t = 0 about the initial state: closed contacts linearised,
/// without friction. Friction couples the normal force of a sliding contact into the tangential
/// direction but not vice versa, so with friction the symmetric part would be indefinite for any
/// structure. A single constant, symmetric term is returned directly, without a copy.
model::SharedSparse undampedStiffness(const model::SecondOrderModel& model);

/// Contribution of the point sets from number `first` on.
Sparse normalStiffness(const model::SecondOrderModel& model, std::size_t first = 0);

/// The `count` lowest modes of undampedStiffness; the vectors are in coordinates of the model,
/// multipliers included. Uses linalg::lowestModes, or linalg::semidefiniteModes for a singular mass
/// (which returns fewer modes if there are fewer finite ones).
linalg::EigenPairs lowestModes(const model::SecondOrderModel& model, int count);

/// lowestModes without spurious modes: with residual mass a dual Craig-Bampton model has a negative
/// eigenvalue for every force that joins parts (Rixen 2004), and these come first. `spurious` is
/// set to the number of omitted modes.
linalg::EigenPairs lowestPhysicalModes(const model::SecondOrderModel& model, int count,
                                       int* spurious = nullptr);

/// Marks columns of `shapes` in which joining forces have more than half of the modal mass phi^H M
/// phi: spurious modes. In a physical mode they have almost none, since forces have only the mass
/// of the residual flexibility.
std::vector<char> spuriousShapes(const model::SecondOrderModel& model,
                                 const Eigen::MatrixXcd& shapes);

}  // namespace tooljoint::coupling
