// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Matrices and vectors between Eigen, numpy and scipy. Dense results are moved into their numpy
/// array; sparse ones are shared with it.
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <string>
#include <utility>
#include <vector>

#include "common/Types.hpp"
#include "model/SharedSparse.hpp"

namespace tooljoint::python {

namespace py = pybind11;

/// A scipy.sparse.csr_matrix; the type appears in the signatures.
class CsrMatrix : public py::object {
 public:
  PYBIND11_OBJECT_DEFAULT(CsrMatrix, object, isObject)
  static bool isObject(PyObject*) { return true; }
};

/// Anything numpy accepts as numbers; ArrayLike in the signatures.
class Numbers : public py::object {
 public:
  PYBIND11_OBJECT_DEFAULT(Numbers, object, isObject)
  static bool isObject(PyObject*) { return true; }
};

/// A copy of `size` numbers, one for each dof. ModelError, naming `what`, for anything else.
Vector toVector(const Numbers& values, Eigen::Index size, const std::string& what);

/// scipy.sparse.csr_matrix of the storage of `matrix`, without a copy. Read-only: models share it.
CsrMatrix toScipy(const model::SharedSparse& matrix);

/// A copy of any scipy.sparse matrix or dense array of two dimensions. ModelError, naming `what`,
/// for anything else. Entries given twice are added.
Sparse toSparse(const py::object& matrix, const std::string& what);

/// A numpy array that takes ownership of the values, row-major.
template <class T>
py::array toNumpy(std::vector<T> values, std::vector<py::ssize_t> shape) {
  auto* owned = new std::vector<T>(std::move(values));
  const py::capsule owner(owned, [](void* data) { delete static_cast<std::vector<T>*>(data); });
  return py::array_t<T>(std::move(shape), owned->data(), owner);
}
template <class T>
py::array toNumpy(std::vector<T> values) {
  const auto size = static_cast<py::ssize_t>(values.size());
  return toNumpy(std::move(values), {size});
}

/// ModelError if the function named by `who` returned complex numbers.
void requireReal(const py::object& values, const std::string& who);

/// Takes the values of `array` as rows x columns. ModelError, naming `who`, when it has another
/// shape.
void copyInto(const py::object& array, py::ssize_t rows, py::ssize_t columns, double* to,
              const std::string& who);

}  // namespace tooljoint::python

template <>
struct pybind11::detail::handle_type_name<tooljoint::python::CsrMatrix> {
  static constexpr auto name = const_name("scipy.sparse.csr_matrix");
};
template <>
struct pybind11::detail::handle_type_name<tooljoint::python::Numbers> {
  static constexpr auto name = const_name("numpy.ndarray");
};
