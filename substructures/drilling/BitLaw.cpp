// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drilling/BitLaw.hpp"

#include <fmt/format.h>
#include <vector>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "deck/Deck.hpp"
#include "deck/PrintedUnits.hpp"
#include "deck/Variants.hpp"
#include "substructures/beam/NodalDofs.hpp"

namespace tooljoint::drilling {

deck::ListSpec bitParameters() {
  deck::ListSpec spec("Bit",
                      "The rock as a law of the motion of the bit; without this list weight and "
                      "torque on bit are the constant ones of Loads.");
  deck::declareVariants<BitLaw, const Teuchos::ParameterList&>(spec, "Law", deck::Required{},
                                                               "The law.");
  return spec;
}

deck::ListSpec turningBitParameters(const std::string& name, const std::string& doc) {
  return deck::ListSpec(name, doc)
      .radius("Radius", deck::Required{}, deck::Range::positive(), "Radius of the bit.")
      .real("Sticking Speed", "rad/s", 1e-2, deck::Range::positive(),
            "The rock resists fully from this speed on; a bit that sticks creeps at less.")
      .expert();
}

BitSettings readBit(const Teuchos::ParameterList& list) {
  const auto name = list.get<std::string>("Law");
  const auto& entry = BitLaws::instance().find(name);
  return {name, entry.make(deck::variantList(list, name, entry.parameters))};
}

PointOnString bitOnString(const BitSettings& bit, int node, const loads::RotarySpeed& rotary,
                          double feed, double weightOnBit) {
  std::vector<StringCoordinate> coordinates;
  if (bit.law->givesWeight())
    coordinates.push_back({beam::nodal::w,
                           [feed](double t) {
                             return FramePosition{feed * t, feed};
                           },
                           {"weight_on_bit", "N", "Weight on bit, positive in compression"},
                           -1.0});
  coordinates.push_back(
      {beam::nodal::thetaZ,
       [rotary](double t) {
         return FramePosition{rotary.angle(t), rotary.speed(t)};
       },
       {"torque_on_bit", "N m",
        "Torque of the rock on the bit, positive against a rotation to the right"},
       -1.0});
  return onString(bitSet, node, coordinates, bit.law->make(weightOnBit));
}

BitLoad steadyLoad(const PointOnString& bit, double t) {
  const std::vector<double> still(bit.components.size());
  auto force = still;
  bit.law->evaluate(t, {0}, still.data(), still.data(), force.data());
  BitLoad load;
  for (std::size_t c = 0; c < force.size(); ++c)
    (bit.components[c] == beam::nodal::w ? load.weight : load.torque) = -force[c];
  return load;
}

double feedFor(const BitSettings& bit, const loads::RotarySpeed& rotary, double t, double weight) {
  constexpr double fastest = 1.0;  // [m/s]
  constexpr int halvings = 80;
  const auto lacks = [&](double feed) {
    return steadyLoad(bitOnString(bit, 0, rotary, feed, 0.0), t).weight < weight;
  };
  double low = 0.0, high = fastest;
  if (!lacks(low) || lacks(high))
    throw DeckError(
        "is not reached with the law " + inQuotes(bit.name) + " of Bit at " +
        deck::printed(rotary.speed(t), "rpm", 4) + " at the start and a block speed of up to " +
        deck::printed(fastest, "m/s") +
        ". Give another weight, a Rotary Speed above zero at the start, or Top Drive/Block Speed.");
  for (int i = 0; i < halvings && high > low; ++i) {
    const double middle = 0.5 * (low + high);
    (lacks(middle) ? low : high) = middle;
  }
  return high;
}

std::string outsideCalibration(const BitSettings& bit, const std::string& what, double least,
                               double most) {
  const auto range = bit.law->calibration();
  if (range.contains(least) && range.contains(most)) return "";
  const deck::PrintedUnit force("kN");
  const auto text = [&](double weight) { return fmt::format("{:.1f}", force(weight)); };
  return "The weight on bit of " + what + " is " + text(least) +
         (most > least ? " to " + text(most) : "") + " " + force.name() + ", outside of the " +
         text(range.least) + " to " + text(range.most) + " " + force.name() + " to which the law " +
         inQuotes(bit.name) + " of Bit was fitted.";
}

}  // namespace tooljoint::drilling
