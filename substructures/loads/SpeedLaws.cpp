// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The speed laws given by a formula: Constant, Exponential, Ramp, Harmonic.
#include <algorithm>
#include <cmath>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "substructures/loads/RotarySpeed.hpp"

namespace tooljoint::loads {
namespace {

using deck::ListSpec;
using deck::Range;
using Teuchos::ParameterList;

using constants::twoPi;

/// Omega = Omega_0
class Constant : public SpeedLaw {
 public:
  explicit Constant(double speed) : speed_(speed) {}
  explicit Constant(const ParameterList& list) : Constant(list.get<double>("Speed")) {}
  double speed(double /*t*/) const override { return speed_; }
  double acceleration(double /*t*/) const override { return 0.0; }
  double angle(double t) const override { return speed_ * t; }

 private:
  double speed_;
};

/// Omega = Omega_inf + (Omega_0 - Omega_inf) exp(-t/tau)
class Exponential : public SpeedLaw {
 public:
  explicit Exponential(const ParameterList& list)
      : final_(list.get<double>("Final Speed")),
        missing_(list.get<double>("Initial Speed") - final_),
        tau_(list.get<double>("Time Constant")) {}
  double speed(double t) const override { return final_ + missing_ * std::exp(-t / tau_); }
  double acceleration(double t) const override { return -missing_ / tau_ * std::exp(-t / tau_); }
  double angle(double t) const override {
    return final_ * t - missing_ * tau_ * std::expm1(-t / tau_);
  }

 private:
  double final_;
  double missing_;
  double tau_;
};

/// Omega_0 before the start, Omega_1 after the end; between them, with x from 0 to 1, Omega_0 +
/// (Omega_1 - Omega_0) r(x) and r = x (linear) or 3 x^2 - 2 x^3 (smooth: dOmega/dt has no jumps).
class Ramp : public SpeedLaw {
 public:
  explicit Ramp(const ParameterList& list)
      : from_(list.get<double>("Initial Speed")),
        rise_(list.get<double>("Final Speed") - from_),
        start_(list.get<double>("Start Time")),
        duration_(list.get<double>("Duration")),
        smooth_(list.get<bool>("Smooth")) {}
  double speed(double t) const override {
    const double x = along(t);
    return from_ + rise_ * (smooth_ ? x * x * (3.0 - 2.0 * x) : x);
  }
  double acceleration(double t) const override {
    if (t < start_ || t >= start_ + duration_) return 0.0;
    const double x = along(t);
    return rise_ / duration_ * (smooth_ ? 6.0 * x * (1.0 - x) : 1.0);
  }
  double angle(double t) const override {
    const double x = along(t);
    const double ramp = smooth_ ? x * x * x * (1.0 - x / 2.0) : x * x / 2.0;  // int_0^x r
    const double after = std::max(0.0, t - start_ - duration_);
    return from_ * t + rise_ * (duration_ * ramp + after);
  }
  std::vector<double> corners() const override { return {start_, start_ + duration_}; }

 private:
  double along(double t) const { return std::clamp((t - start_) / duration_, 0.0, 1.0); }
  double from_;
  double rise_;
  double start_;
  double duration_;
  bool smooth_;
};

/// Omega = mean + amplitude sin(2 pi f t + phase)
class Harmonic : public SpeedLaw {
 public:
  explicit Harmonic(const ParameterList& list)
      : mean_(list.get<double>("Mean Speed")),
        amplitude_(list.get<double>("Amplitude")),
        pulsation_(twoPi * list.get<double>("Frequency")),
        phase_(list.get<double>("Phase")) {}
  double speed(double t) const override {
    return mean_ + amplitude_ * std::sin(pulsation_ * t + phase_);
  }
  double acceleration(double t) const override {
    return amplitude_ * pulsation_ * std::cos(pulsation_ * t + phase_);
  }
  double angle(double t) const override {
    return mean_ * t -
           amplitude_ / pulsation_ * (std::cos(pulsation_ * t + phase_) - std::cos(phase_));
  }

 private:
  double mean_;
  double amplitude_;
  double pulsation_;
  double phase_;
};

template <class Law>
bool add(ListSpec parameters, const std::string& doc) {
  const std::string name = parameters.name();
  return SpeedLaws::instance().add(
      name,
      {doc, std::move(parameters), [](const ParameterList& list) -> std::unique_ptr<SpeedLaw> {
         return std::make_unique<Law>(list);
       }});
}

[[maybe_unused]] const bool constant =
    add<Constant>(ListSpec("Constant", "One speed from the first instant on.")
                      .real("Speed", "rad/s", deck::Required{}, Range::any(),
                            "Rotary speed; positive turns local x into local y."),
                  "One speed from the first instant on.");

[[maybe_unused]] const bool exponential = add<Exponential>(
    ListSpec("Exponential",
             "Approach to a final speed, Omega = Final + (Initial - Final) exp(-t/Time Constant).")
        .real("Final Speed", "rad/s", deck::Required{}, Range::any(),
              "Speed approached as time goes on.")
        .real("Initial Speed", "rad/s", 0.0, Range::any(), "Speed at time 0.")
        .expert()
        .real("Time Constant", "s", deck::Required{}, Range::positive(),
              "Time after which 63 % of the change is done."),
    "Exponential approach to a final speed (section 5.3 of Nguyen et al. 2020: 120 - 120 exp(-6 t) "
    "rpm).");

[[maybe_unused]] const bool ramp = add<Ramp>(
    ListSpec("Ramp", "From one speed to another in a given time, constant before and after.")
        .real("Initial Speed", "rad/s", 0.0, Range::any(), "Speed before the ramp.")
        .expert()
        .real("Final Speed", "rad/s", deck::Required{}, Range::any(), "Speed after the ramp.")
        .real("Start Time", "s", 0.0, Range::nonNegative(), "Time at which the ramp begins.")
        .expert()
        .real("Duration", "s", deck::Required{}, Range::positive(), "Time the ramp takes.")
        .boolean("Smooth", true,
                 "Cubic ramp whose angular acceleration has no jumps; false for a straight one.")
        .expert(),
    "Straight or smooth ramp between two speeds, then hold.");

[[maybe_unused]] const bool harmonic = add<Harmonic>(
    ListSpec("Harmonic",
             "Mean speed plus a sine, Omega = Mean + Amplitude sin(2 pi Frequency t + Phase).")
        .real("Mean Speed", "rad/s", deck::Required{}, Range::any(), "Mean rotary speed.")
        .real("Amplitude", "rad/s", deck::Required{}, Range::any(), "Amplitude of the fluctuation.")
        .real("Frequency", "Hz", deck::Required{}, Range::positive(),
              "Frequency of the fluctuation.")
        .real("Phase", "rad", 0.0, Range::any(), "Phase of the fluctuation at time 0."),
    "Mean speed with a harmonic fluctuation.");

}  // namespace

RotarySpeed RotarySpeed::steady(double speed) {
  return RotarySpeed(std::make_shared<Constant>(speed));
}

}  // namespace tooljoint::loads
