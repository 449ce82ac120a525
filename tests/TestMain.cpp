// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// GoogleTest main for one or several ranks: the exit code is the worst of all ranks.
#include <gtest/gtest.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Core.hpp>

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  Tpetra::ScopeGuard scope(&argc, &argv);
  const auto comm = Tpetra::getDefaultComm();
  const int local = RUN_ALL_TESTS();
  int global = 0;
  Teuchos::reduceAll(*comm, Teuchos::REDUCE_MAX, 1, &local, &global);
  return global;
}
