// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Undamped modes of a coupled model, primal or dual.
#pragma once

#include <complex>
#include <vector>

#include "coupling/assembly/Assembler.hpp"
#include "linalg/trilinos/EigenSolver.hpp"

namespace tooljoint::coupling {

/// Symmetric part of the stiffness at t = 0 about the initial state: closed contacts linear,
/// without friction. Friction couples the normal force of a sliding contact into the tangential
/// direction and not vice versa, so the symmetric part with friction would be indefinite for any
/// structure. A single constant, symmetric term is returned as it is, without a copy.
model::SharedSparse undampedStiffness(const model::SecondOrderModel& model);

/// What the point sets from number `first` on contribute to it.
Sparse normalStiffness(const model::SecondOrderModel& model, std::size_t first = 0);

/// The `count` lowest modes of undampedStiffness; the vectors are in coordinates of the model,
/// multipliers included. linalg::lowestModes, or, where the mass is singular,
/// linalg::semidefiniteModes (which returns fewer when there are fewer finite ones).
linalg::EigenPairs lowestModes(const model::SecondOrderModel& model, int count);

/// lowestModes without those that are spurious: with residual mass a dual Craig-Bampton model has a
/// negative eigenvalue for every force that joins parts (Rixen 2004), and they come first.
/// `spurious` is set to the number left out.
linalg::EigenPairs lowestPhysicalModes(const model::SecondOrderModel& model, int count,
                                       int* spurious = nullptr);

/// Columns of `shapes` whose modal mass phi^H M phi belongs to joining forces by more than half:
/// spurious modes. A physical mode has nearly none there, since forces have the mass of the
/// residual flexibility alone.
std::vector<char> spuriousShapes(const model::SecondOrderModel& model,
                                 const Eigen::MatrixXcd& shapes);

}  // namespace tooljoint::coupling
