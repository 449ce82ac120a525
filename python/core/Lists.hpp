// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Deck lists made by a call: the same names, units, defaults and errors as in a deck.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <memory>
#include <pybind11/pybind11.h>
#include <string>

#include "deck/ListSpec.hpp"

namespace tooljoint::python {

namespace py = pybind11;

/// A list that has been checked, with defaults filled in.
struct List {
  std::shared_ptr<const Teuchos::ParameterList> values;
  const Teuchos::ParameterList& operator*() const { return *values; }
};

/// The description of a list a call may make: "Reduction", "Transient", "Coupling", or the name of
/// a point law. DeckError for any other name.
deck::ListSpec specOf(const std::string& name);

/// The parameters of a variant written in Python: rows (name, kind, unit, default or None,
/// sentence), kind one of "real", "integer", "boolean", "text".
deck::ListSpec specFrom(const std::string& name, const std::string& doc, const py::list& rows);

/// The parameters of such a variant as keyword arguments of its function.
py::dict keywords(const Teuchos::ParameterList& list, const py::dict& names);

}  // namespace tooljoint::python
