// SPDX-License-Identifier: BSD-3-Clause
#include "parts/TimeLaw.hpp"

#include <Teuchos_Array.hpp>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Text.hpp"
#include "common/Types.hpp"
#include "model/SpeedLaw.hpp"

namespace tooljoint::parts {

namespace {

using deck::ListSpec;
using deck::Range;
using Teuchos::ParameterList;

using constants::twoPi;

/// f = c
class Constant : public TimeLaw {
 public:
  explicit Constant(const ParameterList& list) : value_(list.get<double>("Value")) {}
  double value(double /*t*/) const override { return value_; }

 private:
  double value_;
};

/// f = m + a sin(2 pi f t + phi) from the start to the end, m outside of them
class Harmonic : public TimeLaw {
 public:
  explicit Harmonic(const ParameterList& list)
      : mean_(list.get<double>("Mean")),
        amplitude_(list.get<double>("Amplitude")),
        pulsation_(twoPi * list.get<double>("Frequency")),
        phase_(list.get<double>("Phase")),
        start_(list.get<double>("Start Time")),
        end_(list.isParameter("End Time") ? list.get<double>("End Time")
                                          : std::numeric_limits<double>::infinity()) {
    if (!(end_ > start_))
      throw DeckError(list.name() + "/End Time is " + formatNumber(end_) +
                      " s, which is not after its start " + formatNumber(start_) + " s.");
  }
  double value(double t) const override {
    return t < start_ || t >= end_ ? mean_ : mean_ + amplitude_ * std::sin(pulsation_ * t + phase_);
  }
  std::vector<double> corners() const override {
    return std::isfinite(end_) ? std::vector<double>{start_, end_} : std::vector<double>{start_};
  }

 private:
  double mean_, amplitude_, pulsation_, phase_, start_, end_;
};

/// f = f_0 before the start, f_1 after the ramp, linear in between
class Ramp : public TimeLaw {
 public:
  explicit Ramp(const ParameterList& list)
      : from_(list.get<double>("From")),
        to_(list.get<double>("To")),
        start_(list.get<double>("Start Time")),
        duration_(list.get<double>("Duration")) {}
  double value(double t) const override {
    return from_ + (to_ - from_) * std::clamp((t - start_) / duration_, 0.0, 1.0);
  }
  std::vector<double> corners() const override { return {start_, start_ + duration_}; }

 private:
  double from_, to_, start_, duration_;
};

/// Linear between points, constant before the first and after the last.
class Table : public TimeLaw {
 public:
  explicit Table(const ParameterList& list) : Table(list, "Times", "times", "s") {}
  double value(double t) const override {
    if (t <= places_.front()) return values_.front();
    if (t >= places_.back()) return values_.back();
    const auto i = static_cast<std::size_t>(std::upper_bound(places_.begin(), places_.end(), t) -
                                            places_.begin());
    const double x = (t - places_[i - 1]) / (places_[i] - places_[i - 1]);
    return values_[i - 1] + x * (values_[i] - values_[i - 1]);
  }
  std::vector<double> corners() const override { return places_; }

 protected:
  Table(const ParameterList& list, const std::string& name, const std::string& what,
        const std::string& unit)
      : places_(list.get<Teuchos::Array<double>>(name).toVector()),
        values_(list.get<Teuchos::Array<double>>("Values").toVector()) {
    if (places_.empty() || places_.size() != values_.size())
      throw DeckError(list.name() + " has " + std::to_string(places_.size()) + " " + what +
                      " and " + std::to_string(values_.size()) +
                      " values. Give one value for each " + what.substr(0, what.size() - 1) + ".");
    for (std::size_t i = 1; i < places_.size(); ++i)
      if (!(places_[i] > places_[i - 1]))
        throw DeckError(list.name() + "/" + name +
                        " does not increase: " + formatNumber(places_[i - 1]) + " " + unit +
                        " is followed by " + formatNumber(places_[i]) + " " + unit + ".");
  }

 private:
  std::vector<double> places_, values_;
};

/// The same as a function of the rotary speed.
class SpeedTable final : public Table {
 public:
  explicit SpeedTable(const ParameterList& list) : Table(list, "Speeds", "speeds", "rad/s") {}
  bool ofSpeed() const override { return true; }
  std::vector<double> places() const override { return corners(); }
};

/// f = c |Omega|^n, with the sign of Omega for an odd law
class SpeedPower final : public TimeLaw {
 public:
  explicit SpeedPower(const ParameterList& list)
      : factor_(list.get<double>("Factor")),
        exponent_(list.get<double>("Exponent")),
        odd_(list.get<bool>("Odd")) {}
  double value(double speed) const override {
    const double size = factor_ * std::pow(std::abs(speed), exponent_);
    return odd_ && speed < 0.0 ? -size : size;
  }
  bool ofSpeed() const override { return true; }

