// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// SHA-256 after FIPS 180-4, for the provenance of results (nothing secret depends on it).
#pragma once

#include <string>
#include <string_view>

namespace tooljoint {

/// The digest of `data` as 64 lower-case hexadecimal digits.
std::string sha256(std::string_view data);

}  // namespace tooljoint
