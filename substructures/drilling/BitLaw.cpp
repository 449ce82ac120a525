// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drilling/BitLaw.hpp"

#include <vector>

#include "deck/Deck.hpp"
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
    (bit.components[c] == beam::nodal::w ? load.weight : load.torque) = -force[c];
  return load;
}

}  // namespace tooljoint::drilling
