// SPDX-License-Identifier: BSD-3-Clause
#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>

#include "common/InputFile.hpp"
#include "substructures/well/ArcChain.hpp"

namespace tooljoint::well {
namespace {

std::unique_ptr<ArcChain> chainOf(const std::vector<Station>& stations) {
  if (stations.size() < 2) throw DeckError("A survey needs at least two stations.");
  if (stations.front().depth != 0.0)
    throw DeckError("The first survey station must be at measured depth 0.");
  auto chain = std::make_unique<ArcChain>(direction(stations[0].inclination, stations[0].azimuth));
  for (std::size_t i = 1; i < stations.size(); ++i) {
    const Vector3 before = direction(stations[i - 1].inclination, stations[i - 1].azimuth);
    const Vector3 now = direction(stations[i].inclination, stations[i].azimuth);
    const double length = stations[i].depth - stations[i - 1].depth;
    const std::string which = "Survey station " + std::to_string(i + 1);
    if (!(length > 0.0)) throw DeckError(which + " is not deeper than the station before.");
    if ((now + before).norm() < 1e-6)
      throw DeckError(which + " turns back by 180 degrees from the station before.");
    chain->addArc(length, now);
  }
  return chain;
}

std::unique_ptr<Trajectory> surveyFrom(const Teuchos::ParameterList& list,
                                       const std::string& folder) {
  const auto &depthUnit = list.get<std::string>("Depth Unit"),
             &angleUnit = list.get<std::string>("Angle Unit");
  const bool inDeck = list.isParameter("Stations");
  if (inDeck == list.isParameter("File"))
    throw DeckError(list.name() + " has " + (inDeck ? "both" : "neither") + " File " +
                    (inDeck ? "and" : "nor") +
                    " Stations. Give one: the file of a survey, or its stations.");
  if (inDeck)
    return chainOf(surveyStations(list.get<Teuchos::Array<double>>("Stations").toVector(),
                                  list.name() + "/Stations", depthUnit, angleUnit));
  const auto& name = list.get<std::string>("File");
  const std::string file =
      name.empty() || name[0] == '/' || folder.empty() ? name : folder + "/" + name;
  const std::string reason = whyUnreadable(file);
  if (!reason.empty())
    throw DeckError(list.name() + "/File names a file, but " + file + " cannot be read: " + reason +
                    ".");
  const SurveyTable survey = readSurveyTable(file, depthUnit, angleUnit);
  auto chain = chainOf(survey.stations);
  for (const std::string& remark : survey.remarks) chain->addRemark(remark);
  return chain;
}

const bool surveyRegistered = TrajectoryRegistry::instance().add(
    "Survey",
    {"Survey stations joined by circular arcs (minimum curvature method).",
     deck::ListSpec("Survey", "Survey stations, joined by minimum curvature.")
         .text("File", deck::Optional{},
               "Table of measured depth, inclination and azimuth, relative to the deck; cells "
               "separated by commas, semicolons, tabs or blanks. This or Stations.")
         .realArray("Stations", "", deck::Optional{}, deck::Range::any(),
                    "Measured depth, inclination and azimuth of one station after the other, in "
                    "the units below: a short survey without a file.")
         .choice("Depth Unit", std::string("m"), {"m", "ft", "km"},
                 "Unit of the measured depth where no header gives one.")
         .choice("Angle Unit", std::string("deg"), {"deg", "rad"},
                 "Unit of inclination and azimuth where no header gives one.")
         .expert(),
     surveyFrom});

}  // namespace

std::unique_ptr<Trajectory> minimumCurvature(const std::vector<Station>& stations) {
  return chainOf(stations);
}

}  // namespace tooljoint::well
