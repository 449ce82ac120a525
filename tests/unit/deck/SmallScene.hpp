// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A small list specification with one parameter of every kind, and matching decks.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/Error.hpp"
#include "deck/Deck.hpp"

namespace tooljoint::deck::test {

inline ListSpec smallScene() {
  ListSpec contact("Contact", "The contact with the borehole wall.");
  contact.real("Stiffness", "N/m", Required{}, Range::positive(), "The nominal contact stiffness.")
      .real("Friction", "", 0.2, Range::between(0.0, 1.0), "The friction coefficient.")
      .choice("Law", "Linear", {"Linear", "Hertz", "Winkler"}, "The contact law.")
      .boolean("Smooth", true, "Whether the law is rounded at the start of contact.");
  ListSpec interval("interval", "One depth interval.");
  interval
      .realArray("Depths", "m", Required{}, Range::nonNegative(),
                 "The measured depths where it begins and ends.")
      .real("Friction", "", Optional{}, Range::between(0.0, 1.0),
            "The friction coefficient there.");
  contact.list(
      ListSpec("Intervals", "The depth intervals with laws of their own.").namedLists(interval));

  ListSpec transient("Transient", "The time integration.");
  transient.real("End Time", "s", Required{}, Range::positive(), "The end of the simulated time.")
      .real("Step", "s", 1e-3, Range{0.0, 1.0, true, false}, "The time step.")
      .real("Speed", "rad/s", 4.0, Range::any(), "The rotary speed.")
      .real("Angle", "rad", Optional{}, Range::any(), "The angle at the start.")
      .integer("Samples", 100, Range::atLeast(1), "The number of samples.")
      .integerArray("Nodes", Optional{}, Range::atLeast(1), "The recorded nodes, from 1.")
      .textArray("Fields", std::vector<std::string>{"u", "v"}, {"u", "v", "w"},
                 "The recorded fields.")
      .realArray("Forces", "N", Optional{}, Range::any(), "The constant forces.")
      .realArray("Weights", "", std::vector<double>{1.0}, Range::nonNegative(), "The weights.")
      .text("Note", "", "A remark.")
      .passThrough("NOX", "Settings of the nonlinear solver.");

  ListSpec scene("scene", "A small scene.");
  scene.text("Title", "none", "The title.")
      .list(contact)
      .requiredList(transient)
      .list(ListSpec("Mud", "The drilling mud.")
                .real("Density", "kg/m3", 1000.0, Range::positive(), "The density."));
  return scene;
}

/// A deck with `contact` inside its contact list (line 3) and `transient` inside the list of the
/// time integration.
inline std::string deckWith(const std::string& contact, const std::string& transient) {
  return "<ParameterList name=\"well\">\n<ParameterList name=\"Contact\">\n" + contact +
         "\n</ParameterList>\n<ParameterList name=\"Transient\">\n" + transient +
         "\n</ParameterList>\n</ParameterList>\n";
}

inline std::string parameter(const std::string& name, const std::string& type,
                             const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\"/>";
}

inline const std::string stiffness = parameter("Stiffness", "double", "1e6");
inline const std::string endTime = parameter("End Time", "double", "20");

inline Deck parseSmall(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return Deck::parse(text, "deck.xml", smallScene(), overrides);
}

/// The message of the error thrown by `work`, with "FileError: " or "UsageError: " in front for
/// these kinds; "" if it throws none.
inline std::string messageOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const DeckError& error) {
    return error.what();
  } catch (const FileError& error) {
    return std::string("FileError: ") + error.what();
  } catch (const UsageError& error) {
    return std::string("UsageError: ") + error.what();
  }
  return "";
}

inline std::string faultOf(const std::string& text,
                           const std::vector<std::string>& overrides = {}) {
  return messageOf([&] { parseSmall(text, overrides); });
}

}  // namespace tooljoint::deck::test
