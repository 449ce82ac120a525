// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/scene/Remarks.hpp"

#include "deck/PrintedUnits.hpp"

namespace tooljoint::drillstring {
namespace {

/// Number of evenly spaced times of a motion at which the sense of its rotation is evaluated.
constexpr int timesOfSense = 1000;

/// The rotary speed farthest in the sense of `sign` during the motion; at time 0 without one.
double farthestSpeed(const Scene& scene, double sign) {
  const auto& list = scene.list();
  double begin = 0.0, end = 0.0;
  if (list.isSublist("Transient")) {
    begin = list.sublist("Transient").get<double>("Start Time");
    end = list.sublist("Transient").get<double>("End Time");
  }
  double farthest = scene.rotary.speed(begin);
  for (int i = 1; i <= timesOfSense; ++i) {
    const double speed = scene.rotary.speed(begin + (end - begin) * i / timesOfSense);
    if (sign * speed > sign * farthest) farthest = speed;
  }
  return farthest;
}

}  // namespace

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

std::string torqueOnBitRemark(const Scene& scene) {
  if (scene.bit || !scene.list().isSublist("Loads")) return "";
  if (scene.topDrive.control == drilling::DriveControl::Torque) return "";
  const double torque = scene.list().sublist("Loads").get<double>("Torque On Bit");
  const double speed = farthestSpeed(scene, torque > 0.0 ? -1.0 : 1.0);
  if (!(torque * speed < 0.0)) return "";
  return "Loads/Torque On Bit, " + deck::printed(torque, "kN m", 4) +
         ", has a fixed direction and drives the string where Rotary Speed has the other sign (" +
         deck::printed(speed, "rpm", 4) +
         "); the rock resists. Give the torque the sign of the speed, or, where the speed changes "
         "its sign, a law of the list Bit.";
}

}  // namespace tooljoint::drillstring
