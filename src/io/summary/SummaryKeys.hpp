// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The keys of summary.json.
#pragma once

#include <string>
#include <vector>

namespace tooljoint::io {

/// The documented keys, in the order of the file. "[]" ends the name of an array of rows.
const std::vector<std::string>& documentedKeys();

/// The new name of a key of earlier versions; "" if there was no such key. The last name decides if
/// it was renamed in all groups: study[].dyn.
std::string renamedKey(const std::string& key);

}  // namespace tooljoint::io
