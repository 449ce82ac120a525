// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The Boolean part of assembly: one coordinate for all interface dofs of one label, or one for
/// each part.
#pragma once

#include <set>
#include <utility>
#include <vector>

#include "coupling/assembly/AlignedParts.hpp"
#include "coupling/input/DofLookup.hpp"

namespace tooljoint::coupling {

/// Exceptions to joining by equal labels.
struct LabelRules {
  bool apart = false;                      ///< every part keeps its own dofs (dual assembly)
  std::set<std::pair<int, int>> released;  ///< (part, dof): not joined
  std::set<std::pair<int, int>>
      attached;  ///< (part, dof): held by a connection, so its label need not join anything
};

/// Interface dofs of one label, joined or to be joined.
struct Joint {
  model::DofLabel label;
  std::vector<DofPosition> places;  ///< two at least
};

struct Labelled {
  model::SecondOrderModel model;          ///< coordinates in order of first appearance
  std::vector<std::vector<int>> columns;  ///< per part: its dofs -> coordinates
  std::vector<Joint> joints;
};

/// Errors as coupleWithPositions.
Labelled joinByLabels(const std::vector<AlignedPart>& alignedParts, const LabelRules& rules);

}  // namespace tooljoint::coupling
