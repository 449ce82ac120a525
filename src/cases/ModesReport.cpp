// SPDX-License-Identifier: BSD-3-Clause
#include "cases/ModesReport.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <vector>

#include "cases/ReducedCase.hpp"
#include "cases/run/Report.hpp"
#include "cases/run/Run.hpp"
#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "common/report/StageTimes.hpp"
#include "coupling/CoupledModes.hpp"
#include "estimate/ModeComparison.hpp"
#include "io/Csv.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "model/DofNames.hpp"
#include "reduction/part/Partition.hpp"
#include "stability/StateStability.hpp"

namespace tooljoint::cases {

namespace {

const char* const undampedHeading =
    "Undamped modes about the static state: symmetric part of the stiffness, friction left out, "
    "closed contacts linear. A negative frequency means omega^2 < 0, and 0 a rigid-body mode. The "
    "damped modes show whether the state is stable";

std::string dampedHeading(double t) {
  return "Damped modes with the matrices of t = " + formatNumber(t) +
         " s (damping, gyroscopic, circulatory, friction), by |s|; s = Re s + i Im s, damping = "
         "-Re s / |s|";
}

/// Growth rates below this fraction of |s| are within the accuracy of s.
constexpr double noGrowth = 1e-8;

/// What the damped modes say of the stability of the state. \param held point sets whose states
/// they leave as they are at rest
std::string verdict(const std::vector<std::complex<double>>& values,
                    const std::vector<std::string>& held) {
  const std::string without =
      held.empty() ? ""
                   : " The states of " + quotedList(held) +
                         " are held here, so that growth by them (chatter by the delay of a "
                         "cutting bit) is not seen: the motion shows it.";
  std::size_t growing = 0;
  double fastest = 0;
  for (const auto& s : values)
    if (s.real() > noGrowth * std::abs(s)) {
      ++growing;
      fastest = std::max(fastest, s.real());
    }
  if (growing == 0)
    return "None of the " + std::to_string(values.size()) + " damped modes listed grows." + without;
  return std::to_string(growing) + " of the " + std::to_string(values.size()) +
         " damped modes listed " + (growing == 1 ? "grows" : "grow") + ", the fastest as exp(" +
         formatNumber(fastest) + " t): the state is unstable." + without;
}

void reportTimes() {
  const std::string times = stageTimes();
  if (!times.empty()) log::info("times       " + times);
}

void writeTable(const std::vector<estimate::ModeComparison>& modes, const std::string& folder,
                const std::string& name) {
  io::Csv table({{"mode", ""},
                 {"full", "Hz"},
                 {"full_damping", ""},
                 {"coupled_mode", ""},
                 {"coupled", "Hz"},
                 {"coupled_damping", ""},
                 {"mac", ""},
                 {"error", ""},
                 {"estimate", ""},
                 {"definite", ""},
                 {"full_im", "Hz"},
                 {"coupled_im", "Hz"}});
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const auto& m = modes[i];
    std::vector<std::string> cells;
    for (double number : {static_cast<double>(i + 1), m.fullHz(), m.fullDamping(),
                          m.coupledMode + 1.0, m.coupledHz(), m.coupledDamping(), m.mac, m.error})
      cells.push_back(formatNumber(number));
    cells.push_back(m.estimated ? formatNumber(m.estimate) : "");
    cells.push_back(m.definite ? "1" : "0");
    cells.push_back(formatNumber(m.fullImHz()));
    cells.push_back(formatNumber(m.coupledImHz()));
    table.row(cells);
  }
  table.writeInto(folder, name);
}

/// Undamped and damped modes of one model.
void listFullModes(const model::SecondOrderModel& full, const ModesOptions& options, double t) {
  const int count = std::min(options.count, full.size());
  const auto pairs = coupling::lowestModes(full, count);
  const auto values =
      estimate::undampedValues(coupling::undampedStiffness(full),
                               reduction::symmetricPart(full.mass), pairs.values, pairs.vectors);
  log::info(std::string(undampedHeading) + ":");
  log::info("  mode       full [Hz]");
  io::Csv table({{"mode", ""}, {"full", "Hz"}});
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    char line[64];
    std::snprintf(line, sizeof line, "  %4ld  %14.8g", static_cast<long>(i + 1),
                  values(i).imag() / constants::twoPi);
    log::info(line);
    table.row({static_cast<double>(i + 1), values(i).imag() / constants::twoPi});
  }
  if (!options.output.empty()) table.writeInto(options.output, "modes.csv");
  const auto m = estimate::linearise(full, t);
  const auto damped =
      linalg::lowestDampedModes(m.mass, m.damping, m.stiffness, count, model::namer(full));
  log::info(dampedHeading(t) + ":");
  log::info("  mode  full |s| [Hz]  full Im s [Hz]       damping");
  io::Csv dampedTable({{"mode", ""}, {"full", "Hz"}, {"full_damping", ""}, {"full_im", "Hz"}});
  for (Eigen::Index i = 0; i < damped.values.size(); ++i) {
    const auto s = damped.values[i];
    const double size = std::abs(s), ratio = size > 0 ? 0.0 - s.real() / size : 0.0;
    char line[96];
    std::snprintf(line, sizeof line, "  %4ld %14.8g  %14.8g  %12.4e", static_cast<long>(i + 1),
                  size / constants::twoPi, s.imag() / constants::twoPi, ratio);
    log::info(line);
    dampedTable.row(
        {static_cast<double>(i + 1), size / constants::twoPi, ratio, s.imag() / constants::twoPi});
  }
  log::info(verdict({damped.values.begin(), damped.values.end()}, stability::setsWithStates(full)));
  reportTimes();
  if (!options.output.empty()) dampedTable.writeInto(options.output, "damped_modes.csv");
}

