// SPDX-License-Identifier: BSD-3-Clause
#include "response/Resonances.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/Constants.hpp"
#include "linalg/DynamicStiffness.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "reduction/part/Partition.hpp"
#include "response/SweepParameters.hpp"
#include "response/campbell/ModeSearch.hpp"
#include "stability/StateStability.hpp"

namespace tooljoint::response {

namespace {

/// A mode with less damping, as a fraction of |s|, has no finite peak.
constexpr double noDamping = 1e-9;
/// Relative distance from such a resonance at which amplitudes are computed.
constexpr double nearUndamped = 1e-6;
/// Modes computed beyond the undamped ones up to the highest frequency, and largest total number.
constexpr int moreModes = 8, mostModes = 256;
/// Number of speeds of a sweep for which modes are computed.
constexpr int lookedSpeeds = 5;
/// Largest number of iterations to a resonance of the sweep, and its relative accuracy.
constexpr int mostIterations = 30;
constexpr double close = 1e-9;
/// Resonances from two speeds are the same if closer than this relative distance or half their
/// width.
constexpr double samePlace = 1e-4;

class Search {
 public:
  Search(const RotatingCase& rotating, const ResponseSettings& settings)
      : rotating_(rotating),
        settings_(settings),
        sweep_(settings.bySpeed() ? settings.speeds : settings.frequencies),
        perUnit_(settings.bySpeed() ? settings.order : constants::twoPi),
        offset_(settings.bySpeed() ? settings.offset() : 0.0) {}

  Resonances run() {
    if (!settings_.bySpeed()) {
      look(settings_.rotarySpeed);
    } else {
      for (const auto i : spread(sweep_.size(), lookedSpeeds)) look(sweep_[i]);
    }
    auto& found = out_.found;
    std::sort(found.begin(), found.end(),
              [](const auto& a, const auto& b) { return a.where < b.where; });
    found.erase(std::unique(found.begin(), found.end(),
                            [](const auto& a, const auto& b) {
                              return b.where - a.where < 0.5 * std::min(a.width, b.width);
                            }),
                found.end());
    return std::move(out_);
  }

 private:
  /// The modes up to the highest frequency of the sweep.
  linalg::QuadraticModes modes(const estimate::Linearised& m) const {
    const double top = settings_.omega(sweep_.back());
    const int below = linalg::eigenvaluesBelow(reduction::symmetricPart(m.stiffness),
                                               reduction::symmetricPart(m.mass), top * top);
    for (int count = std::min(mostModes, below + moreModes);; count *= 2) {
      auto modes = rotating_.modes(m, count);
      const auto n = modes.values.size();
      if (n < count || count >= mostModes || std::abs(modes.values[n - 1]) > top) return modes;
    }
  }

  void look(double speed) {
    const auto held = rotating_.at(speed);
    const auto found = modes(held);
    for (Eigen::Index j = 0; j < found.values.size(); ++j) {
      const Complex s = found.values[j];
      if (grows(s)) {
        const Complex moving = stability::followed(rotating_.turned(speed), rotating_.time(), held,
                                                   {s, found.vectors.col(j)})
                                   .s;
        if (grows(moving) && (!out_.growing || moving.real() > out_.growing->s.real()))
          out_.growing = Growing{speed, moving};
      }
      if (!vibrates(s) || !(perUnit_ > 0.0)) continue;  // the same frequency at all speeds
      if (!settings_.bySpeed())
        add(placeOf(s), s);
      else if (!isKnown(s))
        follow({s, found.vectors.col(j)});
    }
  }

  double placeOf(Complex s) const { return (s.imag() - offset_) / perUnit_; }

  /// True if a mode of another speed has led to this resonance.
  bool isKnown(Complex s) const {
    const double where = placeOf(s);
    return std::any_of(out_.found.begin(), out_.found.end(), [where](const Resonance& one) {
      return std::abs(one.where - where) < std::max(0.5 * one.width, samePlace * where);
    });
  }

  void add(double where, Complex s) {
    if (!(where > sweep_.front() && where < sweep_.back()) || grows(s)) return;
    const bool damped = -s.real() > noDamping * std::abs(s);
    out_.found.push_back({where, damped ? -s.real() / perUnit_ : nearUndamped * where, damped});
  }

  /// Omega <- (Im s(Omega) - offset)/order.
  void follow(linalg::DampedMode mode) {
    double speed = placeOf(mode.s);
    for (int i = 0; i < mostIterations; ++i) {
      if (!(speed > sweep_.front() && speed < sweep_.back())) return;
      const auto m = rotating_.at(speed);
      const auto there = linalg::refine(m.mass, m.damping, m.stiffness, mode);
      if (!there || !vibrates(there->s)) return;
      mode = *there;
      const double next = placeOf(mode.s);
      if (std::abs(next - speed) <= close * next) return add(next, mode.s);
      speed = next;
    }
  }

  const RotatingCase& rotating_;
  const ResponseSettings& settings_;
  const std::vector<double>& sweep_;
  double perUnit_;  ///< growth of the excitation frequency [rad/s] over the place in the sweep
  double offset_;   ///< that frequency at the place 0
  Resonances out_;
};

}  // namespace

Resonances resonances(const RotatingCase& rotating, const ResponseSettings& settings) {
  return Search(rotating, settings).run();
}

}  // namespace tooljoint::response
