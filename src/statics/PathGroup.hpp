// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A ParametricProblem as a group of LOCA on rank-local vectors. Included only by
/// PathContinuation.cpp.
#pragma once

#include <LOCA_MultiContinuation_AbstractGroup.H>
#include <LOCA_Parameter_Vector.H>
#include <NOX_LAPACK_Vector.H>
#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/Error.hpp"
#include "linalg/trilinos/DirectSolver.hpp"
#include "model/ParametricProblem.hpp"

namespace tooljoint::statics {

inline Vector toEigenVector(const NOX::Abstract::Vector& from) {
  const auto& x = dynamic_cast<const NOX::LAPACK::Vector&>(from);
  Vector to(static_cast<Eigen::Index>(x.length()));
  for (int i = 0; i < static_cast<int>(to.size()); ++i) to[i] = x(i);
  return to;
}

inline void fromEigenVector(const Vector& from, NOX::Abstract::Vector& to) {
  auto& x = dynamic_cast<NOX::LAPACK::Vector&>(to);
  for (int i = 0; i < static_cast<int>(from.size()); ++i) x(i) = from[i];
}

/// Data shared by all copies of a group.
struct PathContext {
  const model::ParametricProblem& problem;
  Vector scale;              ///< of the residual
  Vector weights;            ///< of the length of the path
  double parameterScale;     ///< LOCA's parameter is p divided by this
  std::exception_ptr error;  ///< exception of the problem, if any
  /// Takes a converged point of the path.
  std::function<void(double parameter, const Vector& x)> accept;
};

/// Keeps exceptions of the problem, so that the driver can distinguish them from LOCA's own.
template <class Work>
void guarded(PathContext& context, Work&& work) {
  try {
    work();
  } catch (...) {
    context.error = std::current_exception();
    throw;
  }
}

/// F(x, q) = S r(x, p_0 q) with S the residual scale and p_0 the parameter scale.
class PathGroup : public LOCA::MultiContinuation::AbstractGroup {
  using Group = NOX::Abstract::Group;

 public:
  static constexpr const char* parameterName = "load";

  PathGroup(std::shared_ptr<PathContext> context, const Vector& start, double parameter)
      : context_(std::move(context)),
        x_(static_cast<int>(start.size())),
        f_(x_, NOX::ShapeCopy),
        newton_(x_, NOX::ShapeCopy) {
    fromEigenVector(start, x_);
    parameters_.addParameter(parameterName, parameter / context_->parameterScale);
  }

  Group& operator=(const Group& source) override {
    copy(source);
    return *this;
  }
  void copy(const Group& source) override {
    const auto& other = dynamic_cast<const PathGroup&>(source);
    context_ = other.context_;
    x_ = other.x_, f_ = other.f_, newton_ = other.newton_;
    parameters_ = other.parameters_;
    jacobian_ = other.jacobian_, factors_ = other.factors_;
    isF_ = other.isF_, isNewton_ = other.isNewton_;
  }
  Teuchos::RCP<Group> clone(NOX::CopyType type) const override {
    const auto made = Teuchos::rcp(new PathGroup(*this));
    if (type == NOX::ShapeCopy) made->invalidate();
    return made;
  }

  void setX(const NOX::Abstract::Vector& y) override {
    x_ = y;
    invalidate();
  }
  void computeX(const Group& from, const NOX::Abstract::Vector& d, double step) override {
    x_.update(1.0, from.getX(), step, d, 0.0);
    invalidate();
  }

  void setParamsMulti(const std::vector<int>& ids,
                      const NOX::Abstract::MultiVector::DenseMatrix& values) override {
    for (std::size_t i = 0; i < ids.size(); ++i) setParam(ids[i], values(static_cast<int>(i), 0));
  }
  void setParams(const LOCA::ParameterVector& p) override {
    parameters_ = p;
    invalidate();
  }
  void setParam(int id, double value) override {
    parameters_.setValue(static_cast<unsigned>(id), value);
    invalidate();
  }
  void setParam(std::string name, double value) override {
    parameters_.setValue(name, value);
    invalidate();
  }
  const LOCA::ParameterVector& getParams() const override { return parameters_; }
  double getParam(int id) const override { return parameters_.getValue(static_cast<unsigned>(id)); }
  double getParam(std::string name) const override { return parameters_.getValue(name); }

  ReturnType computeF() override {
    if (isF_) return Ok;
    Vector r;
    guarded(*context_, [&] { context_->problem.residual(toEigenVector(x_), parameter(), r); });
    fromEigenVector(context_->scale.cwiseProduct(r), f_);  // F = S r
    isF_ = true;
    return Ok;
  }

  ReturnType computeJacobian() override {
    if (factors_) return Ok;
    const auto matrix = std::make_shared<Sparse>();
    guarded(*context_,
            [&] { context_->problem.jacobian(toEigenVector(x_), parameter(), *matrix); });
    matrix->makeCompressed();
    for (int row = 0; row < matrix->rows(); ++row)
      for (Sparse::InnerIterator it(*matrix, row); it; ++it)
        it.valueRef() *= context_->scale[row];  // dF/dx = S J
    linalg::DirectSolverOptions options;
    options.checkSingular = false;  // turning points and bifurcations are on the path
    try {
      factors_ = std::make_shared<const linalg::DirectSolver>(
          *matrix, [this](int i) { return context_->problem.unknownName(i); }, options);
    } catch (const ModelError&) {
      return NotConverged;  // the step is repeated with half the length
    }
    jacobian_ = matrix;
    return Ok;
  }

