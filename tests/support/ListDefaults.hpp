// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Lists as returned by the deck reader: every parameter with a default is present.
#pragma once

#include <Teuchos_ParameterList.hpp>

#include "deck/Defaults.hpp"

namespace tooljoint::test {

/// Defaults of the parameters of `spec` (optional sublists stay absent); the test sets the required
/// ones.
inline Teuchos::ParameterList defaultsOf(const deck::ListSpec& spec) {
  Teuchos::ParameterList list;
  deck::withDefaults(spec, Teuchos::ParameterList(spec.name()),
                     [&](const Teuchos::ParameterList& filled) { list = filled; });
  return list;
}

}  // namespace tooljoint::test
