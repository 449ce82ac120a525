// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The stiff string for many bit depths.
#pragma once

#include <vector>

#include "cases/run/ResumedRows.hpp"
#include "substructures/drillstring/analyses/StiffString.hpp"

namespace tooljoint::drillstring {

/// Every operation at every depth, [depth][operation]. Depths are distributed to the ranks one by
/// one; at the end all ranks have all rows. One line of progress per depth. Depths that are stored
/// for the same deck, operations and program are not computed again. Collective. DeckError as
/// StiffString(); FileError; InterruptedError after a signal.
std::vector<std::vector<StiffLoads>> stiffRows(const Scene& scene,
                                               const std::vector<double>& depths,
                                               const std::vector<softstring::Operation>& operations,
                                               const cases::RowFolder& store);

}  // namespace tooljoint::drillstring
