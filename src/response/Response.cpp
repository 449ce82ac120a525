// SPDX-License-Identifier: BSD-3-Clause
#include "response/Response.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <utility>

#include "cases/ListText.hpp"
#include "cases/nodes/NodeDofs.hpp"
#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Interrupt.hpp"
#include "common/Text.hpp"
#include "common/report/Progress.hpp"
#include "linalg/DynamicStiffness.hpp"
#include "model/SteadyRotation.hpp"
#include "response/Resonances.hpp"
#include "response/SweepParameters.hpp"

namespace tooljoint::response {

namespace {

constexpr Complex imaginary{0.0, 1.0};
/// Golden-section steps between the two neighbours of a largest amplitude. They locate a peak to
/// 0.4 % of the distance of the neighbours, which is at most half a width of its resonance, and
/// give its amplitude to 1e-5.
constexpr int goldenSteps = 13;
/// The points resolve resonances whose half width exceeds this multiple of their distance.
constexpr double seenWidth = 1.0;
/// Additional amplitudes at a narrower resonance, at these multiples of its half width.
constexpr double beside[] = {-2.0, -1.0, 0.0, 1.0, 2.0};
/// An output that changes by less than this fraction of its largest amplitude there does not
/// respond to the resonance.
constexpr double unseen = 1e-6;

/// If rounding of the stiffness contributes more than this fraction of the work of a load, the
/// response has no correct digits; the model is probably not supported.
constexpr double noDigits = 0.01;

constexpr int storeFormat = 4;  ///< raised when the meaning of a stored point changes

/// Rows of the recovery named in the deck.
struct Rows {
  std::vector<cases::NodeRow> loads, outputs;
  std::vector<std::array<cases::NodeRow, 2>> unbalances;
};

/// A load at one rotary speed in any model of the case.
class Loads {
 public:
  Loads(const ResponseSettings& settings, const Rows& rows) : settings_(settings), rows_(rows) {}

  /// Complex f, dofs x load cases: Re(f exp(i omega t)).
  ComplexMatrix on(const model::SecondOrderModel& model, double speed) const {
    switch (settings_.excitation) {
      case Excitation::Unbalance:
        return unbalance(model, speed);
      case Excitation::Harmonic: {
        ComplexMatrix f = ComplexMatrix::Zero(model.size(), 1);
        for (std::size_t i = 0; i < rows_.loads.size(); ++i)
          f += std::polar(settings_.loads[i].value, settings_.loads[i].phase) *
               cases::coefficients(model, rows_.loads[i]);
        return f;
      }
      case Excitation::Transfer:
        break;
    }
    return columns(model, rows_.loads);
  }

  ComplexMatrix outputs(const model::SecondOrderModel& model) const {
    return columns(model, rows_.outputs);
  }

 private:
  /// m e Omega^2 (cos, sin)(Omega t + phase) = Re(m e Omega^2 exp(i phase) (1, -i) exp(i Omega t));
  /// below a motor with Omega plus the speed of the motor. Masses of the scene turn with the
  /// string.
  ComplexMatrix unbalance(const model::SecondOrderModel& model, double rotary) const {
    const double speed = rotary + settings_.motorSpeed;
    ComplexMatrix f = model::turningLoad(model, rotary);
    if (settings_.motorSpeed > 0.0) f.setZero();
    for (std::size_t i = 0; i < rows_.unbalances.size(); ++i) {
      const auto& one = settings_.unbalances[i];
      const Complex turning = std::polar(one.value * speed * speed, one.phase);
      f += turning * cases::coefficients(model, rows_.unbalances[i][0]) -
           imaginary * turning * cases::coefficients(model, rows_.unbalances[i][1]);
    }
    return f;
  }

  static ComplexMatrix columns(const model::SecondOrderModel& model,
                               const std::vector<cases::NodeRow>& rows) {
    ComplexMatrix c(model.size(), static_cast<Eigen::Index>(rows.size()));
    for (std::size_t i = 0; i < rows.size(); ++i)
      c.col(static_cast<Eigen::Index>(i)) = cases::coefficients(model, rows[i]).cast<Complex>();
    return c;
  }

  const ResponseSettings& settings_;
  const Rows& rows_;
};

class Sweep {
 public:
  Sweep(const RotatingCase& rotating, const ResponseSettings& settings,
        const cases::RowFolder& store)
      : rotating_(rotating),
        settings_(settings),
        store_(store),
        rows_(find()),
        loads_(settings, rows_),
        along_(rotating, settings.axis) {}

