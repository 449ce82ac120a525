// SPDX-License-Identifier: BSD-3-Clause
#include "app/Report.hpp"

#include <cstdarg>
#include <cstdio>

namespace tooljoint::app {

namespace {

constexpr double kRpm = 30.0 / 3.14159265358979323846;  ///< rad/s -> rpm

/// printf into a string.
__attribute__((format(printf, 1, 2))) std::string format(const char* pattern, ...) {
  char buffer[512];
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(buffer, sizeof buffer, pattern, arguments);
  va_end(arguments);
  return buffer;
}

}  // namespace

std::string describeScene(const Scene& scene) {
  std::string text =
      format("string      %d nodes, %d elements, %.4g m in a well of %.4g m, %d free dofs",
             scene.string.nodeCount(), scene.string.elementCount(), scene.string.length(),
             scene.well.length(), scene.freeDofs());
  for (const auto& remark : scene.well.trajectory().remarks()) text += "\nsurvey      " + remark;
  return text;
}

std::string describeStatic(const StaticStage& stage) {
  const auto& path = stage.path.report;
  const auto& s = stage.state;
  std::string text =
      format("path        %d iterations in %d load steps, nodes within %.2g m of the axis\n",
             path.iterations, path.increments, path.maxPositionError);
  text += format(
      "static      %d iterations, residual %.1e: %d nodes in contact, %d elements in compression\n",
      s.report.iterations, s.report.residual, s.contactNodes, s.compressedElements);
  text += format(
      "            axial force %.4g kN at the top, %.4g kN in the last element; torque %.4g kN m "
      "at the top, %.4g kN m in the "
      "last element\n",
      s.topAxialForce / 1e3, s.lastElementAxialForce / 1e3, s.topTorque / 1e3,
      s.lastElementTorque / 1e3);
  if (s.maxNormalForceNode > 0)
    text += format("            contact %.4g kN in all, at most %.4g kN at node %d\n",
                   s.totalNormalForce / 1e3, s.maxNormalForce / 1e3, s.maxNormalForceNode);
  text += format("            friction: %s", stage.friction.why.c_str());
  if (stage.friction.speed > 0.0) text += format(", %.4g rpm", stage.friction.speed * kRpm);
  text += format(
      "\n            top torque %.4g kN m by the balance of torque, defect %.4g N m (%.2g %% of "
      "%.4g kN m)",
      s.topTorqueEquilibrium() / 1e3, s.torqueBalanceDefect(), 100.0 * s.relativeTorqueDefect(),
      s.torqueScale / 1e3);
  return text;
}

std::string describeReduction(const std::vector<reduction::ReducedSubstructure>& parts,
                              int fullDofs, int reducedDofs, double wall) {
  int modes = 0;
  for (const auto& part : parts) modes += part.modes;
  return format("reduction   %zu parts, %d modes: %d dofs instead of %d, in %.2f s", parts.size(),
                modes, reducedDofs, fullDofs, wall);
}

std::string describeCost(const transient::CostModel& full, const transient::CostModel& reduced) {
  const double ratio = reduced.total() / full.total();
  std::string text = format(
      "cost        a step of the reduced model takes about %.2f of the work of one of the full "
      "model (%.3g of %.3g "
      "multiplications)\n",
      ratio, reduced.total(), full.total());
  if (ratio < transient::worthReducing)
    return text + "            the reduced model is the cheaper one";
  return text +
         "            the full model is the cheaper one, or as cheap, and the more accurate: run "
         "it with --without Reduction "
         "--without Substructures";
}

std::string describeCoupling(const coupling::Coupling& coupled) {
  if (!coupled.multipliers.empty())
    return format("coupling    dual: %zu forces join %zu dofs of the parts",
                  coupled.multipliers.size(), coupled.interface.size());
  if (coupled.interfaceModes < 0)
    return format("coupling    primal: %zu joined dofs", coupled.interface.size());
  return format("coupling    primal: kept %d modes of %d joined dofs", coupled.interfaceModes,
                coupled.joinedDofs);
}

std::string describeMotionError(const estimate::MotionEstimate& error) {
  return format(
      "estimate    error of the motion by the reduction: dyn %.2e, worst sample %.2e, from %ld "
      "samples in %.2f s",
      error.error, error.largest, error.samples, error.wall);
}

std::string describeSteps(const transient::TransientReport& report) {
  const auto& c = report.counters;
  std::string text = format(
      "transient   %s, %g to %g s: %ld steps of %.3g to %.3g s in %.2f s wall, %.2f s CPU: %.3g "
      "times real time\n",
      report.integrator.c_str(), report.start, report.end, c.steps, c.minStep, c.maxStep,
      report.wall, report.cpu, report.realTimeFactor);
  text += format(
      "            %ld Newton iterations, %ld factorisations, %ld right-hand sides, %ld halved, "
      "%ld rejected, %ld unconverged "
      "steps\n",
      c.newtonIterations, c.factorisations, c.rightHandSides, c.halved, c.rejected,
      c.unconvergedSteps);
  return text;
}

std::string describeTransient(const transient::TransientReport& report,
                              const MotionFigures& figures) {
  std::string text = describeSteps(report);
  text +=
      format("            bit speed %.4g to %.4g rpm, mean %.4g rpm; largest penetration %.3g mm",
             figures.minBitSpeed * kRpm, figures.maxBitSpeed * kRpm, figures.meanBitSpeed() * kRpm,
             figures.maxPenetration * 1e3);
  if (report.hasEnergy)
    text += format("\n            energy balance closes to %.2g of the energy exchanged",
                   report.energy.residual());
  return text;
}

}  // namespace tooljoint::app
