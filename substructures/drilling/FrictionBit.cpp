// SPDX-License-Identifier: BSD-3-Clause
// Bits that resist by friction under the weight given in the deck.
#include <Teuchos_ParameterList.hpp>
#include <memory>

#include "common/Text.hpp"
#include "deck/RequireAtMost.hpp"
#include "model/laws/PointLawRegistry.hpp"
#include "substructures/drilling/BitLaw.hpp"

namespace tooljoint::drilling {
namespace {

using deck::Range;

/// T = c w + W R [mu_d + (mu_s - mu_d) exp(-|w|/w_s)] sign w
class Stribeck final : public BitLaw {
 public:
  explicit Stribeck(const Teuchos::ParameterList& list)
      : static_(list.get<double>("Static Coefficient")),
        dynamic_(list.get<double>("Dynamic Coefficient")),
        radius_(list.get<double>("Radius")),
        decay_(list.get<double>("Decay Speed")),
        viscous_(list.get<double>("Viscous Damping")),
        sticking_(list.get<double>("Sticking Speed")) {
    deck::requireAtMost(list, "Dynamic Coefficient", "Static Coefficient",
                        "Friction that weakens with speed needs it at or below.");
  }
  bool givesWeight() const override { return false; }
  std::shared_ptr<const model::PointLaw> make(double weightOnBit) const override {
    Teuchos::ParameterList own("Stribeck");
    own.set("Static Force", weightOnBit * radius_ * static_)
        .set("Dynamic Force", weightOnBit * radius_ * dynamic_)
        .set("Decay Velocity", decay_)
        .set("Viscous Damping", viscous_)
        .set("Slip Velocity", sticking_);
    return model::PointLawRegistry::instance().make("Stribeck", own, {1, 1});
  }
  bool weakensWithSpeed() const override { return dynamic_ < static_; }
  std::string describe() const override {
    return "torque by friction that weakens with speed, coefficient " + formatNumber(static_) +
           " to " + formatNumber(dynamic_);
  }

 private:
  double static_, dynamic_, radius_, decay_, viscous_, sticking_;
};

const bool frictionBitRegistered = addBitLaw<Stribeck>(
    turningBitParameters(
        "Stribeck",
        "Torque by friction under the Weight On Bit of Loads that weakens with the "
        "speed of the bit (E. M. Navarro-Lopez and D. Cortes, J. Sound Vib. 307 (2007) "
        "152-171).")
        .real("Static Coefficient", "", 0.8, Range::positive(),
              "Friction coefficient mu_s of a bit that starts to turn.")
        .real("Dynamic Coefficient", "", 0.5, Range::nonNegative(),
              "Friction coefficient mu_d of a fast bit; at most the static one.")
        .real("Decay Speed", "rad/s", 1.1, Range::positive(),
              "Speed over which the coefficient falls from the one to the other by e.")
        .expert()
        .real("Viscous Damping", "N m s/rad", 0.0, Range::nonNegative(),
              "Coefficient c of a torque that grows with the speed."));

}  // namespace
}  // namespace tooljoint::drilling