  /// The first column of `dfdp` is F, the second dF/dq = p_0 S dr/dp.
  ReturnType computeDfDpMulti(const std::vector<int>& ids, NOX::Abstract::MultiVector& dfdp,
                              bool isValidF) override {
    if (!isValidF) {
      const auto status = computeF();
      if (status != Ok) return status;
      dfdp[0] = f_;
    }
    Vector derivative;
    guarded(*context_, [&] {
      context_->problem.parameterDerivative(toEigenVector(x_), parameter(), derivative);
    });
    for (std::size_t i = 0; i < ids.size(); ++i)
      fromEigenVector(context_->parameterScale * context_->scale.cwiseProduct(derivative),
                      dfdp[static_cast<int>(i) + 1]);
    return Ok;
  }

  ReturnType computeNewton(Teuchos::ParameterList& list) override {
    if (isNewton_) return Ok;
    if (!isF_ || !factors_) return BadDependency;
    const auto status = applyJacobianInverse(list, f_, newton_);
    newton_.scale(-1.0);
    isNewton_ = status == Ok;
    return status;
  }

  ReturnType applyJacobian(const NOX::Abstract::Vector& input,
                           NOX::Abstract::Vector& result) const override {
    if (!factors_) return BadDependency;
    fromEigenVector(*jacobian_ * toEigenVector(input), result);
    return Ok;
  }

  ReturnType applyJacobianInverse(Teuchos::ParameterList&, const NOX::Abstract::Vector& input,
                                  NOX::Abstract::Vector& result) const override {
    if (!factors_) return BadDependency;
    try {
      fromEigenVector(factors_->solve(toEigenVector(input)), result);
    } catch (const ModelError&) {
      return NotConverged;
    }
    return Ok;
  }

  bool isF() const override { return isF_; }
  bool isJacobian() const override { return factors_ != nullptr; }
  bool isNewton() const override { return isNewton_; }
  const NOX::Abstract::Vector& getX() const override { return x_; }
  const NOX::Abstract::Vector& getF() const override { return f_; }
  double getNormF() const override { return f_.norm(); }
  const NOX::Abstract::Vector& getNewton() const override { return newton_; }
  const NOX::Abstract::Vector& getGradient() const override {
    throw Error(ExitCode::Internal, "A path has no gradient.");
  }
  Teuchos::RCP<const NOX::Abstract::Vector> getXPtr() const override {
    return Teuchos::rcpFromRef(x_);
  }
  Teuchos::RCP<const NOX::Abstract::Vector> getFPtr() const override {
    return Teuchos::rcpFromRef(f_);
  }
  Teuchos::RCP<const NOX::Abstract::Vector> getNewtonPtr() const override {
    return Teuchos::rcpFromRef(newton_);
  }
  Teuchos::RCP<const NOX::Abstract::Vector> getGradientPtr() const override {
    return Teuchos::rcpFromRef(getGradient());
  }

  /// sum_i a_i x_i y_i.
  double computeScaledDotProduct(const NOX::Abstract::Vector& x,
                                 const NOX::Abstract::Vector& y) const override {
    return toEigenVector(x).cwiseProduct(context_->weights).dot(toEigenVector(y));
  }
  /// sqrt(a_i) x_i: LOCA applies it twice to the tangent.
  void scaleVector(NOX::Abstract::Vector& x) const override {
    fromEigenVector(toEigenVector(x).cwiseProduct(context_->weights.cwiseSqrt()), x);
  }

  /// LOCA calls it for every point of the path.
  void printSolution(double) const override { context_->accept(parameter(), toEigenVector(x_)); }
  using AbstractGroup::printSolution;

  /// p.
  double parameter() const { return parameters_.getValue(0U) * context_->parameterScale; }

  std::optional<int> negativePivots() const {
    std::optional<int> found;
    guarded(*context_,
            [&] { found = context_->problem.negativePivots(toEigenVector(x_), parameter()); });
    return found;
  }

  /// Whether the parameter grows along the path from another point of it: with t = (-J^-1 dF/dq,
  /// 1), t'(x - x_0, q - q_0) > 0. Empty if J is singular.
  std::optional<bool> parameterGrows(const PathGroup& from) {
    Teuchos::ParameterList none;
    NOX::LAPACK::Vector slope(x_, NOX::ShapeCopy);
    Vector derivative;
    guarded(*context_, [&] {
      context_->problem.parameterDerivative(toEigenVector(x_), parameter(), derivative);
    });
    NOX::LAPACK::Vector load(x_, NOX::ShapeCopy);
    fromEigenVector(-context_->parameterScale * context_->scale.cwiseProduct(derivative), load);
    if (computeJacobian() != Ok || applyJacobianInverse(none, load, slope) != Ok) return {};
    const Vector moved = toEigenVector(x_) - toEigenVector(from.x_);
    return toEigenVector(slope).cwiseProduct(context_->weights).dot(moved) +
               parameters_.getValue(0U) - from.parameters_.getValue(0U) >
           0.0;
  }

 private:
  void invalidate() {
    isF_ = isNewton_ = false;
    jacobian_.reset();
    factors_.reset();
  }

  std::shared_ptr<PathContext> context_;
  NOX::LAPACK::Vector x_, f_, newton_;
  LOCA::ParameterVector parameters_;
  std::shared_ptr<const Sparse> jacobian_;
  std::shared_ptr<const linalg::DirectSolver> factors_;
  bool isF_ = false, isNewton_ = false;
};

}  // namespace tooljoint::statics
