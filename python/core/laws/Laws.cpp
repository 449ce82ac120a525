// SPDX-License-Identifier: BSD-3-Clause
// Point laws: those of the registry, and laws written in Python.
#include <map>
#include <memory>
#include <pybind11/stl.h>
#include <string>
#include <utility>
#include <vector>

#include "Arrays.hpp"
#include "Bind.hpp"
#include "Calls.hpp"
#include "Lists.hpp"
#include "common/Index.hpp"
#include "laws/PythonLaw.hpp"
#include "laws/PythonStateLaw.hpp"
#include "model/laws/PointLawRegistry.hpp"
#include "model/laws/StatefulPointLaw.hpp"

namespace tooljoint::python {

namespace {

using model::PointLaw;

/// A law that decks can name.
struct WrittenLaw {
  int width, states;
  Kept force, tangent, power, start;
  py::dict names;
};

/// By name; changed and read with the GIL only, never destroyed.
std::map<std::string, WrittenLaw>& writtenLaws() {
  static auto* laws = new std::map<std::string, WrittenLaw>;
  return *laws;
}

std::unique_ptr<PointLaw> makeWritten(const std::string& name, const Teuchos::ParameterList& own,
                                      const model::PointLawPlace& place) {
  std::unique_ptr<PointLaw> law;
  fromPython("The point law \"" + name + "\"", [&] {
    const auto& one = writtenLaws().at(name);
    if (one.width > place.coordinates)
      throw DeckError("The point law \"" + name + "\" takes " + std::to_string(one.width) +
                      " coordinates, but its place has " + std::to_string(place.coordinates) + ".");
    LawFunction function(
        name, one.width, one.states,
        {one.force, one.tangent, one.power, one.start, Kept(keywords(own, one.names))});
    if (one.states > 0)
      law = std::make_unique<PythonStateLaw>(place.points, std::move(function));
    else
      law = std::make_unique<PythonLaw>(place.points, std::move(function));
  });
  return law;
}

void registerLaw(const std::string& name, const std::string& doc, const py::list& parameters,
                 const py::dict& names, int width, int states, const py::object& force,
                 const py::object& tangent, const py::object& power, const py::object& start) {
  auto& laws = writtenLaws();
  const bool own = laws.count(name) != 0;
  auto& registry = model::PointLawRegistry::instance();
  if (!own && registry.entries().count(name) != 0)
    throw UsageError("There is a point law \"" + name + "\" already. Choose another name.");
  if (own && !laws.at(name).names.equal(names))
    throw UsageError("The point law \"" + name +
                     "\" was registered with other parameters. Choose another name, or start "
                     "Python anew.");
  laws.insert_or_assign(
      name, WrittenLaw{width, states, Kept(force), Kept(tangent), Kept(power), Kept(start), names});
  if (own) return;
  registry.add(name,
               {doc, specFrom(name, doc, parameters),
                [name](const Teuchos::ParameterList& list, const model::PointLawPlace& place) {
                  return makeWritten(name, list, place);
                }});
}

Vector evaluate(const PointLaw& law, double t, const Vector& d, const Vector& v) {
  const Eigen::Index wanted = law.size() * law.width();
  if (d.size() != wanted || v.size() != wanted)
    throw UsageError("The law has " + std::to_string(law.size()) + " points with " +
                     std::to_string(law.width()) + " coordinates: give " + std::to_string(wanted) +
                     " positions and velocities.");
  if (dynamic_cast<const model::StatefulPointLaw*>(&law) != nullptr)
    throw UsageError("The force of a law with states depends on its motion: integrate it.");
  std::vector<int> all(at(law.size()));
  for (int p = 0; p < law.size(); ++p) all[at(p)] = p;
  Vector f(wanted);
  law.evaluate(t, all, d.data(), v.data(), f.data());
  return f;
}

}  // namespace

void bindLaws(py::module_& module) {
  py::class_<PointLaw, std::shared_ptr<PointLaw>>(module, "PointLaw",
                                                  "Forces f(t, d, v) of points with a common law.")
      .def_property_readonly("size", &PointLaw::size, "Number of points.")
      .def_property_readonly("width", &PointLaw::width, "Coordinates of a point.")
      .def("force", &evaluate, py::arg("t"), py::arg("d"), py::arg("v"),
           "Forces [N] at positions d [m] and velocities v [m/s], points x width in one row.");
  module.def(
      "point_law",
      [](const std::string& name, const List& list, int points, int coordinates) {
        return std::shared_ptr<PointLaw>(model::PointLawRegistry::instance().make(
            name, *list, model::PointLawPlace{points, coordinates}));
      },
      py::arg("name"), py::arg("parameters"), py::arg("points"), py::arg("coordinates"),
      "A point law from the registry.");
  module.def("register_point_law", &registerLaw, py::arg("name"), py::arg("doc"),
             py::arg("parameters"), py::arg("keywords"), py::arg("width"), py::arg("states"),
             py::arg("force"), py::arg("tangent"), py::arg("power"), py::arg("start"),
             "Register a law written in Python.");
  module.def(
      "point_law_names", [] { return model::PointLawRegistry::instance().names(); },
      "Names of the available laws.");
}

}  // namespace tooljoint::python
