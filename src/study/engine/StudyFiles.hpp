// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a study leaves in its folder: study.csv, study.h5, summary.json and pictures.
/// docs/file-formats.md describes all of it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/OutputFolder.hpp"
#include "io/summary/Summary.hpp"
#include "study/Row.hpp"
#include "study/engine/StudyPlan.hpp"

namespace tooljoint::study {

/// All rows of a study, reference first, and what they mean together.
struct StudyResult {
  const StudyPlan& plan;
  std::shared_ptr<const cases::RestingCase> rest;  ///< of the reference; null: not found
  std::vector<StudyRow> rows;
  std::string machine;
  std::optional<double> predictedCpu = std::nullopt;  ///< of the reference, before it ran [s]

  /// The row of this kind when its run is done, else null.
  const StudyRow* find(RunKind kind) const;
};

void stageStudyTable(const StudyResult& result, io::OutputFolder& folder);
void stageStudyFile(const StudyResult& result, io::OutputFolder& folder);
void summarise(const StudyResult& result, io::Summary& summary);

/// Where the step, not the basis, limits the reduced runs: a sentence each (StepLimit.hpp).
std::vector<std::string> stepLimits(const StudyResult& result);

/// What the reference is worth, in two lines.
std::string describeReference(const StudyResult& result);

/// Draws the plots of the files in a folder with the installed script: names of the files made.
/// When that is not possible, warns with the command to draw them later. Rank 0 only.
void drawStudy(const std::string& folder);
/// The same with any script whose pictures begin with `prefix`; those of an earlier run go.
void drawPictures(const std::string& script, const std::string& prefix, const std::string& folder);

}  // namespace tooljoint::study
