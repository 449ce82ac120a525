// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>

#include "cases/imported/ImportedRecord.hpp"
#include "cases/run/AnalysisFiles.hpp"
#include "cases/run/Run.hpp"
#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "common/report/StageTimes.hpp"
#include "deck/PrintedUnits.hpp"
#include "response/Columns.hpp"
#include "response/Response.hpp"
#include "response/StringReport.hpp"
#include "response/SweepParameters.hpp"
#include "response/campbell/ModeSearch.hpp"

namespace tooljoint::response {

namespace {

using constants::rpmPerRadianPerSecond;

/// Formats responses according to the settings.
class Report {
 public:
  Report(const RotatingCase& rotating, const ResponseSettings& settings,
         const HarmonicResponse& response)
      : rotating_(rotating),
        settings_(settings),
        response_(response),
        largest_(largestAmplitudes(response)) {}

  void print() const {
    log::info("largest amplitudes from " +
              (settings_.bySpeed() ? rangeOf(settings_.speeds, rpmPerRadianPerSecond) + " rpm:"
                                   : rangeOf(settings_.frequencies) + " Hz, at " +
                                         formatNumber(rpm(settings_.rotarySpeed)) + " rpm:"));
    for (const auto& peak : response_.peaks) {
      const deck::PrintedUnit unit(unitOf(peak.load, peak.output));
      log::info(fmt::format(
          "  {:<24} {:>9.2f} rpm {:>10.4f} Hz  {:.4e} {:<10} phase {:>7.1f} deg{}",
          nameOf(peak.load, peak.output), rpm(peak.at.speed), peak.at.frequency,
          unit(std::abs(peak.at.x(peak.output, peak.load))), unit.name(),
          std::arg(peak.at.x(peak.output, peak.load)) * degrees,
          peak.at.estimate.size() > 0 ? fmt::format("  estimated error {:.1e}",
                                                    unit(peak.at.estimate(peak.output, peak.load)))
                                      : ""));
    }
    printEnds();
    if (!response_.checks.empty())
      log::info(fmt::format(
          "spot checks with the full model: largest error {:.1e} of the largest amplitude of an "
          "output ({})",
          worstError(),
          rotating_.estimated() ? fmt::format("estimate {:.1e}", worstEstimate(response_.checks))
                                : "without an estimate"));
    const double coarse = std::max(worstEstimate(response_.points), worstEstimate(response_.peaks));
    if (coarse > tooCoarse)
      log::warn(fmt::format(
          "The estimated error of the reduced model is {:.0f} % of the largest amplitude of an "
          "output. Keep more modes (Reduction/Mode Selection), or leave the list Reduction out.",
          100.0 * coarse));
    else if (!response_.checks.empty() && worstError() > tooCoarse)
      log::warn(fmt::format(
          "At a spot check the reduced model is off the full one by {:.0f} % of the largest "
          "amplitude of an output. Keep more modes (Reduction/Mode Selection), or leave the list "
          "Reduction out.",
          100.0 * worstError()));
    else
      warnOfPoorPoints();
    warnOfGrowth();
    warnOfMissingDamping();
    warnOfDeparture();
    StringReport(response_, settings_.bySpeed(), rotating_.estimated()).print();
  }

  void write(io::OutputFolder& folder, io::ResultsFile& file) const {
    table().write("response", folder, file);
    peakTable().write("peaks", folder, file);
    checkTable().write("spot_checks", folder, file);
    StringReport(response_, settings_.bySpeed(), rotating_.estimated()).write(folder, file);
    rotating_.rest().writeProfile(file);
    std::vector<std::string> outputs;
    for (const auto& output : settings_.outputs) outputs.push_back(output.name);
    file.write("/outputs", outputs, "Outputs in the order of the deck");
    file.write("/loads", response_.loads, "Load cases");
  }

  void summarise(io::Summary& summary) const {
    summary.set("response.model", rotating_.reduced() ? "reduced" : "full");
    summary.set("response.dofs", rotating_.model().size());
    summary.set("response.points", static_cast<long>(response_.points.size()));
    if (rotating_.estimated())
      summary.set("response.largest_estimate",
                  std::max(worstEstimate(response_.points), worstEstimate(response_.peaks)));
    if (!response_.checks.empty()) summary.set("response.largest_error", worstError());
    for (const auto& peak : response_.peaks) {
      const auto x = peak.at.x(peak.output, peak.load);
      io::SummaryRow row;
      row.set("load", response_.loads[at(peak.load)])
          .set("output", settings_.outputs[at(peak.output)].name)
          .set("speed_rpm", rpm(peak.at.speed))
          .set("hz", peak.at.frequency)
          .set("amplitude", std::abs(x))
          .set("unit", unitOf(peak.load, peak.output))
          .set("phase", std::arg(x));
      if (peak.at.estimate.size() > 0)
        row.set("estimate", peak.at.estimate(peak.output, peak.load));
      summary.append("response.peaks", row);
    }
    StringReport(response_, settings_.bySpeed(), rotating_.estimated()).summarise(summary);
  }

