// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The speed law given by a table of times and speeds.
#include <Teuchos_Array.hpp>
#include <algorithm>
#include <cmath>
#include <vector>

#include "common/Error.hpp"
#include "substructures/loads/RotarySpeed.hpp"

namespace tooljoint::loads {
namespace {

using Teuchos::ParameterList;

/// Piecewise cubic in Hermite form (linear: slopes are those of the chords), constant before the
/// first and after the last entry. Between t_i and t_i+1 = t_i + h, with x from 0 to 1 and d =
/// y_i+1 - y_i:
///
///     Omega = y_i + h m_i x + (3 d - h (2 m_i + m_i+1)) x^2 + (h (m_i + m_i+1) - 2 d) x^3
class Table : public SpeedLaw {
 public:
  explicit Table(const ParameterList& list)
      : time_(list.get<Teuchos::Array<double>>("Times").toVector()),
        speed_(list.get<Teuchos::Array<double>>("Speeds").toVector()) {
    check();
    const std::size_t n = time_.size();
    const bool linear = list.get<std::string>("Interpolation") == "Linear";
    const std::vector<double> slope = linear ? std::vector<double>() : monotoneSlopes();
    for (std::size_t i = 0; i + 1 < n; ++i) {
      const double h = time_[i + 1] - time_[i];
      const double d = speed_[i + 1] - speed_[i];
      const double left = linear ? d : h * slope[i];
      const double right = linear ? d : h * slope[i + 1];
      pieces_.push_back({h, left, 3.0 * d - 2.0 * left - right, left + right - 2.0 * d, 0.0});
    }
    double angle = speed_.front() * time_.front();  // held from t = 0 to the first entry
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      pieces_[i].angle = angle;
      angle += integral(i, 1.0);
    }
    lastAngle_ = angle;
  }

  double speed(double t) const override {
    if (t <= time_.front()) return speed_.front();
    if (t >= time_.back()) return speed_.back();
    const std::size_t i = piece(t);
    const Piece& p = pieces_[i];
    const double x = (t - time_[i]) / p.width;
    return speed_[i] + x * (p.linear + x * (p.quadratic + x * p.cubic));
  }

  double acceleration(double t) const override {
    if (t < time_.front() || t >= time_.back()) return 0.0;
    const std::size_t i = piece(t);
    const Piece& p = pieces_[i];
    const double x = (t - time_[i]) / p.width;
    return (p.linear + x * (2.0 * p.quadratic + x * 3.0 * p.cubic)) / p.width;
  }

  double angle(double t) const override {
    if (t <= time_.front()) return speed_.front() * t;
    if (t >= time_.back()) return lastAngle_ + speed_.back() * (t - time_.back());
    const std::size_t i = piece(t);
    return pieces_[i].angle + integral(i, (t - time_[i]) / pieces_[i].width);
  }

  std::vector<double> corners() const override { return time_; }

 private:
  struct Piece {
    double width;   ///< h
    double linear;  ///< coefficients of x, x^2, x^3
    double quadratic;
    double cubic;
    double angle;  ///< int_0^{t_i} Omega
  };

  void check() const {
    if (time_.size() != speed_.size() || time_.empty()) {
      throw DeckError("Rotary Speed/Table has " + std::to_string(time_.size()) + " Times and " +
                      std::to_string(speed_.size()) +
                      " Speeds; it needs at least one time, and a speed for each.");
    }
    if (time_.front() < 0.0) throw DeckError("Rotary Speed/Table/Times begins before time 0.");
    for (std::size_t i = 1; i < time_.size(); ++i) {
      if (!(time_[i] > time_[i - 1])) {
        throw DeckError("Rotary Speed/Table/Times must increase, but entry " +
                        std::to_string(i + 1) + " does not follow entry " + std::to_string(i) +
                        ".");
      }
    }
  }

  /// Slopes of Fritsch and Carlson (1980) in Brodlie's weighted harmonic form: no overshoot between
  /// entries. They are zero at both ends, so dOmega/dt has no jump at the constant stretches before
  /// and after.
  std::vector<double> monotoneSlopes() const {
    std::vector<double> slope(time_.size(), 0.0);
    for (std::size_t i = 1; i + 1 < time_.size(); ++i) {
      const double h0 = time_[i] - time_[i - 1];
      const double h1 = time_[i + 1] - time_[i];
      const double d0 = (speed_[i] - speed_[i - 1]) / h0;
      const double d1 = (speed_[i + 1] - speed_[i]) / h1;
      if (d0 * d1 <= 0.0) continue;
      const double w0 = 2.0 * h1 + h0;
      const double w1 = h1 + 2.0 * h0;
      slope[i] = (w0 + w1) / (w0 / d0 + w1 / d1);
    }
    return slope;
  }

  /// Index of the piece that holds t, for t inside the table.
  std::size_t piece(double t) const {
    return static_cast<std::size_t>(std::upper_bound(time_.begin(), time_.end(), t) -
                                    time_.begin()) -
           1;
  }

  /// int of Omega over the first part x of piece i.
  double integral(std::size_t i, double x) const {
    const Piece& p = pieces_[i];
    return p.width * x *
           (speed_[i] + x * (p.linear / 2.0 + x * (p.quadratic / 3.0 + x * p.cubic / 4.0)));
  }

  std::vector<double> time_;
  std::vector<double> speed_;
  std::vector<Piece> pieces_;
  double lastAngle_ = 0.0;
};

[[maybe_unused]] const bool tableSpeedRegistered = SpeedLaws::instance().add(
    "Table",
    {"Speeds at given times, joined by straight lines or by cubics that do not overshoot.",
     deck::ListSpec("Table",
                    "Speeds at given times; the first and the last speed hold before and after.")
         .realArray("Times", "s", deck::Required{}, deck::Range::nonNegative(),
                    "Times of the entries, increasing.")
         .realArray("Speeds", "rad/s", deck::Required{}, deck::Range::any(),
                    "Rotary speed at each time; may change its sign.")
         .choice("Interpolation", std::string("Monotone cubic"), {"Monotone cubic", "Linear"},
                 "Curve between the entries: a cubic without overshoot, or straight lines.")
         .expert(),
     [](const ParameterList& list) -> std::unique_ptr<SpeedLaw> {
       return std::make_unique<Table>(list);
     }});

}  // namespace
}  // namespace tooljoint::loads
