// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/loads/RotarySpeed.hpp"

#include <cmath>
#include <map>

#include "common/Error.hpp"

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
      1e-9;  // [rad/s], a phase of 180 degrees leaves 1e-16 of an amplitude, of either sign
  constexpr double justAfter =
      1e-6;  // share of a smooth stretch: the sign with which the stretch begins
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

model::ScalarLaw RotarySpeed::scalar(const std::string& name) const {
  // F = m e (phi'^2 cos phi + phi'' sin phi, phi'^2 sin phi - phi'' cos phi), phi' = Omega
  static const std::map<std::string, double (*)(const RotarySpeed&, double)> functions{
      {"Omega", [](const RotarySpeed& r, double t) { return r.speed(t); }},
      {"sqrt|Omega|",
       [](const RotarySpeed& r, double t) { return std::sqrt(std::abs(r.speed(t))); }},
      {"Omega^2", [](const RotarySpeed& r, double t) { return r.speed(t) * r.speed(t); }},
      {"Omega sqrt|Omega|",
       [](const RotarySpeed& r, double t) { return r.speed(t) * std::sqrt(std::abs(r.speed(t))); }},
      {"dOmega/dt", [](const RotarySpeed& r, double t) { return r.acceleration(t); }},
      {unbalanceCosine,
       [](const RotarySpeed& r, double t) {
         return r.speed(t) * r.speed(t) * std::cos(r.angle(t)) +
                r.acceleration(t) * std::sin(r.angle(t));
       }},
      {unbalanceSine,
       [](const RotarySpeed& r, double t) {
         return r.speed(t) * r.speed(t) * std::sin(r.angle(t)) -
                r.acceleration(t) * std::cos(r.angle(t));
       }},
  };
  if (name == "1") return model::ScalarLaw::one();
  const auto it = functions.find(name);
  if (it == functions.end())
    throw Error(ExitCode::Internal, "\"" + name + "\" is no scalar law of the rotary speed.");
  return {name, [self = *this, function = it->second](double t) { return function(self, t); }};
}

}  // namespace tooljoint::loads
