// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The module tooljoint._core: a function for each of its files, which adds its classes and
/// functions.
#pragma once

#include <pybind11/pybind11.h>

namespace tooljoint::python {

namespace py = pybind11;

void bindErrors(py::module_& module);
void bindLists(py::module_& module);
void bindModels(py::module_& module);
void bindPartFiles(py::module_& module);
void bindReduction(py::module_& module);
void bindModes(py::module_& module);
void bindLaws(py::module_& module);
void bindTransient(py::module_& module);
void bindBases(py::module_& module);
void bindDecks(py::module_& module);
void bindResults(py::module_& module);

}  // namespace tooljoint::python
