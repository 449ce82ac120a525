// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A NonlinearProblem as a Thyra model evaluator on rank-local Tpetra vectors. Included only by
/// NewtonSolver.cpp.
#pragma once

#include <Thyra_DefaultPreconditioner.hpp>
#include <Thyra_StateFuncModelEvaluatorBase.hpp>
#include <Thyra_TpetraThyraWrappers.hpp>
#include <cmath>
#include <exception>
#include <memory>
#include <optional>
#include <utility>

#include "common/Error.hpp"
#include "linalg/trilinos/DirectSolver.hpp"
#include "linalg/trilinos/FunctionOperator.hpp"
#include "model/NonlinearProblem.hpp"
#include "statics/DividedProblem.hpp"
#include "statics/NewtonMemory.hpp"

namespace tooljoint::statics {

namespace tpetra = linalg::tpetra;
using Extraction = Thyra::TpetraOperatorVectorExtraction<double, tpetra::LocalOrdinal,
                                                         tpetra::GlobalOrdinal, tpetra::Node>;

inline Vector toEigenVector(const Teuchos::RCP<const Thyra::VectorBase<double>>& x) {
  return linalg::toEigen(*Extraction::getConstTpetraVector(x)).col(0);
}

inline void fromEigenVector(const Vector& from, const Teuchos::RCP<Thyra::VectorBase<double>>& to) {
  const auto target = Extraction::getTpetraVector(to);
  const auto host = tpetra::overwriteHost(*target);
  for (Eigen::Index i = 0; i < from.size(); ++i) host(static_cast<std::size_t>(i), 0) = from[i];
}

/// F(x) = S r(x) with S the residual scale of the problem, W = S dr/dx, and a factor of W. If the
/// problem is divided, each rank holds its own rows of W and its part of the factor.
class ThyraProblem : public Thyra::StateFuncModelEvaluatorBase<double> {
 public:
  /// \param residual  at the start
  ThyraProblem(const model::NonlinearProblem& problem, const Vector& start, Vector residual,
               NewtonMemory& memory)
      : problem_(problem),
        divided_(dynamic_cast<const DividedProblem*>(&problem)),
        memory_(memory),
        scale_(problem.residualScale()),
        map_(linalg::serialMap(problem.size())),
        residualAt_(start),
        residual_(std::move(residual)) {
    using MEB = Thyra::ModelEvaluatorBase;
    space_ = Thyra::createVectorSpace<double>(map_);
    evaluateJacobian(start);
    pattern_ = jacobian_;
    jacobianAt_ = start;
    MEB::InArgsSetup<double> in;
    in.setModelEvalDescription(this->description());
    in.setSupports(MEB::IN_ARG_x);
    prototypeIn_ = in;
    MEB::OutArgsSetup<double> out;
    out.setModelEvalDescription(this->description());
    out.setSupports(MEB::OUT_ARG_f);
    out.setSupports(MEB::OUT_ARG_W_op);
    out.setSupports(MEB::OUT_ARG_W_prec);
    prototypeOut_ = out;
    const auto x = Thyra::createMember(space_);
    fromEigenVector(start, x);
    nominal_ = in;
    nominal_.set_x(x);
  }

  Teuchos::RCP<const Thyra::VectorSpaceBase<double>> get_x_space() const override { return space_; }
  Teuchos::RCP<const Thyra::VectorSpaceBase<double>> get_f_space() const override { return space_; }
  Thyra::ModelEvaluatorBase::InArgs<double> getNominalValues() const override { return nominal_; }
  Thyra::ModelEvaluatorBase::InArgs<double> createInArgs() const override { return prototypeIn_; }

  Teuchos::RCP<Thyra::LinearOpBase<double>> create_W_op() const override {
    Teuchos::RCP<tpetra::Operator> matrix;
    if (divided_ != nullptr)
      matrix = Teuchos::rcp(new linalg::FunctionOperator(map_, [this](const Matrix& x) {
        return isWhole_ ? Matrix(jacobian_ * x) : memory_.chain->multiply(jacobian_, x);
      }));
    else
      matrix = linalg::toTpetra(jacobian_, map_);
    return Thyra::tpetraLinearOp<double>(space_, space_, matrix);
  }

  /// W^-1.
  Teuchos::RCP<Thyra::PreconditionerBase<double>> create_W_prec() const override {
    const Teuchos::RCP<tpetra::Operator> inverse =
        Teuchos::rcp(new linalg::FunctionOperator(map_, [this](const Matrix& b) {
          return !isWhole_ ? memory_.chain->solve(b) : memory_.factors->apply(b);
        }));
    const Teuchos::RCP<const Thyra::LinearOpBase<double>> op =
        Thyra::tpetraLinearOp<double>(space_, space_, inverse);
    const auto preconditioner = Teuchos::rcp(new Thyra::DefaultPreconditioner<double>());
    preconditioner->initializeUnspecified(op);
    return preconditioner;
  }