 private:
  /// Outputs whose largest amplitude is at an end of the sweep.
  void printEnds() const {
    const auto size = [](const ResponsePoint& point, int load, int output) {
      return std::abs(point.x(output, load));
    };
    const auto &first = response_.points.front(), &last = response_.points.back();
    for (int load = 0; load < loads(); ++load)
      for (int output = 0; output < outputs(); ++output) {
        const auto& end = size(first, load, output) > size(last, load, output) ? first : last;
        const double amplitude = size(end, load, output);
        if (!(amplitude > 0.0) || amplitude < largest_(output, load)) continue;
        const deck::PrintedUnit unit(unitOf(load, output));
        log::info(fmt::format("  {:<24} {:>9.2f} rpm {:>10.4f} Hz  {:.4e} {:<10} end of the sweep",
                              nameOf(load, output), rpm(end.speed), end.frequency, unit(amplitude),
                              unit.name()));
      }
  }

  /// Warns of inaccurate points. A very large amplitude at one point, as of a free body near 0 Hz,
  /// would hide errors as large as the amplitudes everywhere else.
  void warnOfPoorPoints() const {
    if (!rotating_.estimated()) return;
    int most = 0;
    std::string where;
    for (int load = 0; load < loads(); ++load)
      for (int output = 0; output < outputs(); ++output) {
        if (scale(load, output) > largest_(output, load)) continue;
        const auto poor = static_cast<int>(std::count_if(
            response_.points.begin(), response_.points.end(), [&](const ResponsePoint& point) {
              return point.estimate(output, load) > poorPoint * std::abs(point.x(output, load));
            }));
        if (poor > most) most = poor, where = nameOf(load, output);
      }
    if (most > poorShare * sizeOf(response_.points))
      log::warn(fmt::format(
          "At {} of {} points the estimated error of \"{}\" is above {:.0f} % of the amplitude "
          "there. Retain the dof of the load, or keep more modes (Reduction/Mode Selection).",
          most, response_.points.size(), where, 100.0 * poorPoint));
  }

  const ResponsePoint* farthest() const {
    const ResponsePoint* worst = nullptr;
    const auto look = [&](const ResponsePoint& point) {
      if (worst == nullptr || point.departure.part > worst->departure.part) worst = &point;
    };
    for (const auto& point : response_.points) look(point);
    for (const auto& peak : response_.peaks) look(peak.at);
    return worst;
  }
  void warnOfGrowth() const {
    if (!response_.growing) return;
    const auto& [speed, s] = *response_.growing;
    log::warn(fmt::format(
        "At {:.2f} rpm the state is unstable: {} as exp({:.3g} t), and the responses about it are "
        "never reached. tooljoint campbell shows from which speed on.",
        rpm(speed),
        vibrates(s) ? fmt::format("a vibration of {:.4g} Hz grows", s.imag() / constants::twoPi)
                    : std::string("it is left without vibration"),
        s.real()));
  }
  /// Warns of peaks of undamped modes, whose amplitude depends on the closest computed point.
  void warnOfMissingDamping() const {
    const auto isAtOne = [this](const ResponsePeak& peak) {
      const double where = settings_.bySpeed() ? peak.at.speed : peak.at.frequency;
      return std::any_of(response_.undamped.begin(), response_.undamped.end(),
                         [&](double at) { return std::abs(where - at) <= sameResonance * at; });
    };
    const auto first = std::find_if(response_.peaks.begin(), response_.peaks.end(), isAtOne);
    if (first == response_.peaks.end()) return;
    log::warn(fmt::format(
        "Modes have no damping: at {:.4g} Hz{} the amplitude has no bound, and that listed is the "
        "largest that was computed. Add damping; the other responses are right.",
        first->at.frequency,
        std::count_if(response_.peaks.begin(), response_.peaks.end(), isAtOne) > 1
            ? " and elsewhere"
            : ""));
  }
  void warnOfDeparture() const {
    const auto* worst = farthest();
    if (worst == nullptr || !(worst->departure.part > farFromLinear)) return;
    log::warn(fmt::format(
        "The linear response is not that of the scene: at {:.4g} Hz the forces of \"{}\" leave "
        "their tangents at rest by {:.2g} of the largest load. Reduce the loads, or run the "
        "motion.",
        worst->frequency, worst->departure.set, worst->departure.part));
  }

