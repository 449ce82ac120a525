// SPDX-License-Identifier: BSD-3-Clause
#include "response/Campbell.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cases/nodes/NodeDofs.hpp"
#include "common/Constants.hpp"
#include "common/Index.hpp"
#include "estimate/ModeMatching.hpp"
#include "linalg/DynamicStiffness.hpp"
#include "response/ModeTracker.hpp"
#include "response/SweepParameters.hpp"
#include "response/SweepProgress.hpp"

namespace tooljoint::response {

namespace {

using Complex = std::complex<double>;

/// Of |s|: a mode with less Im s does not vibrate.
constexpr double noVibration = 1e-6;
/// Relative distance of two values that are one repeated value: the whirl of its modes is
/// arbitrary.
constexpr double repeated = 1e-6;
/// Of the squared displacements of a shape, what less of it across the axis is rounding.
constexpr double noLateral = 1e-9;
/// A refined mode is that of the diagram when their MAC is not below this.
constexpr double sameMode = 0.5;
/// Of the frequency: |Im s - order Omega| at a crossing, and iterations allowed.
constexpr double crossed = 1e-10;
constexpr int mostIterations = 40;

/// With u = Re(U exp(i w t)), v likewise: u v' - v u' = w Im(U conj(V)) on average, so
///
///     whirl = 2 sum Im(U conj(V)) / sum (|U|^2 + |V|^2)
class Whirl {
 public:
  Whirl(const model::SecondOrderModel& model, const std::string& axis)
      : recovery_(model.recovery),
        width_(static_cast<Eigen::Index>(model.componentNames.size())),
        lateral_(cases::lateralComponents(model, axis)) {}

  double operator()(const Eigen::VectorXcd& shape) const {
    if (lateral_[0] < 0 || lateral_[1] < 0) return 0.0;
    const Vector re = recovery_ * Vector(shape.real()), im = recovery_ * Vector(shape.imag());
    double area = 0.0, size = 0.0;
    for (Eigen::Index row = 0; row + width_ <= re.size(); row += width_) {
      const Complex u(re[row + lateral_[0]], im[row + lateral_[0]]),
          v(re[row + lateral_[1]], im[row + lateral_[1]]);
      area += std::imag(u * std::conj(v));
      size += std::norm(u) + std::norm(v);
    }
    return size > noLateral * (re.squaredNorm() + im.squaredNorm()) ? 2.0 * area / size : 0.0;
  }

 private:
  Sparse recovery_;
  Eigen::Index width_;
  std::array<int, 2> lateral_;
};

VibratingModes vibrating(const linalg::QuadraticModes& modes) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index j = 0; j < modes.values.size(); ++j)
    if (modes.values[j].imag() > noVibration * std::abs(modes.values[j])) kept.push_back(j);
  VibratingModes out{
      Eigen::VectorXcd(static_cast<Eigen::Index>(kept.size())),
      Eigen::MatrixXcd(modes.vectors.rows(), static_cast<Eigen::Index>(kept.size()))};
  for (std::size_t k = 0; k < kept.size(); ++k) {
    out.values[static_cast<Eigen::Index>(k)] = modes.values[kept[k]];
    out.shapes.col(static_cast<Eigen::Index>(k)) = modes.vectors.col(kept[k]);
  }
  return out;
}

class Diagram {
 public:
  Diagram(const RotatingCase& rotating, const CampbellSettings& settings)
      : rotating_(rotating),
        settings_(settings),
        whirl_(rotating.model(), settings.axis),
        mass_(rotating.at(0.0).mass),
        tracker_([this](double speed, int count) { return modesAt(speed, count); }, mass_,
                 settings.modes) {}

  CampbellDiagram compute() {
    const auto checked =
        spread(settings_.speeds.size(), rotating_.reduced() ? settings_.spotChecks : 0);
    SweepProgress progress("campbell", settings_.speeds.size());
    for (std::size_t i = 0; i < settings_.speeds.size(); ++i) {
      const auto before = tracker_.now();
      tracker_.advance(settings_.speeds[i]);
      addRows();
      if (i > 0) addCrossings(settings_.speeds[i - 1], before);
      if (contains(checked, i)) addChecks();
      progress.done(i + 1);
    }
    std::stable_sort(out_.crossings.begin(), out_.crossings.end(),
                     [](const Crossing& a, const Crossing& b) {
                       return a.order != b.order ? a.order < b.order : a.at.speed < b.at.speed;
                     });
    return std::move(out_);
  }

 private:
  /// At least `count` modes that vibrate, where there are so many.
  VibratingModes modesAt(double speed, int count) {
    const auto m = rotating_.at(speed);
    for (int looked = count;; looked *= 2) {
      latest_ = rotating_.modes(m, looked);
      auto some = vibrating(latest_);
      if (some.values.size() >= count || latest_.values.size() < looked) return some;
    }
  }

