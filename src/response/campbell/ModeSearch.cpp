// SPDX-License-Identifier: BSD-3-Clause
#include "response/campbell/ModeSearch.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/Constants.hpp"
#include "common/Index.hpp"

namespace tooljoint::response {

namespace {

/// A mode with a smaller Im s, relative to |s|, does not vibrate.
constexpr double noVibration = 1e-6;
/// Growth below this fraction of |s| is rounding.
constexpr double noGrowth = 1e-8;
/// Modes computed beyond the tracked ones, since the next modes may move below them.
constexpr int beyond = 8;
/// Margin on either side of a window that is searched too, relative to its width.
constexpr double margin = 0.25;
/// Largest |Re s| of a mode in the window, relative to its width.
constexpr double mostDecay = 0.5;

VibratingModes vibrating(const linalg::QuadraticModes& modes) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index j = 0; j < modes.values.size(); ++j)
    if (vibrates(modes.values[j])) kept.push_back(j);
  VibratingModes out{Eigen::VectorXcd(static_cast<Eigen::Index>(kept.size())),
                     Eigen::MatrixXcd(modes.vectors.rows(), static_cast<Eigen::Index>(kept.size())),
                     {},
                     {}};
  for (std::size_t k = 0; k < kept.size(); ++k) {
    out.values[static_cast<Eigen::Index>(k)] = modes.values[kept[k]];
    out.shapes.col(static_cast<Eigen::Index>(k)) = modes.vectors.col(kept[k]);
  }
  return out;
}

/// Positions of the first `count` values by their distance from `centre`.
std::vector<int> nearestTo(Complex centre, const Eigen::VectorXcd& values, int count) {
  std::vector<int> order = range(values.size());
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return std::abs(values[a] - centre) < std::abs(values[b] - centre);
  });
  order.resize(std::min(order.size(), static_cast<std::size_t>(count)));
  std::sort(order.begin(), order.end());
  return order;
}

}  // namespace

bool vibrates(Complex s) { return s.imag() > noVibration * std::abs(s); }
bool grows(Complex s) { return s.real() > noGrowth * std::abs(s); }

ModeSearch::ModeSearch(const RotatingStates& states, const CampbellSettings& settings)
    : states_(states), settings_(settings) {}

std::optional<linalg::DampedTarget> ModeSearch::target(int count) const {
  if (nearest())
    return linalg::DampedTarget{{0.0, constants::twoPi * *settings_.target}, 0.0, count};
  if (!settings_.window) return std::nullopt;
  const double width = constants::twoPi * settings_.window->width();
  return linalg::DampedTarget{{0.0, constants::twoPi * settings_.window->middle()},
                              width * std::hypot(0.5 + margin, mostDecay),
                              0};
}

linalg::QuadraticModes ModeSearch::solve(const RotatingCase& rotating, double speed,
                                         int count) const {
  const auto m = rotating.at(speed);
  const auto where = target(count);
  return where ? rotating.modes(m, *where) : rotating.modes(m, count);
}

VibratingModes ModeSearch::at(double speed, int followed) {
  const int enough = std::max(settings_.modes, followed) + beyond;
  const auto rotating = states_.about(speed);
  for (int looked = enough;; looked *= 2) {
    latest_ = solve(*rotating, speed, looked);
    auto modes = vibrating(latest_);
    modes.shapes = states_.common(*rotating, modes.shapes);
    if (settings_.window) {
      markWindow(modes);
      return modes;
    }
    if (modes.values.size() < enough && latest_.values.size() >= looked) continue;
    const Complex centre = nearest() ? target(0)->centre : 0.0;
    modes.wanted = nearestTo(centre, modes.values, settings_.modes);
    return modes;
  }
}

void ModeSearch::markWindow(VibratingModes& modes) const {
  for (int j = 0; j < static_cast<int>(modes.values.size()); ++j)
    (shown(modes.values[j]) ? modes.wanted : modes.edge).push_back(j);
}

bool ModeSearch::shown(Complex s) const {
  if (!settings_.window) return true;
  const auto& window = *settings_.window;
  const double frequency = s.imag() / constants::twoPi;
  return frequency >= window.lowest && frequency <= window.highest &&
         std::abs(s.real()) <= mostDecay * constants::twoPi * window.width();
}

Eigen::VectorXcd ModeSearch::errors(double speed) const {
  const auto rotating = states_.about(speed);
  return rotating->error().ofModes(rotating->partsAt(speed), rotating->at(speed), latest_,
                                   target(0));
}

std::vector<estimate::ModeComparison> ModeSearch::compare(double speed) const {
  const auto where = target(settings_.modes);
  const auto rotating = states_.about(speed);
  auto all = where ? rotating->compare(speed, *where) : rotating->compare(speed, settings_.modes);
  all.erase(
      std::remove_if(all.begin(), all.end(),
                     [&](const auto& one) { return !vibrates(one.full) || !shown(one.full); }),
      all.end());
  return all;
}

}  // namespace tooljoint::response
