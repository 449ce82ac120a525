// SPDX-License-Identifier: BSD-3-Clause
#include "transient/ranks/MotionShare.hpp"

#include <algorithm>
#include <string>

#include "common/Parallel.hpp"
#include "common/report/Log.hpp"
#include "model/laws/StatefulPointLaw.hpp"

namespace tooljoint::transient {
namespace {

bool hasPointStates(const model::SecondOrderModel& model) {
  return std::any_of(model.points.begin(), model.points.end(),
                     [](const auto& set) { return model::stateful(*set.law) != nullptr; });
}

/// Models with fewer dofs are computed by all ranks alike: their steps take less than 0.2 ms, of
/// which two ranks save little (docs/scale.md) and lose more where they share a core.
constexpr int fewestToDivide = 1500;

}  // namespace

std::unique_ptr<RankShare> shareOf(const model::SecondOrderModel& model,
                                   const TransientOptions& options, const Integrator& integrator) {
  const bool wanted = options.ranks == RankUse::Divide ||
                      (options.ranks == RankUse::Automatic && model.size() >= fewestToDivide);
  if (!wanted || parallel::size() == 1) return nullptr;
  if (!integrator.dividesAmongRanks() || hasPointStates(model)) {
    if (options.ranks == RankUse::Divide)
      log::warn("The motion is computed by all ranks alike: " +
                (hasPointStates(model)
                     ? std::string("a point law has states.")
                     : "the integrator \"" + options.integrator + "\" does not divide it."));
    return nullptr;
  }
  auto share = RankShare::of(model);
  if (!share && options.ranks == RankUse::Divide)
    log::warn("The motion is computed by all ranks alike: the model cannot be cut into " +
              std::to_string(parallel::size()) + " pieces.");
  return share;
}

}  // namespace tooljoint::transient
