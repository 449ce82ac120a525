// SPDX-License-Identifier: BSD-3-Clause
#include "stability/ReleasedStates.hpp"

#include <algorithm>
#include <complex>
#include <limits>
#include <utility>

#include "common/Index.hpp"
#include "linalg/ComplexProduct.hpp"
#include "model/HarmonicTangent.hpp"
#include "stability/StateStability.hpp"

namespace tooljoint::stability {

namespace {

/// Step of the fraction by which the states of point laws are released: first, smallest and
/// largest; iterations of each step. The first step is short because a neighbouring mode may be as
/// close as the distance the mode moves.
constexpr double firstStep = 1.0 / 32, leastStep = 1.0 / 128, longestStep = 0.25;
constexpr int mostIterations = 30;
/// If the MAC of a mode before and after a step is below this, it is another mode.
constexpr double leastMac = 0.5;
/// Relative change of s at which the last step has converged, and the steps before it.
constexpr double settled = 1e-7, onTheWay = 0.1;
/// A change opposite to the last one and larger than this part of it means slow or no convergence.
constexpr double toAndFro = 0.5;

}  // namespace

std::optional<linalg::DampedMode> ReleasedStates::operator()(linalg::DampedMode mode) const {
  double a = 0.0, step = firstStep;
  while (a < 1.0) {
    const double to = std::min(1.0, a + step), accuracy = to < 1.0 ? onTheWay : settled;
    auto next = iterated(to, mode, accuracy);
    if (!next && mode.s.imag() == 0.0) {  // two divergences may have become a vibration
      mode.s += Complex(0.0, 0.5 * std::abs(mode.s));
      next = iterated(to, mode, accuracy);
    } else if (next && !alike(mode, *next)) {
      next.reset();  // a neighbouring mode
    }
    if (next) {
      mode = std::move(*next);
      a = to;
      step = std::min(2.0 * step, longestStep);
    } else if ((step *= 0.5) < leastStep) {
      return std::nullopt;
    }
  }
  return mode;
}

bool ReleasedStates::alike(const linalg::DampedMode& x, const linalg::DampedMode& y) const {
  const ComplexVector inertia = linalg::times(held_.mass, x.shape);
  const double squares =
      inertia.dot(x.shape).real() * y.shape.dot(linalg::times(held_.mass, y.shape)).real();
  return std::norm(inertia.dot(y.shape)) >= leastMac * squares;
}

std::optional<linalg::DampedMode> ReleasedStates::iterated(double a, linalg::DampedMode mode,
                                                           double accuracy) const {
  double part = 1.0;
  Complex last = 0.0;
  for (int i = 0; i < mostIterations; ++i) {
    const auto moving = estimate::linearise(model_, t_, mode.s);
    auto next = linalg::refine(held_.mass, (1.0 - a) * held_.damping + a * moving.damping,
                               (1.0 - a) * held_.stiffness + a * moving.stiffness, mode);
    if (!next || next->s == 0.0) return std::nullopt;
    const Complex change = next->s - mode.s;
    if (std::abs(change) <= accuracy * std::abs(next->s)) return next;
    // with a delay s may oscillate: then half the change
    if ((std::conj(last) * change).real() < 0.0 && std::abs(change) > toAndFro * std::abs(last))
      part *= 0.5;
    last = change;
    next->s = mode.s + part * change;
    mode = std::move(*next);
  }
  return std::nullopt;
}

double ReleasedStates::reach(const linalg::DampedMode& mode) const {
  const auto& x = mode.shape;
  const Complex s = std::abs(mode.s) > model::slowestOmega ? mode.s : model::slowestOmega;
  Complex added = 0.0;
  for (const auto& set : model_.points) {
    const auto* law = model::stateful(*set.law);
    if (law == nullptr || law->states() == 0) continue;
    const auto change =
        model::tangentByStates(*law, t_, Vector(set.offset + set.rows * model_.initialDisplacement),
                               Vector(set.rows * model_.initialVelocity), s);
    const ComplexVector y = linalg::times(set.rows, x);
    const int width = law->width();
    for (int row = 0; row < y.size(); ++row)
      for (int c = 0; c < width; ++c)
        added += std::conj(y[row]) * change[at(row * width + c)] * y[row / width * width + c];
  }
  const Complex slope =
      2.0 * s * x.dot(linalg::times(held_.mass, x)) + x.dot(linalg::times(held_.damping, x));
  return std::abs(added) / std::max(std::abs(slope), std::numeric_limits<double>::min());
}

linalg::DampedMode followed(const model::SecondOrderModel& model, double t,
                            const estimate::Linearised& held, const linalg::DampedMode& mode) {
  if (model::setsWithMovingStates(model, t).empty() ||
      !model::setsWithUnknownStates(model, t).empty())
    return mode;
  return ReleasedStates(model, t, held)(mode).value_or(mode);
}

}  // namespace tooljoint::stability
