// SPDX-License-Identifier: BSD-3-Clause
#include "app/ModesReport.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "common/Error.hpp"
#include "common/Log.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "coupling/CoupledModes.hpp"
#include "estimate/ModeComparison.hpp"
#include "estimate/PartResidual.hpp"
#include "io/Csv.hpp"

namespace tooljoint::app {

namespace {

constexpr double kTwoPi = 6.28318530717958647692;

void writeInto(const std::string& folder, const std::string& name, const io::Csv& table) {
  parallel::agree([&] {
    if (parallel::rank() != 0) return;
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    if (failed) throw FileError("The folder \"" + folder + "\" cannot be made: " + failed.message() + ".");
    table.write((std::filesystem::path(folder) / name).string());
  });
}

/// True, and said so, when a dof has no mass: the quadratic eigenproblem is solved with the inverse of M.
bool massless(const model::SecondOrderModel& full) {
  const bool none = full.size() > 0 && full.mass.diagonal().minCoeff() <= 0.0;
  if (none) log::info("Damped modes are not listed: they need a mass at every dof, and the model has dofs without one.");
  return none;
}

void writeTable(const std::vector<estimate::ModeComparison>& modes, const std::string& folder, const std::string& name) {
  io::Csv table({{"mode", ""},
                 {"full", "Hz"},
                 {"full_damping", ""},
                 {"coupled_mode", ""},
                 {"coupled", "Hz"},
                 {"coupled_damping", ""},
                 {"mac", ""},
                 {"error", ""},
                 {"estimate", ""},
                 {"definite", ""}});
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const auto& m = modes[i];
    std::vector<std::string> cells;
    for (double number : {static_cast<double>(i + 1), m.fullHz(), m.fullDamping(), m.coupledMode + 1.0, m.coupledHz(), m.coupledDamping(),
                          m.mac, m.error})
      cells.push_back(formatNumber(number));
    cells.push_back(m.estimated ? formatNumber(m.estimate) : "");
    cells.push_back(m.definite ? "1" : "0");
    table.row(cells);
  }
  writeInto(folder, name, table);
}

}  // namespace

void listFullModes(const model::SecondOrderModel& full, const RunOptions& options, double t) {
  const int count = options.modeCount;
  const Vector values = coupling::lowestModes(full, std::min(count, full.size())).values;
  log::info("Eigenfrequencies about the static state (undamped, symmetric part, closed contacts linear, negative = divergent):");
  log::info("  mode       full [Hz]");
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    char line[64];
    std::snprintf(line, sizeof line, "  %4ld  %14.8g", static_cast<long>(i + 1), reduction::signedOmega(values(i)) / kTwoPi);
    log::info(line);
  }
  if (!options.output.empty()) {
    io::Csv table({{"mode", ""}, {"full", "Hz"}});
    for (Eigen::Index i = 0; i < values.size(); ++i)
      table.row({static_cast<double>(i + 1), reduction::signedOmega(values(i)) / kTwoPi});
    writeInto(options.output, "modes.csv", table);
  }
  if (massless(full)) return;
  const auto m = estimate::linearise(full, t);
  const auto damped = linalg::lowestDampedModes(m.mass, m.damping, m.stiffness, std::min(count, full.size()));
  log::info("Damped modes with the matrices of t = " + formatNumber(t) + " s (gyroscopic, circulatory):");
  log::info("  mode       full [Hz]       damping");
  for (Eigen::Index i = 0; i < damped.values.size(); ++i) {
    const auto s = damped.values[i];
    char line[64];
    std::snprintf(line, sizeof line, "  %4ld  %14.8g  %12.4e", static_cast<long>(i + 1), std::abs(s) / kTwoPi,
                  -s.real() / std::max(std::abs(s), 1e-300));
    log::info(line);
  }
}

void listComparedModes(const model::SecondOrderModel& full, const std::vector<Sparse>& maps,
                       const std::vector<model::Substructure>& parts, const coupling::Synthesis& synthesis,
                       const RunOptions& options, double t) {
  log::info("reduced     " + std::to_string(full.size()) + " dofs to " + std::to_string(synthesis.coupled.model.size()));
  const auto undamped = estimate::compareModes(full, parts, synthesis, options.modeCount, maps);
  if (synthesis.coupled.interfaceModes >= 0)
    log::info("The estimates see what the reduction of the parts leaves out, not what the interface reduction does.");
  log::info(
      "Eigenfrequencies about the static state (undamped, symmetric part, closed contacts linear, negative = divergent); the "
      "coupled mode of "
      "the same shape, its true relative error and the one estimated without the full model:");
  log::info(estimate::comparisonTable(undamped, false));
  if (!options.output.empty()) writeTable(undamped, options.output, "modes.csv");
  if (massless(full)) return;
  if (!estimate::isRitz(synthesis)) {
    log::info("Damped modes are not listed: they need a mass at every coordinate, and the coupled model has coordinates without one.");
    return;
  }
  const auto damped = estimate::compareDampedModes(full, parts, synthesis, options.modeCount, t, maps);
  log::info("Damped modes with the matrices of t = " + formatNumber(t) + " s (gyroscopic, circulatory), errors of s:");
  log::info(estimate::comparisonTable(damped, true));
  if (!options.output.empty()) writeTable(damped, options.output, "damped_modes.csv");
}

}  // namespace tooljoint::app
