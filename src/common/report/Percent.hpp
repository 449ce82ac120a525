// SPDX-License-Identifier: BSD-3-Clause
/// \file
#pragma once

#include <string>

namespace tooljoint {

/// A fraction of 1 in per cent, with two digits: "0.35 %", "150 %".
std::string percent(double part);

}  // namespace tooljoint
