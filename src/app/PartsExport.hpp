// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Reduced parts as files.
#pragma once

#include <string>
#include <vector>

#include "app/Commands.hpp"
#include "io/OutputParameters.hpp"
#include "parts/PartFile.hpp"
#include "reduction/ReducedSubstructure.hpp"

namespace tooljoint::app {

/// File (or, ending in "/", folder) of every part, by its name without the characters that file
/// names cannot hold. DeckError when two are the same.
std::vector<std::string> exportedFiles(const std::vector<std::string>& parts,
                                       io::ExportFormat format);

/// Writes every reduced part into `folder`: NAME.h5, or a folder NAME; nothing for
/// ExportFormat::None. Says what was written, and warns of point laws that a file cannot hold.
/// FileError, ModelError. Collective.
void exportParts(const std::vector<parts::PartContent>& originals,
                 const std::vector<reduction::ReducedSubstructure>& reduced,
                 io::ExportFormat format, const std::string& folder);

}  // namespace tooljoint::app
