// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/loads/RotarySpeed.hpp"

#include <cmath>
#include <complex>
#include <map>

#include "common/Error.hpp"
#include "common/Types.hpp"
#include "model/SpeedLaw.hpp"

namespace tooljoint::loads {

const char* const unbalanceCosine = "Omega^2 cos + dOmega/dt sin";
const char* const unbalanceSine = "Omega^2 sin - dOmega/dt cos";

deck::ListSpec rotarySpeedParameters() {
  const auto& laws = SpeedLaws::instance();
  deck::ListSpec spec("Rotary Speed",
                      "Speed imposed at the surface; without this list nothing rotates and no "
                      "gyroscopic matrix is built.");
  spec.choice("Law", deck::Required{}, laws.names(),
              "Form of the speed over time; its numbers stand in the sublist of the same name.");
  for (const auto& [name, entry] : laws.entries()) spec.list(entry.parameters);
  return spec;
}

RotarySpeed::RotarySpeed(const Teuchos::ParameterList& list) {
  const auto law = list.get<std::string>("Law");
  if (!list.isSublist(law)) {
    throw DeckError("Rotary Speed/Law is \"" + law + "\", but the list \"" + law +
                    "\" with its numbers is missing in Rotary Speed.");
  }
  law_ = SpeedLaws::instance().make(law, list.sublist(law));
}

RotarySpeed RotarySpeed::fromDeck(const Teuchos::ParameterList& deck) {
  return deck.isSublist("Rotary Speed") ? RotarySpeed(deck.sublist("Rotary Speed")) : RotarySpeed();
}

double RotarySpeed::sense(double from) const {
  if (!law_) return 0.0;
  constexpr double rounding =
      1e-9;  // [rad/s]; a phase of 180 degrees leaves 1e-16 of an amplitude, of either sign
  constexpr double justAfter =
      1e-6;  // fraction of a smooth stretch; gives the sign with which the stretch begins
  std::vector<double> starts{from};
  for (double corner : law_->corners())
    if (corner > from) starts.push_back(corner);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const double width = i + 1 < starts.size() ? starts[i + 1] - starts[i] : 1.0;
    const double here = speed(starts[i]), after = speed(starts[i] + justAfter * width);
    if (std::abs(here) > rounding) return std::copysign(1.0, here);
    if (after != 0.0) return std::copysign(1.0, after);
  }
  return 0.0;
}

namespace {

/// A law of time, and its value at a constant speed.
struct Form {
  double (*inTime)(const RotarySpeed&, double);
  std::complex<double> (*steady)(double);
  int order = 0;
};

/// F = m e (phi'^2 cos phi + phi'' sin phi, phi'^2 sin phi - phi'' cos phi), phi' = Omega; at a
/// constant speed m e Omega^2 Re((1, -i) exp(i phi))
const std::map<std::string, Form>& forms() {
  using Rotary = const RotarySpeed&;
  static const std::map<std::string, Form> known{
      {"Omega",
       {[](Rotary r, double t) { return r.speed(t); }, [](double w) { return Complex(w); }}},
      {"sqrt|Omega|",
       {[](Rotary r, double t) { return std::sqrt(std::abs(r.speed(t))); },
        [](double w) { return Complex(std::sqrt(std::abs(w))); }}},
      {"Omega^2",
       {[](Rotary r, double t) { return r.speed(t) * r.speed(t); },
        [](double w) { return Complex(w * w); }}},
      {"Omega sqrt|Omega|",
       {[](Rotary r, double t) { return r.speed(t) * std::sqrt(std::abs(r.speed(t))); },
        [](double w) { return Complex(w * std::sqrt(std::abs(w))); }}},
      {"dOmega/dt",
       {[](Rotary r, double t) { return r.acceleration(t); }, [](double) { return Complex(0.0); }}},
      {unbalanceCosine,
       {[](Rotary r, double t) {
          return r.speed(t) * r.speed(t) * std::cos(r.angle(t)) +
                 r.acceleration(t) * std::sin(r.angle(t));
        },
        [](double w) { return Complex(w * w); }, 1}},
      {unbalanceSine,
       {[](Rotary r, double t) {
          return r.speed(t) * r.speed(t) * std::sin(r.angle(t)) -
                 r.acceleration(t) * std::cos(r.angle(t));
        },
        [](double w) { return Complex(0.0, -w * w); }, 1}},
  };
  return known;
}

}  // namespace

model::ScalarLaw RotarySpeed::scalar(const std::string& name) const {
  if (model::ScalarLaw::isOne(name)) return model::ScalarLaw::one();
  const auto it = forms().find(name);
  if (it == forms().end())
    throw Error(ExitCode::Internal, "\"" + name + "\" is no scalar law of the rotary speed.");
  const Form& form = it->second;
  return {
      name,
      model::SpeedLaw{[self = *this, inTime = form.inTime](double t) { return inTime(self, t); },
                      form.steady, form.order},
      law_ ? law_->corners() : std::vector<double>()};
}

}  // namespace tooljoint::loads
