// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The keys of summary.json.
#pragma once

#include <string>
#include <vector>

namespace tooljoint::io {

/// The documented keys, in the order of the file. "[]" ends the name of an array of rows.
const std::vector<std::string>& documentedKeys();

/// The key that stands for one of earlier versions; "" for a key that was none. The last name
/// decides where it was renamed in all parts: study[].dyn.
std::string renamedKey(const std::string& key);

}  // namespace tooljoint::io
