// SPDX-License-Identifier: BSD-3-Clause
#include "cases/ModesReport.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <fmt/format.h>
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
#include "estimate/FrequencyEstimate.hpp"
#include "estimate/ModeComparison.hpp"
#include "estimate/PartResidual.hpp"
#include "io/Csv.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "model/DofNames.hpp"
#include "model/HarmonicTangent.hpp"
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
  const std::string without = stability::withoutStates(held);
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
         fmt::format("{:.3g}", fastest) + " t): the state is unstable." + without;
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
    const auto ofCoupled = [&](double number) {
      return m.coupledMode < 0 ? "" : formatNumber(number);
    };
    table.row({formatNumber(static_cast<double>(i + 1)), formatNumber(m.fullHz()),
               formatNumber(m.fullDamping()), ofCoupled(m.coupledMode + 1.0),
               ofCoupled(m.coupledHz()), ofCoupled(m.coupledDamping()), ofCoupled(m.mac),
               ofCoupled(m.error), m.estimated ? formatNumber(m.estimate) : "",
               ofCoupled(m.definite ? 1.0 : 0.0), formatNumber(m.fullImHz()),
               ofCoupled(m.coupledImHz())});
  }
  table.writeInto(folder, name);
}

/// More modes than these are told of before they are computed.
constexpr int manyModes = 200;

/// The number of modes to list, told where that takes long or is not what was given.
int modesOf(const model::SecondOrderModel& model, int wanted) {
  const int count = std::min(wanted, model.size());
  if (count > manyModes)
    log::info("modes       " + std::to_string(count) + " of " + std::to_string(model.size()) +
              " dofs are computed: so many take long, the damped ones most. --count chooses fewer");
  return count;
}

/// Undamped and damped modes of one model.
void listFullModes(const model::SecondOrderModel& full, const ModesOptions& options, double t) {
  const int count = modesOf(full, options.count);
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
  log::info(
      verdict({damped.values.begin(), damped.values.end()}, model::setsWithMovingStates(full, t)));
  logStageTimes();
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
  const int count = modesOf(full, options.count);
  const auto undamped = estimate::compareModes(full, parts, synthesis, count, maps);
  log::info(std::string(undampedHeading) +
            ". Columns: full mode, coupled mode of the same shape (repeated modes: of the same "
            "subspace), its relative error, and the estimate of the error without the full model:");
  log::info(estimate::comparisonTable(undamped, false));
  if (!options.output.empty()) writeTable(undamped, options.output, "modes.csv");
  const auto damped = estimate::compareDampedModes(full, parts, synthesis, count, t, maps);
  log::info(dampedHeading(t) + ", errors of s:");
  log::info(estimate::comparisonTable(damped, true));
  if (synthesis.coupled.wholeInterfaces)
    log::info("Errors of damped modes are not estimated beside an interface reduction.");
  std::vector<std::complex<double>> values;
  for (const auto& mode : damped) values.push_back(mode.full);
  log::info(verdict(values, model::setsWithMovingStates(full, t)));
  logStageTimes();
  if (!options.output.empty()) writeTable(damped, options.output, "damped_modes.csv");
}

/// Modes of the coupled model without those of the full one.
void listCoupledModes(const ReducedCase& reduced, const ModesOptions& options) {
  const auto& parts = reduced.unreduced.parts;
  const auto& synthesis = reduced.outcome.synthesis;
  const auto& coupled = synthesis.coupled.model;
  const int count = modesOf(coupled, options.count);
  std::vector<estimate::FrequencyEstimate> modes;
  const bool estimated = estimate::estimable(synthesis, [&] {
    modes = estimate::estimateFrequencies(parts, synthesis, {count, 0});
  });
  if (estimated) {
    log::info(estimate::frequencyTable(modes, parts));
  } else {
    log::info(
        "Coupled frequencies, whose errors cannot be estimated here:\n  mode    coupled [Hz]");
    for (const double value : coupling::lowestPhysicalModes(coupled, count).values) {
      modes.emplace_back();
      modes.back().eigenvalue = value;
      log::info(fmt::format("  {:4}  {:14.8g}", modes.size(), modes.back().frequency()));
    }
  }
  logStageTimes();
  if (options.output.empty()) return;
  io::Csv table({{"mode", ""}, {"coupled", "Hz"}, {"estimate", ""}, {"definite", ""}});
  for (std::size_t i = 0; i < modes.size(); ++i)
    table.row({formatNumber(static_cast<double>(i + 1)), formatNumber(modes[i].frequency()),
               estimated ? formatNumber(modes[i].error) : "",
               !estimated          ? ""
               : modes[i].definite ? "1"
                                   : "0"});
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
