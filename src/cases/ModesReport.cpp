// SPDX-License-Identifier: BSD-3-Clause
#include "cases/ModesReport.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "cases/ReducedCase.hpp"
#include "cases/run/AnalysisFiles.hpp"
#include "cases/run/Report.hpp"
#include "cases/run/Run.hpp"
#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Index.hpp"
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

/// Damped modes that grow.
struct Growth {
  long modes = 0;
  double fastest = 0.0;  ///< [1/s]
};

Growth growthOf(const std::vector<std::complex<double>>& values) {
  Growth growth;
  for (const auto& s : values)
    if (s.real() > noGrowth * std::abs(s)) {
      ++growth.modes;
      growth.fastest = std::max(growth.fastest, s.real());
    }
  return growth;
}

/// Prints whether damped modes grow; warns of states of point laws that the modes ignore.
void reportStability(const Growth& growth, std::size_t listed, const model::SecondOrderModel& model,
                     double t) {
  if (growth.modes == 0)
    log::info("None of the " + std::to_string(listed) + " damped modes listed grows.");
  else
    log::info(std::to_string(growth.modes) + " of the " + std::to_string(listed) +
              " damped modes listed " + (growth.modes == 1 ? "grows" : "grow") +
              ", the fastest as exp(" + fmt::format("{:.3g}", growth.fastest) + " t)" +
              (model::setsWithMovingStates(model, t).empty()
                   ? ": the state is unstable."
                   : " with the states of point laws held."));
  stability::warnOfHeldStates(model, t);
}

/// The listed modes, for the files.
struct ListedModes {
  std::optional<io::Csv> undamped, damped;  ///< modes.csv, damped_modes.csv
  Vector hertz;                             ///< of the undamped modes
  std::optional<Growth> growth;             ///< of the damped modes
  std::optional<Growth> coupledGrowth;      ///< of the coupled modes
  std::optional<double> error, estimate;    ///< of the coupled frequencies, the largest
  Matrix shapes;                            ///< undamped modes of the full model, dofs x modes
  model::SecondOrderModel model;            ///< the full model, if there are shapes
};

io::Csv tableOf(const std::vector<estimate::ModeComparison>& modes) {
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
  return table;
}

/// A mode with a smaller fraction of its sum of squares in displacements consists of rotations.
constexpr double noDisplacement = 1e-6;

/// Scales the largest displacement to 1, or the largest rotation for a mode without displacements.
/// \param shape  rows of the recovery, node by node
Vector scaled(const Vector& shape, const model::ComponentNames& components) {
  const auto width = sizeOf(components);
  const Matrix all = shape.reshaped<Eigen::RowMajor>(shape.size() / width, width);
  Matrix moved = all;
  for (int c = 0; c < width; ++c)
    if (components[at(c)].rfind("theta", 0) == 0) moved.col(c).setZero();
  if (moved.squaredNorm() <= noDisplacement * all.squaredNorm()) moved = all;
  Eigen::Index node = 0, component = 0;
  moved.cwiseAbs().maxCoeff(&node, &component);
  const double largest = moved(node, component);
  return largest == 0.0 ? shape : Vector(shape / largest);
}

/// Group /modes.
void writeShapes(const ListedModes& listed, io::ResultsFile& file) {
  const auto& model = listed.model;
  const std::size_t nodes = model.recoveryNodes.size(), width = model.componentNames.size(),
                    count = static_cast<std::size_t>(listed.shapes.cols());
  std::vector<double> rows;
  rows.reserve(count * nodes * width);
  const Matrix recovered = model.recovery * listed.shapes;
  for (Eigen::Index j = 0; j < recovered.cols(); ++j) {
    const Vector shape = scaled(recovered.col(j), model.componentNames);
    rows.insert(rows.end(), shape.begin(), shape.end());
  }
  file.write("/modes/frequency", listed.hertz, {count}, "Hz",
             "omega / 2 pi of undamped modes of the full model, negative where omega^2 < 0");
  file.write(
      "/modes/shape", rows, {count, nodes, width}, "1",
      "Displacements, the largest scaled to 1, and rotations; of a mode without displacements "
      "the largest rotation");
}

/// A larger number of modes is announced before the computation.
constexpr int manyModes = 200;

