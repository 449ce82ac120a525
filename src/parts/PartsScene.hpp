// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Imported parts of a deck: laws, loads, fixed dofs, joints, and node numbers of the whole
/// model.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "coupling/assembly/Assembler.hpp"
#include "coupling/input/CouplingParameters.hpp"
#include "model/NonlinearSolve.hpp"
#include "parts/PartsParameters.hpp"
#include "parts/file/PartFile.hpp"

namespace tooljoint::parts {

/// A node with its number in its file.
struct NodeName {
  int part = 0;           ///< 0-based
  std::int64_t node = 0;  ///< node number in the file of the part
};

struct PartsScene {
  std::vector<PartContent> contents;  ///< with the node numbers of the files, without held dofs
  std::vector<model::Substructure>
      parts;  ///< the same with the node numbers of the scene; interface: joined dofs
  coupling::CouplingOptions coupling;                   ///< with the node numbers of the scene
  std::map<std::int64_t, std::vector<NodeName>> nodes;  ///< by node number of the scene

  int dofs() const;
};

/// Reads the files and joins the parts. Interface dofs that are not joined become retained dofs, as
/// do dofs named by connections. \param given    values of the list Coupling, defaults without it
/// \param resolve  file name of the deck -> path
/// DeckError with the position in the deck, the part and the dof, all faults of one kind together.
/// ModelError as in coupling::resolve. Collective.
PartsScene buildScene(const PartsSettings& settings, const coupling::CouplingInput& given,
                      const std::function<std::string(const std::string&)>& resolve);

/// The initial state of the motion, in coordinates of the coupled unreduced parts: that of the
/// files, or rest under the loads of time t (K q = F + point forces, by `solver`), plus the values
/// of "Starts". Returns the rest state; empty if it is not requested. ConvergenceError, DeckError.
Vector findStart(const PartsSettings& settings, double t, const model::NonlinearSolver& solver,
                 PartsScene& scene);

}  // namespace tooljoint::parts
