// SPDX-License-Identifier: BSD-3-Clause
#include "transient/NodalProblem.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace tooljoint::transient {

/// y - free - G phi(y); phi and, if asked, its derivative in y.
NodalProblem::Local NodalProblem::defect(PointBatch& batch, double t, double c, const Local& y, Local& phi,
                                         LocalMatrix* slope) const {
  const Local position = d + y;
  const Local velocity = v + c * y;
  phi.resize(y.size());
  if (slope != nullptr) {
    LocalMatrix dfdd(y.size(), y.size()), dfdv(y.size(), y.size());
    batch.evaluateOne(t, point, position.data(), velocity.data(), phi.data(), dfdd.data(), dfdv.data());
    *slope = dfdd.transpose() + c * dfdv.transpose() - P;  // the law's arrays are row-major
  } else {
    batch.evaluateOne(t, point, position.data(), velocity.data(), phi.data(), nullptr, nullptr);
  }
  phi -= f0 + P * y;
  return y - free - G * phi;
}

/// Pseudo-time, (1/tau + 1 - G slope) step = -defect: slow, but it goes where forces balance in a stable way, past what stops
/// Newton (friction that falls with speed has up to three balances, and folds between them).
void NodalProblem::flow(PointBatch& batch, double t, double c, const Local& scale, double enough, Local& y, Local& phi) const {
  const Eigen::Index w = free.size();
  const auto size = [&](const Local& x) { return x.cwiseProduct(scale).norm(); };
  LocalMatrix slope(w, w);
  Local now = defect(batch, t, c, y, phi, &slope);
  double tau = 0.1;
  for (int iteration = 0; iteration < 200 && size(now) > enough; ++iteration) {
    const LocalMatrix J = (1 + 1 / tau) * LocalMatrix::Identity(w, w) - G * slope;
    const Local trial = y - J.partialPivLu().solve(now);
    if (!trial.allFinite()) return;
    LocalMatrix nextSlope(w, w);
    const Local next = defect(batch, t, c, trial, phi, &nextSlope);
    const double ratio = size(now) / std::max(size(next), 1e-300);
    if (!(ratio > 0.5)) {  // also catches NaN
      tau *= 0.25;
      continue;
    }
    y = trial, now = next, slope = nextSlope;
    tau = std::min(1e12, tau * std::min(4.0, std::max(0.5, 2 * ratio)));
  }
}

/// Newton with backtracking on the defect scaled by 1/sqrt(G_cc) (an energy); where no decrease is found, the sign change of
/// step . defect is bracketed; where that does not end either, pseudo-time.
bool NodalProblem::solve(PointBatch& batch, double t, double c, Local& y, Local& phi) const {
  const Eigen::Index w = free.size();
  Local scale(w);
  for (Eigen::Index i = 0; i < w; ++i) scale[i] = 1.0 / std::sqrt(std::max(std::abs(G(i, i)), 1e-300));
  const auto size = [&](const Local& x) { return x.cwiseProduct(scale).norm(); };
  LocalMatrix slope(w, w);
  const Local guess = y;
  Local best = y;
  double bestSize = INFINITY;
  for (int start = 0; start < 2; ++start) {
    y = start == 0 ? guess : free;
    for (int iteration = 0; iteration < 30; ++iteration) {
      const Local now = defect(batch, t, c, y, phi, &slope);
      const double before = size(now);
      if (!std::isfinite(before)) break;
      if (before < bestSize) best = y, bestSize = before;
      if (before <= 1e-11 * (size(free) + size(y)) + 1e-300) break;
      const LocalMatrix J = LocalMatrix::Identity(w, w) - G * slope;
      const Local step = -J.partialPivLu().solve(now);
      if (!step.allFinite()) break;
      double fraction = 1, beyond = 0;
      bool decreased = false;
      for (int cut = 0; cut < 10 && !decreased; ++cut, fraction *= 0.5) {
        const Local trial = defect(batch, t, c, y + fraction * step, phi, nullptr);
        if (size(trial) <= (1 - 1e-4 * fraction) * before) {
          y += fraction * step;
          decreased = true;
        } else if (step.cwiseProduct(scale).dot(trial.cwiseProduct(scale)) > 0) {
          beyond = fraction;
        }
      }
      if (decreased) continue;
      if (beyond == 0) break;
      double low = 0, high = beyond;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        const Local trial = defect(batch, t, c, y + middle * step, phi, nullptr);
        (step.cwiseProduct(scale).dot(trial.cwiseProduct(scale)) > 0 ? high : low) = middle;
      }
      y += high * step;
    }
    if (bestSize <= 1e-9 * (size(free) + size(best))) break;
  }
  for (int start = 0; start < 2 && bestSize > 1e-9 * (size(free) + size(best)); ++start) {
    y = start == 0 ? guess : free;
    flow(batch, t, c, scale, 1e-10 * (size(free) + size(best)), y, phi);
    const double reached = size(defect(batch, t, c, y, phi, nullptr));
    if (reached < bestSize) best = y, bestSize = reached;
  }
  y = best;
  defect(batch, t, c, y, phi, nullptr);
  return std::isfinite(bestSize);
}

}  // namespace tooljoint::transient
