// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/scene/Remarks.hpp"

namespace tooljoint::drillstring {

std::string prestressRemark(const Scene& scene) {
  if (scene.path.prestress != path::Prestress::AxialAndTorque) return "";
  for (const double s : scene.string.depths())
    if (scene.well.trajectory().at(s).curvature.norm() > 0.0)
      return "Path/Pre-stress is \"Axial and torque\" in a well that bends: the string then "
             "resists a spin about its own curved axis, and torques are wrong. Take \"Full "
             "tangent\" (the "
             "default) unless the published model of Nguyen et al. 2020 is wanted.";
  return "";
}

std::string bitFrictionRemark(const Scene& scene) {
  const auto& list = scene.list();
  if (!scene.bit || !scene.bit->law->weakensWithSpeed() || !list.isSublist("Transient")) return "";
  if (list.isSublist("Damping") &&
      loads::readDamping(list.sublist("Damping")).stiffnessCoefficient > 0.0)
    return "";
  return "The torque of the bit falls with its speed, and no damping of the string rises with the "
         "frequency: every torsional vibration grows at the bit, up to the shortest waves of the "
         "mesh, and bit speeds depend on step and mesh. Give Damping/Stiffness Coefficient, for "
         "example 5e-4 s (3 % of critical damping at 20 Hz).";
}

std::string unbalanceRemark(const Scene& scene) {
  const bool loaded = scene.list().isSublist("Loads") &&
                      scene.list().sublist("Loads").isSublist("Unbalance") &&
                      scene.list().sublist("Loads").sublist("Unbalance").numParams() > 0;
  if (!loaded || scene.topDrive.control != drilling::DriveControl::Torque) return "";
  return "Loads/Unbalance turns with Rotary Speed, but under the control \"Torque\" of Top Drive "
         "the string turns as fast as the torque makes it: force and phase of the unbalance are "
         "not those of the string. Set Top Drive/Control to \"Speed\", or leave the unbalance out.";
}

std::string axialFrictionRemark(const Scene& scene) {
  if (!scene.contact || !scene.contact->axialFriction || !scene.reduces()) return "";
  const auto& nodes = scene.partition.retainedNodes;
  if (nodes == "Gap" || nodes == "Static contacts" || nodes == "All") return "";
  return "Contact/Friction/Axial acts on nodes that Substructures/Retained Nodes \"" + nodes +
         "\" may leave to the modes of the parts: the change of the hook load of a string that "
         "begins to turn was 10 % off with 4 to 8 modes in a part, 0.001 % with 24. Set Retained "
         "Nodes to \"Static contacts\".";
}

}  // namespace tooljoint::drillstring
