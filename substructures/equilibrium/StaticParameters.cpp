// SPDX-License-Identifier: BSD-3-Clause
#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>

#include "substructures/equilibrium/Equilibrium.hpp"

namespace tooljoint::equilibrium {

deck::ListSpec parameters() {
  using deck::Range;
  deck::ListSpec spec("Static",
                      "How the static equilibrium is found (Nguyen et al. 2020, section 3.2).");
  spec.choice("Recipe", std::string("Continuation"), {"Continuation", "Source"},
              "\"Continuation\" starts on the axis between walls that only push, sharpens them in "
              "stages, then brings in friction, then "
              "what the contact law pulls with; \"Source\" starts from the linear solution without "
              "contact and takes full steps.");
  spec.choice("Jacobian", std::string("Exact"), {"Exact", "Source"},
              "\"Source\" leaves out how the geometric stiffness changes with the displacement, "
              "equation (25).")
      .expert();
  spec.choice("Friction", std::string("Sliding Speed"), {"Sliding Speed", "Peak", "None"},
              "Friction of a string that turns in its hole without moving sideways. \"Sliding "
              "Speed\": the coefficient at the "
              "speed Omega R_c with which "
              "the motion starts, so that a string at constant speed starts in equilibrium; the "
              "peak, in the sense of the first "
              "rotation, where it "
              "starts from rest. \"Peak\": always the static coefficient, as the source. \"None\": "
              "no friction. A string that "
              "never turns has none.");
  spec.boolean("Geometric Stiffness", true,
               "Whether axial force and torque of the static state stiffen the string.")
      .expert();
  spec.real("Tolerance", "", 1e-9, Range::positive(),
            "Largest residual at convergence, relative to the largest load (moments: to that load "
            "on a mean element length).");
  spec.integer("Max Iterations", 200, Range::atLeast(1), "Newton iterations allowed in one stage.")
      .expert();
  spec.real("Lateral Step Limit", "m", 0.05, Range::positive(),
            "Largest change of a lateral displacement in one iteration of \"Continuation\".")
      .expert();
  spec.realArray("Lambda Stages", "1/m", std::vector<double>{1e3, 1e4, 1e6}, Range::positive(),
                 "Contact regularisations that \"Continuation\" goes through before the one of the "
                 "contact list.")
      .expert();
  spec.integer("Friction Steps", 4, Range::atLeast(1),
               "Equal steps in which \"Continuation\" brings in friction.")
      .expert();
  spec.passThrough("NOX", "Handed on to NOX.");
  spec.passThrough("Belos", "Handed on to Belos.");
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
  options.exactJacobian = list.get<std::string>("Jacobian") == "Exact";
  options.geometricStiffness = list.get<bool>("Geometric Stiffness");
  options.tolerance = list.get<double>("Tolerance");
  options.maxIterations = list.get<int>("Max Iterations");
  options.lateralStepLimit = list.get<double>("Lateral Step Limit");
  const auto& lambdas = list.get<Teuchos::Array<double>>("Lambda Stages");
  options.lambdas.assign(lambdas.begin(), lambdas.end());
  options.frictionSteps = list.get<int>("Friction Steps");
  return options;
}

}  // namespace tooljoint::equilibrium
