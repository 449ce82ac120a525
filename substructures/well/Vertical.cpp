// SPDX-License-Identifier: BSD-3-Clause
#include <Teuchos_ParameterList.hpp>

#include "common/Constants.hpp"
#include "substructures/well/ArcChain.hpp"

namespace tooljoint::well {
namespace {

using constants::pi;

const bool verticalRegistered = TrajectoryRegistry::instance().add(
    "Vertical",
    {"Straight well, vertical or with a constant inclination.",
     deck::ListSpec("Vertical", "Straight well, vertical unless an inclination is given.")
         .real("Length", "m", deck::Required{}, deck::Range::positive(), "Length along the hole.")
         .real("Inclination", "rad", 0.0, deck::Range{0.0, pi, false, true},
               "Angle from the vertical.")
         .real("Azimuth", "rad", 0.0, deck::Range::any(),
               "Direction of the inclination, from X (north) towards Y (east)."),
     [](const Teuchos::ParameterList& list, const std::string&) {
       return straight(list.get<double>("Length"), list.get<double>("Inclination"),
                       list.get<double>("Azimuth"));
     }});

}  // namespace

std::unique_ptr<Trajectory> straight(double length, double inclination, double azimuth) {
  auto chain = std::make_unique<ArcChain>(direction(inclination, azimuth));
  chain->addStraight(length);
  return chain;
}

}  // namespace tooljoint::well
