// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a run tells a person: short blocks of text, one per stage.
#pragma once

#include <string>
#include <vector>

#include "app/Recording.hpp"
#include "app/Scene.hpp"
#include "app/Stages.hpp"
#include "estimate/MotionEstimate.hpp"
#include "reduction/ReducedSubstructure.hpp"
#include "transient/CostModel.hpp"
#include "transient/Transient.hpp"

namespace tooljoint::app {

std::string describeScene(const Scene& scene);
std::string describeStatic(const StaticStage& stage);
std::string describeReduction(const std::vector<reduction::ReducedSubstructure>& parts,
                              int fullDofs, int reducedDofs, double wall);
/// Assembly, joined dofs, and what the interface reduction kept of them.
/// Cost of a step of both models, and which is the cheaper one.
std::string describeCost(const transient::CostModel& full, const transient::CostModel& reduced);
std::string describeCoupling(const coupling::Coupling& coupled);
std::string describeMotionError(const estimate::MotionEstimate& error);
/// Integrator, steps and what was counted, two lines.
std::string describeSteps(const transient::TransientReport& report);
std::string describeTransient(const transient::TransientReport& report,
                              const MotionFigures& figures);

}  // namespace tooljoint::app
