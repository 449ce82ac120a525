// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// File names in lists that are read far from their deck.
#pragma once

#include <string>

namespace Teuchos {
class ParameterList;
}

namespace tooljoint::deck {

/// Stores, in every text parameter of a list and of its sublists, the deck file it was read from
/// (as the documentation string of the entry).
void markOrigin(Teuchos::ParameterList& list, const std::string& file);

/// The file named by a text parameter, relative to the folder of its deck unless absolute. The name
/// is unchanged in a list made by a program, which has no deck.
std::string fileName(const Teuchos::ParameterList& list, const std::string& parameter);

}  // namespace tooljoint::deck
