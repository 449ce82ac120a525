// SPDX-License-Identifier: BSD-3-Clause
#include "statics/NewtonSolver.hpp"

#include <NOX_SolverStats.hpp>
#include <NOX_Solver_Factory.H>
#include <NOX_StatusTest_Combo.H>
#include <NOX_StatusTest_FiniteValue.H>
#include <NOX_StatusTest_MaxIters.H>
#include <NOX_StatusTest_NormF.H>
#include <NOX_Thyra_Group.H>
#include <NOX_Utils.H>
#include <Teuchos_ParameterList.hpp>
#include <Teuchos_oblackholestream.hpp>
#include <Thyra_BelosLinearOpWithSolveFactory.hpp>
#include <algorithm>
#include <limits>

#include "common/Error.hpp"
#include "linalg/Scientific.hpp"
#include "statics/NewtonMemory.hpp"
#include "statics/StepSearch.hpp"
#include "statics/ThyraProblem.hpp"

namespace tooljoint::statics {

namespace {

using linalg::scientific;

constexpr double linearTolerance = 1e-10;  ///< of the preconditioned linear residual
/// GMRES steps with an exact factor of the Jacobian as preconditioner: only rounding is left to
/// iterate on, and many steps gain no more than a few.
constexpr int linearIterations = 8;
/// Largest scaled residual at which a solution limited by rounding is accepted.
constexpr double mostRounding = 1e-6;

/// Belos behind Thyra, with the parameters set here, overridden by those of the deck.
Teuchos::RCP<Thyra::BelosLinearOpWithSolveFactory<double>> belosFactory(
    int n, const Teuchos::ParameterList* belos) {
  const auto list = Teuchos::parameterList("Belos");
  list->set("Solver Type", "Block GMRES");
  Teuchos::ParameterList& gmres = list->sublist("Solver Types").sublist("Block GMRES");
  gmres.set("Convergence Tolerance", linearTolerance);
  gmres.set("Maximum Iterations", linearIterations);
  gmres.set("Num Blocks", std::max(1, std::min(n, linearIterations)));
  gmres.set("Verbosity", 0);
  list->sublist("VerboseObject").set("Verbosity Level", "none");
  if (belos != nullptr) list->setParameters(*belos);
  // With the preconditioner on the left the size of the step decides, independent of the units of
  // the rows; not every method of Belos supports that.
  const char* side = "Left Preconditioner If Unspecified";
  const bool known = list->isType<std::string>("Solver Type");
  const std::string method = known ? list->get<std::string>("Solver Type") : "";
  if (!list->isParameter(side))
    list->set(side, method == "Block GMRES" || method == "Pseudo Block GMRES" ||
                        method == "Block CG" || method == "Pseudo Block CG");
  const auto factory = Teuchos::rcp(new Thyra::BelosLinearOpWithSolveFactory<double>());
  try {
    factory->setParameterList(list);
  } catch (const std::exception& refused) {
    throw ModelError(std::string("Belos refuses its parameters: ") + refused.what());
  }
  factory->setVerbLevel(Teuchos::VERB_NONE);
  return factory;
}

Teuchos::RCP<Teuchos::ParameterList> noxParameters(
    const Teuchos::RCP<NOX::LineSearch::Generic>& search, const Teuchos::ParameterList* nox) {
  const auto list = Teuchos::parameterList("NOX");
  list->set("Nonlinear Solver", "Line Search Based");
  Teuchos::ParameterList& newton = list->sublist("Direction").sublist("Newton");
  list->sublist("Direction").set("Method", "Newton");
  newton.set("Forcing Term Method", "Constant");
  newton.set("Rescue Bad Newton Solve",
             true);  // an inexact direction still descends; the search tests it
  newton.sublist("Linear Solver").set("Tolerance", linearTolerance);
  Teuchos::ParameterList& lineSearch = list->sublist("Line Search");
  lineSearch.set("Method", "User Defined");
  const Teuchos::RCP<NOX::LineSearch::UserDefinedFactory> factory =
      Teuchos::rcp(new StepSearchFactory(search));
  lineSearch.set("User Defined Line Search Factory", factory);
  Teuchos::ParameterList& printing = list->sublist("Printing");
  const Teuchos::RCP<std::ostream> nowhere = Teuchos::rcp(new Teuchos::oblackholestream());
  printing.set("Output Information", static_cast<int>(NOX::Utils::Error));
  printing.set("Output Stream", nowhere);
  printing.set("Error Stream", nowhere);
  if (nox != nullptr) {
    if (nox->isSublist("Printing")) {  // output is wanted if the printing is set
      printing.remove("Output Stream", false);
      printing.remove("Error Stream", false);
    }
    list->setParameters(*nox);
  }
  return list;
}

double scaledResidual(const Vector& r, const Vector& scale, int* worst) {
  const Vector scaled = scale.cwiseProduct(r).cwiseAbs();
  for (Eigen::Index i = 0; i < scaled.size(); ++i)
    if (!std::isfinite(scaled[i])) {
      *worst = static_cast<int>(i);
      return std::numeric_limits<double>::quiet_NaN();
    }
  Eigen::Index position = 0;
  const double largest = scaled.size() == 0 ? 0.0 : scaled.maxCoeff(&position);
  *worst = static_cast<int>(position);
  return largest;
}

/// Rounding error of the scaled residual: some roundings, of the unknowns and of the operations, 4
/// epsilon max_i scale_i sum_j |J_ij x_j|.
double roundingOf(const model::NonlinearProblem& problem, const Vector& scale, const Vector& x) {
  Sparse jacobian;
  problem.jacobian(x, jacobian);
  const Vector sums = jacobian.cwiseAbs() * x.cwiseAbs();
  return 4.0 * std::numeric_limits<double>::epsilon() * scale.cwiseProduct(sums).maxCoeff();
}

/// Whether the last iterations have not halved the residual.
bool stagnates(const std::vector<double>& history) {
  constexpr std::size_t iterations = 6;
  return history.size() > iterations &&
         history.back() > 0.5 * history[history.size() - 1 - iterations];
}

/// One NOX solve, with all objects that must live as long.
class Newton {
 public:
  Newton(const model::NonlinearProblem& problem, const Vector& start, const Vector& residual,
         const NewtonOptions& options, const Teuchos::ParameterList* nox,
         const Teuchos::ParameterList* belos, NewtonMemory& memory)
      : problem_(problem),
        options_(options),
        model_(Teuchos::rcp(new ThyraProblem(problem, start, residual, memory))),
        smallStep_(Teuchos::rcp(new SmallStep(options, record_))) {
    using namespace NOX::StatusTest;
    const Teuchos::RCP<const Thyra::ModelEvaluator<double>> model = model_;
    const Teuchos::RCP<const Thyra::LinearOpWithSolveFactoryBase<double>> solves =
        belosFactory(problem.size(), belos);
    const Teuchos::RCP<Thyra::PreconditionerFactoryBase<double>>
        noFactory;  // the model itself updates W_prec
    const auto group = Teuchos::rcp(
        new NOX::Thyra::Group(NOX::Thyra::Vector(*model_->getNominalValues().get_x()), model,
                              model_->create_W_op(), solves, model_->create_W_prec(), noFactory));
    const auto smallResidual =
        Teuchos::rcp(new NormF(options.tolerance, NOX::Abstract::Vector::MaxNorm, NormF::Unscaled));
    const auto solved = Teuchos::rcp(new Combo(Combo::AND, smallResidual, smallStep_));
    const auto tests = Teuchos::rcp(new Combo(Combo::OR));
    tests->addStatusTest(Teuchos::rcp(new FiniteValue()));
    tests->addStatusTest(solved);
    tests->addStatusTest(Teuchos::rcp(new MaxIters(options.maxIterations)));
    const auto search = Teuchos::rcp(new StepSearch(problem, options, record_));
    try {
      solver_ = NOX::Solver::buildSolver(group, tests, noxParameters(search, nox));
    } catch (const std::exception& refused) {
      throw ModelError(std::string("NOX refuses its parameters: ") + refused.what());
    } catch (const char* refused) {  // NOX throws character strings
      throw ModelError(std::string("NOX refuses its parameters: ") + refused);
    }
  }

