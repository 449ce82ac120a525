// SPDX-License-Identifier: BSD-3-Clause
#include "deck/PrintedUnits.hpp"
#include "substructures/loads/Load.hpp"

namespace tooljoint::loads {
namespace {

/// Weight and torque on bit, at the last node. A positive weight pushes the string up the hole, so
/// the force along w is negative. A positive torque resists a positive rotary speed, so the torque
/// about z is negative.
class Bit final : public Load {
 public:
  explicit Bit(const Teuchos::ParameterList& list)
      : weight_(list.get<double>("Weight On Bit")), torque_(list.get<double>("Torque On Bit")) {}

  std::vector<PointLoad> atNodes(const std::vector<double>& depths,
                                 const RotarySpeed&) const override {
    std::vector<PointLoad> out;
    const int bit = static_cast<int>(depths.size());
    const model::ScalarLaw steady = model::ScalarLaw::one();
    if (weight_ != 0.0)
      out.push_back({"weight on bit", bit, 2, -weight_, steady, "Loads/Weight On Bit"});
    if (torque_ != 0.0)
      out.push_back({"torque on bit", bit, 5, -torque_, steady, "Loads/Torque On Bit"});
    return out;
  }

  std::vector<LoadRemark> describe(const RotarySpeed&) const override {
    return {{weight_ != 0.0, "weight on bit", deck::printed(weight_, "N", 6)},
            {torque_ != 0.0, "torque on bit", deck::printed(torque_, "N m", 6)}};
  }

 private:
  double weight_;  ///< [N]
  double torque_;  ///< [N m]
};

const bool bitRegistered = addLoad<Bit>(
    "Bit", "weight and torque on bit.",
    deck::ListSpec("Loads", "")
        .real("Weight On Bit", "N", 0.0, deck::Range::nonNegative(),
              "Force of the rock on the bit, up the hole: compresses the string above the bit.")
        .real("Torque On Bit", "N m", 0.0, deck::Range::any(),
              "Torque of the rock on the bit; positive resists a positive rotary speed."));

}  // namespace
}  // namespace tooljoint::loads
