// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/softstring/Pressure.hpp"

#include <algorithm>
#include <iterator>
#include <string>

#include "common/Constants.hpp"
#include "substructures/softstring/Pieces.hpp"

namespace tooljoint::softstring {

namespace {

/// Pressure loss of both flows per length [Pa/m]; no inner flow in a bar, no annular flow if the
/// string fills the hole.
double lossPerLength(const beam::Section& pipe, double hole, const Circulation& mud) {
  const double factor = mud.frictionCoefficient * mud.density / constants::pi;
  const double inner = pipe.innerRadius(), outer = pipe.outerRadius();
  double loss = 0.0;
  if (inner > 0.0) {
    const double speed = mud.flowRate / (constants::pi * inner * inner);
    loss += factor * speed * speed / inner;
  }
  if (hole > outer) {
    const double speed = mud.flowRate / (constants::pi * (hole * hole - outer * outer));
    loss += factor * speed * speed / (hole - outer);
  }
  return loss;
}

}  // namespace

PressureDifference::PressureDifference(const std::vector<Stretch>& string, const Hole& hole,
                                       double bit, std::optional<double> pumpPressure) {
  const double down = hole.mud.flowRate < 0.0 ? -1.0 : 1.0;  // sign of the flow: down inside the
                                                             // string, or down the annulus
  auto found = pieces(string, hole, bit);
  std::reverse(found.begin(), found.end());
  depth_.push_back(0.0);
  loss_.push_back(0.0);
  for (const auto& piece : found) {
    const auto& section = string[static_cast<std::size_t>(piece.stretch)].section;
    const double radius = hole.radius(0.5 * (piece.top + piece.bottom));
    depth_.push_back(piece.bottom);
    loss_.push_back(loss_.back() +
                    down * (piece.bottom - piece.top) * lossPerLength(section, radius, hole.mud));
  }
  atSurface_ = pumpPressure.value_or(loss_.back());
}

double PressureDifference::at(double depth) const {
  const auto next = std::lower_bound(std::next(depth_.begin()), std::prev(depth_.end()), depth);
  const auto i = static_cast<std::size_t>(next - depth_.begin());
  const double share = std::clamp((depth - depth_[i - 1]) / (depth_[i] - depth_[i - 1]), 0.0, 1.0);
  return atSurface_ - loss_[i - 1] - share * (loss_[i] - loss_[i - 1]);
}

}  // namespace tooljoint::softstring
