// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Parameter lists as text that is the same for the same values: keys of cached results.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <string>

namespace tooljoint::cases {

/// The value of a parameter as text, numbers with all digits.
std::string valueText(const Teuchos::ParameterEntry& entry);

/// A list as text that depends only on names and values, not on their order; numbers with all
/// digits.
std::string canonicalText(const Teuchos::ParameterList& list);

}  // namespace tooljoint::cases
