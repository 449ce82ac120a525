// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Units of the single numbers of summary.json.
#pragma once

#include <string>

namespace tooljoint::io {

/// The SI unit of a documented key ("N m"); "" for counts, shares, times, frequencies and rotary
/// speeds, whose names say what they are, and for figures of parts that mix lengths and angles.
std::string unitOfKey(const std::string& key);

}  // namespace tooljoint::io
