// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Deck descriptions in words, shared by error messages, the manual and the templates, so that they
/// agree.
#pragma once

#include <string>

#include "deck/ListSpec.hpp"

namespace tooljoint::deck {

/// Type attribute of a parameter of this kind: "double", "Array(string)", ...
std::string typeName(Kind kind);

/// "> 0", ">= 1", "in [0, 1)", "" for any number.
std::string describe(const Range& range);
bool contains(const Range& range, double value);

/// The value in the syntax of a deck: 0.5, true, {1, 2}; "required" and "none" for the two kinds
/// without value.
std::string describe(const Default& value);
std::string describe(double value);

/// First sentence, unit, range or choices of a parameter in one clause, followed by further
/// sentences: "the nominal contact stiffness, N/m, > 0".
std::string describe(const ParameterSpec& parameter);

/// `It is the nominal contact stiffness, N/m, > 0.`, or `"Modes": number of modes, >= 0.` when the
/// sentence does not begin with an article.
std::string introduce(const ParameterSpec& parameter);
std::string introduce(const ListSpec& list);

/// A value that lies in range and among the choices, in the syntax of a deck: the default if there
/// is one.
std::string exampleValue(const ParameterSpec& parameter);

}  // namespace tooljoint::deck
