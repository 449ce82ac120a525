// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/CouplingParameters.hpp"

#include <Eigen/Dense>
#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "coupling/ComponentAxes.hpp"

namespace tooljoint::coupling {

namespace {

using deck::Range;
using Teuchos::ParameterList;

/// Axes of a frame may be this far from perpendicular.
constexpr double skewness = 1e-6;

deck::ListSpec jointSpec() {
  deck::ListSpec entry("Joint", "Nodes in one place; the name is free.");
  entry.textArray("Nodes", deck::Required{}, {}, "Nodes that become one, written PART:NODE.");
  return deck::ListSpec("Joints",
                        "Nodes of parts that number theirs for themselves (Node Numbers = Own), "
                        "joined in all their components.")
      .namedLists(entry);
}

deck::ListSpec frameSpec() {
  deck::ListSpec entry("Frame", "Axes of one part, or of one node of it; the name is free.");
  entry.text("Part", deck::Required{}, "Name of the part.")
      .integer("Node", deck::Optional{}, Range::atLeast(1),
               "Node whose dofs are in these axes; without it, all nodes of the part.")
      .realArray("Axis 1", "", deck::Required{}, Range::any(),
                 "First axis of the part in the common frame, three numbers of any length.")
      .realArray("Axis 2", "", deck::Required{}, Range::any(),
                 "Second axis, perpendicular to the first; the third makes them right-handed.");
  return deck::ListSpec("Frames",
                        "Parts that have their dofs in axes of their own; connections and joints "
                        "are meant in the common frame.")
      .namedLists(entry);
}

deck::ListSpec releaseSpec() {
  deck::ListSpec entry("Release",
                       "A node of a part that is not joined in some components; the name is free.");
  entry
      .text("Node", deck::Required{},
            "Node, PART:NODE, or NODE alone: free in every part that has it.")
      .text("Components", deck::Required{},
            "Components that are not joined there, separated by blanks.");
  return deck::ListSpec("Releases",
                        "Dofs that are not joined although their labels are equal: slides, hinges.")
      .namedLists(entry);
}

deck::ListSpec constraintSpec() {
  deck::ListSpec entry(
      "Constraint",
      "One linear equation between dofs, measured from the reference states; the name is free.");
  entry.textArray("Terms", deck::Required{}, {}, "Dofs, written PART:NODE:COMPONENT.")
      .realArray("Factors", "", deck::Required{}, Range::any(), "Factor of each term.")
      .real("Value", "", 0.0, Range::any(),
            "What the sum of the terms times their factors is held at.");
  return deck::ListSpec("Constraints", "Multipoint constraints.").namedLists(entry);
}

deck::ListSpec linkSpec() {
  deck::ListSpec entry(
      "Link", "A node that moves as if it were rigidly fixed to another; the name is free.");
  entry.text("From", deck::Required{}, "Node that leads, PART:NODE.")
      .text("To", deck::Required{}, "Node that follows, PART:NODE.")
      .realArray("Arm", "m", deck::Required{}, Range::any(),
                 "From the first to the second node in the common frame, three numbers.");
  return deck::ListSpec("Rigid Links", "Rigid arms between nodes.").namedLists(entry);
}

deck::ListSpec hingeSpec() {
  deck::ListSpec entry(
      "Hinge",
      "Two nodes that share everything but the rotation about one axis; the name is free.");
  entry.text("First", deck::Required{}, "Node, PART:NODE.")
      .text("Second", deck::Required{},
            "Node, PART:NODE; of the same number, its dofs are released first.")
      .realArray("Axis", "", deck::Required{}, Range::any(),
                 "Axis in the common frame, three numbers of any length.");
  return deck::ListSpec("Hinges", "Hinges between parts.").namedLists(entry);
}

/// Where a point law acts.
deck::ListSpec& ends(deck::ListSpec& entry) {
  return entry.text("First", deck::Required{}, "Node, PART:NODE.")
      .text("Second", deck::Optional{},
            "Node, PART:NODE; without it the ground, and the separation is the displacement of "
            "First.")
      .realArray("Direction", "", deck::Optional{}, Range::any(),
                 "Direction of the separation (Second minus First) in the common frame, three "
                 "numbers of any length; this or Component.")
      .text("Component", deck::Optional{},
            "Component whose difference is the separation, a rotation for instance; this or "
            "Direction.");
}

deck::ListSpec springSpec() {
  deck::ListSpec entry("Spring", "A spring with a dashpot beside it; the name is free.");
  ends(entry)
      .real("Stiffness", "N/m or N m/rad", 0.0, Range::nonNegative(),
            "Stiffness, along a translation or about a rotation.")
      .unitBy("Component", unitByKind("N/m", "N m/rad", "N/m"))
      .real("Cubic Stiffness", "N/m3 or N m/rad3", 0.0, Range::nonNegative(),
            "Factor of the cube of the separation.")
      .unitBy("Component", unitByKind("N/m3", "N m/rad3", "N/m3"))
      .real("Damping", "N s/m or N m s/rad", 0.0, Range::nonNegative(),
            "Damping, along a translation or about a rotation.")
      .unitBy("Component", unitByKind("N s/m", "N m s/rad", "N s/m"));
  return deck::ListSpec("Springs", "Springs and dashpots between parts or to the ground.")
      .namedLists(entry);
}

deck::ListSpec stopSpec() {
  deck::ListSpec entry(
      "Stop", "A stop that is met when the separation falls to minus the gap; the name is free.");
  ends(entry)
      .real("Gap", "m", 0.0, Range::any(),
            "Separation left in the reference state; negative: pressed together.")
      .real("Stiffness", "N/m", deck::Required{}, Range::positive(), "Contact stiffness.")
      .real("Damping", "s/m", 0.0, Range::nonNegative(),
            "Damping factor of Hunt and Crossley (1975).")
      .real("Smoothing", "m", 0.0, Range::nonNegative(),
            "Half width of the quadratic transition at touch.")
      .real("Friction", "", 0.0, Range::nonNegative(),
            "Coulomb friction coefficient across the direction; 0: none. Needs a Direction.")
      .real("Slip Velocity", "m/s", 1e-3, Range::positive(),
            "Regularisation velocity of the friction.");
  return deck::ListSpec("Stops", "One-sided contacts between parts or with the ground.")
      .namedLists(entry);
}

deck::ListSpec sliderSpec() {
  deck::ListSpec entry("Slider", "Coulomb friction of constant size; the name is free.");
  ends(entry)
      .real("Force", "N or N m", deck::Required{}, Range::positive(),
            "Sliding force, or moment about a rotation.")
      .unitBy("Component", unitByKind("N", "N m", "N"))
      .real("Slip Velocity", "m/s", 1e-3, Range::positive(), "Regularisation velocity.");
  return deck::ListSpec("Sliders", "Dry friction between parts or to the ground.")
      .namedLists(entry);
}

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
    refuse(path, "is " + inQuotes(text) +
                     ", but a node is written PART:NODE with the number of the node, \"left "
                     "column:4\" for instance, or NODE alone.");
  return node;
}

/// "left column:4:u" or "4:u".
PartDof parseDof(const std::string& text, const std::string& path) {
  const auto colon = text.rfind(':');
  if (colon == std::string::npos || trim(text.substr(colon + 1)).empty())
    refuse(path,
           "holds " + inQuotes(text) +
               ", but a dof is written PART:NODE:COMPONENT, \"left column:4:u\" for instance.");
  const PartNode node = parseNode(text.substr(0, colon), path);
  return {node.part, node.node, trim(text.substr(colon + 1))};
}

Vector3 triple(const ParameterList& list, const std::string& name, bool direction) {
  const auto values = list.get<Teuchos::Array<double>>(name);
  if (values.size() != 3)
    refuse(list.name() + "/" + name,
           "has " + std::to_string(values.size()) + " numbers; it needs three.");
  const Vector3 v(values[0], values[1], values[2]);
  if (direction && !(v.norm() > 0))
    refuse(list.name() + "/" + name, "is zero, but a direction is needed.");
  return v;
}

PartNode node(const ParameterList& list, const std::string& name) {
  return parseNode(list.get<std::string>(name), list.name() + "/" + name);
}

template <class Plan>
Plan entry(const ParameterList& list) {
  Plan plan;
  plan.path = list.name();
  const auto slash = plan.path.rfind('/');
  plan.name = plan.path.substr(slash + 1);
  return plan;
}

JointPlan readJoint(const ParameterList& list) {
  auto joint = entry<JointPlan>(list);
  for (const auto& text : list.get<Teuchos::Array<std::string>>("Nodes")) {
    joint.nodes.push_back(parseNode(text, list.name() + "/Nodes"));
    if (joint.nodes.back().part.empty())
      refuse(list.name() + "/Nodes",
             "names node " + text +
                 " without its part: every part has numbers of its own. Write PART:NODE.");
  }
  if (joint.nodes.size() < 2)
    refuse(list.name() + "/Nodes", "names fewer than two nodes, so there is nothing to join.");
  return joint;
}

FramePlan readFrame(const ParameterList& list) {
  auto plan = entry<FramePlan>(list);
  plan.frame.part = list.get<std::string>("Part");
  if (list.isParameter("Node")) plan.frame.node = list.get<int>("Node");
  const Vector3 a = triple(list, "Axis 1", true).normalized(),
                b = triple(list, "Axis 2", true).normalized();
  if (std::abs(a.dot(b)) > skewness)
    refuse(list.name() + "/Axis 2",
           "is not perpendicular to Axis 1: the cosine of their angle is " +
               formatNumber(a.dot(b)) + ".");
  plan.frame.axes.col(0) = a;
  plan.frame.axes.col(1) = (b - a.dot(b) * a).normalized();
  plan.frame.axes.col(2) = plan.frame.axes.col(0).cross(plan.frame.axes.col(1));
  return plan;
}

ReleasePlan readRelease(const ParameterList& list) {
  auto plan = entry<ReleasePlan>(list);
  plan.node = node(list, "Node");
  for (const auto& word : split(list.get<std::string>("Components"), ' '))
    if (!trim(word).empty()) plan.components.push_back(trim(word));
  if (plan.components.empty()) refuse(list.name() + "/Components", "names no component.");
  return plan;
}

ConstraintPlan readConstraint(const ParameterList& list) {
  auto plan = entry<ConstraintPlan>(list);
  const auto terms = list.get<Teuchos::Array<std::string>>("Terms");
  const auto factors = list.get<Teuchos::Array<double>>("Factors");
  if (terms.size() != factors.size() || terms.empty())
    refuse(list.name() + "/Factors", "has " + std::to_string(factors.size()) + " numbers for " +
                                         std::to_string(terms.size()) +
                                         " terms; each term needs one.");
  plan.constraint.name = plan.name;
  plan.constraint.value = list.get<double>("Value");
  for (Teuchos::Ordinal k = 0; k < terms.size(); ++k)
    plan.constraint.terms.push_back({parseDof(terms[k], list.name() + "/Terms"), factors[k]});
  return plan;
}

LinkPlan readLink(const ParameterList& list) {
  auto plan = entry<LinkPlan>(list);
  plan.from = node(list, "From");
  plan.to = node(list, "To");
  plan.arm = triple(list, "Arm", false);
  return plan;
}

HingePlan readHinge(const ParameterList& list) {
  auto plan = entry<HingePlan>(list);
  plan.first = node(list, "First");
  plan.second = node(list, "Second");
  plan.axis = triple(list, "Axis", true);
  if (plan.first.part == plan.second.part && plan.first.node == plan.second.node)
    refuse(list.name() + "/Second", "is the first node again.");
  if (plan.second.part.empty() && plan.first.node == plan.second.node)
    refuse(list.name() + "/Second", "names no part, but both nodes have the number " +
                                        std::to_string(plan.second.node) + ". Write PART:NODE.");
  return plan;
}

PointPlan readEnds(const ParameterList& list) {
  auto plan = entry<PointPlan>(list);
  plan.first = node(list, "First");
  if (list.isParameter("Second")) {
    plan.second = node(list, "Second");
    if (plan.first.part == plan.second->part && plan.first.node == plan.second->node)
      refuse(list.name() + "/Second", "is the first node again.");
  }
  if (list.isParameter("Direction") == list.isParameter("Component"))
    refuse(list.name(), std::string("gives ") +
                            (list.isParameter("Direction") ? "both" : "neither") +
                            " Direction and Component. Give exactly one of them.");
  if (list.isParameter("Direction"))
    plan.direction = triple(list, "Direction", true);
  else
    plan.component = trim(list.get<std::string>("Component"));
  return plan;
}

PointPlan readSpring(const ParameterList& list) {
  auto plan = readEnds(list);
  SpringParameters spring;
  spring.stiffness = list.get<double>("Stiffness");
  spring.cubicStiffness = list.get<double>("Cubic Stiffness");
  spring.damping = list.get<double>("Damping");
  if (spring.stiffness == 0.0 && spring.cubicStiffness == 0.0 && spring.damping == 0.0)
    refuse(list.name(), "does nothing: give it a Stiffness, a Cubic Stiffness or a Damping.");
  plan.law = springs({spring});
  return plan;
}

PointPlan readStop(const ParameterList& list) {
  auto plan = readEnds(list);
  StopParameters stop;
  stop.gap = list.get<double>("Gap");
  stop.stiffness = list.get<double>("Stiffness");
  stop.damping = list.get<double>("Damping");
  stop.smoothing = list.get<double>("Smoothing");
  stop.friction = list.get<double>("Friction");
  stop.slipVelocity = list.get<double>("Slip Velocity");
  if (stop.friction > 0) {
    if (!plan.direction)
      refuse(list.name() + "/Friction",
             "needs a Direction, across which it slides, but the stop has a Component.");
    plan.sliding = stop;
  } else {
    plan.law = stops({stop});
  }
  return plan;
}

PointPlan readSlider(const ParameterList& list) {
  auto plan = readEnds(list);
  plan.law = frictions({{list.get<double>("Force"), list.get<double>("Slip Velocity")}});
  return plan;
}

/// One plan for each sublist of `list`'s sublist `name`.
template <class Plan>
void readAll(const ParameterList& list, const std::string& name, Plan (*read)(const ParameterList&),
             std::vector<Plan>& plans, std::vector<std::string>& faults) {
  if (!list.isSublist(name)) return;
  const auto& entries = list.sublist(name);
  for (auto it = entries.begin(); it != entries.end(); ++it) {
    if (!entries.isSublist(entries.name(it))) continue;
    try {
      plans.push_back(read(entries.sublist(entries.name(it))));
    } catch (const DeckError& error) {
      faults.push_back(error.what());
    }
  }
}

/// Looks up what a plan names among the parts.
class NameCheck {
 public:
  NameCheck(const std::vector<PartOutline>& parts, const model::ComponentNames& names)
      : parts_(parts), names_(names) {}

