// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/mud/MudModel.hpp"

#include "deck/Deck.hpp"
#include "deck/Variants.hpp"

namespace tooljoint::mud {

deck::ListSpec parameters() {
  using deck::Range;
  deck::ListSpec spec("Mud",
                      "Drilling mud inside and around the string; without this list nothing of "
                      "it is modelled.");
  deck::declareVariants<MudModel, const Teuchos::ParameterList&, const MudProperties&>(
      spec, "Model", std::string("Annular flow"), "Terms that the mud adds to the elements.")
      .expert();
  spec.real("Density", "kg/m3", deck::Required{}, Range::nonNegative(),
            "Mass density of the mud: added lateral mass inside and outside, and buoyancy.")
      .real("Friction Coefficient", "", 0.013, Range::nonNegative(),
            "Friction coefficient of the axial flow along the string, C_f: lateral damping and "
            "axial drag.")
      .real("Kinematic Viscosity", "m2/s", 1e-6, Range::nonNegative(),
            "Kinematic viscosity of the mud: lateral damping that grows with the square root of "
            "the rotary speed.")
      .real("Flow Rate", "m3/s", 0.0, Range::any(),
            "Volume pumped per second, down the string and up the annulus when positive.")
      .boolean("Coriolis", true,
               "Keep the Coriolis forces of both axial flows; needs a flow rate to matter.")
      .expert()
      .boolean("Centrifugal", true,
               "Keep the centrifugal stiffness of both axial flows; needs a flow rate to matter.")
      .expert()
      .boolean(
          "Axial Drag", true,
          "Keep the axial drag of the returning flow on the string; needs a flow rate to matter.")
      .expert()
      .boolean("Annular Thrust", false,
               "Add to the Axial Drag the thrust of the pressure loss of the returning flow in "
               "the annulus, R_e/(R_w - R_e) times the drag; false as in the published model.")
      .expert()
      .boolean("Rotating Annulus", false,
               "Let the annular mud swirl at half the rotary speed: cross-coupled damping, "
               "negative and circulatory stiffness. It "
               "changes the motion strongly; terms of the angular acceleration are left out.")
      .expert();
  return spec;
}

MudProperties readProperties(const Teuchos::ParameterList& list) {
  MudProperties p;
  p.density = list.get<double>("Density");
  p.frictionCoefficient = list.get<double>("Friction Coefficient");
  p.kinematicViscosity = list.get<double>("Kinematic Viscosity");
  p.flowRate = list.get<double>("Flow Rate");
  p.coriolis = list.get<bool>("Coriolis");
  p.centrifugal = list.get<bool>("Centrifugal");
  p.axialDrag = list.get<bool>("Axial Drag");
  p.annularThrust = list.get<bool>("Annular Thrust");
  p.rotatingAnnulus = list.get<bool>("Rotating Annulus");
  return p;
}

std::unique_ptr<MudModel> readMud(const Teuchos::ParameterList& list) {
  const auto& name = list.get<std::string>("Model");
  const auto& models = MudModels::instance();
  return models.make(name, deck::variantList(list, name, models.find(name).parameters),
                     readProperties(list));
}

}  // namespace tooljoint::mud
