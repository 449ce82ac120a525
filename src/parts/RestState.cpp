// SPDX-License-Identifier: BSD-3-Clause
#include "parts/RestState.hpp"

#include <algorithm>
#include <string>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "linalg/trilinos/DirectSolver.hpp"
#include "model/DofNames.hpp"

namespace tooljoint::parts {

namespace {

/// r(q) = K q - F - R' f(d, 0)
class Equilibrium : public model::NonlinearProblem {
 public:
  Equilibrium(const model::SecondOrderModel& model, double t)
      : model_(model),
        time_(t),
        stiffness_(model.stiffnessAt(t)),
        load_(model.loadAt(t)),
        still_(Vector::Zero(model.size())) {}

  int size() const override { return model_.size(); }
  void residual(const Vector& q, Vector& r) const override {
    r = stiffness_ * q - load_ - model_.pointForce(time_, q, still_);
  }
  void jacobian(const Vector& q, Sparse& J) const override {
    J = stiffness_ + model_.pointStiffness(time_, q, still_);
  }
  Vector residualScale() const override {
    // forces are measured by the largest load, or, without loads, by the point forces of the start
    double size = load_.size() > 0 ? load_.cwiseAbs().maxCoeff() : 0.0;
    if (size == 0.0)
      size = model_.pointForce(time_, model_.initialDisplacement, still_).cwiseAbs().maxCoeff();
    return Vector::Constant(model_.size(), size > 0.0 ? 1.0 / size : 1.0);
  }
  std::string unknownName(int i) const override { return model::dofName(model_, i); }

 private:
  const model::SecondOrderModel& model_;
  double time_;
  Sparse stiffness_;
  Vector load_;
  Vector still_;
};

}  // namespace

Vector restState(const model::SecondOrderModel& model, double t,
                 const model::NonlinearSolver& solver) {
  const Equilibrium problem(model, t);
  Vector q = model.initialDisplacement;
  Sparse J;
  problem.jacobian(q, J);
  try {
    const linalg::DirectSolver held(J, [&](int i) { return problem.unknownName(i); });
  } catch (const ModelError& error) {
    throw ModelError(std::string("The parts have no equilibrium: a dof is not supported. ") +
                     error.what() +
                     " Fix or join this dof, or set Parts/Initial State to \"From files\".");
  }
  model::SolveRequest request;
  request.what = "the equilibrium of the parts";
  request.tolerance = 1e-10;
  const auto outcome = solver(problem, q, request);
  if (!outcome.converged)
    throw ConvergenceError(
        "The equilibrium of the parts did not converge: residual " +
        formatNumber(outcome.residual) + " of the largest load after " +
        std::to_string(outcome.iterations) + " iterations. " + outcome.message +
        " Set Parts/Initial State to \"From files\" and find it by a damped transient.");
  return q;
}

}  // namespace tooljoint::parts
