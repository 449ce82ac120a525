// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Lists as a room receives them from the deck reader: every parameter that has a default is there.
#pragma once

#include <Teuchos_ParameterList.hpp>

#include "deck/Defaults.hpp"

namespace tooljoint::test {

/// Defaults of the parameters of `spec` (optional sublists stay absent); required ones are for the
/// test to set.
inline Teuchos::ParameterList defaultsOf(const deck::ListSpec& spec) {
  Teuchos::ParameterList list;
  deck::withDefaults(spec, Teuchos::ParameterList(spec.name()),
                     [&](const Teuchos::ParameterList& filled) { list = filled; });
  return list;
}

}  // namespace tooljoint::test
