// SPDX-License-Identifier: BSD-3-Clause
#include "response/campbell/Campbell.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <utility>

#include "cases/ListText.hpp"
#include "cases/nodes/NodeDofs.hpp"
#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Interrupt.hpp"
#include "common/Parallel.hpp"
#include "common/report/Progress.hpp"
#include "common/report/Stopwatch.hpp"
#include "estimate/ModeMatching.hpp"
#include "linalg/DynamicStiffness.hpp"
#include "response/SweepParameters.hpp"
#include "response/campbell/ModeSearch.hpp"

namespace tooljoint::response {

namespace {

/// Values with a smaller relative distance are one repeated value; the whirl of its modes is
/// arbitrary.
constexpr double repeated = 1e-6;
/// A smaller fraction of the squared displacements normal to the axis is rounding.
constexpr double noLateral = 1e-9;
/// A refined mode with at least this MAC is the mode of the diagram.
constexpr double sameMode = 0.5;
constexpr int storeFormat = 2;     ///< raised when the meaning of a stored diagram changes
constexpr double keptEvery = 0.2;  ///< [s]
/// Tolerance of |Im s - excitation| at a crossing, relative to the frequency: for one state, and
/// for states that each have their own tolerance. Number of iterations.
constexpr double crossed = 1e-10, crossedStates = 1e-6;
constexpr int mostIterations = 40;

/// Displacements of a mode and its sense. With u = Re(U exp(i w t)), v likewise, u v' - v u' =
/// w Im(U conj(V)) on average, so
///
///     whirl = 2 sum Im(U conj(V)) / sum (|U|^2 + |V|^2)
class Shapes {
 public:
  Shapes(const RotatingStates& states, const std::string& axis)
      : states_(states),
        width_(static_cast<Eigen::Index>(states.first().model().componentNames.size())),
        lateral_(cases::lateralComponents(states.first().model(), axis)) {}

  double whirl(const Eigen::VectorXcd& shape) const {
    if (lateral_[0] < 0 || lateral_[1] < 0) return 0.0;
    const auto x = states_.recovered(shape);
    double area = 0.0, size = 0.0;
    for (Eigen::Index row = 0; row + width_ <= x.size(); row += width_) {
      const Complex u = x[row + lateral_[0]], v = x[row + lateral_[1]];
      area += std::imag(u * std::conj(v));
      size += std::norm(u) + std::norm(v);
    }
    return size > noLateral * x.squaredNorm() ? 2.0 * area / size : 0.0;
  }

  /// Rows of the recovery, scaled as ModeShape::shape.
  Eigen::VectorXcd scaled(const Eigen::VectorXcd& shape) const {
    const auto x = states_.recovered(shape);
    Complex largest = 0.0, lateral = 0.0;
    const auto take = [](Complex& best, Complex one) {
      if (std::abs(one) > std::abs(best)) best = one;
    };
    for (Eigen::Index row = 0; row < x.size(); ++row) take(largest, x[row]);
    for (Eigen::Index row = 0; row + width_ <= x.size(); row += width_)
      for (const int component : lateral_)
        if (component >= 0) take(lateral, x[row + component]);
    if (std::norm(lateral) > noLateral * x.squaredNorm()) largest = lateral;
    return largest == 0.0 ? x : Eigen::VectorXcd(x / largest);
  }

 private:
  const RotatingStates& states_;
  Eigen::Index width_;
  std::array<int, 2> lateral_;
};

class Diagram {
 public:
  Diagram(const RotatingStates& states, const CampbellSettings& settings,
          const cases::RowFolder& store)
      : states_(states),
        settings_(settings),
        search_(states, settings),
        shapes_(states, settings.axis),
        mass_(states.mass()),
        tracker_([this](double speed, int followed) { return search_.at(speed, followed); }, mass_),
        store_(store),
        keys_(keysOf(store, settings)) {}

  CampbellDiagram compute() {
    const auto checked =
        spread(settings_.speeds.size(), states_.first().reduced() ? settings_.spotChecks : 0);
    const std::size_t drawn = shapePlace(), speeds = settings_.speeds.size();
    Progress progress("campbell", static_cast<double>(speeds));
    for (auto i = goOn(); i < speeds; ++i) {
      const bool stops = anyRank(interruptRequested());
      if (stops || anyRank(unkept_.wall() > keptEvery)) keep(i);
      if (stops)
        throw InterruptedError(
            cases::interruptedSentence(keys_, static_cast<int>(i), store_.folder));
      const auto before = tracker_.now();
      tracker_.advance(settings_.speeds[i]);
      addRows();
      if (i == drawn) addShapes();
      if (contains(checked, i)) addChecks();
      if (i > 0) addCrossings(settings_.speeds[i - 1], before);
      if (i > 0) addLimits(settings_.speeds[i - 1], before);
      progress.update(static_cast<double>(i + 1));
    }
    progress.finish();
    std::stable_sort(out_.crossings.begin(), out_.crossings.end(),
                     [](const Crossing& a, const Crossing& b) {
                       return a.line != b.line ? a.line < b.line : a.at.speed < b.at.speed;
                     });
    std::stable_sort(crossingShapes_.begin(), crossingShapes_.end(),
                     [](const ModeShape& a, const ModeShape& b) {
                       return a.line != b.line ? a.line < b.line : a.at.speed < b.at.speed;
                     });
    std::move(crossingShapes_.begin(), crossingShapes_.end(), std::back_inserter(out_.shapes));
    return std::move(out_);
  }