 private:
  double factor_, exponent_;
  bool odd_;
};

template <class Law>
bool add(ListSpec parameters) {
  const std::string name = parameters.name(), doc = parameters.doc();
  return TimeLaws::instance().add(
      name, {doc, std::move(parameters), [](const ParameterList& list) -> std::unique_ptr<TimeLaw> {
               return std::make_unique<Law>(list);
             }});
}

[[maybe_unused]] const bool constant =
    add<Constant>(ListSpec("Constant", "One value at all times.")
                      .real("Value", "", deck::Required{}, Range::any(), "The value."));

[[maybe_unused]] const bool harmonic =
    add<Harmonic>(ListSpec("Harmonic", "Mean + Amplitude sin(2 pi Frequency t + Phase).")
                      .real("Mean", "", 0.0, Range::any(),
                            "Mean value; also the value before the start and after the end.")
                      .expert()
                      .real("Amplitude", "", 1.0, Range::any(), "Amplitude.")
                      .expert()
                      .real("Frequency", "Hz", deck::Required{}, Range::nonNegative(), "Frequency.")
                      .real("Phase", "rad", 0.0, Range::any(), "Phase at time 0.")
                      .real("Start Time", "s", 0.0, Range::any(), "Start of the oscillation.")
                      .expert()
                      .real("End Time", "s", deck::Optional{}, Range::any(),
                            "End of the oscillation; none by default."));

[[maybe_unused]] const bool ramp = add<Ramp>(
    ListSpec("Ramp", "Linear change from one value to another.")
        .real("From", "", 0.0, Range::any(), "Value before the ramp.")
        .real("To", "", 1.0, Range::any(), "Value after it.")
        .real("Start Time", "s", 0.0, Range::any(), "Start of the ramp.")
        .expert()
        .real("Duration", "s", deck::Required{}, Range::positive(), "Duration of the ramp."));

[[maybe_unused]] const bool table = add<Table>(
    ListSpec("Table",
             "Linear interpolation between points, constant before the first and after the last.")
        .realArray("Times", "s", deck::Required{}, Range::any(), "Times of the points, increasing.")
        .realArray("Values", "", deck::Required{}, Range::any(), "Values at these times."));

[[maybe_unused]] const bool speedTable = add<SpeedTable>(
    ListSpec("Speed Table",
             "Linear interpolation against the rotary speed, the law \"Omega\" of the same list: "
             "coefficients of bearings.")
        .realArray("Speeds", "rad/s", deck::Required{}, Range::any(),
                   "Rotary speeds of the points, increasing.")
        .realArray("Values", "", deck::Required{}, Range::any(), "Values at these speeds."));

[[maybe_unused]] const bool speedPower =
    add<SpeedPower>(ListSpec("Speed Power",
                             "Factor |Omega|^Exponent of the rotary speed, the law \"Omega\" of "
                             "the same list.")
                        .real("Factor", "", 1.0, Range::any(), "Factor; the speed is in rad/s.")
                        .expert()
                        .real("Exponent", "", deck::Required{}, Range::nonNegative(), "Exponent.")
                        .boolean("Odd", false, "Takes the sign of Omega.")
                        .expert());

}  // namespace

deck::ListSpec timeLawParameters() {
  const auto& laws = TimeLaws::instance();
  ListSpec spec("law", "A law of time; its name is used by part files and loads.");
  spec.choice("Form", deck::Required{}, laws.names(),
              "Form of the law; its parameters are in the sublist of the same name.");
  for (const auto& [name, entry] : laws.entries()) spec.list(entry.parameters);
  return spec;
}

model::ScalarLaw readTimeLaw(const std::string& name, const ParameterList& list,
                             const model::ScalarLaw& speed) {
  const auto form = list.get<std::string>("Form");
  if (!list.isSublist(form))
    throw DeckError(list.name() + "/Form is " + inQuotes(form) + ", but the list " +
                    inQuotes(form) + " with its parameters is missing.");
  const std::shared_ptr<const TimeLaw> law = TimeLaws::instance().make(form, list.sublist(form));
  if (law->ofSpeed()) {
    if (!speed.value)
      throw DeckError(list.name() + "/Form is " + inQuotes(form) +
                      ", but there is no law of time \"" + rotarySpeedName +
                      "\". Add one to Laws: its value is the rotary speed in rad/s.");
    const auto inTime = [law, speed = speed.value](double t) { return law->value(speed(t)); };
    model::SpeedLaw follows{inTime, [law](double omega) { return Complex(law->value(omega)); }};
    if (const auto places = law->places(); !places.empty())
      follows.least = places.front(), follows.most = places.back();
    return {name, follows, speed.corners};
  }
  const auto inTime = [law](double t) { return law->value(t); };
  const auto corners = law->corners();
  if (name == rotarySpeedName)
    return {name, model::SpeedLaw{inTime, [](double omega) { return Complex(omega); }}, corners};
  if (name == "dOmega/dt")
    return {name, model::SpeedLaw{inTime, [](double /*omega*/) { return Complex(0.0); }}, corners};
  return {name, inTime, corners};
}

}  // namespace tooljoint::parts
