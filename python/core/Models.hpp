// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Models and parts in Python: shared, so that every reference keeps them alive.
#pragma once

#include <memory>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

#include "model/Substructure.hpp"

namespace tooljoint::python {

namespace py = pybind11;

using ModelPointer = std::shared_ptr<model::SecondOrderModel>;
using PartPointer = std::shared_ptr<model::Substructure>;

/// The parts as values; their data are shared.
std::vector<model::Substructure> valuesOf(const std::vector<PartPointer>& parts);

/// The law f(t) `function`, a Python callable. ModelError if it is not callable.
model::ScalarLaw lawOfTime(const std::string& name, const py::object& function);

}  // namespace tooljoint::python