 private:
  static cases::RowKeys keysOf(const cases::RowFolder& store, const CampbellSettings& settings) {
    const auto& own = store.owner.list().sublist("Campbell");
    return {"speeds",
            fmt::format("campbell {}\n{}\n{}", storeFormat, cases::identity(store.owner),
                        cases::canonicalText(own)),
            std::vector<std::string>(settings.speeds.size())};
  }

  static bool anyRank(bool condition) { return parallel::maximum(condition ? 1.0 : 0.0) > 0.0; }

  /// Progress of the diagram.
  struct Reached {
    std::size_t done = 0;  ///< number of speeds
    ModeTracker::Position position;
    CampbellDiagram diagram;
    std::vector<ModeShape> crossingShapes;

    template <class Archive>
    void serialize(Archive& archive) {
      archive(done, position, diagram, crossingShapes);
    }
  };

  /// Restores the progress; returns the number of stored speeds.
  std::size_t goOn() {
    auto reached = cases::restoreReached<Reached>(store_, keys_);
    tracker_.goOnFrom(std::move(reached.position));
    out_ = std::move(reached.diagram);
    crossingShapes_ = std::move(reached.crossingShapes);
    return reached.done;
  }

  void keep(std::size_t speeds) {
    cases::keepReached(store_, keys_, Reached{speeds, tracker_.position(), out_, crossingShapes_});
    unkept_ = Stopwatch();
  }

  /// Index of the speed whose shapes are written.
  std::size_t shapePlace() const {
    const auto& speeds = settings_.speeds;
    if (!settings_.shapeSpeed) return speeds.size() - 1;
    const double wanted = *settings_.shapeSpeed;
    const auto nearest = std::min_element(
        speeds.begin(), speeds.end(),
        [wanted](double a, double b) { return std::abs(a - wanted) < std::abs(b - wanted); });
    return static_cast<std::size_t>(nearest - speeds.begin());
  }

  void addRows() {
    const auto& now = tracker_.now();
    const double speed = tracker_.speed();
    Eigen::VectorXcd errors;
    if (states_.first().estimated()) errors = search_.errors(speed);
    if (states_.ofEachSpeed())
      out_.states.push_back({speed, states_.about(speed)->rest().figures()});
    const auto& latest = search_.latest();
    Divergence diverges{speed, 0.0};
    for (const Complex s : latest.values)
      if (!vibrates(s)) diverges.growth = std::max(diverges.growth, s.real());
    if (diverges.growth > 0.0) out_.divergences.push_back(diverges);
    for (const auto& mode : now) {
      if (!search_.shown(mode.s)) continue;
      CampbellRow row{speed, mode.track, mode.s, mode.mac, shapes_.whirl(mode.shape), 0.0};
      for (const auto& other : now)
        if (other.track != mode.track && std::abs(other.s - mode.s) < repeated * std::abs(mode.s))
          row.whirl = 0.0;
      for (Eigen::Index j = 0; j < errors.size(); ++j)
        if (latest.values[j] == mode.s) row.error = std::abs(errors[j]) / std::abs(mode.s);
      out_.rows.push_back(row);
    }
  }

  /// Adds the shapes of the rows added last.
  void addShapes() {
    for (const auto& row : out_.rows)
      if (row.speed == tracker_.speed())
        for (const auto& mode : tracker_.now())
          if (mode.track == row.mode) out_.shapes.push_back({row, -1, shapes_.scaled(mode.shape)});
  }

  void addCrossings(double from, const std::vector<TrackedMode>& before) {
    for (const auto& late : tracker_.now())
      for (const auto& early : before) {
        if (early.track != late.track) continue;
        for (std::size_t line = 0; line < settings_.lines.size(); ++line) {
          const double a = early.s.imag() - settings_.lines[line].at(from),
                       b = late.s.imag() - settings_.lines[line].at(tracker_.speed());
          if ((a > 0.0) != (b > 0.0)) addCrossing(line, from, early, late);
        }
      }
  }

  void addCrossing(std::size_t line, double from, const TrackedMode& early,
                   const TrackedMode& late) {
    linalg::DampedMode mode;
    const auto found = crossing(line, from, early, late, mode);
    if (!search_.shown(found.at.s)) return;
    out_.crossings.push_back(found);
    crossingShapes_.push_back({found.at, static_cast<int>(line), shapes_.scaled(mode.shape)});
  }

