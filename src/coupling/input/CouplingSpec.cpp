// SPDX-License-Identifier: BSD-3-Clause
// Names and descriptions of the list Coupling.
#include <map>

#include "coupling/input/ComponentAxes.hpp"
#include "coupling/input/CouplingParameters.hpp"
#include "deck/Variants.hpp"
#include "model/laws/PointLawRegistry.hpp"

namespace tooljoint::coupling {

namespace {

using deck::Range;

deck::ListSpec jointSpec() {
  deck::ListSpec entry("Joint", "Nodes at the same place; the name is free.");
  entry.textArray("Nodes", deck::Required{}, {}, "Nodes to join, written PART:NODE.");
  return deck::ListSpec("Joints",
                        "Nodes joined in all their components, for parts with their own node "
                        "numbers (Node Numbers = Own).")
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
                        "Axes of parts whose dofs are not in the common frame. Connections and "
                        "joints are in the common frame.")
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
      .real("Value", "", 0.0, Range::any(), "Value of the sum of the terms times their factors.");
  return deck::ListSpec("Constraints", "Multipoint constraints.").namedLists(entry);
}

deck::ListSpec linkSpec() {
  deck::ListSpec entry("Link", "A node rigidly connected to another; the name is free.");
  entry.text("From", deck::Required{}, "Independent node, PART:NODE.")
      .text("To", deck::Required{}, "Dependent node, PART:NODE.")
      .realArray("Arm", "m", deck::Required{}, Range::any(),
                 "From the first to the second node in the common frame, three numbers.");
  return deck::ListSpec("Rigid Links", "Rigid arms between nodes.").namedLists(entry);
}

deck::ListSpec hingeSpec() {
  deck::ListSpec entry(
      "Hinge", "Two nodes joined except for the rotation about one axis; the name is free.");
  entry.text("First", deck::Required{}, "Node, PART:NODE.")
      .text("Second", deck::Required{},
            "Node, PART:NODE; of the same number, its dofs are released first.")
      .realArray("Axis", "", deck::Required{}, Range::any(),
                 "Axis in the common frame, three numbers of any length.");
  return deck::ListSpec("Hinges", "Hinges between parts.").namedLists(entry);
}

/// End points of a point law.
deck::ListSpec& ends(deck::ListSpec& entry) {
  return entry.text("First", deck::Required{}, "Node, PART:NODE.")
      .text("Second", deck::Optional{},
            "Node, PART:NODE; without it the ground, and the separation is the displacement of "
            "First.")
      .realArray("Direction", "", deck::Optional{}, Range::any(),
                 "Direction of the separation (Second minus First) in the common frame, three "
                 "numbers of any length; this or Component.")
      .expert()
      .text("Component", deck::Optional{},
            "Component whose difference is the separation, a rotation for instance; this or "
            "Direction.");
}

/// The parameters of a registered law in addition to its ends. `byComponent`: along a translation
/// they have the units of the law, about a rotation N m in place of N and rad in place of m.
deck::ListSpec& law(deck::ListSpec& entry, const std::string& name, bool byComponent) {
  static const std::map<std::string, std::string> aboutRotation{
      {"N", "N m"}, {"N/m", "N m/rad"}, {"N/m3", "N m/rad3"}, {"N s/m", "N m s/rad"}};
  for (const auto& one : model::PointLawRegistry::instance().find(name).parameters.parameters()) {
    const auto other = aboutRotation.find(one.unit);
    if (!byComponent || other == aboutRotation.end())
      entry.real(one.name, one.unit, one.value, one.range, one.doc);
    else
      entry.real(one.name, one.unit + " or " + other->second, one.value, one.range, one.doc)
          .unitBy("Component", unitByKind(one.unit, other->second, one.unit));
    if (one.level == deck::Level::Expert) entry.expert();
  }
  return entry;
}

deck::ListSpec springSpec() {
  deck::ListSpec entry("Spring", "A spring with a dashpot beside it; the name is free.");
  return deck::ListSpec("Springs", "Springs and dashpots between parts or to the ground.")
      .namedLists(law(ends(entry), "Spring", true));
}

deck::ListSpec stopSpec() {
  deck::ListSpec entry(
      "Stop", "A stop that closes when the separation reaches minus the gap; the name is free.");
  return deck::ListSpec("Stops", "One-sided contacts between parts or with the ground.")
      .namedLists(law(ends(entry), "Stop", false));
}

deck::ListSpec sliderSpec() {
  deck::ListSpec entry(
      "Slider",
      "Coulomb friction of constant size, f = -Force v / sqrt(v^2 + v_r^2); the name is free.");
  return deck::ListSpec("Sliders", "Dry friction between parts or to the ground.")
      .namedLists(law(ends(entry), "Slider", true));
}

deck::ListSpec pointLawSpec() {
  deck::ListSpec entry("Point Law", "A law between two nodes; the name is free.");
  return deck::ListSpec("Point Laws",
                        "Registered point laws between parts or to the ground. Units of their "
                        "parameters are those of a translation; about a rotation they are in N m "
                        "and rad.")
      .namedLists(deck::declareVariants<model::PointLaw, const Teuchos::ParameterList&,
                                        const model::PointLawPlace&>(ends(entry), "Type",
                                                                     deck::Required{}, "The law."));
}

}  // namespace

deck::ListSpec parameters() {
  deck::ListSpec list("Coupling",
                      "Connections between parts in addition to equal node numbers. Displacements "
                      "are relative to the reference (static) states of the parts. A node is "
                      "written PART:NODE with the name of the part, as tooljoint check lists them, "
                      "or NODE alone where all parts that have it are joined.");
  list.choice("Assembly", std::string("Primal"), {"Primal", "Dual"},
              "Primal: joined dofs become one coordinate. Dual: every reduced part keeps its own "
              "dofs, joined by Lagrange multipliers (the interface forces); this needs an implicit "
              "integrator. The full model is always primal.");
  list.choice("Node Numbers", std::string("Shared"), {"Shared", "Own"},
              "Shared: equal numbers are one node in all parts. Own: every part has its own "
              "numbers, and only Joints join nodes.");
  list.boolean("Keep Static Forces", true,
               "Apply the static force of released dofs as a constant load on both sides, so that "
               "the model stays at rest; otherwise the motion starts with a jump of this force.")
      .expert();
  for (auto& sublist : {jointSpec(), frameSpec(), releaseSpec(), constraintSpec(), linkSpec(),
                        hingeSpec(), springSpec(), stopSpec(), sliderSpec(), pointLawSpec()})
    list.list(sublist);
  return list;
}

}  // namespace tooljoint::coupling
