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

/// Steps in which states of point laws are let go, and iterations of each.
constexpr int releases = 4, mostIterations = 30;
/// Relative change of s that ends them, and the steps before the last.
constexpr double settled = 1e-7, onTheWay = 0.1;
/// A change against the last one that is larger than this part of it converges slowly, or not.
constexpr double toAndFro = 0.5;

}  // namespace

std::optional<linalg::DampedMode> ReleasedStates::operator()(linalg::DampedMode mode) const {
  for (int step = 1; step <= releases; ++step) {
    const double a = static_cast<double>(step) / releases;
    const double accuracy = step < releases ? onTheWay : settled;
    auto next = iterated(a, mode, accuracy);
    if (!next && mode.s.imag() == 0.0) {  // two divergences may have become a vibration
      mode.s += Complex(0.0, 0.5 * std::abs(mode.s));
      next = iterated(a, mode, accuracy);
    }
    if (!next) return std::nullopt;
    mode = std::move(*next);
  }
  return mode;
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
    // a delay throws s to and fro: half the way then
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
