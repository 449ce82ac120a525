// SPDX-License-Identifier: BSD-3-Clause
#include "parts/PartsParameters.hpp"

#include <Eigen/Geometry>
#include <Teuchos_Array.hpp>
#include <functional>

#include "common/Error.hpp"
#include "coupling/input/ComponentAxes.hpp"
#include "parts/TimeLaw.hpp"

namespace tooljoint::parts {

namespace {

using deck::ListSpec;
using deck::Optional;
using deck::Range;
using deck::Required;
using Teuchos::ParameterList;

ListSpec importedParameters() {
  return ListSpec("part",
                  "A part from a file; the name of the list is its name. Several parts may come "
                  "from one file.")
      .text("File", Required{},
            "The part: a folder with part.json, a .json file, or an HDF5 file, relative to the "
            "deck; docs/file-formats.md "
            "describes them.")
      .realArray(
          "Rotation Axis", "", std::vector<double>{0.0, 0.0, 1.0}, Range::any(),
          "Axis about which the part is turned from the frame of its file into the common one.")
      .real("Rotation Angle", "rad", 0.0, Range::any(), "Angle of that turn, right-handed.")
      .textArray("Fixed", Optional{}, {},
                 "Dofs that do not move: a node or the name of an interface set, and components "
                 "unless all of them are meant, "
                 "e.g. {1, 5 u v, "
                 "clamp}.")
      .textArray("Retained", Optional{}, {},
                 "Dofs that stay physical beside those the file says, written as in \"Fixed\".")
      .boolean("Reduce", true,
               "Let the list Reduction reduce this part; false keeps all its dofs, for a part that "
               "was reduced before.");
}

ListSpec loadParameters() {
  return ListSpec("load", "A load on one dof, in the frame of the part.")
      .text("Part", Required{}, "Name of the part.")
      .integer("Node", Required{}, Range::atLeast(1), "Node, as the file of the part numbers it.")
      .text("Component", Required{}, "Component of the node.")
      .real("Value", "N or N m", Required{}, Range::any(),
            "Force, or moment about a rotation component; a plain number for a component of "
            "neither kind.")
      .unitBy("Component", coupling::unitByKind("N", "N m"))
      .text("Law", std::string("1"),
            "Law of time that multiplies it: \"1\", or one of the list Laws.");
}

ListSpec startParameters() {
  return ListSpec("start",
                  "Initial displacement and velocity of one dof, added to what the files say, in "
                  "the frame of the part.")
      .text("Part", Required{}, "Name of the part.")
      .integer("Node", Required{}, Range::atLeast(1), "Node, as the file of the part numbers it.")
      .text("Component", Required{}, "Component of the node.")
      .real("Displacement", "m or rad", 0.0, Range::any(), "Initial displacement.")
      .unitBy("Component", coupling::unitByKind("m", "rad"))
      .real("Velocity", "m/s or rad/s", 0.0, Range::any(), "Initial velocity.")
      .unitBy("Component", coupling::unitByKind("m/s", "rad/s"));
}

std::vector<std::string> texts(const ParameterList& list, const std::string& name) {
  return list.isParameter(name) ? list.get<Teuchos::Array<std::string>>(name).toVector()
                                : std::vector<std::string>{};
}

/// Calls visit(name, list) for every list in the sublist `kind`, in the order of the deck.
void forEachList(const ParameterList& list, const std::string& kind,
                 const std::function<void(const std::string&, const ParameterList&)>& visit) {
  if (!list.isSublist(kind)) return;
  const auto& all = list.sublist(kind);
  for (auto it = all.begin(); it != all.end(); ++it)
    if (it->second.isList()) visit(it->first, all.sublist(it->first));
}

ImportedPart readImported(const std::string& name, const ParameterList& list) {
  ImportedPart part;
  part.name = name;
  part.where = list.name();
  part.file = list.get<std::string>("File");
  const auto axis = list.get<Teuchos::Array<double>>("Rotation Axis").toVector();
  if (axis.size() != 3)
    throw DeckError(list.name() + "/Rotation Axis has " + std::to_string(axis.size()) +
                    " numbers; give three.");
  const Vector3 direction(axis[0], axis[1], axis[2]);
  if (!(direction.norm() > 0.0))
    throw DeckError(list.name() +
                    "/Rotation Axis has no direction: give a vector that is not zero.");
  const double angle = list.get<double>("Rotation Angle");
  part.turned = angle != 0.0;
  if (part.turned) part.axes = Eigen::AngleAxisd(angle, direction.normalized()).toRotationMatrix();
  part.fixed = texts(list, "Fixed");
  part.retained = texts(list, "Retained");
  part.reduce = list.get<bool>("Reduce");
  return part;
}

}  // namespace

deck::ListSpec parameters() {
  ListSpec list("Parts",
                "A scene of parts that came from files, instead of (or beside) what the other "
                "lists describe.");
  ListSpec imported("Imported", "The parts, in the order of the deck.");
  imported.namedLists(importedParameters());
  list.requiredList(imported);
  list.textArray("Joints", Optional{}, {},
                 "What is joined: nodes or interface sets of two or more parts, {left:tip = "
                 "right:root, a:7 = b:1 = c:1}; sets "
                 "are joined node by node in "
                 "their order, in the components all of them have. Every part then numbers its "
                 "nodes for itself; without Joints, "
                 "interface nodes of one number "
                 "are one node unless Coupling/Node Numbers is \"Own\".")
      .choice("Initial State", std::string("From files"), {"From files", "Equilibrium"},
              "\"From files\": initial displacements of the files, which are zero where they give "
              "none; \"Equilibrium\": rest "
              "under the loads of the start time, "
              "about which parts are then reduced.");
  ListSpec loads("Loads", "Loads on single dofs, beside those of the files.");
  loads.namedLists(loadParameters());
  list.list(loads);
  ListSpec starts("Starts", "Initial displacements and velocities of single dofs.");
  starts.namedLists(startParameters());
  list.list(starts);
  ListSpec laws("Laws", "Laws of time that files and loads name; \"1\" is always there.");
  laws.namedLists(timeLawParameters());
  list.list(laws);
  return list;
}

PartsSettings readSettings(const ParameterList& list) {
  PartsSettings settings;
  settings.where = list.name();
  forEachList(list, "Imported", [&](const std::string& name, const ParameterList& one) {
    settings.imported.push_back(readImported(name, one));
  });
  if (settings.imported.empty())
    throw DeckError(list.name() + "/Imported is empty: a scene has one part at least.");
  settings.joints = texts(list, "Joints");
  settings.atRest = list.get<std::string>("Initial State") == "Equilibrium";
  forEachList(list, "Loads", [&](const std::string& name, const ParameterList& one) {
    settings.loads.push_back({name, one.name(), one.get<std::string>("Part"), one.get<int>("Node"),
                              one.get<std::string>("Component"), one.get<double>("Value"),
                              one.get<std::string>("Law")});
  });
  forEachList(list, "Starts", [&](const std::string& /*name*/, const ParameterList& one) {
    settings.starts.push_back({one.name(), one.get<std::string>("Part"), one.get<int>("Node"),
                               one.get<std::string>("Component"), one.get<double>("Displacement"),
                               one.get<double>("Velocity")});
  });
  forEachList(list, "Laws", [&](const std::string& name, const ParameterList& one) {
    if (name == "1")
      throw DeckError(one.name() +
                      " gives the law \"1\", which is 1 at all times. Name it otherwise.");
    settings.laws.push_back(readTimeLaw(name, one));
  });
  return settings;
}

}  // namespace tooljoint::parts
