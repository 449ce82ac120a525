// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Parameters shared by the lists Campbell and Response.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <string>
#include <vector>

#include "deck/ListSpec.hpp"

namespace tooljoint::response {

/// Declares `Friction`, `Spot Checks` and `Axis`.
void declareCommon(deck::ListSpec& list);
bool wantsFriction(const Teuchos::ParameterList& list);
/// As many values as the list's `Points`, from one parameter to another. DeckError when they do not
/// increase.
std::vector<double> evenly(const Teuchos::ParameterList& list, const std::string& from,
                           const std::string& to, const std::string& unit);
/// "0 to 9549.3": ends of a sweep, times a factor.
std::string rangeOf(const std::vector<double>& sweep, double factor = 1.0);
/// Positions of `count` of `size` points, spread from the first to the last.
std::vector<std::size_t> spread(std::size_t size, int count);

}  // namespace tooljoint::response