  void run(NewtonReport& report) {
    report.history.push_back(residual());
    NOX::StatusTest::StatusType status = NOX::StatusTest::Unconverged;
    while (status == NOX::StatusTest::Unconverged) {
      const int before = solver_->getNumIterations();
      status = solver_->step();
      if (solver_->getNumIterations() > before) report.history.push_back(residual());
      if (status != NOX::StatusTest::Converged && isAtRounding(report, status)) break;
    }
    report.converged = status == NOX::StatusTest::Converged || report.rounding > 0;
  }

  Vector solution() const { return vectorOf(solver_->getSolutionGroup().getX()); }
  const ThyraProblem& model() const { return *model_; }
  const SearchRecord& record() const { return record_; }

  void account(NewtonReport& report) const {
    report.iterations = solver_->getNumIterations();
    report.update = smallStep_->update();
    report.factorisations = model_->factorisations();
    report.linearIterations =
        solver_->getSolverStatistics()->linearSolve.lastNonlinearSolve_NumLinearIterations;
    report.halvings = record_.halvings;
    report.linearResidual = record_.linearResidual;
  }

 private:
  /// Whether more iterations would not reduce the residual and rounding explains it; then it is
  /// solved.
  bool isAtRounding(NewtonReport& report, NOX::StatusTest::StatusType status) const {
    if (status != NOX::StatusTest::Failed && !stagnates(report.history)) return false;
    const double rounding =
        std::min(mostRounding, roundingOf(problem_, problem_.residualScale(), solution()));
    if (!(report.history.back() <= rounding)) return false;
    report.rounding = rounding;
    return true;
  }

