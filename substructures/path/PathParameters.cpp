// SPDX-License-Identifier: BSD-3-Clause
#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>

#include "substructures/path/Path.hpp"

namespace tooljoint::path {

deck::ListSpec parameters() {
  using deck::Range;
  deck::ListSpec spec(
      "Path", "Bending of the straight string into the well (Nguyen et al. 2020, section 3.1).");
  spec.removed(
      {"Imposition", "Penalty Factor"},
      "displacements are imposed by elimination, which gives the same path. Leave it out.");
  spec.choice("Mode", std::string("Centre line"), {"Centre line", "Imposed nodes"},
              "\"Centre line\": every node is fixed laterally on the axis and free to slide and to "
              "rotate. \"Imposed nodes\": X and Y of some nodes are moved from the vertical to the "
              "well; between these nodes the string deviates from the axis.");
  spec.choice("Pre-stress", std::string("Full tangent"), {"Full tangent", "Axial and torque"},
              "Contribution of the bent state to the static and dynamic stiffness: the full "
              "corotational tangent with its moments, or the geometric stiffness of axial force "
              "and torque alone, which violates the torque balance of a curved string.");
  spec.integer("Increments", 10, Range::atLeast(1),
               "Load steps of \"Imposed nodes\"; a step that does not converge is halved.")
      .expert();
  spec.integer("Node Count", 9, Range::atLeast(2),
               "Number of imposed nodes, equally spaced in arc length with both ends included, "
               "when no Nodes are given.")
      .expert();
  spec.integerArray("Nodes", deck::Optional{}, Range::atLeast(1),
                    "Imposed nodes by number (1 is at the surface).");
  spec.real("Tolerance", "", 1e-9, Range::positive(),
            "Largest scaled residual at which a load step has converged.");
  spec.integer("Max Iterations", 50, Range::atLeast(1),
               "Newton iterations allowed in one load step.")
      .expert();
  spec.passThrough("NOX", "Parameters passed to NOX unchanged.");
  spec.passThrough("Belos", "Parameters passed to Belos unchanged.");
  return spec;
}

PathOptions optionsFrom(const Teuchos::ParameterList& path) {
  PathOptions options;
  options.mode =
      path.get<std::string>("Mode") == "Centre line" ? Mode::CentreLine : Mode::ImposedNodes;
  options.prestress = path.get<std::string>("Pre-stress") == "Full tangent"
                          ? Prestress::FullTangent
                          : Prestress::AxialAndTorque;
  options.increments = path.get<int>("Increments");
  options.nodeCount = path.get<int>("Node Count");
  if (path.isParameter("Nodes")) {
    const auto& nodes = path.get<Teuchos::Array<int>>("Nodes");
    options.nodes.assign(nodes.begin(), nodes.end());
  }
  options.tolerance = path.get<double>("Tolerance");
  options.maxIterations = path.get<int>("Max Iterations");
  return options;
}

}  // namespace tooljoint::path
