// SPDX-License-Identifier: BSD-3-Clause
#include "statics/PathContinuation.hpp"

#include <LOCA_GlobalData.H>
#include <LOCA_MultiContinuation_AbstractStrategy.H>
#include <LOCA_MultiContinuation_ExtendedVector.H>
#include <LOCA_Stepper.H>
#include <NOX_Solver_Generic.H>
#include <NOX_StatusTest_Combo.H>
#include <NOX_StatusTest_FiniteValue.H>
#include <NOX_StatusTest_MaxIters.H>
#include <NOX_StatusTest_NormF.H>
#include <NOX_Utils.H>
#include <Teuchos_ParameterList.hpp>
#include <Teuchos_oblackholestream.hpp>
#include <algorithm>
#include <cmath>
#include <memory>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "statics/PathGroup.hpp"

namespace tooljoint::statics {

namespace {

/// Thrown when the observer ends a path.
struct Stop {};

/// Parameters closer than this, relative to the range, are equal.
constexpr double sameParameter = 1e-9;
/// A step of length s becomes s (1 + growth ((n_max - n)/n_max)^2) after n iterations.
constexpr double growth = 1.0;

Teuchos::RCP<Teuchos::ParameterList> locaParameters(const PathOptions& options, double scale) {
  const auto list = Teuchos::parameterList();
  Teuchos::ParameterList& loca = list->sublist("LOCA");
  Teuchos::ParameterList& stepper = loca.sublist("Stepper");
  stepper.set("Continuation Method", "Arc Length");
  stepper.set("Continuation Parameter", PathGroup::parameterName);
  stepper.set("Initial Value", options.from / scale);
  stepper.set("Min Value", options.from / scale);
  stepper.set("Max Value", options.to / scale);
  stepper.set("Max Steps", options.maxSteps);
  stepper.set("Max Nonlinear Iterations", options.maxIterations);
  // Tangents are scaled to length 1, and the parameter keeps its scale: its contribution to that
  // length is never above 1.
  stepper.set("Enable Arc Length Scaling", true);
  stepper.set("Initial Scale Factor", 1.0);
  stepper.set("Max Arc Length Parameter Contribution", 2.0);
  // otherwise LOCA would continue to a bound after the last step
  stepper.set("Return Failed on Reaching Max Steps", true);
  stepper.set("Bordered Solver Method", "Bordering");
  loca.sublist("Predictor").set("Method", "Tangent");
  Teuchos::ParameterList& size = loca.sublist("Step Size");
  size.set("Method", "Adaptive");
  size.set("Initial Step Size", options.firstStep);
  size.set("Min Step Size", options.smallestStep);
  size.set("Max Step Size", options.largestStep);
  size.set("Aggressiveness", growth);
  Teuchos::ParameterList& nox = list->sublist("NOX");
  nox.set("Nonlinear Solver", "Line Search Based");
  nox.sublist("Line Search").set("Method", "Full Step");
  Teuchos::ParameterList& printing = nox.sublist("Printing");
  const Teuchos::RCP<std::ostream> nowhere = Teuchos::rcp(new Teuchos::oblackholestream());
  printing.set("Output Information", static_cast<int>(NOX::Utils::Error));
  printing.set("Output Stream", nowhere);
  printing.set("Error Stream", nowhere);
  return list;
}

/// sqrt(x'x) of a vector of x and parameter, with the weights of the problem.
double lengthOf(const LOCA::MultiContinuation::AbstractStrategy& group,
                const NOX::Abstract::Vector& x) {
  return std::sqrt(group.computeScaledDotProduct(x, x));
}

/// Largest length of the last Newton step of a state.
constexpr double smallUpdate = 1e-6;

/// Converged if the last Newton step is small in the weights of the problem. If a motion meets
/// hardly any resistance, a small residual does not mean that a solution is near.
class SmallUpdate : public NOX::StatusTest::Generic {
 public:
  NOX::StatusTest::StatusType checkStatus(const NOX::Solver::Generic& solver,
                                          NOX::StatusTest::CheckType) override {
    status_ = NOX::StatusTest::Unconverged;
    if (solver.getNumIterations() == 0) return status_;
    const auto& now = solver.getSolutionGroup();
    const auto change = now.getX().clone(NOX::DeepCopy);
    change->update(-1.0, solver.getPreviousSolutionGroup().getX(), 1.0);
    update_ =
        lengthOf(dynamic_cast<const LOCA::MultiContinuation::AbstractStrategy&>(now), *change);
    if (update_ <= smallUpdate) status_ = NOX::StatusTest::Converged;
    return status_;
  }
  NOX::StatusTest::StatusType getStatus() const override { return status_; }
  std::ostream& print(std::ostream& stream, int indent) const override {
    return stream << std::string(static_cast<std::size_t>(indent), ' ')
                  << "length of the Newton step = " << update_ << '\n';
  }

