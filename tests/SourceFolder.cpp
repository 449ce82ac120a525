// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/SourceFolder.hpp"

#include <string>

namespace tooljoint::testing_ {

std::string sourceFolder() { return TOOLJOINT_SOURCE_DIR; }

}  // namespace tooljoint::testing_
