// SPDX-License-Identifier: BSD-3-Clause
#include "cases/run/Report.hpp"

#include <fmt/printf.h>

#include "common/Text.hpp"
#include "common/report/Detail.hpp"
#include "common/report/Percent.hpp"

namespace tooljoint::cases {

namespace {

/// A run warns of an estimated error of the motion of a reduced model above this value, the same as
/// for steps that fail (Transient/Step Error Limit).
constexpr double largeError = 0.2;
/// A run warns if the upper half of the kept frequencies has more than this fraction of the kinetic
/// energy. Scenes whose reduced motion is within 10 % have 1e-6 to 5e-3, those on walls too stiff
/// for their modes 0.04 to 0.4 (more than 100 % off).
constexpr double largeCutOffEnergy = 0.01;
/// The same if the error of the reduced motion is estimated.
constexpr double muchCutOffEnergy = 0.03;

/// Integrator and steps, without the counters.
std::string describeSteps(const transient::TransientReport& report) {
  const auto& c = report.counters;
  const std::string shortest = fmt::sprintf("%.3g", c.minStep),
                    longest = fmt::sprintf("%.3g", c.maxStep);
  std::string text = fmt::sprintf(
      "transient   %s, %g to %g s: %ld steps of %s s in %.2f s wall, %.2f s CPU: %.3g times real "
      "time\n",
      report.integrator, report.start, report.end, c.steps,
      shortest == longest ? longest : shortest + " to " + longest, report.wall, report.cpu,
      report.realTimeFactor);
  if (report.ranks > 1) text += fmt::sprintf("            divided among %d ranks\n", report.ranks);
  return text;
}

}  // namespace

std::string describeReduction(const std::vector<reduction::ReducedSubstructure>& parts,
                              int fullDofs, int reducedDofs, double wall) {
  int modes = 0;
  for (const auto& part : parts) modes += part.modes;
  return fmt::sprintf("reduction   %zu parts, %d modes: %d dofs instead of %d, in %.2f s",
                      parts.size(), modes, reducedDofs, fullDofs, wall);
}

std::string describeCuts(const ReducedCase& reduced) {
  std::string text = "cut by cost predicted work of a step, of that of the full model:";
  for (const auto& one : reduced.tried)
    text += fmt::sprintf("\n            %.2f%s  ", one.cost,
                         one.overrides == reduced.cut.overrides ? " taken" : "      ") +
            join(one.overrides, ", ");
  return text;
}

std::string describeCost(const transient::CostModel& full, const transient::CostModel& reduced,
                         const std::string& switches) {
  const double ratio = reduced.total() / full.total();
  std::string text = fmt::sprintf(
      "cost        predicted work of a step: reduced model %.2f of the full model", ratio);
  if (log::verbose())
    text += fmt::sprintf(" (%.3g of %.3g multiplications)", reduced.total(), full.total());
  text += "\n            ";
  if (ratio < transient::worthReducing) return text + "The reduced model is faster.";
  return text + "The full model is as fast and has no reduction error: run it with" + switches +
         ".";
}

std::string describeCoupling(const coupling::Coupling& coupled) {
  if (!coupled.multipliers.empty())
    return fmt::sprintf("coupling    dual: %zu forces join %zu dofs of the parts",
                        coupled.multipliers.size(), coupled.interface.size());
  if (coupled.interfaceModes < 0)
    return fmt::sprintf("coupling    primal: %zu joined dofs", coupled.interface.size());
  return fmt::sprintf("coupling    primal: kept %d modes of %d joined dofs", coupled.interfaceModes,
                      coupled.joinedDofs);
}

std::string describeMotionError(const estimate::MotionEstimate& error) {
  return fmt::sprintf(
      "estimate    error of the motion by the reduction: vibration error %.2e, worst sample %.2e, "
      "from %ld "
      "samples in %.2f s%s",
      error.error, error.largest, error.samples, error.wall,
      error.ofEverySecond ? fmt::sprintf("; %.2e from half of them", *error.ofEverySecond) : "");
}

std::vector<std::string> remarks(const estimate::MotionEstimate& error) {
  std::vector<std::string> out;
  if (error.isTooFast())
    out.push_back("The motion is faster than its samples: the estimate of its error, " +
                  percent(error.error) +
                  (error.ofEverySecond
                       ? ", is " + percent(*error.ofEverySecond) + " from half of them, and"
                       : ", is not to be relied on:") +
                  " the error may be larger. Reduce Transient/Sampling Interval.");
  if (!(error.error <= largeError))
    out.push_back("The reduced motion is estimated to be " + percent(error.error) +
                  " off that of the full model. Keep more modes or nodes, or give Reduction a "
                  "Motion Tolerance.");
  return out;
}

std::vector<std::string> remarksBesideEstimate(const transient::TransientReport& report) {
  if (!(report.cutOffEnergy > muchCutOffEnergy)) return {};
  return {percent(report.cutOffEnergy) +
          " of the kinetic energy of the reduced motion is in modes above half the frequency at "
          "which those of their parts end: in such motions the estimate can be a fifth of the "
          "error. Raise the cut-off, or retain more nodes."};
}

std::vector<std::string> remarks(const transient::TransientReport& report) {
  std::vector<std::string> out;
  if (report.missingEnergy > largeCutOffEnergy)
    out.push_back("The parts without modes of their own would have " +
                  percent(report.missingEnergy) +
                  " of the kinetic energy in their first modes, which the basis lacks: the motion "
                  "is too fast for static condensation. Keep modes, retain more nodes, or see the "
                  "error with Reduction/Error Estimate = Transient.");
  if (report.cutOffEnergy > largeCutOffEnergy)
    out.push_back(
        percent(report.cutOffEnergy) +
        " of the kinetic energy of the reduced motion is in modes above half the highest mode "
        "frequency of their parts: vibration outside the basis is likely to matter. Raise the "
        "cut-off, retain more nodes, or see the error with Reduction/Error Estimate = Transient.");
  return out;
}

std::string describeTransient(const transient::TransientReport& report,
                              const MotionRecord& record) {
  std::string text = describeSteps(report) + record.describe();
  if (report.hasEnergy && log::verbose())
    text += fmt::sprintf("\n            energy balance closes to %.2g of the energy exchanged",
                         report.energy.residual());
  return text;
}

}  // namespace tooljoint::cases
