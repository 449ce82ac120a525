// SPDX-License-Identifier: BSD-3-Clause
#include "parts/TimeLaw.hpp"

#include <Teuchos_Array.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Text.hpp"

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

 private:
  double mean_, amplitude_, pulsation_, phase_, start_, end_;
};

/// f = f_0 before the start, f_1 after the ramp, straight in between
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

 private:
  double from_, to_, start_, duration_;
};

/// Straight lines between points, constant before the first and after the last.
class Table : public TimeLaw {
 public:
  explicit Table(const ParameterList& list)
      : times_(list.get<Teuchos::Array<double>>("Times").toVector()),
        values_(list.get<Teuchos::Array<double>>("Values").toVector()) {
    if (times_.empty() || times_.size() != values_.size())
      throw DeckError(list.name() + " has " + std::to_string(times_.size()) + " times and " +
                      std::to_string(values_.size()) + " values. Give one value for each time.");
    for (std::size_t i = 1; i < times_.size(); ++i)
      if (!(times_[i] > times_[i - 1]))
        throw DeckError(list.name() + "/Times does not increase: " + formatNumber(times_[i - 1]) +
                        " s is followed by " + formatNumber(times_[i]) + " s.");
  }
  double value(double t) const override {
    if (t <= times_.front()) return values_.front();
    if (t >= times_.back()) return values_.back();
    const auto i = static_cast<std::size_t>(std::upper_bound(times_.begin(), times_.end(), t) -
                                            times_.begin());
    const double x = (t - times_[i - 1]) / (times_[i] - times_[i - 1]);
    return values_[i - 1] + x * (values_[i] - values_[i - 1]);
  }

 private:
  std::vector<double> times_, values_;
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
                      .real("Amplitude", "", 1.0, Range::any(), "Amplitude.")
                      .real("Frequency", "Hz", deck::Required{}, Range::nonNegative(), "Frequency.")
                      .real("Phase", "rad", 0.0, Range::any(), "Phase at time 0.")
                      .real("Start Time", "s", 0.0, Range::any(), "Start of the oscillation.")
                      .real("End Time", "s", deck::Optional{}, Range::any(),
                            "End of the oscillation; none by default."));

[[maybe_unused]] const bool ramp = add<Ramp>(
    ListSpec("Ramp", "Linear change from one value to another.")
        .real("From", "", 0.0, Range::any(), "Value before the ramp.")
        .real("To", "", 1.0, Range::any(), "Value after it.")
        .real("Start Time", "s", 0.0, Range::any(), "Start of the ramp.")
        .real("Duration", "s", deck::Required{}, Range::positive(), "Duration of the ramp."));

[[maybe_unused]] const bool table = add<Table>(
    ListSpec("Table",
             "Linear interpolation between points, constant before the first and after the last.")
        .realArray("Times", "s", deck::Required{}, Range::any(), "Times of the points, increasing.")
        .realArray("Values", "", deck::Required{}, Range::any(), "Values at these times."));

}  // namespace

deck::ListSpec timeLawParameters() {
  const auto& laws = TimeLaws::instance();
  ListSpec spec("law", "A law of time; its name is used by part files and loads.");
  spec.choice("Form", deck::Required{}, laws.names(),
              "Form of the law; its parameters are in the sublist of the same name.");
  for (const auto& [name, entry] : laws.entries()) spec.list(entry.parameters);
  return spec;
}

model::ScalarLaw readTimeLaw(const std::string& name, const ParameterList& list) {
  const auto form = list.get<std::string>("Form");
  if (!list.isSublist(form))
    throw DeckError(list.name() + "/Form is " + inQuotes(form) + ", but the list " +
                    inQuotes(form) + " with its parameters is missing.");
  const std::shared_ptr<const TimeLaw> law = TimeLaws::instance().make(form, list.sublist(form));
  return {name, [law](double t) { return law->value(t); }};
}

}  // namespace tooljoint::parts
