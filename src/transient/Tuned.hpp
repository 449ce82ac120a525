// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// All numbers that an implicit step is tuned with. docs/strategies.md says of each which case
/// needs it and over which range results do not depend on it (`ctest -R lint` holds the two
/// together, tests/stability/hard_cases/constants.py measures the ranges).
#pragma once

namespace tooljoint::transient {

struct Tuned {
  // Convergence
  static constexpr double slowestRate = 0.5;         ///< of the error, in an iteration [1]
  static constexpr double slowestRelaxation = 0.25;  ///< of the error, in four relaxations [1]
  static constexpr double progress = 0.99;           ///< what is more of the error is none [1]
  static constexpr int mostIdle = 2;                 ///< tries in a row without progress
  static constexpr double decrease = 0.1;      ///< of the residual that a full step must bring [1]
  static constexpr int mostTries = 8;          ///< lengths of a step, corrections of a path
  static constexpr double counted = 0.1;       ///< share of all from which an error counts [1]
  static constexpr double rightEnough = 0.25;  ///< parts of the tolerance that need no care [1]
  static constexpr double mostGrowth = 10;     ///< of forces over those where a step begins [1]
  static constexpr double rounding = 1e-12;    ///< beside the largest [1]

  // Relaxation
  static constexpr double factorPrice = 45;      ///< of a factor with its compliance [relaxations]
  static constexpr double driftPrice = 0.5;      ///< of a product with drifted laws [relaxations]
  static constexpr int positionsPerPoint = 100;  ///< of the model, for each of few points
  static constexpr double dropped = 1e-5;        ///< in near solves, beside the tolerance [1]
  static constexpr int colours = 4;              ///< of the turns: every fourth point

  // Single points
  static constexpr double pointTolerance = 1e-10;  ///< of a balance, beside the displacement [1]
  static constexpr int mostPointIterations = 30;
  static constexpr int mostPathSteps = 400;

  // Newton
  static constexpr int patience = 5;       ///< iterations that a new factor must save; rescues
  static constexpr int mostTroubled = 24;  ///< points solved together

  // Impacts
  static constexpr double mostLost = 0.005;       ///< of the energy, by one impact [1]
  static constexpr double mostMisplaced = 0.015;  ///< likewise, depending on when it is met [1]
  static constexpr double resolved = 0.15;        ///< w h at which any impact is [rad]
  static constexpr int calmSteps = 12;            ///< without motion, before steps grow
  static constexpr int lookStride = 8;     ///< from one sum of the energy to the next [steps]
  static constexpr double quiet = 1e-4;    ///< speeds below are rest [m/s]
  static constexpr int mostHalvings = 20;  ///< that impacts may need
  static constexpr int atATime = 3;        ///< of them

  // Phase correction and broad phase
  static constexpr double mostPhase = 0.7;  ///< k [1]
  static constexpr double lookAhead = 32;   ///< in which a point may touch and is measured [steps]
};

}  // namespace tooljoint::transient