 private:
  double update_ = 0.0;
  NOX::StatusTest::StatusType status_ = NOX::StatusTest::Unevaluated;
};

/// Limit of the distance to the solution over the length of the step: the path turns by 60 degrees.
/// After a sharper turn, such as at a closing contact, a solution may be on another part of the
/// path.
constexpr double farthest = 2.0;

/// LOCA's stepper, without long steps over bifurcations and without steps to distant solutions.
class PathStepper : public LOCA::Stepper {
 public:
  using LOCA::Stepper::Stepper;
  double bifurcationStep = 0.0;

 protected:
  StepStatus compute(StepStatus before) override {
    const auto status = LOCA::Stepper::compute(before);
    if (status != Successful) return status;
    if (distance() > farthest * std::abs(stepSize) * lengthOf(*curGroupPtr, *curPredictorPtr))
      return Unsuccessful;
    auto& here = pathGroup(*curGroupPtr);
    const auto& last = pathGroup(*prevGroupPtr);
    if (!grew_) pivots_ = last.negativePivots(), grew_ = true;
    if (!pivots_) return status;
    const auto pivots = here.negativePivots();
    const bool grows = here.parameterGrows(last).value_or(*grew_);
    if (pivots != pivots_ && grows == *grew_ && std::abs(stepSize) > bifurcationStep)
      return Unsuccessful;
    pivots_ = pivots, grew_ = grows;
    return status;
  }

 private:
  static PathGroup& pathGroup(LOCA::MultiContinuation::AbstractStrategy& group) {
    return dynamic_cast<PathGroup&>(*group.getBaseLevelUnderlyingGroup());
  }

  /// Distance from the last point of the path.
  double distance() const {
    const auto moved = curGroupPtr->getX().clone(NOX::DeepCopy);
    moved->update(-1.0, prevGroupPtr->getX(), 1.0);
    return lengthOf(*curGroupPtr, *moved);
  }

