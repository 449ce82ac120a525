// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// SHA-256 (FIPS 180-4, computed by OpenSSL), for the provenance of results.
#pragma once

#include <string>
#include <string_view>

namespace tooljoint {

/// The digest of `data` as 64 lower-case hexadecimal digits.
std::string sha256(std::string_view data);

}  // namespace tooljoint
