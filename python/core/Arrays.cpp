// SPDX-License-Identifier: BSD-3-Clause
#include "Arrays.hpp"

#include <algorithm>
#include <limits>

#include "common/Error.hpp"

namespace tooljoint::python {

namespace {

py::module_ scipySparse() { return py::module_::import("scipy.sparse"); }

/// A read-only array that keeps `owner` alive.
template <class T>
py::array shared(const T* values, Eigen::Index size, const py::capsule& owner) {
  py::array_t<T> array(size, values, owner);
  array.attr("setflags")(py::arg("write") = false);
  return std::move(array);
}

/// "3 x 2"; "one number" for a scalar.
std::string shapeOf(const py::array& array) {
  std::string text;
  for (py::ssize_t i = 0; i < array.ndim(); ++i)
    text += (i == 0 ? "" : " x ") + std::to_string(array.shape(i));
  return text.empty() ? "one number" : text;
}

void refuseMasked(const py::object& values, const std::string& what) {
  if (py::module_::import("numpy").attr("ma").attr("is_masked")(values).cast<bool>())
    throw ModelError(what +
                     " has masked entries. Give every entry a number: filled(0.0), for one.");
}

}  // namespace

Vector toVector(const Numbers& values, Eigen::Index size, const std::string& what) {
  refuseMasked(values, what);
  using Values = py::array_t<double, py::array::c_style | py::array::forcecast>;
  const auto given = py::array::ensure(values);
  const bool isReal = given && given.dtype().kind() != 'c';
  const auto numbers = isReal ? Values::ensure(given) : Values();
  if (!isReal || !numbers) {
    PyErr_Clear();
    throw ModelError(what + " is no vector of real numbers.");
  }
  const bool flat = numbers.ndim() < 2 || (numbers.ndim() == 2 && numbers.shape(1) == 1);
  if (!flat || numbers.size() != size)
    throw ModelError(what + " is an array of " + shapeOf(numbers) + "; expected are " +
                     std::to_string(size) + " entries, one for each dof of the model.");
  return Eigen::Map<const Vector>(numbers.data(), size);
}

CsrMatrix toScipy(const model::SharedSparse& matrix) {
  auto* kept = new model::SharedSparse(matrix);
  const py::capsule owner(kept, [](void* data) { delete static_cast<model::SharedSparse*>(data); });
  const py::tuple arrays = py::make_tuple(shared(kept->valuePtr(), kept->nonZeros(), owner),
                                          shared(kept->innerIndexPtr(), kept->nonZeros(), owner),
                                          shared(kept->outerIndexPtr(), kept->rows() + 1, owner));
  return scipySparse().attr("csr_matrix")(
      arrays, py::arg("shape") = py::make_tuple(kept->rows(), kept->cols()));
}

Sparse toSparse(const py::object& matrix, const std::string& what) {
  refuseMasked(matrix, "The " + what);
  py::object csr;
  try {
    // the arrays of a matrix may have changed since it was made; the reading code does not check
    // them
    if (py::hasattr(matrix, "check_format")) matrix.attr("check_format")(true);
    csr = scipySparse().attr("csr_matrix")(matrix);
    if (csr.attr("dtype").attr("kind").cast<std::string>() == "c")
      throw ModelError("The " + what +
                       " is complex. Give real matrices: damping stands in one of its own.");
    csr = csr.attr("astype")("float64", py::arg("copy") = false);
  } catch (const py::error_already_set& error) {
    throw ModelError("The " + what +
                     " is no matrix of real numbers: " + std::string(py::str(error.value())) +
                     ". Give a scipy.sparse matrix or a numpy array of two dimensions.");
  }
  if (!csr.attr("has_canonical_format").cast<bool>()) {
    csr = csr.attr("copy")();
    csr.attr("sum_duplicates")();
  }
  if (csr.attr("nnz").cast<double>() > std::numeric_limits<int>::max())
    throw ModelError("The " + what + " has more than 2^31 entries.");
  using Indices = py::array_t<int, py::array::c_style | py::array::forcecast>;
  using Values = py::array_t<double, py::array::c_style | py::array::forcecast>;
  const Values values(csr.attr("data"));
  const Indices inner(csr.attr("indices")), outer(csr.attr("indptr"));
  const py::tuple shape = csr.attr("shape");
  return Eigen::Map<const Sparse>(shape[0].cast<int>(), shape[1].cast<int>(), values.size(),
                                  outer.data(), inner.data(), values.data());
}

void requireReal(const py::object& values, const std::string& who) {
  if (py::module_::import("numpy").attr("iscomplexobj")(values).cast<bool>())
    throw ModelError(who + " returned complex numbers. Give real ones.");
}

void copyInto(const py::object& array, py::ssize_t rows, py::ssize_t columns, double* to,
              const std::string& who) {
  using Values = py::array_t<double, py::array::c_style | py::array::forcecast>;
  requireReal(array, who);
  const auto values = Values::ensure(array);
  if (!values) {
    PyErr_Clear();
    throw ModelError(who + " did not return numbers.");
  }
  const bool flat =
      values.ndim() == 1 && (columns == 1 || rows == 1) && values.size() == rows * columns;
  const bool fits = values.ndim() == 2 && values.shape(0) == rows && values.shape(1) == columns;
  if (!flat && !fits) {
    throw ModelError(who + " returned an array of " + shapeOf(values) + "; expected are " +
                     std::to_string(rows) + " x " + std::to_string(columns) + ".");
  }
  std::copy_n(values.data(), values.size(), to);
}

}  // namespace tooljoint::python