  HarmonicResponse compute() {
    HarmonicResponse out;
    out.loads = caseNames();
    const auto& sweep = sweepOf();
    cases::RowKeys keys{"points", whose(), {}};
    for (const double where : sweep) keys.rows.push_back(fmt::format("{}", where));
    out.points = resumed(keys, [&](std::size_t i) { return at(sweep[i], true, true); });
    addPeaks(out);
    if (rotating_.reduced() && settings_.spotChecks > 0) addChecks(out);
    if (lookedAlong()) {
      out.nodes = along_.nodes();
      out.elements = along_.elements();
    }
    return out;
  }

 private:
  /// Data that determine a point in addition to its position in the sweep.
  std::string whose() const {
    auto own = store_.owner.list().sublist("Response");
    for (const char* name : {"Lowest Speed", "Highest Speed", "Lowest Frequency",
                             "Highest Frequency", "Points", "Spot Checks"})
      own.remove(name, false);
    return fmt::format("response {}\n{}\n{}\n{}", storeFormat, cases::identity(store_.owner),
                       cases::canonicalText(own), settings_.bySpeed());
  }

  /// Points with these keys, computed or stored.
  template <class Compute>
  std::vector<ResponsePoint> resumed(const cases::RowKeys& keys, const Compute& compute) const {
    Progress progress("response, " + keys.plural, static_cast<double>(keys.rows.size()));
    auto found = cases::resumedRows<ResponsePoint>(store_, keys, [&](std::size_t i) {
      if (interruptRequested()) throw InterruptedError("Interrupted.");
      auto point = compute(i);
      progress.update(static_cast<double>(i + 1));
      return point;
    });
    progress.finish();
    return found;
  }

  std::vector<std::string> caseNames() const {
    if (settings_.excitation == Excitation::Unbalance) return {"unbalance"};
    if (settings_.excitation == Excitation::Harmonic) return {"loads"};
    std::vector<std::string> names;
    for (const auto& load : settings_.loads) names.push_back(load.name);
    return names;
  }

  cases::NodeRow row(const cases::NodeDof& dof) const {
    const auto found = cases::findRow(rotating_.rest(), rotating_.model(), dof);
    if (cases::coefficients(rotating_.model(), found).isZero(0.0))
      throw DeckError(dof.where + " is " + dof.component + " of node " + std::to_string(dof.node) +
                      ", which is held. Choose a dof that is free.");
    return found;
  }

  Rows find() const {
    const auto& model = rotating_.model();
    Rows rows;
    for (const auto& load : settings_.loads) rows.loads.push_back(row(load.dof));
    for (const auto& output : settings_.outputs) rows.outputs.push_back(row(output.dof));
    const auto lateral = cases::lateralComponents(model, settings_.axis);
    for (const auto& one : settings_.unbalances) {
      if (lateral[0] < 0 || lateral[1] < 0)
        throw DeckError(one.dof.where + " is an unbalance about the axis " + settings_.axis +
                        ", but the nodes of the scene have no translations across it.");
      std::array<cases::NodeRow, 2> pair;
      for (std::size_t i = 0; i < 2; ++i) {
        auto dof = one.dof;
        dof.component = model.componentNames[tooljoint::at(lateral[i])];
        pair[i] = row(dof);
      }
      rows.unbalances.push_back(pair);
    }
    const bool below = settings_.motorSpeed > 0.0;
    if (settings_.excitation == Excitation::Unbalance && rows.unbalances.empty() && below)
      throw DeckError(rotating_.deckCase().deck().error(
          "Response/Motor Speed",
          "is the speed of the masses in Response/Unbalance, but there are none; those of "
          "Loads/Unbalance turn with the string. Add a list, or leave the motor out."));
    if (settings_.excitation == Excitation::Unbalance && rows.unbalances.empty() &&
        model::turningLoad(model, 1.0).isZero(0.0))
      throw DeckError(rotating_.deckCase().deck().error(
          "Response/Excitation",
          "is \"Unbalance\", but the scene has no mass off its axis. Add a list to "
          "Response/Unbalance, or to Loads/Unbalance of a string that turns."));
    return rows;
  }