  void part(const std::string& path, const std::string& name) {
    if (name.empty() || findPart(name)) return;
    std::vector<std::string> known;
    for (const auto& one : parts_) known.push_back(one.name);
    const auto meant = closest(name, known);
    add(path, "names part " + inQuotes(name) + ", but there is no such part." +
                  (meant.empty() ? " The parts are " + quotedList(known) + "."
                                 : " Did you mean " + inQuotes(meant) + "?"));
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
    if (name.empty() || std::find(names_.begin(), names_.end(), name) != names_.end()) return;
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
    return part.nodes.empty() ||
           std::find(part.nodes.begin(), part.nodes.end(), node) != part.nodes.end();
  }
  void add(const std::string& path, const std::string& sentence) {
    faults_.push_back(path + " " + sentence);
  }

  const std::vector<PartOutline>& parts_;
  const model::ComponentNames& names_;
  std::vector<std::string> faults_;
};

}  // namespace

deck::ListSpec parameters() {
  deck::ListSpec list("Coupling",
                      "What joins parts beyond equal node numbers. Displacements are measured from "
                      "the reference (static) states of the parts. A node "
                      "is written PART:NODE with the name of the part, as tooljoint check lists "
                      "them, or NODE alone where all parts that have it are joined.");
  list.choice("Assembly", std::string("Primal"), {"Primal", "Dual"},
              "Primal: joined dofs become one coordinate. Dual: every reduced part keeps its own, "
              "and Lagrange multipliers, the forces between parts, join them; needs an "
              "implicit integrator. The full model is always primal.");
  list.choice("Node Numbers", std::string("Shared"), {"Shared", "Own"},
              "Shared: equal numbers are one node, wherever they stand. Own: every part numbers "
              "its nodes for itself, and only Joints join them.");
  list.boolean(
      "Keep Static Forces", true,
      "Released dofs keep the force they carry in the static state as a constant load on both "
      "sides, so that the model stays at rest there; otherwise it starts with a jump.");
  for (auto& sublist : {jointSpec(), frameSpec(), releaseSpec(), constraintSpec(), linkSpec(),
                        hingeSpec(), springSpec(), stopSpec(), sliderSpec()})
    list.list(sublist);
  return list;
}

