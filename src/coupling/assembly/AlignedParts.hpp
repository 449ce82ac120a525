// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A part in the form used by the assembler, reduced or not: its model in the common frame, with
/// the components in one order and the interface among its dofs.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "coupling/input/Connections.hpp"
#include "model/Substructure.hpp"
#include "reduction/ReducedSubstructure.hpp"

namespace tooljoint::coupling {

struct AlignedPart {
  std::string name;
  const model::SecondOrderModel* model = nullptr;      ///< of the part, or `own`
  std::shared_ptr<const model::SecondOrderModel> own;  ///< if the model had to be changed
  bool reduced = false;
  std::vector<int> interface;  ///< positions
  std::vector<int> retained;   ///< positions
  Vector offset;               ///< D at q = 0, 0 for modes
  Sparse turn;          ///< dofs in the frames of the part = turn * dofs here; empty: the same
  Sparse recoveryTurn;  ///< recovery rows here = recoveryTurn * those of the part; empty: the same
  std::set<model::DofLabel>
      unturned;  ///< dofs with a frame that could not be turned; nothing may be attached to them

  // For parts with reduction::DerivedInterface: the interface dofs follow the coordinates of the
  // part, without mass or stiffness.
  int coordinates = 0;  ///< of the part itself
  Sparse boundaryRows;  ///< u_b = rows q + offset; no rows without Boundary
  int forces = 0;       ///< number of interface forces, the last coordinates of the part
  Vector staticForces;  ///< reduction::DerivedInterface::staticForces, in the frames of the part
};

std::vector<AlignedPart> alignParts(const std::vector<reduction::ReducedSubstructure>& parts);
std::vector<AlignedPart> alignParts(const std::vector<model::Substructure>& parts);

/// Components of all parts in the order of the first part. ModelError when parts have other
/// components.
void alignComponents(std::vector<AlignedPart>& alignedParts);

/// Rotates the boundary dofs, and the recovery of all nodes, into the common frame: d_common =
/// axes d_part. ModelErrors of Frame.
void turn(std::vector<AlignedPart>& alignedParts, const std::vector<Frame>& frames);

}  // namespace tooljoint::coupling