  /// r(x).
  const Vector& residual(const Vector& x) const {
    if (residualAt_ != x) {
      residual_.resize(x.size());
      guarded([&] { problem_.residual(x, residual_); });
      residualAt_ = x;
    }
    return residual_;
  }
  int factorisations() const { return factorisations_; }
  /// The error of the problem while NOX was running, if any.
  std::exception_ptr problemError() const { return problemError_; }

 private:
  Thyra::ModelEvaluatorBase::OutArgs<double> createOutArgsImpl() const override {
    return prototypeOut_;
  }

  void evalModelImpl(const Thyra::ModelEvaluatorBase::InArgs<double>& in,
                     const Thyra::ModelEvaluatorBase::OutArgs<double>& out) const override {
    const Vector x = toEigenVector(in.get_x());
    if (out.get_f().get() != nullptr)
      fromEigenVector(scale_.cwiseProduct(residual(x)), out.get_f());  // F = S r
    if (!out.get_W_op().is_null()) updateJacobian(x);
    if (!out.get_W_op().is_null() && divided_ == nullptr) {
      const auto op = Teuchos::rcp_dynamic_cast<
          Thyra::TpetraLinearOp<double, tpetra::LocalOrdinal, tpetra::GlobalOrdinal, tpetra::Node>>(
          out.get_W_op(), true);
      linalg::replaceValues(
          *Teuchos::rcp_dynamic_cast<tpetra::CrsMatrix>(op->getTpetraOperator(), true), jacobian_);
    }
    if (!out.get_W_prec().is_null()) updateFactors(x);
  }

  void updateJacobian(const Vector& x) const {
    if (jacobianAt_ && *jacobianAt_ == x) return;
    evaluateJacobian(x);
    if (!linalg::samePattern(pattern_, jacobian_))
      throw std::logic_error("The pattern of the Jacobian changed between two evaluations.");
    jacobianAt_ = x;
  }

  /// Evaluates W; for a divided problem the rows of this rank and those around.
  void evaluateJacobian(const Vector& x) const {
    guarded([&] {
      if (divided_ != nullptr)
        divided_->jacobianRows(x, jacobian_);
      else
        problem_.jacobian(x, jacobian_);
    });
    jacobian_.makeCompressed();
    isWhole_ = divided_ == nullptr;
    const RowRange rows = isWhole_ ? RowRange{0, problem_.size()} : divided_->share().around();
    for (int row = rows.begin; row < rows.end; ++row)
      for (Sparse::InnerIterator it(jacobian_, row); it; ++it) it.valueRef() *= scale_[row];
  }

  void updateFactors(const Vector& x) const {
    updateJacobian(x);
    if (!isWhole_ && !updateSharedFactors()) {
      divided_->share().gatherRows(jacobian_);
      isWhole_ = true;
    }
    if (isWhole_) updateWholeFactors();
    ++factorisations_;
  }

  void updateWholeFactors() const {
    memory_.name = [this](int i) { return problem_.unknownName(i); };
    if (looked_)
      memory_.factors->refactorUnchecked(jacobian_);
    else if (memory_.factors)
      memory_.factors->refactor(jacobian_);
    else
      memory_.factors = std::make_unique<linalg::DirectSolver>(
          jacobian_, [&memory = memory_](int i) { return memory.name(i); });
    looked_ = true;
  }

  /// False on all ranks if pivots between nodes are needed, or if W looks singular; the factors of
  /// the whole W then decide.
  bool updateSharedFactors() const {
    auto& chain = memory_.chain;
    const bool isKnown =
        chain && (factorisations_ > 0 || (linalg::samePattern(memory_.pattern, jacobian_) &&
                                          chain->share().first() == divided_->share().first()));
    if (!isKnown) {
      chain = std::make_unique<linalg::DividedChain>(divided_->sharedShare(), jacobian_);
      memory_.pattern = jacobian_;
    }
    if (!chain->suits() || !chain->factor(jacobian_)) return false;
    return factorisations_ > 0 ||
           chain->resistance(jacobian_) > linalg::DirectSolverOptions().singularTolerance;
  }

  /// Keeps exceptions of the problem, so that the driver can distinguish them from NOX's own.
  template <class Work>
  void guarded(Work&& work) const {
    try {
      work();
    } catch (...) {
      problemError_ = std::current_exception();
      throw;
    }
  }

  const model::NonlinearProblem& problem_;
  const DividedProblem* divided_;  ///< null: not divided
  NewtonMemory& memory_;
  Vector scale_;
  Teuchos::RCP<const tpetra::Map> map_;
  Teuchos::RCP<const Thyra::VectorSpaceBase<double>> space_;
  Thyra::ModelEvaluatorBase::InArgs<double> prototypeIn_, nominal_;
  Thyra::ModelEvaluatorBase::OutArgs<double> prototypeOut_;
  mutable Sparse jacobian_;
  Sparse pattern_;  ///< the Jacobian at the start
  mutable std::optional<Vector> jacobianAt_;
  mutable bool isWhole_ = false;  ///< every rank has all rows of W
  mutable bool looked_ = false;   ///< the whole W was factored in this solve
  mutable Vector residualAt_, residual_;
  mutable int factorisations_ = 0;
  mutable std::exception_ptr problemError_;
};

}  // namespace tooljoint::statics
