// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Wall at a point, found by evaluating its law. With J = df/dd at the point, the normal is n = J'f
/// / |J'f|; behind the wall, n'f has the stiffness k = -n'J n and the damping c = -n' df/dv n. A
/// point of mass 1/W = 1/(n' R M^-1 R' n) vibrates there with w = sqrt(k W).
#pragma once

#include <array>
#include <vector>

#include "transient/compiled/CompiledModel.hpp"

namespace tooljoint::transient {

class MetWall {
 public:
  void bind(CompiledModel& model);

  /// Evaluates at the position of the point in its batch; then n, W and n'f are known, and the rest
  /// is zero.
  /// \param mobility R M^-1 R' of the point, width x width, row-major [1/kg]
  void face(PointBatch& batch, int point, const double* mobility, double t);
  /// k and c at the depth that the point reaches with this speed in a step of length h.
  void measure(double speed, double h);
  /// Extrapolates c to the start of the wall from its growth behind it. The wall begins at most
  /// `farthest` outwards from the point [m].
  void findOnset(double farthest);

  double frequency() const { return frequency_; }  ///< w [rad/s]; 0 without a wall
  double mobility() const { return mobility_; }    ///< W [1/kg]
  double push() const { return push_; }            ///< n'f [N]
  /// W c at this depth behind the start of the wall, at least 0 [1/s]; before findOnset() at the
  /// depth of measure().
  double damping(double depth) const { return damping_ + rise_ * depth; }
  /// n'R v for velocities of the model [m/s].
  double along(const Vector& v) const;
  /// n'f of forces on the rows of the point [N].
  double along(const double* rows) const;

 private:
  double beginning(double farthest);
  std::array<double, 2> behind(double depth);

  PointBatch* batch_ = nullptr;
  int point_ = 0;
  double t_ = 0;
  double frequency_ = 0, mobility_ = 0, push_ = 0;
  double depth_ = 0;            ///< depth of the evaluation [m]
  double damping_ = 0;          ///< W c there; after findOnset() at the start [1/s]
  double rise_ = 0;             ///< its growth with depth [1/(s m)]
  std::vector<double> normal_;  ///< n, in rows
  std::vector<double> elsewhere_, f_, dfdd_, dfdv_;  ///< coordinates behind the wall, law there
};

}  // namespace tooljoint::transient
