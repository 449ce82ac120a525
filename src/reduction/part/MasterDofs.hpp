// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Ranking of interior dofs for a static condensation.
#pragma once

#include <vector>

#include "reduction/part/PartView.hpp"

namespace tooljoint::reduction {

/// Interior dofs in the order of preference as masters, and for each the ratio k_ii / m_ii
/// [rad^2/s^2] at its elimination.
struct MasterRanking {
  std::vector<int> positions;  ///< of the part
  Vector ratios;               ///< increasing
};

/// R. D. Henshell and J. H. Ong, Automatic masters for eigenvalue economization, Earthquake
/// Engineering and Structural Dynamics 3 (1975) 375-383: the dof with the largest ratio k_ii / m_ii
/// is condensed statically, the ratios of the remaining dofs are updated, and so on; the last dofs
/// are the masters. Ratios are made monotonic: each is limited by the ratios of the dofs eliminated
/// before it. Dofs without mass are eliminated first, dofs without positive remaining stiffness
/// last. Uses the symmetric part of the constant stiffness.
MasterRanking rankMasters(const PartView& part);

}  // namespace tooljoint::reduction