  std::optional<bool> grew_;   ///< whether the parameter grew in the last step
  std::optional<int> pivots_;  ///< negative pivots at its end
};

Teuchos::RCP<NOX::StatusTest::Combo> statusTests(const PathOptions& options) {
  using namespace NOX::StatusTest;
  const auto solved = Teuchos::rcp(new Combo(
      Combo::AND,
      Teuchos::rcp(new NormF(options.tolerance, NOX::Abstract::Vector::MaxNorm, NormF::Unscaled)),
      Teuchos::rcp(new SmallUpdate())));
  const auto tests = Teuchos::rcp(new Combo(Combo::OR));
  tests->addStatusTest(Teuchos::rcp(new FiniteValue()));
  tests->addStatusTest(solved);
  tests->addStatusTest(Teuchos::rcp(new MaxIters(options.maxIterations)));
  return tests;
}

void check(const model::ParametricProblem& problem, const Vector& start,
           const PathOptions& options) {
  if (start.size() != problem.size())
    throw ModelError("A path of " + std::to_string(problem.size()) +
                     " unknowns cannot begin with a state of " + std::to_string(start.size()) +
                     ".");
  if (!(options.from < options.to))
    throw ModelError("The end parameter of a path must be larger than its first one. Given: from " +
                     formatNumber(options.from) + " to " + formatNumber(options.to) + ".");
  const bool sizes = options.smallestStep > 0.0 && options.smallestStep <= options.firstStep &&
                     options.firstStep <= options.largestStep;
  if (!sizes)
    throw ModelError(
        "The steps of a path must satisfy 0 < smallest <= first <= largest: they are " +
        formatNumber(options.smallestStep) + ", " + formatNumber(options.firstStep) + " and " +
        formatNumber(options.largestStep) + ".");
}

/// \param began whether the first point was found
void conclude(const PathOptions& options, bool began, bool stopped, const std::string& thrown,
              PathReport& report) {
  const double same = sameParameter * (options.to - options.from);
  const std::string at = " at " + formatNumber(report.parameter);
  if (stopped) {
    report.end = PathEnd::Stopped;
    report.explanation = "The path was stopped" + at + ".";
  } else if (std::abs(report.parameter - options.to) <= same) {
    report.end = PathEnd::Reached;
    report.explanation = "The path reached its end" + at + ".";
  } else if (report.steps > 0 && std::abs(report.parameter - options.from) <= same) {
    report.end = PathEnd::Returned;
    report.explanation = "The path turned and returned to its start" + at + ".";
  } else if (thrown.empty() && report.steps + report.failedSteps >= options.maxSteps) {
    report.end = PathEnd::Steps;
    report.explanation = "The path ended" + at + " after " + std::to_string(report.steps) +
                         " steps (" + std::to_string(report.failedSteps) +
                         " more were repeated with half the length), the number allowed.";
  } else {
    report.end = PathEnd::Failed;
    const std::string why = thrown.empty()
                                ? "a step of the smallest length, " +
                                      formatNumber(options.smallestStep) + ", does not converge"
                                : "LOCA says \"" + thrown + "\"";
    report.explanation = began ? "The path ended" + at + ": " + why + "."
                               : "The path has no beginning at " + formatNumber(options.from) +
                                     ": the first state does not converge.";
  }
}

}  // namespace

PathReport followPath(const model::ParametricProblem& problem, const Vector& start,
                      const PathOptions& options, const PathObserver& observer) {
  check(problem, start, options);
  PathReport report;
  report.parameter = options.from;
  int points = 0;
  const double scale = problem.parameterScale();
  const auto context = std::make_shared<PathContext>(PathContext{
      problem, problem.residualScale(), problem.pathWeights(), scale, nullptr, nullptr});
  const double slack = sameParameter * (options.to - options.from);
  const auto observe = [&](double parameter, const Vector& x) {
    // the last step but one may pass the end
    if (parameter > options.to + slack || parameter < options.from - slack) return;
    report.parameter = parameter;
    report.steps = points++;
    if (!observer({report.steps, parameter, x, problem.negativePivots(x, parameter)})) throw Stop{};
  };
  context->accept = [&](double parameter, const Vector& x) {
    try {
      observe(parameter, x);
    } catch (const Stop&) {
      throw;
    } catch (...) {
      context->error = std::current_exception();
      throw;
    }
  };

  const auto list = locaParameters(options, scale);
  const auto global = LOCA::createGlobalData(list);
  bool stopped = false;
  std::string thrown;
  std::unique_ptr<PathStepper> stepper;
  try {
    const auto group = Teuchos::rcp(new PathGroup(context, start, options.from));
    stepper = std::make_unique<PathStepper>(global, group, statusTests(options), list);
    stepper->bifurcationStep = options.bifurcationStep;
    stepper->run();
  } catch (const Stop&) {
    stopped = true;
  } catch (const std::exception& error) {
    thrown = error.what();
  } catch (const char* error) {
    thrown = error;
  }
  if (stepper) report.failedSteps = stepper->getNumFailedSteps();
  stepper.reset();
  LOCA::destroyGlobalData(global);
  if (context->error) std::rethrow_exception(context->error);
  conclude(options, points > 0, stopped, thrown, report);
  return report;
}

bool startsPath(const model::ParametricProblem& problem, const Vector& start,
                const PathOptions& options) {
  return options.from >= options.to || followPath(problem, start, options, [](const PathPoint&) {
                                         return false;
                                       }).end == PathEnd::Stopped;
}

}  // namespace tooljoint::statics
