// SPDX-License-Identifier: BSD-3-Clause
// Reduction, coupling, and both together with error estimates.
#include <pybind11/stl.h>
#include <string>
#include <utility>

#include "Arrays.hpp"
#include "Bind.hpp"
#include "Calls.hpp"
#include "Lists.hpp"
#include "Synthesis.hpp"
#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Index.hpp"
#include "coupling/StartMisfit.hpp"
#include "reduction/Reduce.hpp"

namespace tooljoint::python {

namespace {

using reduction::ReducedSubstructure;

/// Connections and their parts: the parts of a list Coupling get their own node numbers and
/// retained dofs.
coupling::ResolvedCoupling resolve(const Parts& parts, const Joining& joining) {
  if (const auto* list = std::get_if<List>(&joining))
    return coupling::resolve(valuesOf(parts), coupling::readCoupling(**list));
  coupling::ResolvedCoupling resolved{valuesOf(parts), {}};
  if (const auto* options = std::get_if<coupling::CouplingOptions>(&joining))
    resolved.options = *options;
  return resolved;
}

std::vector<ReducedSubstructure> reduce(const Parts& parts, const List& list) {
  return longCall([&] { return reduction::reduceAll(valuesOf(parts), *list); });
}

ModelPointer couple(const Parts& parts, const Joining& joining) {
  return longCall([&] {
    const auto resolved = resolve(parts, joining);
    return std::make_shared<model::SecondOrderModel>(
        coupling::couple(resolved.parts, resolved.options));
  });
}

ModelPointer coupleReduced(const std::vector<ReducedSubstructure>& parts) {
  return longCall([&] {
    coupling::CouplingOptions options;
    for (const auto& part : parts)
      if (part.derivedInterface && part.derivedInterface->forces > 0)
        options.assembly = coupling::Assembly::Dual;
    return std::make_shared<model::SecondOrderModel>(coupling::couple(parts, options));
  });
}

std::shared_ptr<Synthesised> synthesise(const Parts& parts, const List& list,
                                        const Joining& joining) {
  return longCall([&] {
    auto out = std::make_shared<Synthesised>();
    out->unreduced = resolve(parts, joining);
    out->outcome = estimate::synthesise(out->unreduced.parts, *list, {}, out->unreduced.options);
    out->model = std::make_shared<model::SecondOrderModel>(out->outcome.synthesis.coupled.model);
    coupling::warnOfStart(out->outcome.synthesis);
    return out;
  });
}

py::dict roundOf(const estimate::Round& round) {
  py::dict row;
  row["modes"] = round.modes;
  row["frequency_error"] = round.frequencyError;
  return row;
}

void bindReduced(py::module_& module) {
  py::class_<ReducedSubstructure>(
      module, "ReducedPart",
      "A reduced part, D = offset + basis q with q = (interface, retained, modes).")
      .def_readonly("name", &ReducedSubstructure::name, "Name of the part.")
      .def_property_readonly(
          "model",
          [](const ReducedSubstructure& part) {
            return std::make_shared<model::SecondOrderModel>(part.model);
          },
          "The reduced model.")
      .def_readonly("interface", &ReducedSubstructure::interface,
                    "Number of interface coordinates, which come first and may be joined.")
      .def_readonly("retained", &ReducedSubstructure::retained,
                    "Number of retained dofs, which follow the interface.")
      .def_readonly("modes", &ReducedSubstructure::modes,
                    "Number of modal coordinates, which come last.")
      .def_property_readonly(
          "basis", [](const ReducedSubstructure& part) { return toScipy(part.basis->vectors); },
          "Phi, dofs of the part x coordinates.")
      .def_property_readonly(
          "offset", [](const ReducedSubstructure& part) { return part.offset; },
          "D at q = 0, dofs of the part [m].")
      .def_property_readonly(
          "frequencies_hz",
          [](const ReducedSubstructure& part) {
            const Vector& values = part.basis->eigenvalues;
            return Vector(values.array().sign() * values.array().abs().sqrt() / constants::twoPi);
          },
          "Frequencies of the kept modes [Hz]; negative if omega^2 is negative.")
      .def_property_readonly(
          "method", [](const ReducedSubstructure& part) { return part.basis->method; },
          "How the modes were computed.")
      .def_property_readonly(
          "remarks", [](const ReducedSubstructure& part) { return part.report.remarks; },
          "Remarks on the basis for the user.")
      .def(
          "table", [](const ReducedSubstructure& part, bool all) { return part.report.table(all); },
          py::arg("all") = false,
          "Every vector: kind, name, frequency, whether it is kept, reason.")
      .def("__len__", &ReducedSubstructure::size)
      .def("__repr__", [](const ReducedSubstructure& part) {
        return "<ReducedPart \"" + part.name + "\": " + std::to_string(part.size()) +
               " coordinates, " + std::to_string(part.modes) + " of them modes>";
      });
}

void bindSynthesis(py::module_& module) {
  py::class_<Synthesised, std::shared_ptr<Synthesised>>(module, "Synthesis",
                                                        "Reduced parts and their coupled model.")
      .def_readonly("model", &Synthesised::model, "The coupled reduced model.")
      .def_property_readonly(
          "parts", [](const Synthesised& s) { return s.outcome.synthesis.parts; },
          "The reduced parts.")
      .def_property_readonly(
          "unreduced",
          [](const Synthesised& s) {
            Parts parts;
            for (const auto& part : s.unreduced.parts)
              parts.push_back(std::make_shared<model::Substructure>(part));
            return parts;
          },
          "The parts before their reduction.")
      .def(
          "map",
          [](const Synthesised& s, int part) {
            const auto& maps = s.outcome.synthesis.coupled.maps;
            if (part < 0 || part >= static_cast<int>(maps.size()))
              throw UsageError("There is no part " + std::to_string(part) + " among " +
                               std::to_string(maps.size()) + ".");
            return toScipy(maps[at(part)]);
          },
          py::arg("part"), "Coordinates of a part x coordinates of the coupled model.")
      .def_property_readonly(
          "rounds",
          [](const Synthesised& s) {
            py::list rows;
            for (const auto& round : s.outcome.rounds) rows.append(roundOf(round));
            return rows;
          },
          "Rounds of the selection of modes by a tolerance: modes and frequency_error.")
      .def_property_readonly(
          "remarks", [](const Synthesised& s) { return s.outcome.synthesis.coupled.remarks; },
          "Remarks of the coupling: redundant constraints, for example.")
      .def("__repr__", [](const Synthesised& s) {
        return "<Synthesis of " + std::to_string(s.outcome.synthesis.parts.size()) + " parts, " +
               std::to_string(s.model->size()) + " dofs>";
      });
}

}  // namespace

void bindReduction(py::module_& module) {
  bindReduced(module);
  bindSynthesis(module);
  py::class_<coupling::CouplingOptions>(
      module, "Connections", "Connections of the parts of a deck in addition to equal labels.");
  module.def("reduce", &reduce, py::arg("parts"), py::arg("reduction"),
             "Reduce parts separately with the settings of the list Reduction.");
  module.def("couple", &couple, py::arg("parts"), py::arg("coupling") = py::none(),
             "Couple unreduced parts: the full model.");
  module.def("couple_reduced", &coupleReduced, py::arg("parts"), "Couple reduced parts.");
  module.def("synthesise", &synthesise, py::arg("parts"), py::arg("reduction"),
             py::arg("coupling") = py::none(), "Reduce, couple and estimate.");
}

}  // namespace tooljoint::python
