// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Files of a study in its folder: study.csv, study.h5, summary.json and pictures.
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

/// All rows of a study, reference first, and common results.
struct StudyResult {
  const StudyPlan& plan;
  std::shared_ptr<const cases::RestingCase> rest;  ///< of the reference; null: not found
  std::vector<StudyRow> rows;
  std::string machine;
  std::optional<double> predictedCpu = std::nullopt;  ///< of the reference, before it ran [s]

  /// The row of this kind if its run is done, otherwise null.
  const StudyRow* find(RunKind kind) const;
};

void stageStudyTable(const StudyResult& result, io::OutputFolder& folder);
void stageStudyFile(const StudyResult& result, io::OutputFolder& folder);
void summarise(const StudyResult& result, io::Summary& summary);

/// One sentence for each group of reduced runs limited by the step, not by the basis
/// (StepLimit.hpp).
std::vector<std::string> stepLimits(const StudyResult& result);

/// Accuracy of the reference, in two lines.
std::string describeReference(const StudyResult& result);

/// Draws the plots of the files in a folder with the installed script; returns the names of the
/// files. If that fails, warns with the command to draw them later. Rank 0 only.
void drawStudy(const std::string& folder);
/// The same with any script whose pictures begin with `prefix`; pictures of an earlier run are
/// removed.
void drawPictures(const std::string& script, const std::string& prefix, const std::string& folder);

}  // namespace tooljoint::study
