// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Line search and step test for NOX. Included only by NewtonSolver.cpp.
#pragma once

#include <NOX_Abstract_Group.H>
#include <NOX_Abstract_Vector.H>
#include <NOX_LineSearch_Generic.H>
#include <NOX_LineSearch_UserDefinedFactory.H>
#include <NOX_Solver_Generic.H>
#include <NOX_StatusTest_Generic.H>
#include <NOX_Thyra_Vector.H>
#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <string>
#include <utility>

#include "model/NonlinearProblem.hpp"
#include "statics/NewtonSolver.hpp"
#include "statics/ThyraProblem.hpp"

namespace tooljoint::statics {

/// s is accepted if |F(x + s dx)| <= (1 - armijo s) |F(x)|, F the scaled residual, or, for the
/// critical point, if |r(x + s dx)' dx| <= workLeft |r(x)' dx| (at the step limit also if r(x + s
/// dx)' dx is negative).
constexpr double armijo = 1e-4, workLeft = 0.5;
/// Limit of halvings of one step, or of cuts of its bracket; then the best one tried is taken.
constexpr int maxHalvings = 16;
/// Limit of consecutive searches without a decrease before the solver gives up.
constexpr int maxFailedSearches = 4;
/// Absolute part of the step test, for solutions near zero.
constexpr double updateFloor = 1e-14;

/// Record of the line search, shared with the step test and the report.
struct SearchRecord {
  double step = 1.0;  ///< s of the last step x + s dx
  int halvings = 0;
  int failuresInARow = 0;
  double linearResidual = 0.0;
};

inline Vector vectorOf(const NOX::Abstract::Vector& x) {
  return toEigenVector(dynamic_cast<const NOX::Thyra::Vector&>(x).getThyraRCPVector());
}

/// Applies the step limit of the problem, then backtracking on the scaled residual from that limit,
/// or the critical point below it.
class StepSearch : public NOX::LineSearch::Generic {
 public:
  StepSearch(const model::NonlinearProblem& problem, const NewtonOptions& options,
             SearchRecord& record)
      : problem_(problem), options_(options), record_(record), scale_(problem.residualScale()) {}

  bool compute(NOX::Abstract::Group& group, double& step, const NOX::Abstract::Vector& direction,
               const NOX::Solver::Generic& solver) override {
    const NOX::Abstract::Group& old = solver.getPreviousSolutionGroup();
    recordLinearResidual(group, direction);
    const Vector x = vectorOf(old.getX()), dx = vectorOf(direction);
    const Line line{group, x, dx};
    step = limit(x, dx);
    bool found = true;
    if (options_.lineSearch == NewtonOptions::Backtracking)
      found = backtrack(line, old.getNormF(), step);
    else if (options_.lineSearch == NewtonOptions::CriticalPoint)
      found = criticalPoint(line, vectorOf(old.getF()), step);
    else
      found = evaluate(line, step);
    if (found) record_.step = step;
    return found;
  }

 private:
  /// Data for steps of any length.
  struct Line {
    NOX::Abstract::Group& group;
    const Vector& x;
    const Vector& dx;
  };

  double limit(const Vector& x, const Vector& dx) const {
    return x.allFinite() && dx.allFinite() ? problem_.stepLimit(x, dx) : 1.0;
  }

  /// Evaluates F at the end of the step s; the group holds the result.
  bool evaluate(const Line& line, double s) const {
    const auto there = line.group.getX().clone(NOX::ShapeCopy);
    fromEigenVector(problem_.moved(line.x, line.dx, s),
                    dynamic_cast<NOX::Thyra::Vector&>(*there).getThyraRCPVector());
    line.group.setX(*there);
    return line.group.computeF() == NOX::Abstract::Group::Ok;
  }

  bool backtrack(const Line& line, double before, double& step) {
    double bestStep = 0.0, best = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= maxHalvings; ++k) {
      if (!evaluate(line, step)) return false;
      const double after = line.group.getNormF();
      // Armijo, or already within the tolerance (where rounding decides about a decrease)
      if (std::isfinite(after) && (after <= (1.0 - armijo * step) * before || solved(line.group))) {
        record_.failuresInARow = 0;
        return true;
      }
      if (after < best) {
        best = after;
        bestStep = step;
      }
      step *= 0.5;
      ++record_.halvings;
    }
    // No decrease: take the best step tried, a few times, because the next direction may be better.
    ++record_.failuresInARow;
    const bool hopeless = bestStep == 0.0 || record_.failuresInARow >= maxFailedSearches;
    step = hopeless ? 0.0 : bestStep;
    return evaluate(line, step) && !hopeless;
  }