/// Full and coupled modes side by side, undamped and with the matrices of time t.
/// \param maps of the full model where it was coupled from the parts, see estimate::compareModes
void listComparedModes(const model::SecondOrderModel& full, const std::vector<Sparse>& maps,
                       const std::vector<model::Substructure>& parts,
                       const coupling::Synthesis& synthesis, const ModesOptions& options,
                       double t) {
  log::info("reduced     " + std::to_string(full.size()) + " dofs to " +
            std::to_string(synthesis.coupled.model.size()));
  const auto undamped = estimate::compareModes(full, parts, synthesis, options.count, maps);
  if (synthesis.coupled.interfaceModes >= 0)
    log::info(
        "The estimates include the error of the reduced parts, but not of the interface "
        "reduction.");
  log::info(std::string(undampedHeading) +
            ". Columns: full mode, coupled mode of the same shape (repeated modes: of the same "
            "subspace), its relative error, and the estimate of the error without the full model:");
  log::info(estimate::comparisonTable(undamped, false));
  if (!options.output.empty()) writeTable(undamped, options.output, "modes.csv");
  const auto damped = estimate::compareDampedModes(full, parts, synthesis, options.count, t, maps);
  log::info(dampedHeading(t) + ", errors of s:");
  log::info(estimate::comparisonTable(damped, true));
  std::vector<std::complex<double>> values;
  for (const auto& mode : damped) values.push_back(mode.full);
  log::info(verdict(values, stability::setsWithStates(full)));
  reportTimes();
  if (!options.output.empty()) writeTable(damped, options.output, "damped_modes.csv");
}

/// Modes of the coupled model without those of the full one.
void listCoupledModes(const ReducedCase& reduced, const ModesOptions& options) {
  const auto& parts = reduced.unreduced.parts;
  const auto& synthesis = reduced.outcome.synthesis;
  const auto estimates = estimate::estimateFrequencies(parts, synthesis, {options.count, 0});
  if (synthesis.coupled.interfaceModes >= 0)
    log::info("The estimates do not include the error of the interface reduction.");
  log::info(estimate::frequencyTable(estimates, parts));
  reportTimes();
  if (options.output.empty()) return;
  io::Csv table({{"mode", ""}, {"coupled", "Hz"}, {"estimate", ""}, {"definite", ""}});
  for (std::size_t i = 0; i < estimates.size(); ++i)
    table.row({static_cast<double>(i + 1), estimates[i].frequency(), estimates[i].error,
               estimates[i].definite ? 1.0 : 0.0});
  table.writeInto(options.output, "modes.csv");
}

}  // namespace

double timeOfLaws(const Case& one) {
  return one.moves() ? one.transient().get<double>("End Time") : 0.0;
}

void listModes(const Case& one, const ModesOptions& options) {
  announce(one);
  const auto rest = one.atRest();
  const auto text = rest->describe();
  if (!text.empty()) log::info(text);
  const double t = options.time.value_or(timeOfLaws(one));
  if (!one.reduces()) {
    if (options.coupledOnly)
      throw UsageError(
          "`modes --coupled` lists the modes of a reduced model, but the deck has no list "
          "\"Reduction\". Add the list, or leave --coupled out.");
    listFullModes(rest->full().model, options, t);
    return;
  }
  const auto reduced = reduce(one, *rest);
  log::info(describeCoupling(reduced.coupled()));
  if (options.coupledOnly) {
    listCoupledModes(reduced, options);
  } else {
    const auto full = rest->full();
    listComparedModes(full.model, full.maps, reduced.unreduced.parts, reduced.outcome.synthesis,
                      options, t);
  }
  if (!reduced.outcome.rounds.empty()) log::info(estimate::roundTable(reduced.outcome.rounds));
  log::info(reduction::summaryTable(reduced.parts()));
  if (options.bases)
    for (const auto& part : reduced.parts()) log::info(part.report.table());
}

}  // namespace tooljoint::cases
