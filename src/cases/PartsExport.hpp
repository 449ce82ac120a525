// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Reduced parts as files.
#pragma once

#include <string>
#include <vector>

#include "cases/Case.hpp"
#include "io/OutputParameters.hpp"
#include "parts/file/PartFile.hpp"
#include "reduction/ReducedSubstructure.hpp"

namespace tooljoint::cases {

/// File (or folder, if it ends in "/") of every part: its name without the characters that file
/// names cannot contain. DeckError when two are the same.
std::vector<std::string> exportedFiles(const std::vector<std::string>& parts,
                                       io::ExportFormat format);

/// Start, end and step of the motion of a case (the sampling interval where the integrator chooses
/// its steps); all zero for a case without one.
parts::LoadTimes loadTimes(const Case& one);

/// Writes every reduced part into `folder`: NAME.h5, a folder NAME, NAME.pch (DMIG) or NAME.dat
/// (ExtPtfm, loads at `times`); nothing for ExportFormat::None. Logs the written files, and warns
/// of point laws that a file cannot hold. FileError, ModelError. Collective.
void exportParts(const std::vector<parts::PartContent>& originals,
                 const std::vector<reduction::ReducedSubstructure>& reduced,
                 io::ExportFormat format, const std::string& folder, const parts::LoadTimes& times);

/// `tooljoint export`: reduces the parts of a case and writes each with its basis as a part file.
/// \param folder  "": results/NAME/parts for NAME.xml. DeckError without the list Reduction;
///                errors of the stages. Collective.
void exportCase(const Case& one, io::ExportFormat format, const std::string& folder);

}  // namespace tooljoint::cases