  /// \param where  rotary speed [rad/s] or frequency [Hz]
  /// \param whole  with estimate and margin
  /// \param given  true for points of the sweep; false close to resonances, which may lose digits
  ResponsePoint at(double where, bool whole = true, bool given = false) const {
    ResponsePoint point;
    point.speed = settings_.bySpeed() ? where : settings_.rotarySpeed;
    const double omega = settings_.omega(where);
    point.frequency = omega / constants::twoPi;
    const Complex s = imaginary * omega;
    const auto m = rotating_.at(point.speed, omega);
    linalg::DynamicStiffness Q(m.mass, m.damping, m.stiffness, s);
    if (Q.singular()) throw singular(point);
    const ComplexMatrix f = loads_.on(rotating_.model(), point.speed), y = Q.solve(f);
    for (Eigen::Index j = 0; given && j < f.cols(); ++j)
      if (rotating_.rounding(m, y.col(j)) > noDigits * y.col(j).cwiseAbs().dot(f.col(j).cwiseAbs()))
        throw singular(point);
    const ComplexMatrix c = loads_.outputs(rotating_.model());
    point.x = c.transpose() * y;
    if (!whole) return point;
    if (lookedAlong()) point.along = along_.of(y.col(0));
    if (settings_.excitation != Excitation::Transfer)
      point.departure =
          departure(rotating_.turned(point.speed), rotating_.time(), omega, y.col(0), f.col(0));
    if (rotating_.estimated()) takeEstimates(point, s, y, Q);
    return point;
  }

  bool lookedAlong() const {
    return settings_.excitation != Excitation::Transfer && !along_.empty();
  }

  ModelError singular(const ResponsePoint& point) const {
    return ModelError("The dynamic stiffness at " + formatNumber(point.frequency) +
                      " Hz is singular: the model has an undamped resonance there, or it is not "
                      "supported. Add damping or supports, or leave this frequency out (Response/" +
                      (settings_.bySpeed() ? "Lowest Speed" : "Lowest Frequency") + ").");
  }

  /// The outputs of the deck and the extremes along the string in any model of the case.
  ComplexMatrix outputs(const model::SecondOrderModel& model, const ResponsePoint& point) const {
    const ComplexMatrix given = loads_.outputs(model), along = along_.outputs(model, point.along);
    ComplexMatrix all(given.rows(), given.cols() + along.cols());
    all << given, along;
    return all;
  }

  void takeEstimates(ResponsePoint& point, Complex s, const ComplexMatrix& y,
                     linalg::DynamicStiffness& Q) const {
    std::vector<ComplexMatrix> loads, outputsOfParts;
    for (const auto& part : rotating_.parts()) {
      loads.push_back(loads_.on(part.model, point.speed));
      outputsOfParts.push_back(outputs(part.model, point));
    }
    const ComplexMatrix z = Q.solveTransposed(outputs(rotating_.model(), point));
    const Matrix errors =
        rotating_.error()
            .ofResponses(rotating_.partsAt(point.speed, s.imag()), s, y, loads, z, outputsOfParts)
            .cwiseAbs();
    const auto given = static_cast<Eigen::Index>(settings_.outputs.size());
    point.estimate = errors.topRows(given);
    AlongString::takeEstimates(errors.col(0).tail(errors.rows() - given), point.along);
  }

  ResponsePoint fullAt(const ResponsePoint& reduced) const {
    ResponsePoint point;
    point.speed = reduced.speed;
    point.frequency = reduced.frequency;
    const double omega = constants::twoPi * point.frequency;
    const auto m = rotating_.fullAt(point.speed, omega);
    const linalg::DynamicStiffness Q(m.mass, m.damping, m.stiffness, imaginary * omega);
    if (Q.singular()) throw singular(point);
    const ComplexMatrix y = Q.solve(loads_.on(rotating_.full(), point.speed));
    point.x = loads_.outputs(rotating_.full()).transpose() * y;
    if (lookedAlong()) point.along = along_.ofFull(y.col(0), reduced.along);
    return point;
  }

  /// Solves the full model at points spread over the sweep, and at the highest peak of every
  /// output.
  void addChecks(HarmonicResponse& out) const {
    for (const auto i : spread(out.points.size(), settings_.spotChecks))
      out.checks.push_back({out.points[i], fullAt(out.points[i])});
    std::map<std::pair<int, int>, const ResponsePeak*> highest;
    for (const auto& peak : out.peaks) {
      auto& best = highest.try_emplace({peak.load, peak.output}, &peak).first->second;
      if (amplitude(peak) > amplitude(*best)) best = &peak;
    }
    for (const auto& [which, peak] : highest) out.checks.push_back({peak->at, fullAt(peak->at)});
  }

  static double amplitude(const ResponsePeak& peak) {
    return std::abs(peak.at.x(peak.output, peak.load));
  }

  double whereOf(const ResponsePoint& point) const {
    return settings_.bySpeed() ? point.speed : point.frequency;
  }

  /// A local maximum of the amplitude and its neighbours.
  struct Bracket {
    int load = 0, output = 0;
    double from = 0.0, middle = 0.0, to = 0.0;
    double size = 0.0;  ///< at `middle`
  };

  /// Amplitudes at a place of the sweep, outputs x load cases.
  struct Sample {
    double where = 0.0;
    Matrix size;
  };