  Crossing crossing(std::size_t line, double from, const TrackedMode& early,
                    const TrackedMode& late, linalg::DampedMode& guess) {
    const auto& excitation = settings_.lines[line];
    const auto found =
        root([&](double speed, Complex s) { return s.imag() - excitation.at(speed); }, from, early,
             late, guess);
    Crossing there{line, found.at, found.refined};
    if (there.refined && there.at.whirl != 0.0) there.at.whirl = shapes_.whirl(guess.shape);
    return there;
  }

  /// Adds the limits between two speeds at which modes begin or cease to grow.
  void addLimits(double from, const std::vector<TrackedMode>& before) {
    for (const auto& late : tracker_.now())
      for (const auto& early : before) {
        if (early.track != late.track || (grows(early.s) == grows(late.s))) continue;
        linalg::DampedMode mode;
        const auto found =
            root([](double, Complex s) { return s.real(); }, from, early, late, mode);
        if (search_.shown(found.at.s))
          out_.limits.push_back({found.at, grows(late.s), found.refined});
      }
  }

  struct Root {
    CampbellRow at;
    bool refined = true;
  };

  /// g(Omega, s(Omega)) = 0 between two speeds by false position (Illinois); each value is a
  /// refined mode. \param guess  the mode there
  template <class Function>
  Root root(const Function& g, double from, const TrackedMode& early, const TrackedMode& late,
            linalg::DampedMode& guess) {
    const double to = tracker_.speed();
    const double close = states_.ofEachSpeed() ? crossedStates : crossed;
    double a = from, b = to, ga = g(a, early.s), gb = g(b, late.s);
    const double linear = a - ga * (b - a) / (gb - ga);
    Root found{nearestRow(late.track)};
    const double share = (linear - from) / (to - from);
    guess = {early.s + share * (late.s - early.s), share < 0.5 ? early.shape : late.shape};
    const Complex interpolated = guess.s;
    int side = 0;  // end moved last; if it moves again, the value at the other end is halved
    for (int i = 0; i < mostIterations; ++i) {
      const double speed = a - ga * (b - a) / (gb - ga);
      const auto mode = refined(speed, guess);
      if (!mode || !isSame(mode->shape, early, late)) break;
      guess = *mode;
      found.at.speed = speed;
      found.at.s = mode->s;
      const double value = g(speed, mode->s);
      if (std::abs(value) <= close * std::abs(mode->s) || b - a <= close * b) return found;
      if ((value > 0.0) == (ga > 0.0)) {
        a = speed, ga = value, gb *= side < 0 ? 0.5 : 1.0, side = -1;
      } else {
        b = speed, gb = value, ga *= side > 0 ? 0.5 : 1.0, side = 1;
      }
    }
    found.at.speed = linear;
    found.at.s = interpolated;
    found.refined = false;
    return found;
  }

  /// The mode at a speed close to a guess; both as common shapes.
  std::optional<linalg::DampedMode> refined(double speed, linalg::DampedMode guess) const {
    const auto rotating = states_.about(speed);
    const auto m = rotating->at(speed);
    guess.shape = states_.own(*rotating, guess.shape);
    auto mode = linalg::refine(m.mass, m.damping, m.stiffness, guess);
    if (mode) mode->shape = states_.common(*rotating, mode->shape);
    return mode;
  }

  /// The last row of a track; without values if the window has not contained it yet.
  CampbellRow nearestRow(int track) const {
    const auto found = std::find_if(out_.rows.rbegin(), out_.rows.rend(),
                                    [&](const auto& row) { return row.mode == track; });
    if (found != out_.rows.rend()) return *found;
    CampbellRow none;
    none.mode = track;
    return none;
  }

  bool isSame(const Eigen::VectorXcd& shape, const TrackedMode& early,
              const TrackedMode& late) const {
    Eigen::MatrixXcd ends(shape.size(), 2);
    ends << early.shape, late.shape;
    return estimate::modalAssurance(mass_, shape, ends).maxCoeff() >= sameMode;
  }

  void addChecks() {
    const double speed = tracker_.speed();
    for (const auto& one : search_.compare(speed)) {
      SpotCheck check{speed, 0, one.full, one.coupled, one.error, one.estimate, one.mac};
      for (const auto& mode : tracker_.now())
        if (std::abs(mode.s - one.coupled) < repeated * std::abs(mode.s)) check.mode = mode.track;
      out_.checks.push_back(check);
    }
  }

  const RotatingStates& states_;
  const CampbellSettings& settings_;
  ModeSearch search_;
  Shapes shapes_;
  Sparse mass_;
  ModeTracker tracker_;
  std::vector<ModeShape> crossingShapes_;
  CampbellDiagram out_;
  const cases::RowFolder& store_;
  cases::RowKeys keys_;
  Stopwatch unkept_;  ///< time since the diagram was stored
};

}  // namespace

double CampbellRow::frequency() const { return s.imag() / constants::twoPi; }
double CampbellRow::damping() const { return 0.0 - s.real() / std::abs(s); }

CampbellDiagram campbell(const RotatingStates& states, const CampbellSettings& settings,
                         const cases::RowFolder& store) {
  return Diagram(states, settings, store).compute();
}

}  // namespace tooljoint::response