CouplingPlan readCoupling(const ParameterList& list) {
  CouplingPlan plan;
  plan.assembly = list.get<std::string>("Assembly") == "Dual" ? Assembly::Dual : Assembly::Primal;
  plan.ownNumbers = list.get<std::string>("Node Numbers") == "Own";
  plan.keepStaticForces = list.get<bool>("Keep Static Forces");
  std::vector<std::string> faults;
  readAll(list, "Joints", readJoint, plan.joints, faults);
  readAll(list, "Frames", readFrame, plan.frames, faults);
  readAll(list, "Releases", readRelease, plan.releases, faults);
  readAll(list, "Constraints", readConstraint, plan.constraints, faults);
  readAll(list, "Rigid Links", readLink, plan.links, faults);
  readAll(list, "Hinges", readHinge, plan.hinges, faults);
  readAll(list, "Springs", readSpring, plan.points, faults);
  readAll(list, "Stops", readStop, plan.points, faults);
  readAll(list, "Sliders", readSlider, plan.points, faults);
  if (!plan.joints.empty() && !plan.ownNumbers)
    faults.push_back(list.name() +
                     "/Joints has no effect while node numbers are shared: equal numbers are "
                     "joined. Set \"Node Numbers\" to \"Own\", or leave Joints out.");
  if (!faults.empty()) throw DeckError(join(faults, "\n"));
  return plan;
}

