// SPDX-License-Identifier: BSD-3-Clause
#include "transient/ranks/MotionShare.hpp"

#include <string>

#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/report/Log.hpp"

namespace tooljoint::transient {
namespace {

/// Smaller models are computed by all ranks alike. Their steps take less than 0.2 ms, of which two
/// ranks save little (docs/scale.md), and they lose more if they share a core.
constexpr int fewestToDivide = 1500;

}  // namespace

std::unique_ptr<RankShare> shareOf(const model::SecondOrderModel& model,
                                   const TransientOptions& options, const Integrator& integrator) {
  const bool wanted = options.ranks == RankUse::Divide ||
                      (options.ranks == RankUse::Automatic && model.size() >= fewestToDivide);
  if (!wanted || parallel::size() == 1) return nullptr;
  const bool isDemanded = options.ranks == RankUse::Divide;
  if (!integrator.dividesAmongRanks()) {
    const std::string why =
        "the integrator \"" + options.integrator + "\" does not divide a motion";
    if (isDemanded)
      throw DeckError("Transient/Ranks is \"Divide\", but " + why +
                      " among ranks. Use \"Generalized-alpha\", \"RK4\" or \"RK4 adaptive\", or "
                      "leave Ranks \"Automatic\".");
    log::info("ranks       all compute the same motion: " + why);
    return nullptr;
  }
  auto share = RankShare::of(model);
  if (!share && isDemanded)
    log::warn("The motion is computed by all ranks alike: the model cannot be cut into " +
              std::to_string(parallel::size()) + " pieces.");
  return share;
}

}  // namespace tooljoint::transient
