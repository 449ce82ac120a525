// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/input/CouplingParameters.hpp"

#include <Eigen/Dense>
#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "coupling/input/ComponentAxes.hpp"
#include "coupling/input/DofLookup.hpp"
#include "deck/Deck.hpp"
#include "model/laws/PointLawRegistry.hpp"

namespace tooljoint::coupling {

namespace {

using Teuchos::ParameterList;

/// Largest deviation of the axes of a frame from perpendicular.
constexpr double skewness = 1e-6;

[[noreturn]] void refuse(const std::string& path, const std::string& sentence) {
  throw DeckError(path + " " + sentence);
}

bool integer(const std::string& text, std::int64_t& value) {
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  return fault == std::errc() && end == text.data() + text.size() && value > 0;
}

/// "left column:4" or "4".
PartNode parseNode(const std::string& text, const std::string& path) {
  const auto colon = text.rfind(':');
  PartNode node;
  const std::string number = trim(colon == std::string::npos ? text : text.substr(colon + 1));
  if (colon != std::string::npos) node.part = trim(text.substr(0, colon));
  if (!integer(number, node.node) || (colon != std::string::npos && node.part.empty()))
    refuse(path,
           "is " + inQuotes(text) +
               ". A node is written PART:NODE, for example \"left column:4\", or NODE alone.");
  return node;
}

/// "left column:4:u" or "4:u".
PartDof parseDof(const std::string& text, const std::string& path) {
  const auto colon = text.rfind(':');
  if (colon == std::string::npos || trim(text.substr(colon + 1)).empty())
    refuse(path, "holds " + inQuotes(text) +
                     ". A dof is written PART:NODE:COMPONENT, for example \"left column:4:u\".");
  const PartNode node = parseNode(text.substr(0, colon), path);
  return {node.part, node.node, trim(text.substr(colon + 1))};
}

Vector3 triple(const ParameterList& list, const std::string& name, bool direction) {
  const auto& values = list.get<Teuchos::Array<double>>(name);
  if (values.size() != 3)
    refuse(list.name() + "/" + name,
           "has " + std::to_string(values.size()) + " numbers. Give three.");
  Vector3 v(values[0], values[1], values[2]);
  if (direction && !(v.norm() > 0))
    refuse(list.name() + "/" + name, "is zero. Give a nonzero vector.");
  return v;
}

PartNode node(const ParameterList& list, const std::string& name) {
  return parseNode(list.get<std::string>(name), list.name() + "/" + name);
}

template <class Plan>
Plan entry(const ParameterList& list) {
  Plan input;
  input.path = list.name();
  const auto slash = input.path.rfind('/');
  input.name = input.path.substr(slash + 1);
  return input;
}

JointInput readJoint(const ParameterList& list) {
  auto joint = entry<JointInput>(list);
  for (const auto& text : list.get<Teuchos::Array<std::string>>("Nodes")) {
    joint.nodes.push_back(parseNode(text, list.name() + "/Nodes"));
    if (joint.nodes.back().part.empty())
      refuse(list.name() + "/Nodes",
             "names node " + text +
                 " without its part, but every part has its own node numbers. Write PART:NODE.");
  }
  if (joint.nodes.size() < 2)
    refuse(list.name() + "/Nodes", "names fewer than two nodes. Give at least two.");
  return joint;
}

FrameInput readFrame(const ParameterList& list) {
  auto input = entry<FrameInput>(list);
  input.frame.part = list.get<std::string>("Part");
  if (list.isParameter("Node")) input.frame.node = list.get<int>("Node");
  const Vector3 a = triple(list, "Axis 1", true).normalized(),
                b = triple(list, "Axis 2", true).normalized();
  if (std::abs(a.dot(b)) > skewness)
    refuse(list.name() + "/Axis 2",
           "is not perpendicular to Axis 1: the cosine of their angle is " +
               formatNumber(a.dot(b)) + ".");
  input.frame.axes.col(0) = a;
  input.frame.axes.col(1) = (b - a.dot(b) * a).normalized();
  input.frame.axes.col(2) = input.frame.axes.col(0).cross(input.frame.axes.col(1));
  return input;
}

ReleaseInput readRelease(const ParameterList& list) {
  auto input = entry<ReleaseInput>(list);
  input.node = node(list, "Node");
  for (const auto& word : split(list.get<std::string>("Components"), ' '))
    if (!trim(word).empty()) input.components.push_back(trim(word));
  if (input.components.empty()) refuse(list.name() + "/Components", "names no component.");
  return input;
}

ConstraintInput readConstraint(const ParameterList& list) {
  auto input = entry<ConstraintInput>(list);
  const auto terms = list.get<Teuchos::Array<std::string>>("Terms");
  const auto factors = list.get<Teuchos::Array<double>>("Factors");
  if (terms.size() != factors.size() || terms.empty())
    refuse(list.name() + "/Factors", "has " + std::to_string(factors.size()) + " numbers for " +
                                         std::to_string(terms.size()) +
                                         " terms. Give one factor for each term.");
  input.constraint.name = input.name;
  input.constraint.value = list.get<double>("Value");
  for (Teuchos::Ordinal k = 0; k < terms.size(); ++k)
    input.constraint.terms.push_back({parseDof(terms[k], list.name() + "/Terms"), factors[k]});
  return input;
}

LinkInput readLink(const ParameterList& list) {
  auto input = entry<LinkInput>(list);
  input.from = node(list, "From");
  input.to = node(list, "To");
  input.arm = triple(list, "Arm", false);
  return input;
}

HingeInput readHinge(const ParameterList& list) {
  auto input = entry<HingeInput>(list);
  input.first = node(list, "First");
  input.second = node(list, "Second");
  input.axis = triple(list, "Axis", true);
  if (input.first.part == input.second.part && input.first.node == input.second.node)
    refuse(list.name() + "/Second", "is the same node as First.");
  if (input.second.part.empty() && input.first.node == input.second.node)
    refuse(list.name() + "/Second", "names no part, but both nodes have the number " +
                                        std::to_string(input.second.node) + ". Write PART:NODE.");
  return input;
}

PointInput readEnds(const ParameterList& list) {
  auto input = entry<PointInput>(list);
  input.first = node(list, "First");
  if (list.isParameter("Second")) {
    input.second = node(list, "Second");
    if (input.first.part == input.second->part && input.first.node == input.second->node)
      refuse(list.name() + "/Second", "is the same node as First.");
  }
  if (list.isParameter("Direction") == list.isParameter("Component"))
    refuse(list.name(), std::string("gives ") +
                            (list.isParameter("Direction") ? "both" : "neither") +
                            " Direction and Component. Give exactly one of them.");
  if (list.isParameter("Direction"))
    input.direction = triple(list, "Direction", true);
  else
    input.component = trim(list.get<std::string>("Component"));
  return input;
}

/// Sets the law `name` with its parameters in `own`. It is made once here, so that its faults are
/// found before the parts exist.
void setLaw(PointInput& input, const std::string& name, const ParameterList& own) {
  input.law = [name, own](int coordinates) -> std::shared_ptr<const model::PointLaw> {
    return model::PointLawRegistry::instance().make(name, own, {1, coordinates});
  };
  input.law(input.direction ? 3 : 1);
}

/// An entry of Springs, Stops or Sliders with the parameters of its law.
PointInput readConnector(const ParameterList& list, const char* law) {
  auto input = readEnds(list);
  setLaw(input, law, list);
  return input;
}
PointInput readSpring(const ParameterList& list) { return readConnector(list, "Spring"); }
PointInput readStop(const ParameterList& list) { return readConnector(list, "Stop"); }
PointInput readSlider(const ParameterList& list) { return readConnector(list, "Slider"); }

PointInput readPointLaw(const ParameterList& list) {
  auto input = readEnds(list);
  const auto type = list.get<std::string>("Type");
  const auto& entry = model::PointLawRegistry::instance().find(type);
  setLaw(input, type, deck::variantList(list, type, entry.parameters));
  return input;
}

/// One entry for each sublist of `list`'s sublist `name`.
template <class Plan>
void readAll(const ParameterList& list, const std::string& name, Plan (*read)(const ParameterList&),
             std::vector<Plan>& inputs, std::vector<std::string>& faults) {
  if (!list.isSublist(name)) return;
  const auto& entries = list.sublist(name);
  for (auto it = entries.begin(); it != entries.end(); ++it) {
    if (!entries.isSublist(entries.name(it))) continue;
    try {
      inputs.push_back(read(entries.sublist(entries.name(it))));
    } catch (const DeckError& error) {
      faults.push_back(error.what());
    }
  }
}

/// Checks the names of entries against the parts.
class NameCheck {
 public:
  NameCheck(const std::vector<PartOutline>& parts, const model::ComponentNames& names)
      : parts_(parts), names_(names) {}

