// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What the reduction and the transient of any case leave in results.h5, in the tables and in
/// summary.json. docs/file-formats.md describes all of it.
#pragma once

#include <string>
#include <vector>

#include "deck/Deck.hpp"
#include "estimate/AdaptiveReduction.hpp"
#include "io/OutputFolder.hpp"
#include "io/ResultsFile.hpp"
#include "io/Summary.hpp"
#include "reduction/ReducedSubstructure.hpp"
#include "transient/Transient.hpp"

namespace tooljoint::cases {

io::Provenance provenance(const deck::Deck& deck);

/// Group /reduction: Phi, offset and eigenvalues of every part.
void writeBases(const std::vector<reduction::ReducedSubstructure>& parts, io::ResultsFile& file);

/// basis.csv: every vector of every basis, kept or dropped and why.
void stageBasisTable(const std::vector<reduction::ReducedSubstructure>& parts,
                     io::OutputFolder& folder);

void summarise(const std::vector<reduction::ReducedSubstructure>& parts, const std::string& basis,
               int reducedDofs, double wall, io::Summary& summary);
void summarise(const coupling::Coupling& coupled, io::Summary& summary);
void summarise(const estimate::Outcome& outcome, const std::vector<model::Substructure>& parts,
               io::Summary& summary);
void summarise(const estimate::MotionEstimate& error, io::Summary& summary);
/// Counts and times of a transient.
void summarise(const transient::TransientReport& report, bool reduced, io::Summary& summary);

}  // namespace tooljoint::cases