  /// From the step limit, unless work is still done there, to the zero of g(s) = r(x + s dx)' dx,
  /// by regula falsi that cuts at least a tenth off its bracket (Brune, Knepley, Smith and Tu
  /// 2015). A direction that is no descent direction is taken in full.
  bool criticalPoint(const Line& line, const Vector& start, double& step) {
    const Vector unscaled = line.dx.cwiseQuotient(scale_);  // F = S r
    const double before = start.dot(unscaled), enough = workLeft * std::abs(before);
    double low = 0.0, lowWork = before, high = step, highWork = 0.0;
    for (int k = 0;; ++k) {
      if (!evaluate(line, step)) return false;
      const double there = vectorOf(line.group.getF()).dot(unscaled);
      const bool finite = std::isfinite(there);
      const double work = finite ? there : -before;
      if (finite &&
          (before >= 0.0 || (k == 0 ? work : std::abs(work)) <= enough || solved(line.group)))
        return true;
      if (k == maxHalvings) break;
      (work > 0.0 ? high : low) = step;
      (work > 0.0 ? highWork : lowWork) = work;
      const double cut = low - lowWork * (high - low) / (highWork - lowWork),
                   edge = 0.1 * (high - low);
      step = std::clamp(cut, low + edge, high - edge);
      ++record_.halvings;
    }
    step = low > 0.0 ? low : step;  // the force jumps there: stay below it
    return evaluate(line, step);
  }

  bool solved(const NOX::Abstract::Group& group) const {
    return group.getF().norm(NOX::Abstract::Vector::MaxNorm) <= options_.tolerance;
  }

  /// |J dx + F| / |F| with the Jacobian itself, independent of the linear solver's own result.
  void recordLinearResidual(const NOX::Abstract::Group& start,
                            const NOX::Abstract::Vector& direction) {
    const auto residual = direction.clone(NOX::ShapeCopy);
    if (!start.isJacobian() ||
        start.applyJacobian(direction, *residual) != NOX::Abstract::Group::Ok)
      return;
    residual->update(1.0, start.getF(), 1.0);
    const double size = start.getNormF();
    if (size > 0.0)
      record_.linearResidual = std::max(record_.linearResidual, residual->norm() / size);
  }

  const model::NonlinearProblem& problem_;
  const NewtonOptions& options_;
  SearchRecord& record_;
  const Vector scale_;
};

class StepSearchFactory : public NOX::LineSearch::UserDefinedFactory {
 public:
  explicit StepSearchFactory(Teuchos::RCP<NOX::LineSearch::Generic> search)
      : search_(std::move(search)) {}
  Teuchos::RCP<NOX::LineSearch::Generic> buildLineSearch(const Teuchos::RCP<NOX::GlobalData>&,
                                                         Teuchos::ParameterList&) const override {
    return search_;
  }

 private:
  Teuchos::RCP<NOX::LineSearch::Generic> search_;
};

/// Converged if the last full Newton step is small, |dx| <= tolerance |x| + floor, or if nothing is
/// left to solve.
class SmallStep : public NOX::StatusTest::Generic {
 public:
  SmallStep(const NewtonOptions& options, const SearchRecord& record)
      : options_(options), record_(record) {}

  NOX::StatusTest::StatusType checkStatus(const NOX::Solver::Generic& solver,
                                          NOX::StatusTest::CheckType) override {
    const NOX::Abstract::Group& now = solver.getSolutionGroup();
    if (solver.getNumIterations() == 0) {
      status_ = now.getNormF() == 0.0 ? NOX::StatusTest::Converged : NOX::StatusTest::Unconverged;
      return status_;
    }
    const auto change = now.getX().clone(NOX::DeepCopy);
    change->update(-1.0, solver.getPreviousSolutionGroup().getX(), 1.0);
    const double dx = change->norm() / record_.step, size = now.getX().norm();
    update_ = size > 0.0 ? dx / size : (dx > 0.0 ? std::numeric_limits<double>::infinity() : 0.0);
    const bool small = dx <= options_.updateTolerance * size + updateFloor;
    status_ = small ? NOX::StatusTest::Converged : NOX::StatusTest::Unconverged;
    return status_;
  }
  NOX::StatusTest::StatusType getStatus() const override { return status_; }
  std::ostream& print(std::ostream& stream, int indent) const override {
    return stream << std::string(static_cast<std::size_t>(indent), ' ')
                  << "relative Newton step = " << update_ << '\n';
  }
  double update() const { return update_; }

 private:
  const NewtonOptions& options_;
  const SearchRecord& record_;
  double update_ = 0.0;
  NOX::StatusTest::StatusType status_ = NOX::StatusTest::Unevaluated;
};

}  // namespace tooljoint::statics
