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
                  "A part from a file; the name of the list is the name of the part. Several parts "
                  "may use one file.")
      .text("File", Required{},
            "The part: a folder with part.json, a .json file, an HDF5 file, a Nastran file of DMIG "
            "entries (.pch, .dmig, .bdf), or the stiffness JOB_STIFn.mtx of Abaqus with its mass "
            "beside it, relative to the deck; or the text of a part.json, which begins with \"{\". "
            "docs/file-formats.md describes them.")
      .realArray("Rotation Axis", "", std::vector<double>{0.0, 0.0, 1.0}, Range::any(),
                 "Axis of the rotation from the frame of the file to the common frame.")
      .real("Rotation Angle", "rad", 0.0, Range::any(), "Angle of this rotation, right-handed.")
      .textArray("Fixed", Optional{}, {},
                 "Fixed dofs: a node or the name of an interface set, followed by components (all "
                 "of them without), for example {1, 5 u v, clamp}.")
      .textArray("Retained", Optional{}, {},
                 "Retained dofs in addition to those of the file, written as in \"Fixed\".")
      .boolean("Reduce", true,
               "Let the list Reduction reduce this part; false keeps all its dofs, for a part that "
               "was reduced before.")
      .expert();
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
                  "Initial displacement and velocity of one dof, added to those of the files, in "
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
                    " numbers. Give three.");
  const Vector3 direction(axis[0], axis[1], axis[2]);
  if (!(direction.norm() > 0.0))
    throw DeckError(list.name() + "/Rotation Axis has a zero direction. Give a nonzero vector.");
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
  ListSpec list("Parts", "A model of parts from files.");
  ListSpec imported("Imported", "The parts, in the order of the deck.");
  imported.namedLists(importedParameters());
  list.requiredList(imported);
  list.textArray("Joints", Optional{}, {},
                 "Joined nodes or interface sets of two or more parts, {left:tip = right:root, a:7 "
                 "= b:1 = c:1}. Sets are joined node by node in their order, in their common "
                 "components. With Joints every part has its own node numbers; without, interface "
                 "nodes of equal numbers are one node unless Coupling/Node Numbers is \"Own\".")
      .choice("Initial State", std::string("From files"), {"From files", "Equilibrium"},
              "\"From files\": initial displacements of the files, zero where a file has none. "
              "\"Equilibrium\": static equilibrium under the loads of the start time; parts are "
              "reduced about it.");
  ListSpec loads("Loads", "Loads on single dofs, in addition to those of the files.");
  loads.namedLists(loadParameters());
  list.list(loads);
  ListSpec starts("Starts", "Initial displacements and velocities of single dofs.");
  starts.namedLists(startParameters());
  list.list(starts);
  ListSpec laws("Laws",
                "Laws of time for files and loads; \"1\" always exists. The law \"Omega\" is the "
                "rotary speed [rad/s], which Campbell diagrams and responses vary.");
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
    throw DeckError(list.name() + "/Imported is empty. Give at least one part.");
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
  model::ScalarLaw speed;
  forEachList(list, "Laws", [&](const std::string& name, const ParameterList& one) {
    if (name == rotarySpeedName) speed = readTimeLaw(name, one, {});
  });
  forEachList(list, "Laws", [&](const std::string& name, const ParameterList& one) {
    if (model::ScalarLaw::isOne(name))
      throw DeckError(one.name() +
                      " has the name \"1\", which is the constant law. Choose another name.");
    settings.laws.push_back(readTimeLaw(name, one, speed));
  });
  return settings;
}

}  // namespace tooljoint::parts
