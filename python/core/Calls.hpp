// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Long calls from Python into the toolkit, and calls of the toolkit back into Python.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <pybind11/pybind11.h>
#include <string>
#include <type_traits>

#include "common/Error.hpp"
#include "common/Interrupt.hpp"

namespace tooljoint::python {

namespace py = pybind11;

/// A call from Python into the toolkit, which begins without warnings. During its lifetime SIGINT
/// and SIGTERM set the flag of the toolkit, which long work checks, and not the one of Python. May
/// be nested.
class CallScope {
 public:
  CallScope();
  ~CallScope();
  CallScope(const CallScope&) = delete;
  CallScope& operator=(const CallScope&) = delete;
};

/// Held by the running call; recursive, because a Python function may call the toolkit again in the
/// same thread.
std::recursive_mutex& turn();

/// Runs work() without the GIL, one call at a time: the toolkit and MPI serve one thread, calls
/// from others wait. InterruptedError if a signal arrived in the meantime.
template <class Work>
auto longCall(const Work& work) {
  const CallScope call;
  const auto ended = [] {
    if (interruptRequested()) throw InterruptedError("The call was interrupted.");
  };
  const py::gil_scoped_release release;
  const std::lock_guard<std::recursive_mutex> alone(turn());
  if constexpr (std::is_void_v<decltype(work())>) {
    work();
    ended();
  } else {
    auto result = work();
    ended();
    return result;
  }
}

/// Runs work() with the GIL and converts a Python exception into one of the toolkit: an exception
/// of the toolkit into the original one, KeyboardInterrupt into InterruptedError, any other into
/// ModelError. `who` begins the message: `The basis "A"`. The final Python exception has the first
/// one as its cause.
void fromPython(const std::string& who, const std::function<void()>& work);

/// A Python object held by the toolkit that may safely outlive the interpreter. Copies need no GIL.
class Kept {
 public:
  explicit Kept(py::object object);
  py::handle operator*() const { return *object_; }

 private:
  std::shared_ptr<py::object> object_;
};

}  // namespace tooljoint::python
