// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// All tuned numbers of an implicit step. docs/step-constants.md says for each which case needs it
/// and over which range results do not depend on it (`ctest -R lint` compares both,
/// tests/stability/hard_cases/constants.py measures the ranges).
#pragma once

namespace tooljoint::transient {

struct Tuned {
  // Convergence
  static constexpr double slowestRate = 0.5;         ///< error factor, of one iteration [1]
  static constexpr double slowestRelaxation = 0.25;  ///< error factor, of four relaxations [1]
  static constexpr double progress = 0.99;           ///< error reduction that is progress [1]
  static constexpr int mostIdle = 2;                 ///< consecutive tries without progress
  static constexpr double decrease = 0.1;      ///< of the residual, required of a full step [1]
  static constexpr int mostTries = 8;          ///< step lengths; corrections of a path
  static constexpr double counted = 0.1;       ///< of the total, from which errors count [1]
  static constexpr double rightEnough = 0.25;  ///< of the tolerance: not corrected below [1]
  static constexpr double mostGrowth = 10;     ///< of forces since the start of the step [1]
  static constexpr double rounding = 1e-12;    ///< relative to the largest [1]

  // Relaxation
  static constexpr double factorPrice = 45;      ///< factor with its compliance [relaxations]
  static constexpr double driftPrice = 0.5;      ///< product with drifted laws [relaxations]
  static constexpr int positionsPerPoint = 100;  ///< model positions per point, if points are few
  static constexpr double dropped = 1e-5;        ///< in near solves, part of the tolerance [1]
  static constexpr int colours = 4;              ///< of the turns: every fourth point

  // Single points
  static constexpr double pointTolerance = 1e-10;  ///< of a balance, over the displacement [1]
  static constexpr int mostPointIterations = 30;
  static constexpr int mostPathSteps = 400;

  // Newton
  static constexpr int patience = 5;       ///< iterations that a new factor must save; rescues
  static constexpr int mostTroubled = 24;  ///< points solved together

  // Impacts
  static constexpr double mostLost = 0.005;       ///< of the energy, lost by one impact [1]
  static constexpr double mostMisplaced = 0.015;  ///< likewise misplace, by its time [1]
  static constexpr double resolved = 0.15;        ///< w h at which every impact is resolved [rad]
  static constexpr int calmSteps = 12;            ///< without motion, before steps grow
  static constexpr int lookStride = 8;            ///< between two sums of the energy [steps]
  static constexpr double quiet = 1e-4;           ///< speeds below count as rest [m/s]
  static constexpr int atATime = 3;               ///< halvings at once

  // Phase correction and broad phase
  static constexpr double mostPhase = 0.7;  ///< k [1]
  static constexpr double mostTurn = 3e-3;  ///< of the normal of a corrected point, per step [rad]
  static constexpr double lookAhead = 32;   ///< points that may touch are measured [steps]
};

}  // namespace tooljoint::transient
