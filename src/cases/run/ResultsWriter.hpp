// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Output of the reduction and the transient of any case in results.h5, in the tables and in
/// summary.json. docs/file-formats.md describes all of it.
#pragma once

#include <string>
#include <vector>

#include "cases/ReducedCase.hpp"
#include "deck/Deck.hpp"
#include "estimate/AdaptiveReduction.hpp"
#include "io/OutputFolder.hpp"
#include "io/ResultsFile.hpp"
#include "io/summary/Summary.hpp"
#include "reduction/ReducedSubstructure.hpp"
#include "transient/Transient.hpp"

namespace tooljoint::cases {

io::Provenance provenance(const deck::Deck& deck);

/// Group /reduction: Phi, offset and eigenvalues of every part.
void writeBases(const std::vector<reduction::ReducedSubstructure>& parts, io::ResultsFile& file);

/// basis.csv: every vector of every basis, with the reason for keeping or dropping it.
void stageBasisTable(const std::vector<reduction::ReducedSubstructure>& parts,
                     io::OutputFolder& folder);

/// Parts, coupling and estimates of a reduction that took `wall` seconds; `basis` is its name.
void summarise(const ReducedCase& reduced, const std::string& basis, double wall,
               io::Summary& summary);
void summarise(const estimate::MotionEstimate& error, io::Summary& summary);
/// Counts and times of a transient.
void summarise(const transient::TransientReport& report, bool reduced, io::Summary& summary);

}  // namespace tooljoint::cases
