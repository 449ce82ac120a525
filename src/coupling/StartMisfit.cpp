// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/StartMisfit.hpp"

#include <cmath>

#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "reduction/project/ReducedModels.hpp"

namespace tooljoint::coupling {
namespace {

/// Fraction of the initial energy that may be lost without a warning.
constexpr double startLoss = 0.01;

}  // namespace

double startMisfit(const Synthesis& synthesis) {
  double energy = 0.0, misfit = 0.0;
  const auto& coupled = synthesis.coupled;
  for (std::size_t p = 0; p < synthesis.parts.size(); ++p) {
    const auto& part = synthesis.parts[p];
    energy += part.report.startEnergy;
    misfit += part.report.startMisfit;
    const Vector moved = coupled.maps[p] * coupled.model.initialDisplacement + coupled.offsets[p],
                 moving = coupled.maps[p] * coupled.model.initialVelocity;
    misfit += reduction::energyOf(part.model, part.model.initialDisplacement - moved,
                                  part.model.initialVelocity - moving);
  }
  return energy > 0.0 ? misfit / energy : 0.0;
}

void warnOfStart(const Synthesis& synthesis) {
  const double loss = startMisfit(synthesis);
  if (loss > startLoss)
    log::warn("The basis does not represent the initial state: the misfit has " +
              formatNumber(std::round(1e3 * loss) / 10.0) +
              " % of its kinetic and strain energy, so the initial state of the reduced motion "
              "differs from that of the full motion. Set Reduction/Start State Vectors, keep more "
              "modes, or retain the dofs that move.");
}

}  // namespace tooljoint::coupling
