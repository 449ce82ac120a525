// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Spellings of Trilinos 13.2 that newer versions have changed, and the set of template arguments
/// for which this build of Trilinos was instantiated (double / int / long long / Serial). A port to
/// another Trilinos edits this file.
#pragma once

#include <Teuchos_DefaultSerialComm.hpp>
#include <Teuchos_RCP.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Operator.hpp>
#include <Tpetra_Vector.hpp>

namespace tooljoint::linalg::tpetra {

using Map = Tpetra::Map<>;
using LocalOrdinal = Map::local_ordinal_type;
using GlobalOrdinal = Map::global_ordinal_type;
using Node = Map::node_type;
using Operator = Tpetra::Operator<double, LocalOrdinal, GlobalOrdinal, Node>;
using CrsMatrix = Tpetra::CrsMatrix<double, LocalOrdinal, GlobalOrdinal, Node>;
using MultiVector = Tpetra::MultiVector<double, LocalOrdinal, GlobalOrdinal, Node>;
using Vector = Tpetra::Vector<double, LocalOrdinal, GlobalOrdinal, Node>;

/// Host access to a multivector; the view must be destroyed before any other access to the data.
inline auto readHost(const MultiVector& x) { return x.getLocalViewHost(Tpetra::Access::ReadOnly); }
inline auto overwriteHost(MultiVector& x) {
  return x.getLocalViewHost(Tpetra::Access::OverwriteAll);
}

}  // namespace tooljoint::linalg::tpetra