  void part(const std::string& path, const std::string& name) {
    if (name.empty() || findPart(name)) return;
    faults_.push_back(path + noSuchPart(name, namesOf(parts_)));
  }
  void node(const std::string& path, const PartNode& n) {
    part(path, n.part);
    if (n.part.empty()) {
      if (std::none_of(parts_.begin(), parts_.end(),
                       [&](const auto& one) { return has(one, n.node); }))
        add(path, "names node " + std::to_string(n.node) + ", but no part has such a node.");
    } else if (const auto* found = findPart(n.part); found != nullptr && !has(*found, n.node)) {
      const auto [low, high] = std::minmax_element(found->nodes.begin(), found->nodes.end());
      add(path, "names node " + std::to_string(n.node) + " of part " + inQuotes(n.part) +
                    ", but the part has no such node. Its nodes lie between " +
                    std::to_string(*low) + " and " + std::to_string(*high) + ".");
    }
  }
  void component(const std::string& path, const std::string& name) {
    if (name.empty() || contains(names_, name)) return;
    add(path, "names the component " + inQuotes(name) + ", but the components of a node are " +
                  quotedList(names_) + ".");
  }
  void raise() const {
    if (!faults_.empty()) throw DeckError(join(faults_, "\n"));
  }

 private:
  const PartOutline* findPart(const std::string& name) const {
    const auto it = std::find_if(parts_.begin(), parts_.end(),
                                 [&](const auto& one) { return one.name == name; });
    return it == parts_.end() ? nullptr : &*it;
  }
  static bool has(const PartOutline& part, std::int64_t node) {
    return part.nodes.empty() || contains(part.nodes, node);
  }
  void add(const std::string& path, const std::string& sentence) {
    faults_.push_back(path + " " + sentence);
  }

