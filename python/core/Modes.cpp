// SPDX-License-Identifier: BSD-3-Clause
// Modes of models, their comparison by shape, and estimates of their errors.
#include <pybind11/complex.h>
#include <pybind11/stl.h>

#include "Arrays.hpp"
#include "Bind.hpp"
#include "Calls.hpp"
#include "Synthesis.hpp"
#include "common/Error.hpp"
#include "coupling/CoupledModes.hpp"
#include "estimate/DynamicError.hpp"
#include "estimate/FrequencyEstimate.hpp"
#include "estimate/ModeComparison.hpp"

namespace tooljoint::python {

namespace {

py::tuple undamped(const ModelPointer& model, int count) {
  auto pairs = longCall([&] { return coupling::lowestPhysicalModes(*model, count); });
  return py::make_tuple(std::move(pairs.values), std::move(pairs.vectors),
                        std::move(pairs.residuals));
}

py::tuple damped(const ModelPointer& model, int count, double t) {
  auto modes = longCall([&] {
    const auto m = estimate::linearise(*model, t);
    return estimate::physicalDampedModes(*model, m, count, {});
  });
  return py::make_tuple(std::move(modes.values), std::move(modes.vectors),
                        std::move(modes.residuals));
}

Matrix assurance(const py::object& mass, const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b) {
  const Sparse M = toSparse(mass, "mass matrix");
  if (M.rows() != a.rows() || M.rows() != b.rows())
    throw ModelError("The mass matrix has " + std::to_string(M.rows()) + " rows, the shapes have " +
                     std::to_string(a.rows()) + " and " + std::to_string(b.rows()) + ".");
  return estimate::modalAssurance(M, a, b);
}

py::dict rowOf(const estimate::ModeComparison& mode, bool damped) {
  py::dict row;
  const auto ofCoupled = [&](auto number) {
    return mode.coupledMode < 0 ? py::object(py::none()) : py::cast(number);
  };
  row["coupled_mode"] = ofCoupled(mode.coupledMode);
  row["full_hz"] = mode.fullHz();
  row["coupled_hz"] = ofCoupled(mode.coupledHz());
  if (damped) {
    row["full_damping"] = mode.fullDamping();
    row["coupled_damping"] = ofCoupled(mode.coupledDamping());
  }
  row["mac"] = ofCoupled(mode.mac);
  row["error"] = ofCoupled(mode.error);
  row["estimate"] = mode.estimated ? py::object(py::float_(mode.estimate)) : py::none();
  return row;
}

/// \param t time of damped modes; none: undamped ones
py::list compare(const Synthesised& synthesis, int count, const std::optional<double>& t,
                 const ModelPointer& whole) {
  const auto modes = longCall([&] {
    coupling::Coupling full;
    if (whole)
      full.model = *whole;
    else
      full = coupling::coupleWithPositions(synthesis.unreduced.parts, synthesis.unreduced.options);
    const auto& reduced = synthesis.outcome.synthesis;
    return t ? estimate::compareDampedModes(full.model, synthesis.unreduced.parts, reduced, count,
                                            *t, full.maps)
             : estimate::compareModes(full.model, synthesis.unreduced.parts, reduced, count,
                                      full.maps);
  });
  py::list rows;
  for (const auto& mode : modes) rows.append(rowOf(mode, t.has_value()));
  return rows;
}

py::list estimates(const Synthesised& synthesis, int count) {
  const auto found = longCall([&] {
    return estimate::estimateFrequencies(synthesis.unreduced.parts, synthesis.outcome.synthesis,
                                         {count, 0.0});
  });
  py::list rows;
  for (const auto& one : found) {
    py::dict row;
    row["frequency_hz"] = one.frequency();
    row["error"] = one.error;
    row["by_part"] = one.byPart;
    row["definite"] = one.definite;
    rows.append(row);
  }
  return rows;
}

}  // namespace

void bindModes(py::module_& module) {
  module.def("undamped_modes", &undamped, py::arg("model"), py::arg("count"),
             "omega^2, shapes (dofs x modes) and residuals of the lowest undamped modes.");
  module.def("damped_modes", &damped, py::arg("model"), py::arg("count"), py::arg("t"),
             "s, shapes (dofs x modes) and residuals of the damped modes of smallest |s|.");
  module.def("modal_assurance", &assurance, py::arg("mass"), py::arg("a"), py::arg("b"),
             "M-weighted modal assurance criterion, columns of a x columns of b.");
  module.def("compare_modes", &compare, py::arg("synthesis"), py::arg("count"),
             py::arg("t") = py::none(), py::arg("full") = py::none(),
             "Modes of the full model, each with the coupled mode of the same shape.");
  module.def("estimate_frequencies", &estimates, py::arg("synthesis"), py::arg("count"),
             "Estimated errors of the lowest coupled frequencies, without the full model.");
}

}  // namespace tooljoint::python