  const std::vector<double>& sweepOf() const {
    return settings_.bySpeed() ? settings_.speeds : settings_.frequencies;
  }
  /// Distance of the points of the sweep.
  double distance() const {
    const auto& sweep = sweepOf();
    return (sweep.back() - sweep.front()) / static_cast<double>(sweep.size() - 1);
  }

  /// Samples around each resonance that is too narrow for the points.
  std::vector<std::vector<Sample>> besideNarrow(const std::vector<Resonance>& resonances) const {
    const auto& sweep = sweepOf();
    std::vector<std::vector<Sample>> found;
    for (const auto& one : resonances) {
      if (one.width > seenWidth * distance()) continue;
      auto& samples = found.emplace_back();
      for (const double widths : beside) {
        const double where = one.where + widths * one.width;
        if (!one.damped && widths == 0.0) continue;  // the dynamic stiffness is singular
        if (where > sweep.front() && where < sweep.back())
          samples.push_back({where, at(where, false).x.cwiseAbs()});
      }
    }
    return found;
  }

  /// Amplitudes of one output under one load: at the points, and at the narrow resonances to which
  /// it responds.
  std::vector<std::pair<double, double>> amplitudes(const std::vector<ResponsePoint>& points,
                                                    const std::vector<std::vector<Sample>>& narrow,
                                                    int load, int output) const {
    std::vector<std::pair<double, double>> all;
    for (const auto& point : points)
      all.emplace_back(whereOf(point), std::abs(point.x(output, load)));
    for (const auto& samples : narrow) {
      const auto [least, most] = std::minmax_element(
          samples.begin(), samples.end(), [&](const Sample& a, const Sample& b) {
            return a.size(output, load) < b.size(output, load);
          });
      if (least == samples.end() ||
          most->size(output, load) - least->size(output, load) <= unseen * most->size(output, load))
        continue;
      for (const auto& one : samples) all.emplace_back(one.where, one.size(output, load));
    }
    std::sort(all.begin(), all.end());
    return all;
  }

  std::vector<Bracket> brackets(const std::vector<ResponsePoint>& points,
                                const std::vector<std::vector<Sample>>& narrow, int load,
                                int output) const {
    std::vector<Bracket> found;
    const auto all = amplitudes(points, narrow, load, output);
    for (std::size_t i = 1; i + 1 < all.size(); ++i)
      if (all[i].second > all[i - 1].second && all[i].second >= all[i + 1].second)
        found.push_back(
            {load, output, all[i - 1].first, all[i].first, all[i + 1].first, all[i].second});
    return found;
  }

  void addPeaks(HarmonicResponse& out) const {
    const auto found = resonances(rotating_, settings_);
    out.growing = found.growing;
    for (const auto& one : found.found)
      if (!one.damped) out.undamped.push_back(one.where);
    const auto narrow = besideNarrow(found.found);
    std::vector<Bracket> all;
    for (int load = 0; load < static_cast<int>(out.loads.size()); ++load)
      for (int output = 0; output < sizeOf(settings_.outputs); ++output)
        for (const auto& one : brackets(out.points, narrow, load, output)) all.push_back(one);
    cases::RowKeys keys{"peaks", whose(), {}};
    for (const auto& one : all)
      keys.rows.push_back(fmt::format("{} {} {} {}", one.load, one.output, one.from, one.to));
    const auto peaks = resumed(keys, [&](std::size_t i) { return peak(all[i]); });
    for (std::size_t i = 0; i < all.size(); ++i)
      out.peaks.push_back({all[i].load, all[i].output, peaks[i]});
  }

  /// Golden section in the larger side of the largest point, which is thus never lost.
  ResponsePoint peak(const Bracket& bracket) const {
    const double section = 0.5 * (3.0 - std::sqrt(5.0));
    double a = bracket.from, best = bracket.middle, b = bracket.to, most = bracket.size;
    for (int k = 0; k < goldenSteps; ++k) {
      const bool above = b - best > best - a;
      const double probe = best + section * (above ? b - best : a - best);
      const double size = std::abs(at(probe, false).x(bracket.output, bracket.load));
      if (size > most) {
        (above ? a : b) = best;
        best = probe, most = size;
      } else {
        (above ? b : a) = probe;
      }
    }
    return at(best);
  }

  const RotatingCase& rotating_;
  const ResponseSettings& settings_;
  const cases::RowFolder& store_;
  Rows rows_;
  Loads loads_;
  AlongString along_;
};

}  // namespace

double ResponseSettings::omega(double where) const {
  return bySpeed() ? order * where + offset() : constants::twoPi * where;
}

HarmonicResponse respond(const RotatingCase& rotating, const ResponseSettings& settings,
                         const cases::RowFolder& store) {
  return Sweep(rotating, settings, store).compute();
}

}  // namespace tooljoint::response
