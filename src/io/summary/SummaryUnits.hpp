// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Units of the numbers of summary.json.
#pragma once

#include <string>

namespace tooljoint::io {

/// The SI unit of a documented key ("N m"); "" for counts, fractions, times, frequencies and rotary
/// speeds, whose names contain the unit, and for results of parts that mix lengths and angles.
std::string unitOfKey(const std::string& key);

}  // namespace tooljoint::io
