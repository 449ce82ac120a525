// SPDX-License-Identifier: BSD-3-Clause
// results.h5 as arrays.
#include <memory>
#include <pybind11/stl.h>
#include <string>
#include <utility>
#include <vector>

#include "Arrays.hpp"
#include "Bind.hpp"
#include "common/Error.hpp"
#include "io/ResultsReader.hpp"

namespace tooljoint::python {

namespace {

using io::ResultsReader;

py::object values(const ResultsReader& file, const std::string& path) {
  const auto extents = file.shape(path);
  const std::vector<py::ssize_t> shape(extents.begin(), extents.end());
  switch (file.kind(path)) {
    case ResultsReader::Kind::Text:
      return py::module_::import("numpy")
          .attr("array")(file.texts(path), py::arg("dtype") = "object")
          .attr("reshape")(shape);
    case ResultsReader::Kind::Integer:
      return toNumpy(file.integers(path), shape);
    default:
      return toNumpy(file.numbers(path), shape);
  }
}

std::string attribute(const ResultsReader& file, const std::string& object, const char* name) {
  return file.hasAttribute(object, name) ? file.textAttribute(object, name) : "";
}

}  // namespace

void bindResults(py::module_& module) {
  py::class_<ResultsReader>(module, "ResultsFile", "A file results.h5.")
      .def(py::init<const std::string&>(), py::arg("path"))
      .def("datasets", &ResultsReader::datasets, "Paths of all datasets.")
      .def("has", &ResultsReader::has, py::arg("path"), "Whether a dataset or group exists.")
      .def("read", &values, py::arg("path"), "All values of a dataset. FileError.")
      .def(
          "unit",
          [](const ResultsReader& f, const std::string& p) { return attribute(f, p, "units"); },
          py::arg("path"), "SI unit of a dataset; empty without a unit.")
      .def(
          "long_name",
          [](const ResultsReader& f, const std::string& p) { return attribute(f, p, "long_name"); },
          py::arg("path"), "Description of a dataset in words.");
}

}  // namespace tooljoint::python
