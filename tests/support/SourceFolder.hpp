// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Where the sources are. One source knows it, so that a clone in another folder compiles no other.
#pragma once

#include <string>

namespace tooljoint::testing_ {

/// The folder of the sources, without a closing slash.
std::string sourceFolder();

}  // namespace tooljoint::testing_