  double residual() const {
    const NOX::Abstract::Group& group = solver_->getSolutionGroup();
    if (!group.isF()) const_cast<NOX::Abstract::Group&>(group).computeF();
    const Vector F = vectorOf(group.getF());
    return F.allFinite() ? F.cwiseAbs().maxCoeff() : std::numeric_limits<double>::quiet_NaN();
  }

  const model::NonlinearProblem& problem_;
  const NewtonOptions& options_;
  SearchRecord record_;
  Teuchos::RCP<ThyraProblem> model_;
  Teuchos::RCP<SmallStep> smallStep_;
  Teuchos::RCP<NOX::Solver::Generic> solver_;
};

std::string explain(const NewtonReport& report, const NewtonOptions& options,
                    const SearchRecord& record, const std::string& worst) {
  const std::string state =
      "the scaled residual is " + scientific(report.residual) + " (largest at " + worst +
      "; tolerance " + scientific(options.tolerance) + "), the last relative step " +
      scientific(report.update) + " (tolerance " + scientific(options.updateTolerance) + ")";
  if (!std::isfinite(report.residual))
    return "the residual is not finite at " + worst + " after " +
           std::to_string(report.iterations) + " iterations.";
  if (record.failuresInARow >= maxFailedSearches)
    return "no step along the Newton direction reduces the residual any more after " +
           std::to_string(report.iterations) + " iterations: " + state + ".";
  std::string text =
      std::to_string(report.iterations) + " Newton iterations were not enough: " + state + ".";
  if (report.linearResidual > 0.1)
    text += " Some linear systems were badly solved (relative residual " +
            scientific(report.linearResidual) + ").";
  return text;
}

/// A sentence if double precision does not allow the tolerance, else empty.
std::string explainRounding(const model::NonlinearProblem& problem, const Vector& scale,
                            const Vector& x, const NewtonOptions& options) {
  if (!x.allFinite()) return "";
  const double rounding = roundingOf(problem, scale, x);
  if (!(rounding > options.tolerance)) return "";
  return " Rounding to double precision may leave " + scientific(rounding) +
         ": set no smaller tolerance.";
}

}  // namespace

NewtonOptions::LineSearch lineSearch(model::LineSearch asked) {
  switch (asked) {
    case model::LineSearch::None:
      return NewtonOptions::LimitedStep;
    case model::LineSearch::Work:
      return NewtonOptions::CriticalPoint;
    default:
      return NewtonOptions::Backtracking;
  }
}

NewtonReport solve(const model::NonlinearProblem& problem, Vector& x, const NewtonOptions& options,
                   const Teuchos::ParameterList* nox, const Teuchos::ParameterList* belos,
                   NewtonMemory* memory) {
  if (x.size() != problem.size())
    throw ModelError("A starting point of " + std::to_string(x.size()) +
                     " unknowns was given to a nonlinear problem of " +
                     std::to_string(problem.size()) + ".");
  NewtonReport report;
  const Vector scale = problem.residualScale();
  int worst = 0;
  Vector r(x.size());
  problem.residual(x, r);
  report.residual = scaledResidual(r, scale, &worst);
  if (problem.size() == 0) {
    report.converged = true;
    report.message = "converged: no unknowns to solve for.";
    return report;
  }
  if (!std::isfinite(report.residual)) {
    report.history.push_back(report.residual);
    report.message =
        "the residual is not finite at " + problem.unknownName(worst) + " at the starting point.";
    return report;
  }
  NewtonMemory own;
  Newton newton(problem, x, r, options, nox, belos, memory != nullptr ? *memory : own);
  std::string stopped;
  try {
    newton.run(report);
  } catch (const std::exception& error) {
    if (newton.model().problemError()) std::rethrow_exception(newton.model().problemError());
    stopped = error.what();
  } catch (const char* error) {
    stopped = error;
  }
  x = newton.solution();
  newton.account(report);
  report.residual = scaledResidual(newton.model().residual(x), scale, &worst);
  if (!stopped.empty()) report.converged = false;
  // the recomputed residual decides, not NOX's
  if (!(report.residual <= std::max(options.tolerance, report.rounding))) report.converged = false;
  if (!stopped.empty())
    report.message =
        "stopped after " + std::to_string(report.iterations) + " iterations: " + stopped;
  else if (report.converged)
    report.message = "converged in " + std::to_string(report.iterations) +
                     " iterations to a scaled residual of " + scientific(report.residual) +
                     (report.residual > options.tolerance ? ", which rounding leaves." : ".");
  else
    report.message = explain(report, options, newton.record(), problem.unknownName(worst)) +
                     explainRounding(problem, scale, x, options);
  return report;
}

}  // namespace tooljoint::statics
