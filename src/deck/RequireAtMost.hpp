// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A check of two parameters of a list against each other. Header only.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <string>

#include "common/Error.hpp"
#include "common/Text.hpp"

namespace tooljoint::deck {

/// DeckError if the parameter `name` of the list is above its parameter `bound`; `why` is a
/// sentence. The list contains both, as numbers with the same unit.
inline void requireAtMost(const Teuchos::ParameterList& list, const std::string& name,
                          const std::string& bound, const std::string& why) {
  const auto value = list.get<double>(name), most = list.get<double>(bound);
  if (value > most)
    throw DeckError(list.name() + "/" + name + " is " + formatNumber(value) + ", above the " +
                    bound + " of " + formatNumber(most) + ". " + why);
}

}  // namespace tooljoint::deck
