// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Lists as a room receives them from the deck reader: every parameter that has a default is there.
#pragma once

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <string>
#include <variant>
#include <vector>

#include "deck/ListSpec.hpp"

namespace tooljoint::test {

/// Defaults of the parameters of `spec` (optional sublists stay absent); required ones are for the
/// test to set.
inline Teuchos::ParameterList defaultsOf(const deck::ListSpec& spec) {
  Teuchos::ParameterList list(spec.name());
  for (const auto& parameter : spec.parameters()) {
    const std::string& name = parameter.name;
    const auto& value = parameter.value;
    if (const auto* flag = std::get_if<bool>(&value)) list.set(name, *flag);
    if (const auto* whole = std::get_if<int>(&value)) {
      if (parameter.kind == deck::Kind::Real) {
        list.set(name, static_cast<double>(*whole));
      } else {
        list.set(name, *whole);
      }
    }
    if (const auto* real = std::get_if<double>(&value)) list.set(name, *real);
    if (const auto* text = std::get_if<std::string>(&value)) list.set(name, *text);
    if (const auto* wholes = std::get_if<std::vector<int>>(&value))
      list.set(name, Teuchos::Array<int>(*wholes));
    if (const auto* reals = std::get_if<std::vector<double>>(&value))
      list.set(name, Teuchos::Array<double>(*reals));
    if (const auto* texts = std::get_if<std::vector<std::string>>(&value))
      list.set(name, Teuchos::Array<std::string>(*texts));
  }
  return list;
}

}  // namespace tooljoint::test