  void addRows() {
    const auto& now = tracker_.now();
    const double speed = tracker_.speed();
    Eigen::VectorXcd errors;
    if (rotating_.estimated())
      errors = rotating_.error().ofModes(rotating_.partsAt(speed), rotating_.at(speed), latest_);
    for (const auto& mode : now) {
      CampbellRow row{speed, mode.track, mode.s, mode.mac, whirl_(mode.shape), 0.0};
      for (const auto& other : now)
        if (other.track != mode.track && std::abs(other.s - mode.s) < repeated * std::abs(mode.s))
          row.whirl = 0.0;
      for (Eigen::Index j = 0; j < errors.size(); ++j)
        if (latest_.values[j] == mode.s) row.error = std::abs(errors[j]) / std::abs(mode.s);
      out_.rows.push_back(row);
    }
  }

  void addCrossings(double from, const std::vector<TrackedMode>& before) {
    for (const auto& late : tracker_.now())
      for (const auto& early : before) {
        if (early.track != late.track) continue;
        for (const double order : settings_.orders) {
          const double a = early.s.imag() - order * from,
                       b = late.s.imag() - order * tracker_.speed();
          if ((a > 0.0) != (b > 0.0)) out_.crossings.push_back(crossing(order, from, early, late));
        }
      }
  }

  /// Im s(Omega) = order Omega by false position (Illinois), each value a refined mode.
  Crossing crossing(double order, double from, const TrackedMode& early, const TrackedMode& late) {
    const double to = tracker_.speed();
    double a = from, b = to, ga = early.s.imag() - order * a, gb = late.s.imag() - order * b;
    const double linear = a - ga * (b - a) / (gb - ga);
    Crossing found{order, *std::find_if(out_.rows.rbegin(), out_.rows.rend(),
                                        [&](const auto& row) { return row.mode == late.track; })};
    const double share = (linear - from) / (to - from);
    linalg::DampedMode guess{early.s + share * (late.s - early.s),
                             share < 0.5 ? early.shape : late.shape};
    const Complex interpolated = guess.s;
    int side = 0;  // that moved last: its opposite weighs half when it moves again
    for (int i = 0; i < mostIterations; ++i) {
      const double speed = a - ga * (b - a) / (gb - ga);
      const auto m = rotating_.at(speed);
      const auto mode = linalg::refine(m.mass, m.damping, m.stiffness, guess);
      if (!mode || !isSame(mode->shape, early, late)) break;
      guess = *mode;
      found.at.speed = speed;
      found.at.s = mode->s;
      const double g = mode->s.imag() - order * speed;
      if (std::abs(g) <= crossed * std::abs(mode->s) || b - a <= crossed * b) return found;
      if ((g > 0.0) == (ga > 0.0)) {
        a = speed, ga = g, gb *= side < 0 ? 0.5 : 1.0, side = -1;
      } else {
        b = speed, gb = g, ga *= side > 0 ? 0.5 : 1.0, side = 1;
      }
    }
    found.at.speed = linear;
    found.at.s = interpolated;
    found.refined = false;
    return found;
  }

  bool isSame(const Eigen::VectorXcd& shape, const TrackedMode& early,
              const TrackedMode& late) const {
    Eigen::MatrixXcd ends(shape.size(), 2);
    ends << early.shape, late.shape;
    return estimate::modalAssurance(mass_, shape, ends).maxCoeff() >= sameMode;
  }

  void addChecks() {
    const double speed = tracker_.speed();
    for (const auto& one : rotating_.compare(speed, settings_.modes)) {
      if (!(one.full.imag() > noVibration * std::abs(one.full))) continue;
      SpotCheck check{speed, 0, one.full, one.coupled, one.error, one.estimate, one.mac};
      for (const auto& mode : tracker_.now())
        if (std::abs(mode.s - one.coupled) < repeated * std::abs(mode.s)) check.mode = mode.track;
      out_.checks.push_back(check);
    }
  }

  const RotatingCase& rotating_;
  const CampbellSettings& settings_;
  Whirl whirl_;
  Sparse mass_;
  ModeTracker tracker_;
  linalg::QuadraticModes latest_;  ///< of all kinds, at the speed of the last call of modesAt()
  CampbellDiagram out_;
};

}  // namespace

double CampbellRow::frequency() const { return s.imag() / constants::twoPi; }
double CampbellRow::damping() const { return -s.real() / std::abs(s); }

CampbellDiagram campbell(const RotatingCase& rotating, const CampbellSettings& settings) {
  return Diagram(rotating, settings).compute();
}

}  // namespace tooljoint::response
