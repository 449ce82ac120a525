// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drilling/BitLaw.hpp"

#include <vector>

#include "deck/Deck.hpp"
#include "deck/Variants.hpp"

namespace tooljoint::drilling {
namespace {

constexpr int axial = 2, torsional = 5;  // w and theta_z of a node

}  // namespace

deck::ListSpec bitParameters() {
  deck::ListSpec spec("Bit",
                      "The rock as a law of the motion of the bit; without this list weight and "
                      "torque on bit are the constant ones of Loads.");
  deck::declareVariants<BitLaw, const Teuchos::ParameterList&>(spec, "Law", deck::Required{},
                                                               "The law.");
  return spec;
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
    coordinates.push_back({axial,
                           [feed](double t) {
                             return FramePosition{feed * t, feed};
                           },
                           {"weight_on_bit", "N", "Weight on bit, positive in compression"},
                           -1.0});
  coordinates.push_back(
      {torsional,
       [rotary](double t) {
         return FramePosition{rotary.angle(t), rotary.speed(t)};
       },
       {"torque_on_bit", "N m", "Torque of the rock on the bit, positive against rotation"},
       -1.0});
  return onString(bitSet, node, coordinates, bit.law->make(weightOnBit));
}

BitLoad steadyLoad(const PointOnString& bit, double t) {
  const std::vector<double> still(bit.components.size());
  auto force = still;
  bit.law->evaluate(t, {0}, still.data(), still.data(), force.data());
  BitLoad load;
  for (std::size_t c = 0; c < force.size(); ++c)
    (bit.components[c] == axial ? load.weight : load.torque) = -force[c];
  return load;
}

}  // namespace tooljoint::drilling
