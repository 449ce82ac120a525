// SPDX-License-Identifier: BSD-3-Clause
#include "parts/RestState.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Text.hpp"
#include "linalg/trilinos/DirectSolver.hpp"
#include "model/DofNames.hpp"
#include "model/laws/StatefulPointLaw.hpp"

namespace tooljoint::parts {

namespace {

/// Step of finite differences for forces whose states depend on rest: fraction of d, and least step
/// [m].
constexpr double differencePart = 1e-6, leastDifference = 1e-9;

/// df/dd of a law whose states are reset at each d, as at rest, minus df/dd at constant states: 0
/// and -k for a spring and a dashpot in series.
Matrix changeByStates(const model::PointLaw& law, double t, const Vector& d) {
  const int w = law.width(), size = static_cast<int>(d.size());
  std::vector<int> all(static_cast<std::size_t>(law.size()));
  std::iota(all.begin(), all.end(), 0);
  const Vector still = Vector::Zero(size);
  Vector f = still, held = Vector::Zero(size * w), rates = held;
  law.evaluateWithTangent(t, all, d.data(), still.data(), f.data(), held.data(), rates.data());
  Matrix change(size, w);
  for (int k = 0; k < w; ++k) {
    std::array<Vector, 2> forces{f, f}, places{d, d};
    for (int side = 0; side < 2; ++side) {
      for (int i = k; i < size; i += w)
        places[at(side)][i] +=
            (side == 0 ? 1 : -1) * std::max(leastDifference, differencePart * std::abs(d[i]));
      law.evaluate(t, all, places[at(side)].data(), still.data(), forces[at(side)].data());
    }
    for (int i = 0; i < size; ++i) {
      const int moved = i / w * w + k;
      change(i, k) =
          (forces[0][i] - forces[1][i]) / (places[0][moved] - places[1][moved]) - held[i * w + k];
    }
  }
  return change;
}

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
    for (const auto& set : model_.points) {
      if (dynamic_cast<const model::StatefulPointLaw*>(set.law.get()) == nullptr) continue;
      const int w = set.law->width();
      const Matrix change = changeByStates(*set.law, time_, set.offset + set.rows * q);
      Triplets entries;
      for (int i = 0; i < change.rows(); ++i)
        for (int k = 0; k < w; ++k) entries.emplace_back(i, i / w * w + k, change(i, k));
      Sparse tangent(change.rows(), change.rows());
      tangent.setFromTriplets(entries.begin(), entries.end());
      J -= Sparse(Sparse(set.rows.transpose()) * Sparse(tangent * set.rows));
    }
  }
  Vector residualScale() const override {
    // forces are scaled by the largest load or, without loads, by the point forces of the start
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
