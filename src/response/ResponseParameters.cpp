// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "cases/CaseLists.hpp"
#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Text.hpp"
#include "coupling/input/ComponentAxes.hpp"
#include "response/Response.hpp"
#include "response/SweepParameters.hpp"

namespace tooljoint::response {

namespace {

using deck::ListSpec;
using deck::Range;
using Teuchos::ParameterList;

/// Parameters of the other kind of sweep.
std::vector<std::string> ofTheOther(bool bySpeed) {
  if (bySpeed) return {"Lowest Frequency", "Rotary Speed"};
  return {"Lowest Speed", "Order", "Motor Speed"};
}

constexpr const char* excitations[] = {"Unbalance", "Harmonic", "Transfer"};

ListSpec loadParameters() {
  ListSpec list("load", "A load on one dof; the name is free.");
  cases::declareNode(list, "that is loaded");
  return list
      .text("Component", deck::Required{}, "Component of the node, in the frame of the results.")
      .real(
          "Value", "N or N m", 1.0, Range::any(),
          "Amplitude: a force, or a moment about a rotation component. Transfer functions take 1.")
      .unitBy("Component", coupling::unitByKind("N", "N m"))
      .real("Phase", "rad", 0.0, Range::any(), "Phase of the load.");
}

ListSpec unbalanceParameters() {
  ListSpec list("unbalance", "A mass off the axis; the name is free.");
  cases::declareNode(list, "that carries it");
  return list
      .real("Moment", "kg m", deck::Required{}, Range::positive(), "Mass times eccentricity.")
      .real("Phase", "rad", 0.0, Range::any(), "Angle of the mass, from x towards y about z.");
}

ListSpec outputParameters() {
  ListSpec list("output", "A dof whose response is wanted; the name is that of its columns.");
  cases::declareNode(list, "whose response is written");
  return list.text("Component", deck::Required{},
                   "Component of the node, in the frame of the results.");
}

/// Calls read(name, list) for every list in the sublist `kind`.
template <class Read>
void forEachList(const ParameterList& list, const char* kind, const Read& read) {
  if (!list.isSublist(kind)) return;
  const auto& all = list.sublist(kind);
  for (auto it = all.begin(); it != all.end(); ++it)
    if (it->second.isList()) read(it->first, all.sublist(it->first));
}

DeckError noEffect(const ParameterList& list, const std::string& name, bool bySpeed) {
  return DeckError(list.name() + "/" + name + " has no effect in a sweep by " +
                   (bySpeed ? "speed" : "frequency") + ". Leave it out.");
}

/// omega = Order Omega + Motor Order Omega_m
void readMotor(const ParameterList& list, ResponseSettings& settings) {
  settings.motorSpeed = list.get<double>("Motor Speed");
  settings.motorOrder =
      list.isParameter("Motor Order") ? list.get<double>("Motor Order") : settings.order;
  if (settings.motorSpeed == 0.0 && list.isParameter("Motor Order"))
    throw DeckError(list.name() +
                    "/Motor Order has no effect without Motor Speed. Give the speed of the bit "
                    "over that of the string.");
  if (!(settings.order > 0.0) && !(settings.offset() > 0.0))
    throw DeckError(list.name() +
                    "/Order is 0, so that nothing vibrates. Give a larger one, or Motor Speed and "
                    "Motor Order.");
}

void readSweep(const ParameterList& list, ResponseSettings& settings) {
  const bool bySpeed = list.isParameter("Highest Speed"),
             byFrequency = list.isParameter("Highest Frequency");
  if (bySpeed == byFrequency)
    throw DeckError(list.name() + " has " + (bySpeed ? "both" : "neither") + " Highest Speed " +
                    (bySpeed ? "and" : "nor") +
                    " Highest Frequency. Give one: the sweep is by rotary speed or by frequency.");
  for (const auto& other : ofTheOther(bySpeed))
    if (list.get<double>(other) != (other == "Order" ? 1.0 : 0.0))
      throw noEffect(list, other, bySpeed);
  if (bySpeed) {
    settings.speeds = evenly(list, "Lowest Speed", "Highest Speed", "rad/s");
    settings.order = list.get<double>("Order");
    readMotor(list, settings);
  } else {
    if (list.isParameter("Motor Order")) throw noEffect(list, "Motor Order", bySpeed);
    settings.frequencies = evenly(list, "Lowest Frequency", "Highest Frequency", "Hz");
    settings.rotarySpeed = list.get<double>("Rotary Speed");
  }
}

void requireSense(const ParameterList& list, const ResponseSettings& settings) {
  const bool unbalance = settings.excitation == Excitation::Unbalance;
  if (settings.outputs.empty())
    throw DeckError(list.name() + "/Outputs holds no dof. Add a list with Node and Component.");
  if (!unbalance && settings.loads.empty())
    throw DeckError(list.name() + "/Loads holds no load, which Excitation \"" +
                    list.get<std::string>("Excitation") +
                    "\" needs. Add a list with Node and Component.");
  if (unbalance && !settings.bySpeed())
    throw DeckError(list.name() +
                    "/Highest Frequency has no meaning for an unbalance, whose frequency is the "
                    "rotary speed. Give Highest Speed.");
  for (const auto& [name, order] :
       {std::pair{"/Order", settings.order}, std::pair{"/Motor Order", settings.motorOrder}})
    if (unbalance && order != 1.0)
      throw DeckError(list.name() + name + " is " + formatNumber(order) +
                      ", but an unbalance has the order 1. Leave it out.");
  if (unbalance ? !settings.loads.empty() : !settings.unbalances.empty())
    throw DeckError(list.name() + (unbalance ? "/Loads" : "/Unbalance") +
                    " has no effect with Excitation \"" + list.get<std::string>("Excitation") +
                    "\". Leave it out.");
}

std::string motorText(const ResponseSettings& settings) {
  if (!(settings.motorSpeed > 0.0)) return "";
  return fmt::format(", excited at {} x rotary speed + {:.6g} Hz", formatNumber(settings.order),
                     settings.offset() / constants::twoPi);
}

std::string describe(const cases::Case& one) {
  const auto settings = readResponse(one.list().sublist("Response"));
  const bool bySpeed = settings.bySpeed();
  const double last = bySpeed ? settings.speeds.back() * constants::rpmPerRadianPerSecond
                              : settings.frequencies.back();
  std::vector<std::string> names;
  for (const auto& output : settings.outputs) names.push_back(output.name);
  return lower(excitations[static_cast<int>(settings.excitation)]) + " at " +
         std::to_string(settings.points()) + (bySpeed ? " speeds up to " : " frequencies up to ") +
         fmt::format("{:.6g}", last) + (bySpeed ? " rpm" : " Hz") + ", outputs " +
         quotedList(names) + motorText(settings) + ", " + (settings.friction ? "with" : "without") +
         " friction; " +
         (one.reduces()
              ? "reduced model, full model at " + std::to_string(settings.spotChecks) + " points"
              : "full model") +
         " (tooljoint response)";
}

const bool responseParametersRegistered = cases::AnalysisLists::instance().add(
    {"Response", responseParameters, [](const ParameterList& list) { readResponse(list); },
     describe,
     "no Response list: give its Highest Speed or Highest Frequency, and Outputs (tooljoint "
     "response)"});

}  // namespace

ListSpec responseParameters() {
  ListSpec list("Response",
                "Harmonic response about the state at rest against rotary speed or frequency: what "
                "`tooljoint response` computes.");
  list.choice("Excitation", std::string("Unbalance"),
              {excitations[0], excitations[1], excitations[2]},
              "Unbalance: masses off the axis, of the list Unbalance and of Loads/Unbalance of a "
              "string, by Omega^2. Harmonic: all Loads at once. Transfer: response to a unit load "
              "at each dof of Loads in turn.")
      .real("Lowest Speed", "rad/s", 0.0, Range::nonNegative(), "First speed of a sweep by speed.")
      .real("Highest Speed", "rad/s", deck::Optional{}, Range::positive(),
            "Last speed; this or Highest Frequency.")
      .real("Order", "", 1.0, Range::nonNegative(),
            "Excitation frequency over the rotary speed in a sweep by speed.")
      .expert()
      .real("Motor Speed", "rad/s", 0.0, Range::nonNegative(),
            "Speed of the bit over that of the string, of a mud motor between them, in a sweep by "
            "speed. Adds Motor Order times itself to the frequency; masses of the list Unbalance "
            "turn with the bit.")
      .expert()
      .real("Motor Order", "", deck::Optional{}, Range::nonNegative(),
            "Excitation frequency over the speed of the motor. Default: Order, an excitation by "
            "the bit. With Order 0 the lobes of the motor: its rotor goes round so many times in "
            "its turn.")
      .expert()
      .real("Lowest Frequency", "Hz", 0.0, Range::nonNegative(),
            "First frequency of a sweep by frequency.")
      .real("Highest Frequency", "Hz", deck::Optional{}, Range::positive(), "Last frequency.")
      .real("Rotary Speed", "rad/s", 0.0, Range::nonNegative(),
            "Rotary speed in a sweep by frequency.")
      .integer("Points", 201, Range::atLeast(2), "Speeds or frequencies, evenly spaced.");
  declareCommon(list);
  ListSpec loads("Loads", "Harmonic loads, or dofs of transfer functions.");
  loads.namedLists(loadParameters());
  ListSpec unbalances("Unbalance", "Masses off the axis, in addition to those of the scene.");
  unbalances.namedLists(unbalanceParameters());
  ListSpec outputs("Outputs", "Dofs whose amplitude and phase are written.");
  outputs.namedLists(outputParameters());
  return list.list(loads).list(unbalances).list(outputs);
}

ResponseSettings readResponse(const ParameterList& list) {
  ResponseSettings settings;
  const auto excitation = list.get<std::string>("Excitation");
  const auto* const found = std::find(std::begin(excitations), std::end(excitations), excitation);
  settings.excitation = static_cast<Excitation>(found - std::begin(excitations));
  readSweep(list, settings);
  forEachList(list, "Loads", [&](const std::string& name, const ParameterList& one) {
    settings.loads.push_back(
        {name, cases::readNode(one), one.get<double>("Value"), one.get<double>("Phase")});
  });
  forEachList(list, "Unbalance", [&](const std::string& name, const ParameterList& one) {
    settings.unbalances.push_back(
        {name, cases::readNode(one), one.get<double>("Moment"), one.get<double>("Phase")});
  });
  forEachList(list, "Outputs", [&](const std::string& name, const ParameterList& one) {
    settings.outputs.push_back({name, cases::readNode(one)});
  });
  settings.friction = wantsFriction(list);
  settings.spotChecks = list.get<int>("Spot Checks");
  settings.axis = list.get<std::string>("Axis");
  requireSense(list, settings);
  return settings;
}

}  // namespace tooljoint::response
