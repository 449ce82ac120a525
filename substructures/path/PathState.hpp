// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The string bent into the well: positions of its nodes, and the reactions.
#pragma once

#include <vector>

#include "common/Types.hpp"
#include "substructures/beam/BeamMatrices.hpp"

namespace tooljoint::path {

struct PathReport {
  bool converged = false;
  int increments = 0;     ///< load steps taken
  int iterations = 0;     ///< Newton iterations of all load steps
  double residual = 0.0;  ///< scaled residual norm of the last step
  double maxPositionError =
      0.0;  ///< largest distance of a node from the axis, in the axis' normal plane through it [m]
};

/// State at the end of the path computation (Nguyen et al. 2020, section 3.1). Nodes and elements
/// in order from the surface.
struct PathState {
  std::vector<double>
      arcLength;  ///< depth along the well of each node (of its foot on the axis) [m]
  std::vector<Vector3> position;  ///< global [m]
  std::vector<Matrix3> frame;  ///< nodal frames Q, columns x, y, z; z is the well tangent (`Centre
                               ///< line`) or the axis of the node's cross section (`Imposed nodes`)
  std::vector<Vector3> sectionAxis;  ///< axis of the cross section of each node, global; differs
                                     ///< from z where bending jumps, mainly at the ends
  std::vector<Vector3>
      offset;  ///< position minus foot on the axis, in the nodal frame [m]; zero in `Centre line`
  std::vector<Matrix3> elementFrame;  ///< E: z on the chord, x and y from the mean nodal frames
  std::vector<double> chordLength;    ///< l [m]
  Matrix reaction;                    ///< R_ipa = -Q' f_int, 6 x nodes, nodal frames [N, N m]
  std::vector<beam::Vector12> force;  ///< internal forces and moments of each element at its nodes,
                                      ///< global axes [N, N m]
  Vector axialForce;                  ///< F_apa per element [N]
  Vector torque;                      ///< T_apa per element [N m]
  /// Corotational tangent of each element at this state in nodal frames, moments included. Empty
  /// unless requested (pre-stress `Full tangent`); it then replaces K_a + K_g(F_apa, T_apa).
  std::vector<beam::Matrix12> tangent;
  PathReport report;

  /// The axis of the cross section of a node in its nodal frame.
  Vector3 axisInFrame(std::size_t node) const {
    return frame[node].transpose() * sectionAxis[node];
  }
};

}  // namespace tooljoint::path
