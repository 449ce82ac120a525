// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The keys of summary.json.
#pragma once

#include <string>
#include <vector>

namespace tooljoint::io {

/// The documented keys, in the order of the file. "[]" ends the name of an array of rows.
const std::vector<std::string>& documentedKeys();

}  // namespace tooljoint::io
