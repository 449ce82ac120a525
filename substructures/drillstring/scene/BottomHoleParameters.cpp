// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/scene/BottomHoleParameters.hpp"

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>

#include "common/Constants.hpp"

namespace tooljoint::drillstring {

deck::ListSpec bottomHoleParameters() {
  using deck::Optional;
  using deck::Range;
  deck::ListSpec list("Bottom-Hole Assembly",
                      "Forces, tilt and bending of the lower part of the string at rest: what "
                      "`tooljoint bha` computes, for every combination of the arrays.");
  list.realArray("Weight On Bit", "N", Optional{}, Range::nonNegative(),
                 "Weights on bit; that of Loads when absent.");
  list.realArray("Inclination", "rad", Optional{}, Range{0.0, constants::pi, false, true},
                 "Inclinations at the bit of holes of constant curvature; the hole of the list "
                 "Well when absent.");
  list.real("Build Rate", "rad/m", 0.0, Range::any(),
            "Change of inclination per length of the holes of Inclination.");
  list.real("Turn Rate", "rad/m", 0.0, Range::any(),
            "Change of azimuth per length, at the bit, of the holes of Inclination; positive "
            "turns to the right.")
      .expert();
  list.realArray("Tool Face", "rad", Optional{}, Range::any(),
                 "Tool faces of the string that slides; Drillstring/Tool Face when absent.");
  list.real("Survey Tool", "m", Optional{}, Range::positive(),
            "Distance of the survey tool from the bit; without it no sag.");
  list.real("Length", "m", Optional{}, Range::positive(),
            "Length of the string modelled above the bit; when absent it grows until the force on "
            "the bit and its tilt change by less than 1 %.");
  list.real("Element Length", "m", 0.5, Range::positive(),
            "Longest element; those of the deck are divided where they are longer.")
      .expert();
  list.integer("Rotating Tool Faces", 12, Range::atLeast(3),
               "Number of evenly spaced tool faces in the average of the string that turns.")
      .expert();
  return list;
}

BottomHoleSettings readBottomHole(const Teuchos::ParameterList& list) {
  const auto array = [&](const char* name) {
    return list.isParameter(name) ? list.get<Teuchos::Array<double>>(name).toVector()
                                  : std::vector<double>();
  };
  BottomHoleSettings settings;
  settings.weights = array("Weight On Bit");
  settings.inclinations = array("Inclination");
  settings.buildRate = list.get<double>("Build Rate");
  settings.turnRate = list.get<double>("Turn Rate");
  settings.toolFaces = array("Tool Face");
  if (list.isParameter("Survey Tool")) settings.surveyTool = list.get<double>("Survey Tool");
  if (list.isParameter("Length")) settings.length = list.get<double>("Length");
  settings.elementLength = list.get<double>("Element Length");
  settings.rotatingToolFaces = list.get<int>("Rotating Tool Faces");
  return settings;
}

}  // namespace tooljoint::drillstring