/// The number of modes to list; printed if the computation is long or the number differs from
/// `wanted`.
int modesOf(const model::SecondOrderModel& model, int wanted) {
  const int count = std::min(wanted, model.size());
  if (count > manyModes)
    log::info("modes       " + std::to_string(count) + " of " + std::to_string(model.size()) +
              " dofs are computed: so many take long, the damped ones most. --count chooses fewer");
  return count;
}

/// The number of damped modes: dofs that do not vibrate have two each.
int dampedModesOf(const model::SecondOrderModel& model, int wanted) {
  return std::min(wanted, 2 * model.size());
}

/// Undamped and damped modes of one model.
ListedModes listFullModes(const model::SecondOrderModel& full, const ModesOptions& options,
                          double t) {
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
  ListedModes listed;
  listed.undamped = table;
  listed.hertz = values.imag() / constants::twoPi;
  listed.shapes = pairs.vectors;
  listed.model = full;
  const auto m = estimate::linearise(full, t);
  const auto damped = linalg::lowestDampedModes(
      m.mass, m.damping, m.stiffness, dampedModesOf(full, options.count), model::namer(full));
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
  listed.growth = growthOf({damped.values.begin(), damped.values.end()});
  reportStability(*listed.growth, at(damped.values.size()), full, t);
  logStageTimes();
  listed.damped = dampedTable;
  return listed;
}

/// Full and coupled modes side by side, undamped and with the matrices of time t.
/// \param maps  of the full model if it was coupled from the parts, see estimate::compareModes
ListedModes listComparedModes(const model::SecondOrderModel& full, const std::vector<Sparse>& maps,
                              const std::vector<model::Substructure>& parts,
                              const coupling::Synthesis& synthesis, const ModesOptions& options,
                              double t) {
  log::info("reduced     " + std::to_string(full.size()) + " dofs to " +
            std::to_string(synthesis.coupled.model.size()));
  const int count = modesOf(full, options.count);
  const auto exact = estimate::modesToCompare(full, count);
  const auto undamped = estimate::compareModes(full, exact, count, parts, synthesis, maps);
  log::info(std::string(undampedHeading) +
            ". Columns: full mode, coupled mode of the same shape (repeated modes: of the same "
            "subspace), its relative error, and the estimate of the error without the full model:");
  log::info(estimate::comparisonTable(undamped, false));
  const auto listedCount = static_cast<Eigen::Index>(undamped.size());
  ListedModes listed;
  listed.undamped = tableOf(undamped);
  listed.hertz.resize(listedCount);
  for (Eigen::Index i = 0; i < listedCount; ++i) {
    const auto& mode = undamped[at(i)];
    listed.hertz[i] = mode.fullHz();
    if (mode.coupledMode < 0) continue;
    listed.error = std::max(listed.error.value_or(0.0), std::abs(mode.error));
    if (mode.estimated)
      listed.estimate = std::max(listed.estimate.value_or(0.0), std::abs(mode.estimate));
  }
  listed.shapes = exact.vectors.leftCols(listedCount);
  listed.model = full;
  const auto damped = estimate::compareDampedModes(full, parts, synthesis,
                                                   dampedModesOf(full, options.count), t, maps);
  log::info(dampedHeading(t) + ", errors of s:");
  log::info(estimate::comparisonTable(damped, true));
  if (synthesis.coupled.wholeInterfaces)
    log::info("Errors of damped modes are not estimated with an interface reduction.");
  std::vector<std::complex<double>> values, coupled;
  for (const auto& mode : damped) {
    values.push_back(mode.full);
    if (mode.coupledMode >= 0) coupled.push_back(mode.coupled);
  }
  listed.growth = growthOf(values);
  listed.coupledGrowth = growthOf(coupled);
  reportStability(*listed.growth, values.size(), full, t);
  if (listed.growth->modes == 0 && listed.coupledGrowth->modes > 0)
    log::warn(fmt::format(
        "{} of the coupled modes beside them {}, the fastest as exp({:.3g} t): the reduction makes "
        "a stable model unstable. Keep more modes, or choose another basis.",
        listed.coupledGrowth->modes, listed.coupledGrowth->modes == 1 ? "grows" : "grow",
        listed.coupledGrowth->fastest));
  logStageTimes();
  listed.damped = tableOf(damped);
  return listed;
}

