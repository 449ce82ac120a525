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

/// A node in the numbers of its file.
struct NodeName {
  int part = 0;           ///< 0-based
  std::int64_t node = 0;  ///< as the file of the part numbers it
};

struct PartsScene {
  std::vector<PartContent> contents;  ///< as the files number nodes, held dofs taken out
  std::vector<model::Substructure>
      parts;  ///< the same in numbers of the scene; interface: what is joined
  coupling::CouplingOptions coupling;                   ///< in numbers of the scene
  std::map<std::int64_t, std::vector<NodeName>> nodes;  ///< of a number of the scene

  int dofs() const;
};

/// Reads the files and puts the parts together. Interface dofs that nothing joins become retained
/// ones, as do dofs that connections name. \param given what the list Coupling says, defaults
/// without it \param resolve file name of the deck -> path DeckError naming the place in the deck,
/// the part and the dof, all faults of one kind together. ModelError as in coupling::plan.
/// Collective.
PartsScene buildScene(const PartsSettings& settings, const coupling::CouplingInput& given,
                      const std::function<std::string(const std::string&)>& resolve);

/// The state the motion starts from, in coordinates of the coupled unreduced parts: that of the
/// files, or rest under the loads of time t (K q = F + point forces, by `solver`); and what
/// "Starts" adds. Returns that rest; empty where it is not wanted. ConvergenceError, DeckError.
Vector findStart(const PartsSettings& settings, double t, const model::NonlinearSolver& solver,
                 PartsScene& scene);

}  // namespace tooljoint::parts
