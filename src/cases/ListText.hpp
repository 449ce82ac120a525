// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Parameter lists as text that is the same for the same values: keys of what is computed once.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <string>

namespace tooljoint::cases {

/// The value of a parameter as text, numbers in full.
std::string valueText(const Teuchos::ParameterEntry& entry);

/// A list as text that depends on names and values alone, not on their order; numbers in full.
std::string canonicalText(const Teuchos::ParameterList& list);

}  // namespace tooljoint::cases
