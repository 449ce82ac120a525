// SPDX-License-Identifier: BSD-3-Clause
// Drag bits. The depth of cut depends on the passage of the previous blade.
#include <Teuchos_ParameterList.hpp>
#include <memory>

#include "common/Text.hpp"
#include "model/laws/RegenerativeCutting.hpp"
#include "substructures/drilling/BitLaw.hpp"

namespace tooljoint::drilling {
namespace {

using deck::Range;
using deck::Required;

class Cutting final : public BitLaw {
 public:
  explicit Cutting(const Teuchos::ParameterList& list) {
    p_.blades = list.get<int>("Blades");
    p_.radius = list.get<double>("Radius");
    p_.specificEnergy = list.get<double>("Specific Energy");
    p_.inclination = list.get<double>("Inclination");
    p_.wearFlat = list.get<double>("Wear Flat");
    p_.contactStress = list.get<double>("Contact Stress");
    p_.friction = list.get<double>("Friction");
    p_.axialVelocity = list.get<double>("Contact Velocity");
    p_.angularVelocity = list.get<double>("Sticking Speed");
    p_.samples = list.get<int>("Samples");
  }
  bool givesWeight() const override { return true; }
  bool cutsForwardOnly() const override { return true; }
  std::shared_ptr<const model::PointLaw> make(double) const override {
    return std::make_shared<model::FormulaLaw<model::RegenerativeCutting>>(
        model::RegenerativeCutting(p_), 1);
  }
  std::string describe() const override {
    return "weight and torque by the depth of cut of " + std::to_string(p_.blades) + " blades";
  }

 private:
  model::CuttingParameters p_;
};

const bool cuttingBitRegistered = addBitLaw<Cutting>(
    turningBitParameters(
        "Cutting",
        "Weight and torque by the depth of cut, measured from what the blade before has "
        "left, and by friction of the wear flats (E. Detournay and P. Defourny 1992; T. "
        "Richard, C. Germay and E. Detournay, J. Sound Vib. 305 (2007) 432-456).")
        .integer("Blades", Required{}, Range::atLeast(1), "Number n of blades.")
        .real("Specific Energy", "Pa", 60e6, Range::positive(),
              "Energy eps to remove a volume of rock [J/m3]: 10 to 100 MPa, near the compressive "
              "strength.")
        .real("Inclination", "", 0.6, Range::positive(),
              "zeta: axial over tangential force of a cutter.")
        .real("Wear Flat", "m", 0.0, Range::nonNegative(),
              "Width l of the wear flats of one blade; 0 for sharp cutters.")
        .real("Contact Stress", "Pa", 60e6, Range::positive(), "Stress sigma at the wear flats.")
        .real("Friction", "", 0.6, Range::nonNegative(),
              "mu gamma: friction coefficient at the wear flats times the geometry number of the "
              "bit.")
        .real("Contact Velocity", "m/s", 1e-5, Range::positive(),
              "Advance from which the wear flats carry their full stress.")
        .expert()
        .integer("Samples", 256, Range::atLeast(8),
                 "Samples of the surface between two blades that are kept.")
        .expert());

}  // namespace
}  // namespace tooljoint::drilling
