// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Output of the static state of a string in results.h5, in the tables, in summary.json and in the
/// log. docs/file-formats.md describes all of it.
#pragma once

#include <string>
#include <vector>

#include "cases/Case.hpp"
#include "io/OutputFolder.hpp"
#include "io/ResultsFile.hpp"
#include "io/summary/Summary.hpp"
#include "substructures/drillstring/scene/Scene.hpp"
#include "substructures/drillstring/scene/Stages.hpp"

namespace tooljoint::drillstring {

/// Groups /model, /path and /static of the results file.
void writeModel(const Scene& scene, const StaticStage& stage, io::ResultsFile& file);
void writeSections(const Scene& scene, io::ResultsFile& file);
void writeBending(const Scene& scene, const StaticStage& stage, io::ResultsFile& file);
void writePath(const StaticStage& stage, io::ResultsFile& file);
void writeStatic(const Scene& scene, const StaticStage& stage, io::ResultsFile& file);
/// Group /profile of the file of a study.
void writeProfile(const Scene& scene, const StaticStage& stage, io::ResultsFile& file);

/// static_nodes.csv and static_elements.csv.
void stageStaticTables(const Scene& scene, const StaticStage& stage, io::OutputFolder& folder);

void summarise(const Scene& scene, io::Summary& summary);
void summarise(const Scene& scene, const StaticStage& stage, io::Summary& summary);
/// Contacts and loads at the ends.
std::vector<cases::RestFigure> restFigures(const StaticStage& stage);

/// Lines of the log.
std::string describeScene(const Scene& scene);
/// Torques are positive against the rotation. With log::verbose() also the solution of path and
/// static state.
std::string describeStatic(const Scene& scene, const StaticStage& stage);

}  // namespace tooljoint::drillstring
