// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Tables, datasets and summary values of torque and drag.
#pragma once

#include <vector>

#include "io/OutputFolder.hpp"
#include "io/ResultsFile.hpp"
#include "io/summary/Summary.hpp"
#include "substructures/drillstring/analyses/TorqueDrag.hpp"

namespace tooljoint::drillstring {

/// The largest contact force of the stiff string [N] and its depth.
Margin largestContact(const StiffLoads& stiff);
/// Depth of the deepest bit [m].
double deepestBit(const std::vector<TorqueDragProfile>& profiles);

/// torque_drag.csv, torque_drag_profile.csv, and torque_drag_stiff_profile.csv if there is a stiff
/// string.
void stageTables(const std::vector<TorqueDragProfile>& profiles,
                 const softstring::TorqueDragSettings& settings, io::OutputFolder& folder);
/// Groups /rows, /known and /profile of torque_drag.h5.
void writeDatasets(const std::vector<TorqueDragProfile>& profiles,
                   const softstring::TorqueDragSettings& settings, io::ResultsFile& file);
/// Keys torque_drag; rows are those of the deepest bit.
void summarise(const std::vector<TorqueDragProfile>& profiles,
               const softstring::TorqueDragSettings& settings, io::Summary& summary);

}  // namespace tooljoint::drillstring