  const std::vector<PartOutline>& parts_;
  const model::ComponentNames& names_;
  std::vector<std::string> faults_;
};

}  // namespace

CouplingInput readCoupling(const ParameterList& list) {
  CouplingInput input;
  input.assembly = list.get<std::string>("Assembly") == "Dual" ? Assembly::Dual : Assembly::Primal;
  input.ownNumbers = list.get<std::string>("Node Numbers") == "Own";
  input.keepStaticForces = list.get<bool>("Keep Static Forces");
  std::vector<std::string> faults;
  readAll(list, "Joints", readJoint, input.joints, faults);
  readAll(list, "Frames", readFrame, input.frames, faults);
  readAll(list, "Releases", readRelease, input.releases, faults);
  readAll(list, "Constraints", readConstraint, input.constraints, faults);
  readAll(list, "Rigid Links", readLink, input.links, faults);
  readAll(list, "Hinges", readHinge, input.hinges, faults);
  readAll(list, "Springs", readSpring, input.points, faults);
  readAll(list, "Stops", readStop, input.points, faults);
  readAll(list, "Sliders", readSlider, input.points, faults);
  readAll(list, "Point Laws", readPointLaw, input.points, faults);
  if (!input.joints.empty() && !input.ownNumbers)
    faults.push_back(list.name() +
                     "/Joints has no effect with shared node numbers, where equal numbers are "
                     "joined. Set \"Node Numbers\" to \"Own\", or remove Joints.");
  if (!faults.empty()) throw DeckError(join(faults, "\n"));
  return input;
}

void checkNames(const CouplingInput& input, const std::vector<PartOutline>& parts,
                const model::ComponentNames& names) {
  NameCheck check(parts, names);
  for (const auto& joint : input.joints)
    for (const auto& n : joint.nodes) check.node(joint.path + "/Nodes", n);
  for (const auto& frame : input.frames) {
    if (frame.frame.node > 0)
      check.node(frame.path, {frame.frame.part, frame.frame.node});
    else
      check.part(frame.path + "/Part", frame.frame.part);
  }
  for (const auto& release : input.releases) {
    check.node(release.path + "/Node", release.node);
    for (const auto& component : release.components)
      check.component(release.path + "/Components", component);
  }
  for (const auto& constraint : input.constraints)
    for (const auto& term : constraint.constraint.terms) {
      check.node(constraint.path + "/Terms", {term.dof.part, term.dof.node});
      check.component(constraint.path + "/Terms", term.dof.component);
    }
  for (const auto& link : input.links) {
    check.node(link.path + "/From", link.from);
    check.node(link.path + "/To", link.to);
  }
  for (const auto& hinge : input.hinges) {
    check.node(hinge.path + "/First", hinge.first);
    check.node(hinge.path + "/Second", hinge.second);
  }
  for (const auto& point : input.points) {
    check.node(point.path + "/First", point.first);
    if (point.second) check.node(point.path + "/Second", *point.second);
    check.component(point.path + "/Component", point.component);
  }
  check.raise();
}

std::string describe(const CouplingInput& input) {
  std::vector<std::string> items;
  const auto add = [&](std::size_t count, const std::string& one) {
    if (count > 0) items.push_back(std::to_string(count) + " " + one + (count > 1 ? "s" : ""));
  };
  add(input.joints.size(), "joint");
  add(input.frames.size(), "frame");
  add(input.releases.size(), "release");
  add(input.constraints.size(), "constraint");
  add(input.links.size(), "rigid link");
  add(input.hinges.size(), "hinge");
  add(input.points.size(), "point law");
  return std::string(input.assembly == Assembly::Dual ? "dual" : "primal") +
         (items.empty() ? "" : ", " + join(items, ", "));
}

}  // namespace tooljoint::coupling
