// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/case/UsualRanges.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "common/Text.hpp"
#include "deck/reading/Units.hpp"
#include "substructures/drillstring/scene/Scene.hpp"

namespace tooljoint::drillstring {

namespace {

/// Largest number of units proposed for one number.
constexpr std::size_t mostUnits = 2;

/// Rotary speeds [rad/s]: 760 rpm; 300 rpm for a value in rad/s, the unit of a bare number, since
/// "60" most probably means rpm; 2400 rpm for a diagram over the speed.
constexpr double fastest = 80.0, fastestInSi = 31.5, fastestDrawn = 250.0;
/// One revolution [rad], and largest friction coefficient.
constexpr double round = 6.3, roughest = 1.5;
/// Weight on bit and torques [N, N m].
constexpr double leastWeight = 1e3, mostWeight = 5e6, leastTorque = 10.0, mostTorque = 3e5;
/// Length along the well [m], its curvature [rad/m] (11 deg/m) and the speed of a block [m/s].
constexpr double longest = 15e3, mostCurved = 0.2, fastestBlock = 3.0;
/// Yield strengths [Pa].
constexpr double weakest = 1e7, strongest = 3e9;

/// A parameter of the deck and its list.
struct Place {
  std::string list, name;
};

Place placeOf(const std::string& path) {
  const auto slash = path.rfind('/');
  return {path.substr(0, slash), path.substr(slash + 1)};
}

const deck::ListSpec* listAt(const deck::ListSpec& root, const std::string& path) {
  const deck::ListSpec* list = &root;
  std::istringstream names(path);
  for (std::string name; list != nullptr && std::getline(names, name, '/');)
    list = list->findList(name);
  return list;
}

const Teuchos::ParameterList& valuesAt(const Teuchos::ParameterList& root,
                                       const std::string& path) {
  const Teuchos::ParameterList* list = &root;
  std::istringstream names(path);
  for (std::string name; std::getline(names, name, '/');) list = &list->sublist(name);
  return *list;
}

/// The number of a parameter, or the numbers of an array.
std::vector<double> numbers(const Teuchos::ParameterList& list, const deck::ParameterSpec& spec) {
  if (spec.kind == deck::Kind::Real) return {list.get<double>(spec.name)};
  const auto& all = list.get<Teuchos::Array<double>>(spec.name);
  return {all.begin(), all.end()};
}

bool isUsual(double value, const UsualRange& range) {
  const double size = std::abs(value);
  return size == 0.0 || (size >= range.low && size <= range.high);
}

/// The number in other units in which it is usual; empty if there are none.
/// \param scale  judged value over the value in the deck (radius, diameter)
std::string otherUnits(double value, const std::string& si, double scale, const UsualRange& range) {
  std::vector<std::string> found;
  for (const auto& unit : deck::unitsLike(si)) {
    std::string fault;
    const auto converted = deck::toSi(formatNumber(value) + " " + unit, si, fault);
    if (found.size() < mostUnits && unit != si && converted && isUsual(scale * *converted, range))
      found.push_back(inQuotes(formatNumber(value) + " " + unit));
  }
  return found.empty() ? "" : " Is " + join(found, " or ") + " meant?";
}

std::string withUnit(const std::string& number, const std::string& unit) {
  return unit.empty() ? number : number + " " + unit;
}

std::string bounds(double scale, const UsualRange& range, const std::string& unit) {
  const auto text = [&](double bound) { return formatNumber(bound / scale); };
  return (range.low > 0 ? text(range.low) + " to " : "up to ") + withUnit(text(range.high), unit);
}

}  // namespace

const std::vector<UsualRange>& usualRanges() {
  static const std::vector<UsualRange> ranges{
      {"Well/Bore Radius", 0.02, 0.75},
      {"Well/Vertical/Length", 0, longest},
      {"Well/Arc/Kick-off Depth", 0, longest},
      {"Well/Arc/Tangent Length", 0, longest},
      {"Well/Arc/Build Rate", 0, mostCurved},
      {"Drillstring/Bit Depth", 0, longest},
      {"Drillstring/Material/Density", 1500, 20e3},        // carbon fibre to tungsten
      {"Drillstring/Material/Young Modulus", 1e10, 1e12},  // fibres to tungsten carbide
      {"Drillstring/Material/Yield Strength", weakest, strongest},
      {"Mud/Density", 100, 3000},  // foam to the heaviest mud
      {"Mud/Kinematic Viscosity", 1e-7, 1e-2},
      {"Mud/Flow Rate", 1e-5, 0.5},
      {"Contact/Stiffness", 1e3, 1e13},
      {"Loads/Weight On Bit", leastWeight, mostWeight},
      {"Loads/Torque On Bit", leastTorque, mostTorque},
      {"Loads/Gravity", 1, 30},
      {"Rotary Speed/Constant/Speed", 0, fastest, fastestInSi},
      {"Drillstring/Tool Face", 0, round},
      {"Contact/Friction/Static", 0, roughest},
      {"Contact/Friction/Dynamic", 0, roughest},
      {"Rotary Speed/Exponential/Initial Speed", 0, fastest, fastestInSi},
      {"Rotary Speed/Exponential/Final Speed", 0, fastest, fastestInSi},
      {"Rotary Speed/Harmonic/Mean Speed", 0, fastest, fastestInSi},
      {"Rotary Speed/Ramp/Initial Speed", 0, fastest, fastestInSi},
      {"Rotary Speed/Ramp/Final Speed", 0, fastest, fastestInSi},
      {"Rotary Speed/Table/Speeds", 0, fastest},
      {"Top Drive/Torque Limit", leastTorque, mostTorque},
      {"Top Drive/Block Speed", 0, fastestBlock},
      {"Top Drive/Autodriller/Weight On Bit", leastWeight, mostWeight},
      {"Torque and Drag/Depths", 0, longest},
      {"Torque and Drag/Block Weight", leastWeight, mostWeight},
      {"Torque and Drag/Rotary Speed", 0, fastest, fastestInSi},
      {"Torque and Drag/Broomstick", 0, roughest},
      {"Torque and Drag/Reaming Speed", 0, fastestBlock},
      {"Torque and Drag/Rate Of Penetration", 0, 0.1},
      {"Torque and Drag/Pump Pressure", 1e4, 2e8},
      {"Torque and Drag/Yield Strength", weakest, strongest},
      {"Bottom-Hole Assembly/Weight On Bit", leastWeight, mostWeight},
      {"Bottom-Hole Assembly/Tool Face", 0, round},
      {"Bottom-Hole Assembly/Build Rate", 0, mostCurved},
      {"Bottom-Hole Assembly/Turn Rate", 0, mostCurved},
      {"Buckling/Last Weight On Bit", leastWeight, mostWeight},
      {"Campbell/Highest Speed", 0, fastestDrawn},
      {"Response/Highest Speed", 0, fastestDrawn}};
  return ranges;
}

std::vector<std::string> unusualValues(const deck::Deck& scene) {
  std::vector<std::string> found;
  const auto spec = sceneSpec();
  for (UsualRange range : usualRanges()) {
    const Place place = placeOf(range.path);
    const deck::ListSpec& list = *listAt(spec, place.list);
    const auto* diameter = list.diameterOf(place.name);
    const std::string other = diameter == nullptr ? "" : place.list + "/" + diameter->name;
    const bool doubled = diameter != nullptr && scene.gives(other);
    if (!doubled && !scene.gives(range.path)) continue;
    const auto& parameter = *list.findParameter(place.name);
    if (range.highInSi > 0 && scene.given(range.path, parameter.unit).unit == parameter.unit)
      range.high = range.highInSi;
    const auto values = numbers(valuesAt(scene.list(), place.list), parameter);
    const auto odd = std::find_if(values.begin(), values.end(),
                                  [&](double value) { return !isUsual(value, range); });
    if (odd == values.end()) continue;
    const double scale = doubled ? 0.5 : 1.0, given = *odd / scale;
    found.push_back(scene.error(doubled ? other : range.path,
                                "is " + withUnit(formatNumber(given), parameter.unit) +
                                    ", outside what is usual in drilling (" +
                                    bounds(scale, range, parameter.unit) + ")." +
                                    otherUnits(given, parameter.unit, scale, range)));
  }
  return found;
}

}  // namespace tooljoint::drillstring
