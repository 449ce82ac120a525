// SPDX-License-Identifier: BSD-3-Clause
#include "transient/contact/PointSolve.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "transient/Tuned.hpp"

namespace tooljoint::transient {
namespace {

constexpr double tiny = 1e-300;  // avoids division by zero

}  // namespace

/// y - free - G phi(y); phi and, if requested, its derivative in y.
PointSolve::Local PointSolve::defect(PointBatch& batch, double t, double c, const Local& y,
                                     Local& phi, LocalMatrix* slope) const {
  const Local position = d + y;
  const Local velocity = v + c * y;
  phi.resize(y.size());
  if (slope != nullptr) {
    LocalMatrix dfdd(y.size(), y.size()), dfdv(y.size(), y.size());
    batch.evaluateOne(t, point, position.data(), velocity.data(), phi.data(), dfdd.data(),
                      dfdv.data());
    *slope = dfdd.transpose() + c * dfdv.transpose() - P;  // the arrays of the law are row-major
  } else {
    batch.evaluateOne(t, point, position.data(), velocity.data(), phi.data(), nullptr, nullptr);
  }
  phi -= f0 + P * y;
  return y - free - G * phi;
}

/// Pseudo-time, (1/tau + 1 - G slope) step = -defect: slow, but it converges to stable balances and
/// passes points where Newton stops (friction that decreases with speed has up to three balances,
/// and folds between them).
void PointSolve::flow(PointBatch& batch, double t, double c, const Local& scale, double enough,
                      Local& y, Local& phi) const {
  const Eigen::Index w = free.size();
  const auto size = [&](const Local& x) { return x.cwiseProduct(scale).norm(); };
  LocalMatrix slope(w, w);
  Local now = defect(batch, t, c, y, phi, &slope);
  double tau = 1;
  for (int iteration = 0; iteration < Tuned::mostPathSteps && size(now) > enough; ++iteration) {
    const LocalMatrix J = (1 + 1 / tau) * LocalMatrix::Identity(w, w) - G * slope;
    const Local trial = y - J.partialPivLu().solve(now);
    if (!trial.allFinite()) return;
    LocalMatrix nextSlope(w, w);
    const Local next = defect(batch, t, c, trial, phi, &nextSlope);
    const double ratio = size(now) / std::max(size(next), tiny);
    if (!(ratio > Tuned::slowestRate)) {  // also true for NaN
      tau *= 0.25;
      continue;
    }
    y = trial, now = next, slope = nextSlope;
    tau = std::min(1 / Tuned::rounding, tau * std::min(4.0, std::max(0.5, 2 * ratio)));
  }
}

/// Path y(s) of y = free + s G phi(y) from y(0) = free to s = 1, followed along its length.
/// Restoring forces keep the path bounded, so it reaches s = 1, through folds (friction that
/// decreases with speed) and around corners (sticking, touching).
void PointSolve::follow(PointBatch& batch, double t, double c, const Local& scale, double enough,
                        Local& y, Local& phi) const {
  using Path = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, widest + 1, 1>;  // y scaled, s
  using PathMatrix =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, widest + 1, widest + 1>;
  const Eigen::Index w = free.size();
  const double unit = std::max(free.cwiseProduct(scale).norm(), y.cwiseProduct(scale).norm());
  if (!(unit > 0)) return;
  const Local size = scale / unit;
  const Path whole = Path::Unit(w + 1, w);
  LocalMatrix slope(w, w);
  PathMatrix J(w + 1, w + 1);
  Path wrong(w + 1);
  // S (y - free - s G phi) and [S (1 - s G slope) S^-1, -S G phi] above `row`
  const auto evaluate = [&](const Path& at, const Path& row) {
    const Local here = at.head(w).cwiseQuotient(size);
    defect(batch, t, c, here, phi, &slope);
    const Local answer = G * phi;
    J.topLeftCorner(w, w) =
        LocalMatrix::Identity(w, w) -
        at[w] * (size.asDiagonal() * G * slope * size.cwiseInverse().asDiagonal());
    J.topRightCorner(w, 1) = -answer.cwiseProduct(size);
    J.row(w) = row.transpose();
    wrong.head(w) = (here - free - at[w] * answer).cwiseProduct(size);
  };
  Path at(w + 1), ahead = whole;
  at << free.cwiseProduct(size), 0.0;
  double step = 0.5;  // largest step; the path has a length of about 1
  for (int count = 0; count < Tuned::mostPathSteps && step > Tuned::rounding; ++count) {
    evaluate(at, ahead);
    const Path tangent = J.partialPivLu().solve(whole).normalized();
    if (!tangent.allFinite()) return;
    const bool last = tangent[w] > 0 && at[w] + step * tangent[w] >= 1;
    const double length = last ? (1 - at[w]) / tangent[w] : step;
    Path next = at + length * tangent;
    bool found = false;
    int iteration = 0;
    for (; iteration < Tuned::mostTries && !found && next.allFinite(); ++iteration) {
      wrong[w] = last ? 0.0 : tangent.dot(next - at) - length;
      evaluate(next, last ? whole : tangent);
      found = wrong.norm() * unit <= enough;
      if (!found) next -= J.partialPivLu().solve(wrong);
    }
    if (!found || (next - at).norm() > 2 * length) {
      step = 0.25 * length;
      continue;
    }
    at = next;
    ahead = tangent;
    if (last) {
      y = at.head(w).cwiseQuotient(size);
      return;
    }
    if (2 * iteration <= Tuned::mostTries) step = std::min(0.5, 2 * step);
  }
}

/// Newton with backtracking on the defect scaled by 1/sqrt(G_cc) (an energy). If the defect does
/// not decrease, the sign change of step . defect is bracketed. y becomes the best iterate; returns
/// the size of its defect.
double PointSolve::iterate(PointBatch& batch, double t, double c, const Local& scale, Local& y,
                           Local& phi) const {
  const Eigen::Index w = free.size();
  const auto size = [&](const Local& x) { return x.cwiseProduct(scale).norm(); };
  LocalMatrix slope(w, w);
  Local best = y;
  double bestSize = INFINITY;
  int idle = 0;  // consecutive brackets without progress
  for (int iteration = 0; iteration < Tuned::mostPointIterations; ++iteration) {
    const Local now = defect(batch, t, c, y, phi, &slope);
    const double before = size(now);
    if (!std::isfinite(before)) break;
    if (before < Tuned::progress * bestSize) idle = 0;
    if (before < bestSize) best = y, bestSize = before;
    if (before <= 0.1 * Tuned::pointTolerance * (size(free) + size(y)) + tiny) break;
    const LocalMatrix J = LocalMatrix::Identity(w, w) - G * slope;
    const Local step = -J.partialPivLu().solve(now);
    if (!step.allFinite()) break;
    double fraction = 1, beyond = 0;
    bool decreased = false;
    for (int cut = 0; cut < Tuned::mostTries && !decreased; ++cut, fraction *= 0.5) {
      const Local trial = defect(batch, t, c, y + fraction * step, phi, nullptr);
      if (size(trial) <= (1 - Tuned::decrease * fraction) * before) {
        y += fraction * step;
        decreased = true;
      } else if (step.cwiseProduct(scale).dot(trial.cwiseProduct(scale)) > 0) {
        beyond = fraction;
      }
    }
    if (decreased) continue;
    if (beyond == 0 || ++idle > Tuned::mostIdle) break;
    double low = 0, high = beyond;
    while (high - low > std::numeric_limits<double>::epsilon() * beyond) {
      const double middle = 0.5 * (low + high);
      const Local trial = defect(batch, t, c, y + middle * step, phi, nullptr);
      (step.cwiseProduct(scale).dot(trial.cwiseProduct(scale)) > 0 ? high : low) = middle;
    }
    y += high * step;
  }
  y = best;
  return bestSize;
}

/// Bound of the scaled defect by rounding of d + y and v + c y. If contact switches within 1e-12 m,
/// the balance is not known better.
double PointSolve::rounding(PointBatch& batch, double t, double c, const Local& scale,
                            const Local& y) const {
  LocalMatrix slope(y.size(), y.size());
  Local phi;
  defect(batch, t, c, y, phi, &slope);
  const Local unsure =
      std::numeric_limits<double>::epsilon() * (d.cwiseAbs() + 2 * y.cwiseAbs() + v.cwiseAbs() / c);
  return (G.cwiseAbs() * (slope.cwiseAbs() * unsure)).cwiseProduct(scale).norm();
}

/// Newton from the guess and from zero force, then pseudo-time from both, then the path. Each is
/// used only if the one before has not found a balance.
bool PointSolve::solve(PointBatch& batch, double t, double c, Local& y, Local& phi) const {
  const Eigen::Index w = free.size();
  Local scale(w);
  for (Eigen::Index i = 0; i < w; ++i)
    scale[i] = 1.0 / std::sqrt(std::max(std::abs(G(i, i)), tiny));
  const auto size = [&](const Local& x) { return x.cwiseProduct(scale).norm(); };
  const Local guess = y;
  Local best = y;
  double bestSize = INFINITY;
  const auto balanced = [&] {
    return bestSize <= 10 * Tuned::pointTolerance * (size(free) + size(best)) ||
           (std::isfinite(bestSize) && bestSize <= rounding(batch, t, c, scale, best));
  };
  const auto keep = [&](double reached) {
    if (reached < bestSize) best = y, bestSize = reached;
  };
  const auto measure = [&] { return size(defect(batch, t, c, y, phi, nullptr)); };
  for (const Local* start : {&guess, static_cast<const Local*>(&free)}) {
    if (balanced()) break;
    y = *start;
    keep(iterate(batch, t, c, scale, y, phi));
  }
  const bool follows =
      !balanced() && std::isfinite(bestSize) && strategies->use(Strategy::PointPaths);
  for (const Local* start : {&guess, static_cast<const Local*>(&free)}) {
    if (!follows || balanced()) break;
    y = *start;
    flow(batch, t, c, scale, Tuned::pointTolerance * (size(free) + size(best)), y, phi);
    keep(measure());
  }
  if (follows && !balanced()) {
    y = best;
    follow(batch, t, c, scale, Tuned::pointTolerance * (size(free) + size(best)), y, phi);
    keep(measure());
  }
  y = best;
  defect(batch, t, c, y, phi, nullptr);
  return std::isfinite(bestSize);
}

}  // namespace tooljoint::transient
