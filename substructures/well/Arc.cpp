// SPDX-License-Identifier: BSD-3-Clause
#include <Teuchos_ParameterList.hpp>
#include <cmath>

#include "common/Constants.hpp"
#include "substructures/well/ArcChain.hpp"

namespace tooljoint::well {
namespace {

using constants::pi;

std::unique_ptr<Trajectory> arcFrom(const Teuchos::ParameterList& list, const std::string&) {
  ArcShape shape;
  const bool radius = list.isParameter("Radius");
  if (radius == list.isParameter("Build Rate"))
    throw DeckError(list.name() +
                    ": The arc needs either Radius or Build Rate, and only one of them.");
  shape.radius = radius ? list.get<double>("Radius") : 1.0 / list.get<double>("Build Rate");
  shape.kickOffDepth = list.get<double>("Kick-off Depth");
  shape.startInclination = list.get<double>("Start Inclination");
  shape.endInclination = list.get<double>("End Inclination");
  shape.azimuth = list.get<double>("Azimuth");
  shape.tangentLength = list.get<double>("Tangent Length");
  try {
    return arc(shape);
  } catch (const DeckError& error) {
    throw DeckError(list.name() + ": " + error.what());
  }
}

const bool arcRegistered = TrajectoryRegistry::instance().add(
    "Arc",
    {"Planar arc between two inclinations with straight parts above and below it.",
     deck::ListSpec(
         "Arc",
         "Planar well: straight to the kick-off depth, a circular arc, a straight tangent section.")
         .real("Kick-off Depth", "m", 0.0, deck::Range::nonNegative(),
               "Length of the straight part above the arc.")
         .real("Radius", "m", deck::Optional{}, deck::Range::positive(),
               "Radius of curvature; or give the Build Rate.")
         .real("Build Rate", "rad/m", deck::Optional{}, deck::Range::positive(),
               "Change of inclination per length, for example \"3 deg/30m\"; or give the Radius.")
         .real("Start Inclination", "rad", 0.0, deck::Range{0.0, pi, false, true},
               "Angle from the vertical above the arc.")
         .expert()
         .real("End Inclination", "rad", deck::Required{}, deck::Range{0.0, pi, false, true},
               "Angle from the vertical below the arc; below the Start Inclination the arc drops.")
         .real("Azimuth", "rad", 0.0, deck::Range::any(),
               "Direction of the plane, from X (north) towards Y (east).")
         .real("Tangent Length", "m", 0.0, deck::Range::nonNegative(),
               "Length of the straight part below the arc."),
     arcFrom});

}  // namespace

std::unique_ptr<Trajectory> arc(const ArcShape& shape) {
  const double turn = std::abs(shape.endInclination - shape.startInclination);
  if (!(turn > 0.0))
    throw DeckError(
        "The arc starts and ends at the same inclination, so it has no length; give two "
        "inclinations, or use the trajectory Vertical with an Inclination.");
  auto chain = std::make_unique<ArcChain>(direction(shape.startInclination, shape.azimuth));
  chain->addStraight(shape.kickOffDepth);
  chain->addArc(shape.radius * turn, direction(shape.endInclination, shape.azimuth));
  chain->addStraight(shape.tangentLength);
  return chain;
}

}  // namespace tooljoint::well