  /// An estimate above the first fraction of its amplitude makes a point useless; a warning is
  /// given if the fraction of such points exceeds the second.
  static constexpr double poorPoint = 0.2, poorShare = 0.25;
  /// A peak closer than this relative distance to a mode without damping belongs to that mode.
  static constexpr double sameResonance = 1e-5;
  /// A larger deviation of point laws from their tangents, relative to the largest load, causes a
  /// warning.
  static constexpr double farFromLinear = 0.1;
  /// A larger estimate or error, relative to the largest amplitude, causes a warning.
  static constexpr double tooCoarse = 0.05;
  /// An output below this fraction of the largest amplitude of its unit moves only by coupling of
  /// other directions, or by rounding.
  static constexpr double unmoved = 1e-6;
  static constexpr double degrees = 180.0 / constants::pi;
  static double rpm(double speed) { return speed * rpmPerRadianPerSecond; }

  int loads() const { return sizeOf(response_.loads); }
  int outputs() const { return sizeOf(settings_.outputs); }

  /// "bit", or for transfer functions "bit:table", output and load.
  std::string nameOf(int load, int output) const {
    const auto& name = settings_.outputs[at(output)].name;
    return settings_.excitation == Excitation::Transfer ? name + ":" + response_.loads[at(load)]
                                                        : name;
  }
  std::string unitOf(int load, int output) const {
    const auto unit = cases::unitOf(settings_.outputs[at(output)].dof.component);
    if (settings_.excitation != Excitation::Transfer) return unit.empty() ? "1" : unit;
    const bool moment = cases::unitOf(settings_.loads[at(load)].dof.component) == "rad";
    return (unit.empty() ? "1" : unit) + (moment ? "/(N m)" : "/N");
  }

  template <class Value>
  void addColumn(Columns& table, const std::string& name, const std::string& unit,
                 const std::string& longName, const Value& value) const {
    table.columns.push_back({name, unit, longName, collect(response_.points, value)});
  }

  Columns table() const {
    Columns table;
    addColumn(table, "speed", "rad/s", "Rotary speed", [](const auto& p) { return p.speed; });
    addColumn(table, "frequency", "Hz", "Frequency of the excitation",
              [](const auto& p) { return p.frequency; });
    for (int load = 0; load < loads(); ++load)
      for (int output = 0; output < outputs(); ++output) {
        const auto name = nameOf(load, output), unit = unitOf(load, output);
        addColumn(table, name + "_amplitude", unit, "|x|",
                  [=](const auto& p) { return std::abs(p.x(output, load)); });
        addColumn(table, name + "_phase", "rad", "Phase of x ahead of the load",
                  [=](const auto& p) { return std::arg(p.x(output, load)); });
        if (rotating_.estimated())
          addColumn(table, name + "_estimate", unit, "Estimate of |x - x_full|",
                    [=](const auto& p) { return p.estimate(output, load); });
      }
    StringReport(response_, settings_.bySpeed(), rotating_.estimated()).addColumns(table);
    return table;
  }

  Columns peakTable() const {
    const auto& peaks = response_.peaks;
    const auto value = [](const auto& p) { return p.at.x(p.output, p.load); };
    Columns table{{
        {"load", "1", "Load case, from 1",
         collect(peaks, [](const auto& p) { return p.load + 1; })},
        {"output", "1", "Output, from 1",
         collect(peaks, [](const auto& p) { return p.output + 1; })},
        {"speed", "rad/s", "Rotary speed",
         collect(peaks, [](const auto& p) { return p.at.speed; })},
        {"frequency", "Hz", "Frequency of the excitation",
         collect(peaks, [](const auto& p) { return p.at.frequency; })},
        {"amplitude", "1", "|x| in SI units",
         collect(peaks, [&](const auto& p) { return std::abs(value(p)); })},
        {"phase", "rad", "Phase of x ahead of the load",
         collect(peaks, [&](const auto& p) { return std::arg(value(p)); })},
    }};
    if (rotating_.estimated())
      table.columns.push_back(
          {"estimate", "1", "Estimate of |x - x_full| in SI units",
           collect(peaks, [](const auto& p) { return p.at.estimate(p.output, p.load); })});
    return table;
  }

