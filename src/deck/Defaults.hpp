// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Lists made in C++, without a deck, with the defaults of their description.
#pragma once

#include <functional>

#include "deck/ListSpec.hpp"

namespace Teuchos {
class ParameterList;
}

namespace tooljoint::deck {

/// Calls use() with a copy of `given` in which the absent parameters of `spec` have their defaults
/// (required and optional ones stay absent). Lists of a deck have been checked by the strict
/// reader; for other lists, DeckError if the value of a choice is not among its choices.
void withDefaults(const ListSpec& spec, const Teuchos::ParameterList& given,
                  const std::function<void(const Teuchos::ParameterList&)>& use);

}  // namespace tooljoint::deck
