// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What the stages before the transient leave in results.h5, in the tables and in summary.json.
/// docs/file-formats.md describes all of it.
#pragma once

#include <string>
#include <vector>

#include "app/Recording.hpp"
#include "app/Scene.hpp"
#include "app/Stages.hpp"
#include "estimate/AdaptiveReduction.hpp"
#include "io/OutputFolder.hpp"
#include "io/ResultsFile.hpp"
#include "io/Summary.hpp"
#include "reduction/ReducedSubstructure.hpp"
#include "transient/Transient.hpp"

namespace tooljoint::app {

io::Provenance provenance(const deck::Deck& deck);

/// Groups /model, /path and /static of the results file.
void writeModel(const Scene& scene, const StaticStage& stage, io::ResultsFile& file);
void writePath(const StaticStage& stage, io::ResultsFile& file);
void writeStatic(const Scene& scene, const StaticStage& stage, io::ResultsFile& file);
/// Group /reduction: Phi, offset and eigenvalues of every part.
void writeBases(const std::vector<reduction::ReducedSubstructure>& parts, io::ResultsFile& file);

/// static_nodes.csv and static_elements.csv.
void stageStaticTables(const Scene& scene, const StaticStage& stage, io::OutputFolder& folder);
/// basis.csv: every vector of every basis, kept or dropped and why.
void stageBasisTable(const std::vector<reduction::ReducedSubstructure>& parts,
                     io::OutputFolder& folder);

void summarise(const Scene& scene, io::Summary& summary);
void summarise(const StaticStage& stage, io::Summary& summary);
void summarise(const std::vector<reduction::ReducedSubstructure>& parts, const std::string& basis,
               int reducedDofs, double wall, io::Summary& summary);
void summarise(const coupling::Coupling& coupled, io::Summary& summary);
void summarise(const estimate::Outcome& outcome, const std::vector<model::Substructure>& parts,
               io::Summary& summary);
void summarise(const estimate::MotionEstimate& error, io::Summary& summary);
/// Counts and times of a transient.
void summarise(const transient::TransientReport& report, bool reduced, io::Summary& summary);
void summarise(const transient::TransientReport& report, const MotionFigures& figures, bool reduced,
               io::Summary& summary);

}  // namespace tooljoint::app
