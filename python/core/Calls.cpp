// SPDX-License-Identifier: BSD-3-Clause
#include "Calls.hpp"

#include <csignal>
#include <map>
#include <utility>

#include "Bind.hpp"
#include "common/Parallel.hpp"
#include "common/report/Log.hpp"

namespace tooljoint::python {

namespace {

// Changed with the GIL only.
int depth = 0;  ///< of calls, nested ones and those of other threads
/// Handlers before the first call, of the signals handled by the toolkit.
std::map<int, struct sigaction> handlers{{SIGINT, {}}, {SIGTERM, {}}, {SIGXFSZ, {}}};

/// The Python exception that caused the current error of the toolkit; null: none.
py::object& cause() {
  static auto* kept = new py::object;
  return *kept;
}

py::object errorType(ExitCode code) {
  const auto errors = py::module_::import("tooljoint.errors");
  switch (code) {
    case ExitCode::Usage:
      return errors.attr("UsageError");
    case ExitCode::InvalidDeck:
      return errors.attr("DeckError");
    case ExitCode::ModelNotBuilt:
      return errors.attr("ModelError");
    case ExitCode::NotConverged:
      return errors.attr("ConvergenceError");
    case ExitCode::Files:
      return errors.attr("FileError");
    case ExitCode::Interrupted:
      return py::reinterpret_borrow<py::object>(PyExc_KeyboardInterrupt);
    default:
      return errors.attr("Error");
  }
}

/// Sets the exception of Python that belongs to an error of the toolkit.
void raise(const Error& error) {
  const py::object made = errorType(error.code())(error.what());
  if (const auto from = std::exchange(cause(), py::object())) made.attr("__cause__") = from;
  PyErr_SetObject(py::type::of(made).ptr(), made.ptr());
}

/// The exit code of an exception of Python that came from the toolkit, and of KeyboardInterrupt;
/// ModelNotBuilt of any other.
ExitCode codeOf(const py::object& exception) {
  if (PyErr_GivenExceptionMatches(exception.ptr(), PyExc_KeyboardInterrupt) != 0)
    return ExitCode::Interrupted;
  const auto own = py::module_::import("tooljoint.errors").attr("Error");
  if (py::isinstance(exception, own))
    return static_cast<ExitCode>(exception.attr("code").cast<int>());
  return ExitCode::ModelNotBuilt;
}

}  // namespace

std::recursive_mutex& turn() {
  static std::recursive_mutex one;
  return one;
}

CallScope::CallScope() {
  if (depth++ > 0) return;
  for (auto& [number, before] : handlers) sigaction(number, nullptr, &before);
  cause() = py::object();
  log::clearWarnings();
  requestInterrupt(false);
  installInterruptHandlers();
}

CallScope::~CallScope() {
  if (--depth > 0) return;
  for (const auto& [number, before] : handlers) sigaction(number, &before, nullptr);
  requestInterrupt(false);
}

void fromPython(const std::string& who, const std::function<void()>& work) {
  const py::gil_scoped_acquire gil;
  try {
    work();
  } catch (py::error_already_set& error) {
    const py::object exception = error.value();
    if (error.trace()) exception.attr("__traceback__") = error.trace();
    const auto code = codeOf(exception);
    const std::string text = py::str(exception);
    const std::string type = py::str(py::type::of(exception).attr("__name__"));
    cause() = exception;
    const bool own =
        code != ExitCode::ModelNotBuilt ||
        py::isinstance(exception, py::module_::import("tooljoint.errors").attr("Error"));
    parallel::throwError(
        code, own ? text : who + " raised " + type + (text.empty() ? "" : ": " + text) + ".");
  } catch (const py::cast_error&) {
    parallel::throwError(ExitCode::ModelNotBuilt,
                         who + " returned something else than the real numbers that are expected.");
  }
}

Kept::Kept(py::object object)
    : object_(new py::object(std::move(object)), [](py::object* held) {
        if (Py_IsInitialized() == 0) return;  // the process frees the memory
        const py::gil_scoped_acquire gil;
        delete held;
      }) {}

void bindErrors(py::module_&) {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& error) {
      raise(error);
    }
  });
}

}  // namespace tooljoint::python