void checkNames(const CouplingPlan& plan, const std::vector<PartOutline>& parts,
                const model::ComponentNames& names) {
  NameCheck check(parts, names);
  for (const auto& joint : plan.joints)
    for (const auto& n : joint.nodes) check.node(joint.path + "/Nodes", n);
  for (const auto& frame : plan.frames) {
    if (frame.frame.node > 0)
      check.node(frame.path, {frame.frame.part, frame.frame.node});
    else
      check.part(frame.path + "/Part", frame.frame.part);
  }
  for (const auto& release : plan.releases) {
    check.node(release.path + "/Node", release.node);
    for (const auto& component : release.components)
      check.component(release.path + "/Components", component);
  }
  for (const auto& constraint : plan.constraints)
    for (const auto& term : constraint.constraint.terms) {
      check.node(constraint.path + "/Terms", {term.dof.part, term.dof.node});
      check.component(constraint.path + "/Terms", term.dof.component);
    }
  for (const auto& link : plan.links) {
    check.node(link.path + "/From", link.from);
    check.node(link.path + "/To", link.to);
  }
  for (const auto& hinge : plan.hinges) {
    check.node(hinge.path + "/First", hinge.first);
    check.node(hinge.path + "/Second", hinge.second);
  }
  for (const auto& point : plan.points) {
    check.node(point.path + "/First", point.first);
    if (point.second) check.node(point.path + "/Second", *point.second);
    check.component(point.path + "/Component", point.component);
  }
  check.raise();
}

std::string describe(const CouplingPlan& plan) {
  std::vector<std::string> items;
  const auto add = [&](std::size_t count, const std::string& one) {
    if (count > 0) items.push_back(std::to_string(count) + " " + one + (count > 1 ? "s" : ""));
  };
  add(plan.joints.size(), "joint");
  add(plan.frames.size(), "frame");
  add(plan.releases.size(), "release");
  add(plan.constraints.size(), "constraint");
  add(plan.links.size(), "rigid link");
  add(plan.hinges.size(), "hinge");
  add(plan.points.size(), "point law");
  return std::string(plan.assembly == Assembly::Dual ? "dual" : "primal") +
         (items.empty() ? "" : ", " + join(items, ", "));
}

}  // namespace tooljoint::coupling
