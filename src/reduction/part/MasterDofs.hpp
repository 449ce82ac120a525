// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Which interior dofs are worth keeping in a static condensation.
#pragma once

#include <vector>

#include "reduction/part/PartView.hpp"

namespace tooljoint::reduction {

/// Interior dofs in the order in which they should be kept, and for each the ratio k_ii / m_ii
/// [rad^2/s^2] it had when it was eliminated.
struct MasterRanking {
  std::vector<int> positions;  ///< of the part
  Vector ratios;               ///< increasing
};

/// R. D. Henshell and J. H. Ong, Automatic masters for eigenvalue economization, Earthquake
/// Engineering and Structural Dynamics 3 (1975) 375-383: the dof with the largest ratio k_ii / m_ii
/// is condensed statically, the ratios are those of what is left, and so on; the last ones are the
/// masters. Ratios are made increasing: each counts at most as much as the one eliminated after it
/// lets it. Dofs without mass come first, dofs whose remaining stiffness is not positive last.
/// With the symmetric part of the constant stiffness.
MasterRanking rankMasters(const PartView& part);

}  // namespace tooljoint::reduction