/// Modes of the coupled model without those of the full one.
ListedModes listCoupledModes(const ReducedCase& reduced, const ModesOptions& options) {
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
  io::Csv table({{"mode", ""}, {"coupled", "Hz"}, {"estimate", ""}, {"definite", ""}});
  for (std::size_t i = 0; i < modes.size(); ++i)
    table.row({formatNumber(static_cast<double>(i + 1)), formatNumber(modes[i].frequency()),
               estimated ? formatNumber(modes[i].error) : "",
               !estimated          ? ""
               : modes[i].definite ? "1"
                                   : "0"});
  ListedModes listed;
  listed.undamped = table;
  listed.hertz.resize(static_cast<Eigen::Index>(modes.size()));
  for (std::size_t i = 0; i < modes.size(); ++i) {
    listed.hertz[static_cast<Eigen::Index>(i)] = modes[i].frequency();
    if (estimated)
      listed.estimate = std::max(listed.estimate.value_or(0.0), std::abs(modes[i].error));
  }
  return listed;
}

void summarise(const ListedModes& listed, io::Summary& summary) {
  const auto set = [&](const char* key, const auto& value) {
    if (value) summary.set(key, *value);
  };
  summary.set("modes.count", static_cast<long>(listed.hertz.size()));
  if (listed.hertz.size() > 0) {
    summary.set("modes.lowest_hz", listed.hertz.minCoeff());
    summary.set("modes.highest_hz", listed.hertz.maxCoeff());
  }
  set("modes.largest_error", listed.error);
  set("modes.largest_estimate", listed.estimate);
  if (!listed.growth) return;
  summary.set("modes.growing", listed.growth->modes);
  summary.set("modes.fastest_growth", listed.growth->fastest);
  if (!listed.coupledGrowth) return;
  summary.set("modes.coupled_growing", listed.coupledGrowth->modes);
  summary.set("modes.coupled_fastest_growth", listed.coupledGrowth->fastest);
}

ListedModes listModes(const Case& one, const RestingCase& rest, const ModesOptions& options) {
  const auto text = rest.describe();
  if (!text.empty()) log::info(text);
  const double t = options.time.value_or(timeOfLaws(one));
  if (!one.reduces()) {
    if (options.coupledOnly)
      throw UsageError(
          "`modes --coupled` lists the modes of a reduced model, but the deck has no list "
          "\"Reduction\". Add the list, or leave --coupled out.");
    return listFullModes(rest.full().model, options, t);
  }
  const auto reduced = reduce(one, rest);
  log::info(describeCoupling(reduced.coupled()));
  ListedModes listed;
  if (options.coupledOnly) {
    listed = listCoupledModes(reduced, options);
  } else {
    const auto full = rest.full();
    listed = listComparedModes(full.model, full.maps, reduced.unreduced.parts,
                               reduced.outcome.synthesis, options, t);
  }
  if (!reduced.outcome.rounds.empty()) log::info(estimate::roundTable(reduced.outcome.rounds));
  log::info(reduction::summaryTable(reduced.parts()));
  if (options.bases)
    for (const auto& part : reduced.parts()) log::info(part.report.table());
  return listed;
}

}  // namespace

double timeOfLaws(const Case& one) {
  return one.moves() ? one.transient().get<double>("End Time") : 0.0;
}

void listModes(const Case& one, const ModesOptions& options) {
  std::shared_ptr<const RestingCase> rest;
  ListedModes listed;
  const auto list = [&] {
    announce(one);
    rest = one.atRest();
    listed = listModes(one, *rest, options);
  };
  if (options.output.empty()) return list();
  AnalysisFiles files(one, options.output, "modes", Beside::Results);
  files.complete(list, [&](io::ResultsFile& file) {
    if (listed.undamped) listed.undamped->stage(files.folder().file("modes.csv"));
    if (listed.damped) listed.damped->stage(files.folder().file("damped_modes.csv"));
    rest->writeProfile(file);
    if (listed.shapes.cols() > 0) writeShapes(listed, file);
    summarise(listed, files.summary());
  });
}

}  // namespace tooljoint::cases
