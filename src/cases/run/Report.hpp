// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Printed report of the reduction and the motion of a run: short blocks of text, one per stage;
/// diagnostics only with log::verbose().
#pragma once

#include <string>
#include <vector>

#include "cases/MotionRecord.hpp"
#include "cases/ReducedCase.hpp"
#include "coupling/assembly/Assembler.hpp"
#include "estimate/MotionEstimate.hpp"
#include "reduction/ReducedSubstructure.hpp"
#include "transient/CostModel.hpp"
#include "transient/Transient.hpp"

namespace tooljoint::cases {

std::string describeReduction(const std::vector<reduction::ReducedSubstructure>& parts,
                              int fullDofs, int reducedDofs, double wall);
/// The cut chosen by Substructures/Rule = "By cost", and the trials.
std::string describeCuts(const ReducedCase& reduced);
/// Predicted work of a step of both models, and the faster one; `switches` of the command make the
/// full model.
std::string describeCost(const transient::CostModel& full, const transient::CostModel& reduced,
                         const std::string& switches);
/// Assembly, joined dofs, and those kept by the interface reduction.
std::string describeCoupling(const coupling::Coupling& coupled);
std::string describeMotionError(const estimate::MotionEstimate& error);
/// Warnings: motion too fast for the samples, and an estimate above a fifth of the motion.
std::vector<std::string> remarks(const estimate::MotionEstimate& error);
/// Warns of a reduced motion with more than a hundredth of its kinetic energy near its cut-off.
std::vector<std::string> remarks(const transient::TransientReport& report);
/// The same if the error of a reduced motion is estimated.
std::vector<std::string> remarksBesideEstimate(const transient::TransientReport& report);
/// Integrator and steps, the figures of the case, and the energy balance.
std::string describeTransient(const transient::TransientReport& report, const MotionRecord& record);

}  // namespace tooljoint::cases
