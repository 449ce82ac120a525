// SPDX-License-Identifier: BSD-3-Clause
// tooljoint._core: MPI and Kokkos are initialised at the import and finalised at the end of the
// interpreter.
#include <Kokkos_Core.hpp>
#include <Tpetra_Core.hpp>
#include <memory>
#include <mpi.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "Bind.hpp"
#include "common/Parallel.hpp"
#include "common/Version.hpp"
#include "common/ranks/QuickStart.hpp"
#include "common/report/Log.hpp"

namespace tooljoint::python {

namespace {

/// Initialised at the import; MPI initialised by another package (mpi4py) is finalised by that
/// package.
std::unique_ptr<Tpetra::ScopeGuard> session;

void begin() {
  if (Kokkos::is_initialized()) return;
  const parallel::QuickStart quick;
  int none = 0;
  char* end = nullptr;
  char** nothing = &end;
  session = std::make_unique<Tpetra::ScopeGuard>(&none, &nothing);
}

/// Ends all ranks: after an error on one rank the others must not wait for it.
[[noreturn]] void abortAll(int code) {
  MPI_Abort(MPI_COMM_WORLD, code);
  std::abort();
}

}  // namespace

}  // namespace tooljoint::python

PYBIND11_MODULE(_core, module) {
  namespace own = tooljoint::python;
  namespace py = pybind11;
  module.doc() = "The library behind the package tooljoint.";
  own::begin();
  py::module_::import("atexit").attr("register")(py::cpp_function([] { own::session.reset(); }));
  tooljoint::log::setQuiet(true);
  own::bindErrors(module);
  own::bindLists(module);
  own::bindLaws(module);
  own::bindModels(module);
  own::bindPartFiles(module);
  own::bindReduction(module);
  own::bindModes(module);
  own::bindTransient(module);
  own::bindBases(module);
  own::bindDecks(module);
  own::bindResults(module);
  module.def("rank", &tooljoint::parallel::rank, "Number of this rank, from 0.");
  module.def("ranks", &tooljoint::parallel::size, "Number of ranks.");
  module.def("abort", &own::abortAll, py::arg("code"), "End all ranks with this exit code.");
  module.def("warnings", &tooljoint::log::warnings, "Warnings of the last long call on this rank.");
  module.def("version", &tooljoint::programVersion, "Version of the library.");
}
