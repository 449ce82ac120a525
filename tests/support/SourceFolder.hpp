// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Path of the sources. Only one source file contains it, so that a clone in another folder
/// recompiles no other.
#pragma once

#include <string>

namespace tooljoint::testing_ {

/// The folder of the sources, without a closing slash.
std::string sourceFolder();

}  // namespace tooljoint::testing_
