// SPDX-License-Identifier: BSD-3-Clause
#include <Teuchos_ParameterList.hpp>

#include "substructures/equilibrium/Equilibrium.hpp"

namespace tooljoint::equilibrium {

deck::ListSpec parameters() {
  using deck::Range;
  deck::ListSpec spec("Static",
                      "Solution of the static equilibrium (Nguyen et al. 2020, section 3.2).");
  spec.removed({"Lambda Stages"},
               "the contact regularisations of the recipe \"Continuation\" are constants. Leave it "
               "out.");
  spec.choice(
      "Recipe", std::string("Continuation"), {"Continuation", "Source"},
      "\"Continuation\" starts on the axis with a soft contact law without attraction and stiffens "
      "it in stages; then it adds friction, then the attraction of the contact law. \"Source\" "
      "starts from the linear solution without contact and takes full Newton steps.");
  spec.choice("Jacobian", std::string("Exact"), {"Exact", "Source"},
              "\"Exact\": the complete Jacobian. \"Source\": without the derivative of the "
              "geometric stiffness, equation (25).")
      .expert();
  spec.choice("Friction", std::string("Sliding Speed"), {"Sliding Speed", "Peak", "None"},
              "Friction in the static state, where the string rotates without lateral motion. "
              "\"Sliding Speed\": the coefficient at the sliding speed Omega R_c of the start of "
              "the motion, so that a string at constant speed starts in equilibrium; where the "
              "string starts from rest, the static coefficient in the direction of the first "
              "rotation. \"Peak\": always the static coefficient, as the source. \"None\": no "
              "friction. A string that never rotates has no friction, unless a block moves it and "
              "Contact/Friction/Axial is true: then the speed along the hole counts, too.");
  spec.choice(
      "Reference", std::string("Unloaded"), {"Unloaded", "Hanging"},
      "Which string has its nodes at the depths of the mesh; displacements count from there. "
      "\"Unloaded\": a string without loads, which its weight then stretches along the well. "
      "\"Hanging\": the string under its weight. Strings of kilometres need it: where they "
      "move along a well that turns, displacements are too large for the model.");
  spec.boolean("Geometric Stiffness", true,
               "Include the geometric stiffness of axial force and torque in the static state.")
      .expert();
  spec.real("Tolerance", "", 1e-9, Range::positive(),
            "Largest residual at convergence, relative to the largest load (moments: to that load "
            "on a mean element length).");
  spec.integer("Max Iterations", 200, Range::atLeast(1), "Newton iterations allowed in one stage.")
      .expert();
  spec.real("Lateral Step Limit", "m", 0.05, Range::positive(),
            "Largest change of a lateral displacement in one iteration of \"Continuation\".")
      .expert();
  spec.integer("Friction Steps", 4, Range::atLeast(1),
               "Number of equal steps in which \"Continuation\" adds friction.")
      .expert();
  spec.choice("Unstable State", std::string("Warn"), {"Warn", "Perturb", "Refuse"},
              "Treatment of an unstable static state: buckled on the axis of the bore, or with a "
              "growing vibration about it. \"Warn\": the state is used and a warning names mode "
              "and growth rate. \"Perturb\": the string is moved along the unstable mode and "
              "settles on the wall, again until the state is stable; a growing vibration is warned "
              "of. \"Refuse\": the run ends with exit code 4.");
  spec.passThrough("NOX", "Parameters passed to NOX unchanged.");
  spec.passThrough("Belos", "Parameters passed to Belos unchanged.");
  return spec;
}

StaticOptions optionsFrom(const Teuchos::ParameterList& list) {
  StaticOptions options;
  options.recipe =
      list.get<std::string>("Recipe") == "Source" ? Recipe::Source : Recipe::Continuation;
  const auto& friction = list.get<std::string>("Friction");
  options.friction = friction == "Peak"   ? FrictionRule::Peak
                     : friction == "None" ? FrictionRule::None
                                          : FrictionRule::SlidingSpeed;
  options.reference =
      list.get<std::string>("Reference") == "Hanging" ? Reference::Hanging : Reference::Unloaded;
  options.exactJacobian = list.get<std::string>("Jacobian") == "Exact";
  options.geometricStiffness = list.get<bool>("Geometric Stiffness");
  options.tolerance = list.get<double>("Tolerance");
  options.maxIterations = list.get<int>("Max Iterations");
  options.lateralStepLimit = list.get<double>("Lateral Step Limit");
  const auto& unstable = list.get<std::string>("Unstable State");
  options.unstable = unstable == "Perturb"  ? UnstableRule::Perturb
                     : unstable == "Refuse" ? UnstableRule::Refuse
                                            : UnstableRule::Warn;
  options.frictionSteps = list.get<int>("Friction Steps");
  return options;
}

}  // namespace tooljoint::equilibrium
