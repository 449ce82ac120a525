// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A NonlinearProblem as a Thyra model evaluator on rank-local Tpetra vectors. Included by
/// NewtonSolver.cpp only.
#pragma once

#include <Thyra_DefaultPreconditioner.hpp>
#include <Thyra_StateFuncModelEvaluatorBase.hpp>
#include <Thyra_TpetraThyraWrappers.hpp>
#include <cmath>
#include <exception>
#include <memory>
#include <optional>

#include "common/Error.hpp"
#include "linalg/trilinos/DirectSolver.hpp"
#include "linalg/trilinos/FunctionOperator.hpp"
#include "model/NonlinearProblem.hpp"

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

/// F(x) = S r(x) with S the residual scale of the problem, W = S dr/dx, and a factor of W.
class ThyraProblem : public Thyra::StateFuncModelEvaluatorBase<double> {
 public:
  ThyraProblem(const model::NonlinearProblem& problem, const Vector& start)
      : problem_(problem),
        scale_(problem.residualScale()),
        map_(linalg::serialMap(problem.size())) {
    using MEB = Thyra::ModelEvaluatorBase;
    space_ = Thyra::createVectorSpace<double>(map_);
    problem_.jacobian(start, jacobian_);
    scaleJacobian();
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
    const Teuchos::RCP<tpetra::Operator> matrix = linalg::toTpetra(jacobian_, map_);
    return Thyra::tpetraLinearOp<double>(space_, space_, matrix);
  }

  /// W^-1.
  Teuchos::RCP<Thyra::PreconditionerBase<double>> create_W_prec() const override {
    const Teuchos::RCP<tpetra::Operator> inverse = Teuchos::rcp(
        new linalg::FunctionOperator(map_, [this](const Matrix& b) { return factors_->apply(b); }));
    const Teuchos::RCP<const Thyra::LinearOpBase<double>> op =
        Thyra::tpetraLinearOp<double>(space_, space_, inverse);
    const auto preconditioner = Teuchos::rcp(new Thyra::DefaultPreconditioner<double>());
    preconditioner->initializeUnspecified(op);
    return preconditioner;
  }

  const Vector& scale() const { return scale_; }
  int factorisations() const { return factorisations_; }
  /// The error the problem threw while NOX was running, if any.
  std::exception_ptr problemError() const { return problemError_; }

 private:
  Thyra::ModelEvaluatorBase::OutArgs<double> createOutArgsImpl() const override {
    return prototypeOut_;
  }

  void evalModelImpl(const Thyra::ModelEvaluatorBase::InArgs<double>& in,
                     const Thyra::ModelEvaluatorBase::OutArgs<double>& out) const override {
    const Vector x = toEigenVector(in.get_x());
    if (out.get_f().get() != nullptr) {
      Vector r(x.size());
      guarded([&] { problem_.residual(x, r); });
      fromEigenVector(scale_.cwiseProduct(r), out.get_f());  // F = S r
    }
    if (!out.get_W_op().is_null()) {
      updateJacobian(x);
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
    guarded([&] { problem_.jacobian(x, jacobian_); });
    scaleJacobian();
    if (!linalg::samePattern(pattern_, jacobian_))
      throw std::logic_error("The pattern of the Jacobian changed between two evaluations.");
    jacobianAt_ = x;
  }

  void updateFactors(const Vector& x) const {
    updateJacobian(x);
    if (factors_)
      factors_->refactorUnchecked(jacobian_);
    else
      factors_ = std::make_unique<linalg::DirectSolver>(
          jacobian_, [this](int i) { return problem_.unknownName(i); });
    ++factorisations_;
  }

  void scaleJacobian() const {
    jacobian_.makeCompressed();
    for (int row = 0; row < jacobian_.rows(); ++row)
      for (Sparse::InnerIterator it(jacobian_, row); it; ++it) it.valueRef() *= scale_[row];
  }

  /// Keeps what the problem throws, so that the driver can tell it from NOX's own exceptions.
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
  Vector scale_;
  Teuchos::RCP<const tpetra::Map> map_;
  Teuchos::RCP<const Thyra::VectorSpaceBase<double>> space_;
  Thyra::ModelEvaluatorBase::InArgs<double> prototypeIn_, nominal_;
  Thyra::ModelEvaluatorBase::OutArgs<double> prototypeOut_;
  mutable Sparse jacobian_;
  Sparse pattern_;  ///< the Jacobian at the start
  mutable std::optional<Vector> jacobianAt_;
  mutable std::unique_ptr<linalg::DirectSolver> factors_;
  mutable int factorisations_ = 0;
  mutable std::exception_ptr problemError_;
};

}  // namespace tooljoint::statics
