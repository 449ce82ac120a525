// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Bends the straight string into the well (Nguyen et al. 2020, section 3.1) with corotational
/// beams.
#pragma once

#include <memory>
#include <vector>

#include "deck/ListSpec.hpp"
#include "model/NonlinearSolve.hpp"
#include "substructures/beam/Element.hpp"
#include "substructures/path/PathState.hpp"
#include "substructures/well/Trajectory.hpp"

namespace Teuchos {
class ParameterList;
}

namespace tooljoint::path {

/// Input of the path computation: elements from the surface down.
struct PathInput {
  std::vector<std::shared_ptr<const beam::Element>> elements;
  const well::Trajectory* trajectory = nullptr;  ///< must outlive the call
};

enum class Mode { CentreLine, ImposedNodes };
enum class Prestress { AxialAndTorque, FullTangent };

/// The deck's `Path` list as a plain value.
struct PathOptions {
  Mode mode = Mode::CentreLine;
  Prestress prestress = Prestress::FullTangent;
  int increments = 10;  ///< of `Imposed nodes`
  int nodeCount = 9;    ///< imposed nodes, equally spaced in arc length, both ends included, when
                        ///< `nodes` is empty
  std::vector<int> nodes;   ///< imposed nodes, 1-based, increasing
  double tolerance = 1e-9;  ///< on the largest scaled residual
  int maxIterations = 50;   ///< per load step
};

/// Description of the deck list `Path`.
deck::ListSpec parameters();

/// Reads a validated `Path` list.
PathOptions optionsFrom(const Teuchos::ParameterList& path);

/// The path state. Throws ConvergenceError when a load step fails even after repeated halving, and
/// ModelError for an empty string, imposed nodes that do not exist, or elements that `Imposed
/// nodes` cannot bend. Rotations that no element has at a node remain those of the well.
PathState computePath(const PathInput& input, const PathOptions& options,
                      const model::NonlinearSolver& solve);
PathState computePath(const PathInput& input, const Teuchos::ParameterList& path,
                      const model::NonlinearSolver& solve);

}  // namespace tooljoint::path
