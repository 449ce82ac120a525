// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/figures/BendingFigures.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/Constants.hpp"
#include "substructures/beam/NodalDofs.hpp"

namespace tooljoint::drillstring {

using namespace beam::nodal;

/// kappa = kappa_path + (theta2 x a2 - theta1 x a1)/l
Eigen::Vector2d meanMoment(const BendingElement& element, std::size_t index,
                           const Vector& displacement) {
  const auto node = static_cast<Eigen::Index>(index);
  const Eigen::Vector2d turn =
      element.slope[1] * displacement.segment<3>(perNode * (node + 1) + thetaX) -
      element.slope[0] * displacement.segment<3>(perNode * node + thetaX);
  return element.rigidity * (element.pathCurvature + turn / element.length);
}

BendingFigures::BendingFigures(std::vector<BendingElement> elements, std::optional<io::SnLine> line)
    : elements_(std::move(elements)), line_(line), planes_(elements_.size()) {
  for (std::size_t p = 0; p < kBendingPlanes; ++p) {
    const double alpha =
        constants::pi * static_cast<double>(p) / static_cast<double>(kBendingPlanes);
    planeCosine_[p] = std::cos(alpha);
    planeSine_[p] = std::sin(alpha);
  }
}

void BendingFigures::add(const Vector& displacement, double angle) {
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const auto node = static_cast<Eigen::Index>(e);
    const Eigen::Vector2d moment = meanMoment(elements_[e], e, displacement);
    const double x = moment[0], y = moment[1];
    const double spin = angle + 0.5 * (displacement[perNode * node + thetaZ] +
                                       displacement[perNode * (node + 1) + thetaZ]);
    // x cos(phi + alpha) + y sin(phi + alpha)
    const double along = x * std::cos(spin) + y * std::sin(spin);
    const double across = y * std::cos(spin) - x * std::sin(spin);
    for (std::size_t p = 0; p < kBendingPlanes; ++p) {
      auto& plane = planes_[e][p];
      plane.rainflow.add(along * planeCosine_[p] + across * planeSine_[p],
                         [&](const cases::LoadCycle& c) { count(e, c, plane.totals); });
    }
  }
}

void BendingFigures::count(std::size_t element, const cases::LoadCycle& cycle,
                           cases::CycleTotals& totals) const {
  if (cycle.range >= elements_[element].leastRange) totals.add(cycle, exponent());
}

/// sum n/N with N = N_0 (S_0/S)^m and S = M R/I.
double BendingFigures::damage(std::size_t element, const cases::CycleTotals& totals) const {
  if (!line_) return 0.0;
  return totals.damage *
         std::pow(elements_[element].stressPerMoment / line_->stressRange, line_->slope) /
         line_->cycles;
}

std::vector<BendingCounts> BendingFigures::counts() const {
  std::vector<BendingCounts> out(elements_.size());
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    for (const auto& plane : planes_[e]) {
      auto totals = plane.totals;
      plane.rainflow.finish([&](const cases::LoadCycle& c) { count(e, c, totals); });
      out[e].damage = std::max(out[e].damage, damage(e, totals));
      if (!(totals.largestRange > out[e].largestRange)) continue;
      out[e].largestRange = totals.largestRange;
      out[e].cycles = totals.cycles;
    }
  }
  return out;
}

void BendingFigures::save(std::vector<double>& memory) const {
  for (const auto& planes : planes_)
    for (const auto& plane : planes) {
      plane.rainflow.save(memory);
      memory.insert(memory.end(),
                    {plane.totals.cycles, plane.totals.largestRange, plane.totals.damage});
    }
}

void BendingFigures::restore(const double*& memory) {
  for (auto& planes : planes_)
    for (auto& plane : planes) {
      plane.rainflow.restore(memory);
      auto& totals = plane.totals;
      for (double* value : {&totals.cycles, &totals.largestRange, &totals.damage})
        *value = *memory++;
    }
}

}  // namespace tooljoint::drillstring
