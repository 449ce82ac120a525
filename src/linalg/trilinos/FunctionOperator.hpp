// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Any function of columns as a rank-local Tpetra operator, for Anasazi, Belos and Thyra. Included
/// only by solver sources.
#pragma once

#include <functional>
#include <stdexcept>
#include <utility>

#include "linalg/trilinos/TpetraConversion.hpp"

namespace tooljoint::linalg {

/// Y = f(X) on rank-local multivectors.
class FunctionOperator : public tpetra::Operator {
 public:
  using Function = std::function<Matrix(const Matrix&)>;
  FunctionOperator(Teuchos::RCP<const tpetra::Map> map, Function f)
      : map_(std::move(map)), f_(std::move(f)) {}

  Teuchos::RCP<const tpetra::Map> getDomainMap() const override { return map_; }
  Teuchos::RCP<const tpetra::Map> getRangeMap() const override { return map_; }
  void apply(const tpetra::MultiVector& X, tpetra::MultiVector& Y, Teuchos::ETransp mode,
             double alpha, double beta) const override {
    if (mode != Teuchos::NO_TRANS || alpha != 1.0 || beta != 0.0)
      throw std::logic_error("FunctionOperator: only Y = f(X).");
    onViews(X, Y, [this](const ConstMatrixView& x, MatrixView& y) { y = f_(x); });
  }

 private:
  Teuchos::RCP<const tpetra::Map> map_;
  Function f_;
};

}  // namespace tooljoint::linalg
