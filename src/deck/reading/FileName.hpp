// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// File names in lists that are read far from the deck they came from.
#pragma once

#include <string>

namespace Teuchos {
class ParameterList;
}

namespace tooljoint::deck {

/// Notes in every text parameter of a list, and of the lists in it, the deck file it was read from
/// (as the documentation string of the entry).
void markOrigin(Teuchos::ParameterList& list, const std::string& file);

/// The file a text parameter names, relative to the folder of the deck it was read from unless
/// absolute; a list made by a program has none, and the name stays as it is.
std::string fileName(const Teuchos::ParameterList& list, const std::string& parameter);

}  // namespace tooljoint::deck
