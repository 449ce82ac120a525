// SPDX-License-Identifier: BSD-3-Clause
#include "Lists.hpp"

#include <pybind11/stl.h>
#include <tuple>
#include <utility>
#include <vector>

#include "Bind.hpp"
#include "common/Error.hpp"
#include "coupling/input/CouplingParameters.hpp"
#include "deck/Deck.hpp"
#include "deck/Manual.hpp"
#include "deck/Variants.hpp"
#include "model/laws/PointLawRegistry.hpp"
#include "reduction/ReductionParameters.hpp"
#include "transient/TransientParameters.hpp"

namespace tooljoint::python {

namespace {

using deck::ListSpec;
using deck::Range;

List parseList(const std::string& xml, const std::string& name) {
  const auto parsed = deck::Deck::parse(xml, name, specOf(name));
  return {std::make_shared<const Teuchos::ParameterList>(parsed.list())};
}

/// A value of a list as an object of Python; lists become dicts.
py::object toPython(const Teuchos::ParameterEntry& entry);

py::dict toPython(const Teuchos::ParameterList& list) {
  py::dict values;
  for (auto it = list.begin(); it != list.end(); ++it)
    values[py::str(list.name(it))] = toPython(list.entry(it));
  return values;
}

py::object toPython(const Teuchos::ParameterEntry& entry) {
  using Teuchos::Array;
  using Teuchos::getValue;
  if (entry.isList()) return toPython(getValue<Teuchos::ParameterList>(entry));
  if (entry.isType<bool>()) return py::bool_(getValue<bool>(entry));
  if (entry.isType<int>()) return py::int_(getValue<int>(entry));
  if (entry.isType<double>()) return py::float_(getValue<double>(entry));
  if (entry.isType<std::string>()) return py::str(getValue<std::string>(entry));
  if (entry.isType<Array<int>>()) return py::cast(getValue<Array<int>>(entry).toVector());
  if (entry.isType<Array<double>>()) return py::cast(getValue<Array<double>>(entry).toVector());
  if (entry.isType<Array<std::string>>())
    return py::cast(getValue<Array<std::string>>(entry).toVector());
  throw Error(ExitCode::Internal, "A deck holds a value of an unknown type.");
}

template <class T>
deck::Default defaultOf(const py::object& value) {
  if (value.is_none()) return deck::Required{};
  return value.cast<T>();
}

}  // namespace

py::object listToPython(const Teuchos::ParameterList& list) { return toPython(list); }

ListSpec specOf(const std::string& name) {
  if (name == "Reduction") return reduction::parameters();
  if (name == "Transient") return transient::parameters();
  if (name == "Coupling") return coupling::parameters();
  return deck::variantSpec(name, model::PointLawRegistry::instance().find(name));
}

ListSpec specFrom(const std::string& name, const std::string& doc, const py::list& rows) {
  ListSpec spec(name, doc);
  for (const auto& row : rows) {
    const auto [parameter, kind, unit, value, sentence] =
        row.cast<std::tuple<std::string, std::string, std::string, py::object, std::string>>();
    if (kind == "integer")
      spec.integer(parameter, defaultOf<int>(value), Range::any(), sentence);
    else if (kind == "boolean")
      spec.boolean(parameter, defaultOf<bool>(value), sentence);
    else if (kind == "text")
      spec.text(parameter, defaultOf<std::string>(value), sentence);
    else
      spec.real(parameter, unit, defaultOf<double>(value), Range::any(), sentence);
  }
  if (const auto faults = spec.inconsistencies(); !faults.empty()) throw UsageError(faults.front());
  return spec;
}

py::dict keywords(const Teuchos::ParameterList& list, const py::dict& names) {
  py::dict values;
  for (const auto& [name, keyword] : names)
    values[keyword] = toPython(list.getEntry(name.cast<std::string>()));
  return values;
}

void bindLists(py::module_& module) {
  py::class_<List>(module, "DeckList", "A checked deck list with defaults, in SI.")
      .def(
          "to_dict", [](const List& list) { return toPython(*list); },
          "The values of the list; sublists are dicts.");
  module.def("parse_list", &parseList, py::arg("xml"), py::arg("name"),
             "Check a list in XML against the description of the list `name`. DeckError.");
  module.def(
      "list_description", [](const std::string& name) { return deck::manualJson(specOf(name)); },
      py::arg("name"), "The description of a list as JSON, like `tooljoint doc --format json`.");
}

}  // namespace tooljoint::python
