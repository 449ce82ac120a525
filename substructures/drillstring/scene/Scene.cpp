// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/scene/Scene.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Text.hpp"
#include "deck/PrintedUnits.hpp"
#include "estimate/AdaptiveReduction.hpp"
#include "model/laws/PointLawRegistry.hpp"
#include "parts/PartsParameters.hpp"
#include "reduction/Reduce.hpp"
#include "reduction/selection/ModeSelection.hpp"
#include "substructures/beam/NodalDofs.hpp"
#include "substructures/drillstring/ContactNodes.hpp"
#include "substructures/drillstring/StringModel.hpp"
#include "substructures/drillstring/assembly/DrillstringReader.hpp"
#include "substructures/drillstring/scene/BottomHoleParameters.hpp"
#include "substructures/drillstring/scene/BucklingParameters.hpp"
#include "substructures/drillstring/scene/CutByCost.hpp"
#include "substructures/softstring/TorqueDragParameters.hpp"
#include "transient/Integrator.hpp"

namespace tooljoint::drillstring {

namespace nodal = beam::nodal;

deck::ListSpec sceneSpec() {
  deck::ListSpec scene(
      "Scene",
      "A scene: a string in a well, what acts on it, and what to compute. Every list but Well and "
      "Drillstring may be left out, and what is left out is not modelled.");
  scene.requiredList(well::parameters());
  scene.requiredList(drillstringParameters());
  scene.list(supportParameters());
  scene.list(mud::parameters());
  scene.list(contact::parameters());
  scene.list(loads::parameters());
  scene.list(loads::rotarySpeedParameters());
  scene.list(loads::dampingParameters());
  scene.list(drilling::bitParameters());
  scene.list(drilling::topDriveParameters());
  scene.list(path::parameters());
  scene.list(equilibrium::parameters());
  scene.list(softstring::torqueDragParameters());
  scene.list(bottomHoleParameters());
  scene.list(bucklingParameters());
  scene.list(partitionParameters());
  scene.list(coupling::parameters());
  scene.list(parts::parameters());
  cases::addCommonLists(scene);
  return scene;
}

int Scene::freeDofs() const {
  return static_cast<int>(std::count(held.begin(), held.end(), char{0}));
}

double Scene::startTime() const {
  return moves() ? list().sublist("Transient").get<double>("Start Time") : 0.0;
}

double Scene::weightOnBit() const {
  return list().isSublist("Loads") ? list().sublist("Loads").get<double>("Weight On Bit") : 0.0;
}

std::vector<char> Scene::heldAtRest() const {
  auto all = held;
  if (topDrive.movesFreely()) all[nodal::w] = 1;
  if (topDrive.turnsFreely()) all[nodal::thetaZ] = 1;
  return all;
}

namespace {

using cases::Faults;

/// Requirements of the list Coupling on other lists.
void crossCheckCoupling(const Scene& scene, Faults& faults) {
  const auto& list = scene.list();
  if (scene.coupling->ownNumbers)
    faults.add(
        "Coupling/Node Numbers",
        "is \"Own\", but the parts of a string share their node numbers. Set it to \"Shared\".");
  const auto& input = *scene.coupling;
  if (scene.reduces()) {
    const auto& reduction = list.sublist("Reduction");
    const auto estimated = reduction.get<std::string>("Error Estimate");
    const bool simple = input.assembly == coupling::Assembly::Primal && input.frames.empty() &&
                        input.constraints.empty() && input.links.empty() && input.hinges.empty();
    if (!simple && (estimated == "Transient" || estimated == "Both" ||
                    reduction::selectsModesBy(reduction, "Motion Tolerance")))
      faults.add("Coupling",
                 "has frames, constraints, links, hinges or dual assembly. With these the error of "
                 "the motion is not estimated. Set \"Error Estimate\" to \"Frequencies\", or "
                 "remove \"Motion Tolerance\".");
  }
}

/// Loads at nodes that do not exist (DeckError) or on held dofs. Without axial dofs the weight on a
/// friction bit acts only in the law of the bit.
void checkLoads(const Scene& scene, Faults& faults) {
  const bool weightOfBit = scene.bit && !scene.bit->law->givesWeight() && !scene.supports.axial;
  for (const auto& load : loads::pointLoads(scene.loads, scene.string.depths(), scene.rotary)) {
    if (load.parameter.empty() || scene.held[at(kNodeDofs * (load.node - 1) + load.component)] == 0)
      continue;
    if (weightOfBit && load.parameter == "Loads/Weight On Bit") continue;
    const std::string node =
        load.node == scene.string.nodeCount() ? "the bit" : "node " + std::to_string(load.node);
    faults.add(load.parameter, "acts on a held dof: " + componentNames()[at(load.component)] +
                                   " of " + node +
                                   " is held by the Supports. Release it, or leave the load out.");
  }
}

/// A law that gives the weight on bit needs a bit that advances, and it must cut.
void checkAdvance(const Scene& scene, Faults& faults) {
  const auto& drive = scene.topDrive;
  const std::string name = inQuotes(scene.bit->name);
  if (drive.constantHookLoad || drive.autodriller) return;
  if (drive.blockSpeed == 0.0) {
    faults.add("Bit/Law", "is " + name +
                              ", whose weight on bit comes from the advance of the bit, but the "
                              "string does not advance. Give Top Drive/Block Speed or Top "
                              "Drive/Autodriller, or set Top Drive/Hook to \"Constant Load\".");
    return;
  }
  if (!scene.rotary.present() || scene.rotary.sense(scene.startTime()) >= 0.0) return;
  if (scene.bit->law->cutsForwardOnly())
    faults.add("Rotary Speed", "is negative, but a bit of the law " + name +
                                   " cuts forward only. Turn the string in the positive sense.");
}

/// A law's Radius against that of the hole at the bit.
void checkBitRadius(const Scene& scene, Faults& faults) {
  const std::string& name = scene.bit->name;
  const auto& bit = scene.list().sublist("Bit");
  if (!bit.isSublist(name) || !bit.sublist(name).isParameter("Radius")) return;
  const double radius = bit.sublist(name).get<double>("Radius");
  const double hole = scene.well.boreRadius(scene.string.nodes.back().s);
  if (radius > hole * (1 + 1e-9))  // the factor allows for other units
    faults.add("Bit/" + name + "/Radius", "is " + deck::printed(radius, "mm", 4) +
                                              ", but the hole at the bit has a radius of " +
                                              deck::printed(hole, "mm", 4) +
                                              ". Give the radius of a bit that fits into it.");
}

/// Requirements of a bit law on loads and supports.
void checkBit(const Scene& scene, Faults& faults) {
  const auto& list = scene.list();
  const auto& law = *scene.bit->law;
  const std::string name = inQuotes(scene.bit->name);
  const int dof = law.givesWeight() ? nodal::w : nodal::thetaZ;
  if (law.givesWeight() && scene.weightOnBit() != 0.0)
    faults.add("Loads/Weight On Bit",
               "is given, but the law " + name + " of Bit gives the weight on bit. Leave it out.");
  if (!law.givesWeight() && scene.weightOnBit() == 0.0)
    faults.add("Bit/Law", "is " + name +
                              ", whose torque is friction under the weight on bit. Give "
                              "Loads/Weight On Bit.");
  if (list.isSublist("Loads") && list.sublist("Loads").get<double>("Torque On Bit") != 0.0)
    faults.add("Loads/Torque On Bit",
               "is given, but the law " + name + " of Bit gives the torque on bit. Leave it out.");
  if (scene.held[at(kNodeDofs * (scene.string.nodeCount() - 1) + dof)] != 0)
    faults.add("Bit/Law", "is " + name + ", but the Supports hold " + componentNames()[at(dof)] +
                              " of the bit, on which it acts. Release it.");
  if (law.givesWeight()) checkAdvance(scene, faults);
  checkBitRadius(scene, faults);
}

/// Analyses of vibrations about the static state use the equations of the motion.
bool vibrates(const Scene& scene) {
  return scene.moves() || scene.list().isSublist("Response") || scene.list().isSublist("Campbell");
}

bool hasAxialFriction(const Scene& scene) { return scene.contact && scene.contact->axialFriction; }

/// Requirements of an autodriller on other lists.
void checkAutodriller(const Scene& scene, Faults& faults) {
  const std::string path = "Top Drive/Autodriller";
  if (!scene.bit || !scene.bit->law->givesWeight())
    faults.add(path, "has no effect without a Bit law that gives the weight on bit.");
  if (!vibrates(scene) && !scene.list().isSublist("Torque and Drag"))
    faults.add(path,
               "has no effect without Transient, Response, Campbell or Torque and Drag: the hook "
               "holds the static state. Add one of these lists.");
  if (scene.topDrive.constantHookLoad)
    faults.add(path,
               "moves the block, but Top Drive/Hook is \"Constant Load\". Leave one of the "
               "two out.");
  if (scene.held[nodal::w] != 0)
    faults.add(path,
               "moves the top of the string, but the Supports hold w of node 1. Leave w out "
               "of Supports/Top.");
}

/// Requirements of the drive on bit and supports.
void checkTopDrive(const Scene& scene, Faults& faults) {
  const auto& drive = scene.topDrive;
  const bool feeds = scene.bit && scene.bit->law->givesWeight();
  if (!drive.turnsFreely() && drive.blockSpeed == 0.0 && !drive.movesFreely())
    faults.add(
        "Top Drive",
        "is stiff and does not move, as without the list. Choose a Control, or leave it out.");
  if (drive.turnsFreely() && scene.held[nodal::thetaZ] != 0)
    faults.add("Top Drive/Control",
               "turns the top of the string, but the Supports hold theta_z of node 1. Leave "
               "theta_z out of Supports/Top, or set Control to \"Stiff\".");
  if (drive.turnsFreely() && !scene.rotary.present())
    faults.add("Top Drive/Control", "needs the set speed: give Rotary Speed.");
  if (drive.control == drilling::DriveControl::Torque && !drive.torqueGiven &&
      scene.rotary.present() && scene.rotary.speed(scene.startTime()) == 0.0)
    faults.add("Top Drive/Control",
               "is \"Torque\" without a Torque, which is then that of the static state. The "
               "string stands still there. Give Top Drive/Torque, or let the string turn from the "
               "start.");
  if (drive.turnsFreely() && !vibrates(scene))
    faults.add("Top Drive/Control",
               "has no effect without Transient, Response or Campbell: the drive holds the static "
               "state. Add one of these lists.");
  if (drive.blockSpeed < 0.0 && feeds)
    faults.add("Top Drive/Block Speed",
               "is negative, but the Bit cuts on the way down. Leave Bit out to pull the string.");
  if (drive.blockSpeed != 0.0 && !feeds && !hasAxialFriction(scene))
    faults.add("Top Drive/Block Speed",
               "has no effect without a Bit law that gives the weight on bit or "
               "Contact/Friction/Axial.");
  if (drive.constantHookLoad && !feeds)
    faults.add("Top Drive/Hook",
               "is \"Constant Load\", but no Bit law gives the weight on bit: nothing would hold "
               "the string along the well.");
  if (drive.constantHookLoad && scene.held[nodal::w] != 0)
    faults.add("Top Drive/Hook",
               "is \"Constant Load\", but the Supports hold w of node 1. Leave w out of "
               "Supports/Top.");
  if (drive.autodriller) checkAutodriller(scene, faults);
}

/// A block that moves a string with friction in a hole that is not vertical drags it along the
/// wall; the deck must then say whether axial friction acts.
void checkAxialFriction(const Scene& scene, Faults& faults) {
  constexpr double vertical = 1e-6;  // [rad]
  if (!scene.contact || !scene.contact->friction) return;
  const auto& nodes = scene.contactPoints.node;
  const bool slides = std::any_of(nodes.begin(), nodes.end(), [&](int node) {
    return scene.held[at(kNodeDofs * (node - 1) + nodal::w)] == 0;
  });
  if (scene.contact->axialFriction && !slides)
    faults.add("Contact/Friction/Axial",
               "has no effect: the Supports hold w of every node that can touch the wall. Release "
               "w, or leave it out.");
  const auto& drive = scene.topDrive;
  if (!slides || scene.deck.gives("Contact/Friction/Axial") ||
      (drive.blockSpeed == 0.0 && !drive.movesFreely()))
    return;
  const auto depths = scene.string.depths();
  const auto inclined = std::find_if(depths.begin(), depths.end(), [&](double s) {
    const auto& tangent = scene.well.trajectory().at(s).tangent;
    return std::hypot(tangent.x(), tangent.y()) > vertical;
  });
  if (inclined == depths.end()) return;
  faults.add("Contact/Friction",
             "needs Axial, because the block moves the string in a hole that is not vertical. Give "
             "true to count friction along the hole, or false to leave it out, and with it the "
             "weight that it takes from the bit.");
}

/// Requirements of bends and eccentric gauges on other lists.
void checkSidedFeatures(const Scene& scene, Faults& faults) {
  const auto& string = scene.string;
  const auto refuse = [&](const std::string& what, int node) {
    faults.add("Transient", "moves a string with " + what + " (node " + std::to_string(node + 1) +
                                "), which is modelled at rest alone. Leave Transient out, or " +
                                what + ".");
  };
  if (scene.moves() && !string.bends.empty()) refuse("a bend", string.bends.front().node);
  if (string.eccentricGauges.empty()) return;
  if (scene.moves()) refuse("an eccentric gauge", string.eccentricGauges.front().node);
  if (scene.contact && model::PointLawRegistry::instance().entries().count(scene.contact->lawName))
    faults.add("Contact/Law", "is " + inQuotes(scene.contact->lawName) +
                                  ", a point law, which does not support an eccentric gauge. Use "
                                  "\"Clamped\", or leave Gauge Offset out.");
}

/// Errors that concern several lists.
void crossCheck(const Scene& scene, Faults& faults) {
  const auto& list = scene.list();
  if (list.isSublist("Substructures") && !scene.reduces() && !scene.coupling)
    faults.add("Substructures",
               "has no effect without a Reduction list. Add one, or leave Substructures out.");
  if (list.isSublist("Parts"))
    faults.add("Parts",
               "is a scene of its own and cannot be combined with Well and Drillstring. Reduce and "
               "export the string (tooljoint export), and import it there.");
  if (scene.output.exportFormat != io::ExportFormat::None && !(scene.reduces() && scene.moves()))
    faults.add("Output/Export Parts",
               "has no effect without Reduction and Transient. Add them, or use tooljoint export.");
  if (scene.coupling) crossCheckCoupling(scene, faults);
  if (scene.reduces() && !scene.moves() && !list.isSublist("Substructures"))
    faults.add("Reduction",
               "has neither a Transient list to serve nor Substructures to cut. Add Transient, or "
               "leave Reduction out.");
  checkCutByCost(scene, faults);
  std::vector<std::string> parts;
  if (scene.reduces() && faults.none())
    for (const auto& part : cutParts(scene.string, scene.partition)) parts.push_back(part.name);
  cases::checkCommonLists(list, {scene.output, scene.coupling}, parts, faults);
  if (scene.reduces() && list.sublist("Reduction").isParameter("Load Vector Nodes"))
    for (const int node : list.sublist("Reduction").get<Teuchos::Array<int>>("Load Vector Nodes"))
      if (std::count(scene.contactPoints.node.begin(), scene.contactPoints.node.end(), node) == 0)
        faults.add("Reduction/Load Vector Nodes",
                   "names node " + std::to_string(node) +
                       ", which cannot touch the wall and so has no point law. Name nodes with "
                       "contact, or leave the list out for all of them.");
  checkAxialFriction(scene, faults);
  if (scene.contact && scene.contact->friction && !scene.rotary.present() && !scene.moves() &&
      !(hasAxialFriction(scene) && scene.topDrive.blockSpeed != 0.0) &&
      !list.isSublist("Torque and Drag"))
    faults.add("Contact/Friction",
               "has no effect in a scene that neither turns nor moves. Add Rotary Speed, Transient "
               "or Torque and Drag, or leave Friction out.");
  checkSidedFeatures(scene, faults);
  if (scene.bit) checkBit(scene, faults);
  if (list.isSublist("Top Drive")) checkTopDrive(scene, faults);
  if (scene.freeDofs() == 0)
    faults.add("Supports",
               "hold every dof of the string; nothing is left to compute. Release some.");
}

/// Outlines of the parts of the string, before the parts exist.
std::vector<coupling::PartOutline> outlines(const Scene& scene) {
  requireKnownNodes(scene.string, scene.partition);
  std::vector<coupling::PartOutline> parts;
  for (const auto& range : cutParts(scene.string, scene.partition)) {
    parts.push_back({range.name, {}});
    for (int node = range.firstElement + 1; node <= range.lastElement + 2; ++node)
      parts.back().nodes.push_back(node);
  }
  return parts;
}

/// The same for a basis: a node shared by two parts is an inner node of neither.
std::vector<reduction::PartOutline> reductionOutlines(const Scene& scene) {
  const auto ranges = cutParts(scene.string, scene.partition);
  std::vector<reduction::PartOutline> parts;
  for (std::size_t p = 0; p < ranges.size(); ++p) {
    reduction::PartOutline part{ranges[p].name, 0, false};
    for (int node = ranges[p].firstElement; node <= ranges[p].lastElement + 1; ++node) {
      const auto first = scene.held.begin() + kNodeDofs * node;
      const auto free = static_cast<int>(std::count(first, first + kNodeDofs, 0));
      const bool shared = (p > 0 && node == ranges[p].firstElement) ||
                          (p + 1 < ranges.size() && node == ranges[p].lastElement + 1);
      part.dofs += free;
      part.inner = part.inner || (free > 0 && !shared);
    }
    parts.push_back(part);
  }
  return parts;
}

/// With the gains for the components in the upper tenth of the string: waves of some kilometres are
/// not affected by short components.
drilling::TopDrive tunedToPipe(const drilling::TopDrive& drive, const DrillString& string) {
  std::vector<std::pair<beam::Section, double>> pieces;
  double length = 0.0;
  for (const auto& one : string.instances) {
    for (int e = one.firstElement; e <= one.lastElement; ++e) {
      pieces.emplace_back(string.elements[at(e)].section(), string.elements[at(e)].length());
      length += pieces.back().second;
    }
    if (length >= 0.1 * string.length()) break;
  }
  return drilling::tuned(drive, drilling::torsionalImpedance(pieces));
}

/// Removes the dofs that the drive moves from those held by default at the top.
void releaseTop(const drilling::TopDrive& drive, SupportSettings& supports) {
  if (drive.movesFreely()) supports.top[nodal::w] = false;
  if (drive.turnsFreely()) supports.top[nodal::thetaZ] = false;
}

/// The block speed of steady drilling under the weight of the autodriller.
double feedOfSetWeight(const Scene& scene) {
  try {
    return drilling::feedFor(*scene.bit, scene.rotary, scene.startTime(),
                             scene.topDrive.autodriller->weight);
  } catch (const DeckError& error) {
    throw DeckError(scene.deck.error("Top Drive/Autodriller/Weight On Bit", error.what()));
  }
}

/// True if an autodriller determines the block speed of the static state.
bool feedsBySetWeight(const Scene& scene) {
  return scene.bit && scene.bit->law->givesWeight() && scene.topDrive.autodriller &&
         !scene.deck.gives("Top Drive/Block Speed");
}

/// Checks of parts and basis that are possible before the static state.
void checkReduction(const Scene& scene) {
  requireKnownNodes(scene.string, scene.partition);
  const auto& list = scene.deck.list().sublist("Reduction");
  const auto parts = cutParts(scene.string, scene.partition);
  const auto options = reduction::readOptions(list, static_cast<int>(parts.size()));
  reduction::makeBasis(options.basis, list)->checkInput(reductionOutlines(scene));
  estimate::readEstimateOptions(list);
}

/// Values that follow from several lists, and their consistency.
void complete(Scene& scene, const drilling::TopDrive& topDrive, Faults& faults) {
  scene.topDrive = tunedToPipe(topDrive, scene.string);
  if (feedsBySetWeight(scene))
    faults.attempt([&] { scene.topDrive.blockSpeed = feedOfSetWeight(scene); });
  if (!scene.deck.gives("Supports/Top")) releaseTop(topDrive, scene.supports);
  if (scene.coupling)
    faults.attempt(
        [&] { coupling::checkNames(*scene.coupling, outlines(scene), componentNames()); });
  faults.attempt([&] { scene.held = heldDofs(scene.supports, scene.string); });
  faults.raise();
  if (scene.contact)
    faults.attempt(
        [&] { scene.contactPoints = contactPoints(*scene.contact, scene.string, scene.held); });
  scene.partition.axialContact = hasAxialFriction(scene);
  faults.attempt([&] { checkLoads(scene, faults); });
  if (scene.reduces()) faults.attempt([&] { checkReduction(scene); });
  crossCheck(scene, faults);
  faults.raise();
}

}  // namespace

Scene turningAt(Scene scene, double speed) {
  constexpr double slowest = 1e-6;  // [rad/s], far below every speed of drilling
  scene.rotary = loads::RotarySpeed::steady(std::max(speed, slowest));
  if (feedsBySetWeight(scene)) scene.topDrive.blockSpeed = feedOfSetWeight(scene);
  return scene;
}

Scene readScene(const std::string& file, const std::vector<std::string>& overrides) {
  return readScene(deck::Deck::read(file, sceneSpec(), overrides));
}

Scene readScene(const deck::Deck& deck) {
  using cases::listOrDefaults;
  const auto& list = deck.list();
  Faults faults(deck, sceneSpec());

  std::optional<well::Well> well;
  std::optional<DrillString> string;
  faults.attempt([&] { well = well::readWell(list.sublist("Well"), deck.folder()); });
  if (well) faults.attempt([&] { string = buildDrillString(readDrillstring(deck), *well); });
  const auto read = [&](const char* name, auto& into, const auto& reader) {
    if (list.isSublist(name)) faults.attempt([&] { into = reader(list.sublist(name)); });
  };
  std::shared_ptr<const mud::MudModel> mud;
  std::optional<contact::ContactSettings> contact;
  loads::RotarySpeed rotary;
  loads::Loads loads;
  loads::RayleighDamping damping;
  SupportSettings supports;
  std::optional<BucklingSettings> buckling;  // read for its faults
  std::optional<drilling::BitSettings> bit;
  drilling::TopDrive topDrive;
  path::PathOptions path;
  equilibrium::StaticOptions statics;
  PartitionRules partition;
  read("Mud", mud, mud::readMud);
  read("Contact", contact, contact::readContact);
  faults.attempt([&] { rotary = loads::RotarySpeed::fromDeck(list); });
  read("Loads", loads, loads::readLoads);
  read("Damping", damping, loads::readDamping);
  read("Supports", supports, readSupports);
  read("Buckling", buckling, readBuckling);
  read("Bit", bit, drilling::readBit);
  read("Top Drive", topDrive, drilling::readTopDrive);
  faults.attempt([&] { path = path::optionsFrom(listOrDefaults(list, path::parameters())); });
  faults.attempt(
      [&] { statics = equilibrium::optionsFrom(listOrDefaults(list, equilibrium::parameters())); });
  const auto common = cases::readCommonLists(list, faults);
  const bool explicitSteps =
      list.isSublist("Transient") && transient::isExplicit(list.sublist("Transient"));
  faults.attempt([&] {
    partition = readPartition(listOrDefaults(list, partitionParameters()), explicitSteps);
  });
  faults.raise();

  Scene scene{deck,   *well, *string, supports, {},      mud,       contact,      {},
              rotary, loads, damping, path,     statics, partition, common.output};
  scene.coupling = common.coupling;
  scene.bit = bit;
  complete(scene, topDrive, faults);
  return scene;
}

}  // namespace tooljoint::drillstring