  Columns checkTable() const {
    Columns table{{{"speed", "rad/s", "Rotary speed", {}},
                   {"frequency", "Hz", "Frequency of the excitation", {}},
                   {"load", "1", "Load case, from 1", {}},
                   {"output", "1", "Output, from 1", {}},
                   {"full", "1", "|x| of the full model in SI units", {}},
                   {"reduced", "1", "|x| of the reduced model in SI units", {}},
                   {"error", "1", "|x - x_full| in SI units", {}}}};
    if (rotating_.estimated())
      table.columns.push_back({"estimate", "1", "Estimate of that in SI units", {}});
    for (const auto& check : response_.checks)
      for (int load = 0; load < loads(); ++load)
        for (int output = 0; output < outputs(); ++output) {
          const auto full = check.full.x(output, load), reduced = check.reduced.x(output, load);
          std::vector<double> row{
              check.full.speed,  check.full.frequency,    load + 1.0, output + 1.0, std::abs(full),
              std::abs(reduced), std::abs(reduced - full)};
          if (rotating_.estimated()) row.push_back(check.reduced.estimate(output, load));
          for (std::size_t c = 0; c < row.size(); ++c) table.columns[c].values.push_back(row[c]);
        }
    return table;
  }

  /// Reference of errors: the largest amplitude of the output in the sweep. If the load does not
  /// move the output, the largest amplitude of outputs with the same unit.
  double scale(int load, int output) const {
    const double own = largest_(output, load);
    double ofUnit = own;
    for (int other = 0; other < outputs(); ++other)
      if (unitOf(load, other) == unitOf(load, output))
        ofUnit = std::max(ofUnit, largest_(other, load));
    if (own < unmoved * ofUnit) return ofUnit;
    return own > 0.0 ? own : 1.0;
  }

  /// Largest amplitude of every output and load in the sweep.
  static Matrix largestAmplitudes(const HarmonicResponse& response) {
    Matrix largest;
    const auto take = [&](const ResponsePoint& point) {
      if (largest.size() == 0) largest.setZero(point.x.rows(), point.x.cols());
      largest = largest.cwiseMax(point.x.cwiseAbs());
    };
    for (const auto& point : response.points) take(point);
    for (const auto& peak : response.peaks) take(peak.at);
    return largest;
  }

  double worstError() const {
    double worst = 0.0;
    for (const auto& check : response_.checks)
      for (int load = 0; load < loads(); ++load)
        for (int output = 0; output < outputs(); ++output)
          worst =
              std::max(worst, std::abs(check.full.x(output, load) - check.reduced.x(output, load)) /
                                  scale(load, output));
    return worst;
  }

  static const ResponsePoint& pointOf(const ResponsePoint& point) { return point; }
  static const ResponsePoint& pointOf(const ResponseCheck& check) { return check.reduced; }
  static const ResponsePoint& pointOf(const ResponsePeak& peak) { return peak.at; }
  template <class Points>
  double worstEstimate(const Points& points) const {
    double worst = 0.0;
    for (const auto& one : points) {
      const Matrix& estimate = pointOf(one).estimate;
      for (Eigen::Index load = 0; load < estimate.cols(); ++load)
        for (Eigen::Index output = 0; output < estimate.rows(); ++output)
          worst = std::max(worst, estimate(output, load) /
                                      scale(static_cast<int>(load), static_cast<int>(output)));
    }
    return worst;
  }

  const RotatingCase& rotating_;
  const ResponseSettings& settings_;
  const HarmonicResponse& response_;
  Matrix largest_;  ///< amplitudes, outputs x loads
};

}  // namespace

void runResponse(const cases::Case& one, const std::string& folder, bool fresh) {
  if (!one.list().isSublist("Response"))
    throw DeckError(one.deck().file() +
                    ": the deck has no list Response. Add one with a Highest Speed or a Highest "
                    "Frequency, and Outputs.");
  const auto settings = readResponse(one.list().sublist("Response"));
  cases::AnalysisFiles files(one, folder, "response");
  std::unique_ptr<RotatingCase> rotating;
  HarmonicResponse response;
  files.complete(
      [&] {
        cases::announce(one);
        rotating = std::make_unique<RotatingCase>(one, settings.friction);
        if (settings.bySpeed())
          rotating->announceLaws(settings.speeds);
        else if (one.list().isSublist("Rotary Speed") && !one.deck().gives("Response/Rotary Speed"))
          log::warn(
              "The string turns, but the response is that of 0 rpm. Give Response/Rotary "
              "Speed, 0 if that is meant.");
        rotating->announceUnknownStates();
        try {
          response = respond(*rotating, settings, {one, files.folder().folder(), fresh});
        } catch (const DeckError& fault) {
          throw DeckError(one.deck().located(fault.what()));
        }
        Report(*rotating, settings, response).print();
        logStageTimes();
      },
      [&](io::ResultsFile& file) {
        const Report report(*rotating, settings, response);
        report.write(files.folder(), file);
        report.summarise(files.summary());
      });
}

}  // namespace tooljoint::response
