// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Values of surface gauges at a sample: speed, torque and hook load.
#pragma once

#include "cases/MotionRecord.hpp"
#include "substructures/drillstring/scene/Scene.hpp"
#include "substructures/drillstring/scene/Stages.hpp"

namespace tooljoint::drillstring {

/// From the strain of the uppermost element, of length L:
///
///     T = T_s + E S (w_2 - w_1 - (w_2 - w_1)_s)/L,
///     M = M_s + G J (theta_2 - theta_1 - (theta_2 - theta_1)_s)/L,
///
/// with w and theta_z of its nodes; s: static state, T_s its hook load, M_s the torque of the
/// element.
class SurfaceSampler {
 public:
  SurfaceSampler(const Scene& scene, const StaticStage& stage);

  /// Computes the values at this sample.
  void sample(const cases::Sample& sample);

  const double& speed() const { return speed_; }        ///< Omega + dtheta_z/dt, node 1 [rad/s]
  const double& torque() const { return torque_; }      ///< -M, against the rotation [N m]
  const double& hookLoad() const { return hookLoad_; }  ///< T [N]

 private:
  /// Sense of rotation: 1 to the right or without rotation, -1 to the left.
  double sense(double t) const;

  const Scene& scene_;
  double axialStiffness_, torsionalStiffness_;  ///< E S/L [N/m], G J/L [N m/rad]
  double axialOffset_, torqueOffset_;           ///< T and M at w_2 = w_1, theta_2 = theta_1
  double speed_ = 0.0, torque_ = 0.0, hookLoad_ = 0.0;
};

}  // namespace tooljoint::drillstring
