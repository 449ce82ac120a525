// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/project/StartMisfit.hpp"

#include <cmath>

#include "common/Text.hpp"
#include "common/report/Log.hpp"

namespace tooljoint::reduction {
namespace {

/// Energy of the start that the bases may lose without a warning.
constexpr double startLoss = 0.01;

}  // namespace

double startMisfit(const std::vector<ReducedSubstructure>& parts) {
  double energy = 0.0, misfit = 0.0;
  for (const auto& part : parts) {
    energy += part.report.startEnergy;
    misfit += part.report.startMisfit;
  }
  return energy > 0.0 ? misfit / energy : 0.0;
}

void warnOfStart(const std::vector<ReducedSubstructure>& parts) {
  const double loss = startMisfit(parts);
  if (loss > startLoss)
    log::warn("The basis does not represent the initial state: the misfit has " +
              formatNumber(std::round(1e3 * loss) / 10.0) +
              " % of its kinetic and strain energy, so the initial state of the reduced motion "
              "differs from that of the full motion. Set Reduction/Start State Vectors, keep more "
              "modes, or retain the dofs that move.");
}

}  // namespace tooljoint::reduction
