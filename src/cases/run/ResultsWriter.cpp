// SPDX-License-Identifier: BSD-3-Clause
#include "cases/run/ResultsWriter.hpp"

#include <cmath>

#include "cases/run/Report.hpp"
#include "common/Text.hpp"
#include "coupling/StartMisfit.hpp"
#include "io/Csv.hpp"

namespace tooljoint::cases {

io::Provenance provenance(const deck::Deck& deck) {
  return {deck.file(), deck.text(), deck.sha256(), deck.overrides()};
}

void writeBases(const std::vector<reduction::ReducedSubstructure>& parts, io::ResultsFile& file) {
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto& part = parts[p];
    const std::string group = "/reduction/part_" + std::to_string(p + 1);
    file.write(group + "/basis", Matrix(part.basis->vectors), "1",
               "Basis Phi of " + part.name + ": D = offset + Phi q");
    file.write(group + "/offset", part.offset, {static_cast<std::size_t>(part.offset.size())},
               "m, rad", "D at q = 0");
    if (part.basis->eigenvalues.size() > 0)
      file.write(group + "/eigenvalues", part.basis->eigenvalues,
                 {static_cast<std::size_t>(part.basis->eigenvalues.size())}, "rad2/s2",
                 "Squared angular frequencies of the modes");
  }
}

void stageBasisTable(const std::vector<reduction::ReducedSubstructure>& parts,
                     io::OutputFolder& folder) {
  io::Csv table({{"part", ""},
                 {"kind", ""},
                 {"vector", ""},
                 {"frequency", "Hz"},
                 {"omega2", "rad2/s2"},
                 {"residual", ""},
                 {"kept", ""},
                 {"why", ""}});
  const auto number = [](double value) {
    return std::isfinite(value) ? formatNumber(value) : std::string();
  };
  for (const auto& part : parts)
    for (const auto& row : part.basisRows())
      table.row({part.name, row.kind, row.name, number(row.frequency()), number(row.eigenvalue),
                 number(row.residual), row.kept ? "kept" : "dropped", row.why});
  table.stage(folder.file("basis.csv"));
}

namespace {

void summariseParts(const std::vector<reduction::ReducedSubstructure>& parts,
                    const std::string& basis, int reducedDofs, double wall, io::Summary& summary) {
  summary.set("reduction.basis", basis);
  for (const auto& part : parts)
    summary.append("reduction.substructures", io::SummaryRow()
                                                  .set("name", part.name)
                                                  .set("interior", part.report.interior)
                                                  .set("interface", part.report.interface)
                                                  .set("retained", part.report.retained)
                                                  .set("modes", part.report.modes)
                                                  .set("cutoff_hz", part.report.cutOffHz()));
  summary.set("reduction.reduced_dofs", reducedDofs);
  summary.set("reduction.wall_s", wall);
}

void summariseCoupling(const coupling::Coupling& coupled, io::Summary& summary) {
  summary.set("reduction.coupling.assembly",
              std::string(coupled.multipliers.empty() ? "Primal" : "Dual"));
  summary.set("reduction.coupling.joined_dofs", coupled.joinedDofs);
  summary.set("reduction.coupling.multipliers", static_cast<long>(coupled.multipliers.size()));
  if (coupled.interfaceModes >= 0)
    summary.set("reduction.coupling.interface_modes", coupled.interfaceModes);
}

void summariseEstimate(const estimate::Outcome& outcome,
                       const std::vector<model::Substructure>& parts, io::Summary& summary) {
  if (!outcome.rounds.empty())
    summary.set("reduction.estimate.rounds", static_cast<long>(outcome.rounds.size()));
  if (!outcome.rounds.empty() || !outcome.frequencies.empty())
    summary.set("reduction.estimate.wall_s", outcome.wall);
  if (outcome.frequencies.empty()) return;
  for (const auto& e : outcome.frequencies) {
    Eigen::Index worst = 0;
    if (e.byPart.size() > 0) e.byPart.maxCoeff(&worst);
    io::SummaryRow row;
    row.set("hz", e.frequency()).set("error", e.error).set("complete", e.definite);
    if (e.byPart.size() > 0 && e.byPart[worst] > 0)
      row.set("part", parts[static_cast<std::size_t>(worst)].name);
    summary.append("reduction.estimate.frequencies", row);
  }
  summary.set("reduction.estimate.frequency_error", estimate::largestError(outcome.frequencies));
}

}  // namespace

void summarise(const ReducedCase& reduced, const std::string& basis, double wall,
               io::Summary& summary) {
  if (!reduced.tried.empty()) summary.set("reduction.cut_by_cost", reduced.cut.overrides);
  summary.set("reduction.start_misfit", coupling::startMisfit(reduced.outcome.synthesis));
  summariseParts(reduced.parts(), basis, reduced.model().size(), wall, summary);
  summariseCoupling(reduced.coupled(), summary);
  summariseEstimate(reduced.outcome, reduced.unreduced.parts, summary);
}

void summarise(const estimate::MotionEstimate& error, io::Summary& summary) {
  summary.set("reduction.estimate.motion_error", error.error);
  summary.set("reduction.estimate.motion_worst_sample", error.largest);
  summary.set("reduction.estimate.motion_wall_s", error.wall);
}

void summarise(const transient::TransientReport& report, bool reduced, io::Summary& summary) {
  const auto& c = report.counters;
  summary.set("transient.model", reduced ? "reduced" : "full");
  summary.set("transient.integrator", report.integrator);
  summary.set("transient.start", report.start);
  summary.set("transient.end", report.end);
  summary.set("transient.steps", c.steps);
  summary.set("transient.min_step", c.minStep);
  summary.set("transient.max_step", c.maxStep);
  summary.set("transient.rejected", c.rejected);
  summary.set("transient.halved", c.halved);
  summary.set("transient.newton_iterations", c.newtonIterations);
  summary.set("transient.unconverged_steps", c.unconvergedSteps);
  summary.set("transient.factorisations", c.factorisations);
  summary.set("transient.right_hand_sides", c.rightHandSides);
  if (c.strategies != transient::StrategyCounts{})
    for (std::size_t i = 0; i < transient::strategyCount; ++i)
      summary.set(std::string("transient.strategies.") + transient::strategyNames[i].summary,
                  c.strategies[i]);
  summary.set("transient.ranks", report.ranks);
  if (report.ranks > 1) {
    summary.set("transient.dofs_of_rank", report.ownSize);
    summary.set("transient.messages", report.messages);
  }
  summary.set("transient.wall_s", report.wall);
  summary.set("transient.cpu_s", report.cpu);
  summary.set("transient.real_time_factor", report.realTimeFactor);
  if (report.stepError > 0) summary.set("transient.step_error", report.stepError);
  if (reduced) summary.set("transient.cut_off_energy", report.cutOffEnergy);
  if (reduced) summary.set("transient.missing_energy", report.missingEnergy);
  if (report.hasEnergy) summary.set("transient.energy_residual", report.energy.residual());
}

}  // namespace tooljoint::cases
