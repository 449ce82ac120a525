// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// ARKODE and CVODE of SUNDIALS (Hindmarsh et al. 2005; Reynolds et al. 2023) behind a plain
/// interface: steps on a FirstOrderForm, which solves their Newton matrix. A build without SUNDIALS
/// has this header but not its source.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "transient/schemes/sundials/FirstOrderForm.hpp"

namespace tooljoint::transient {

struct SundialsOptions {
  double relative = 1e-4;    ///< relative tolerance
  double positions = 1e-6;   ///< absolute tolerance of q and of states of point laws
  double velocities = 1e-4;  ///< absolute tolerance of v
  double firstStep = 0;      ///< 0: chosen by SUNDIALS
  double maxStep = 0;        ///< 0: no limit
  int maxIterations = 3;     ///< of Newton
  int maxOrder = 2;          ///< CVODE
  std::string table;         ///< ARKODE

  /// Error allowed in a step for a position or a state of a law, or a velocity, with the value y:
  ///     rtol min(|y|, 1) + atol,   rtol |y| + atol_v
  /// Positions count up to 1 m or 1 rad, because a string that has turned a hundred times is no
  /// stiffer in angle than one that has not.
  double allowedPosition(double y) const {
    return relative * std::min(std::abs(y), 1.0) + positions;
  }
  double allowedVelocity(double v) const { return relative * std::abs(v) + velocities; }
};

/// Reason why a step failed.
enum class SundialsTrouble {
  None,
  Accuracy,   ///< tolerances below rounding
  ErrorTest,  ///< the error test failed for all step lengths
  Newton,     ///< Newton did not converge for all step lengths
  NotFinite,  ///< f(t, y) is not finite, at once or for all step lengths
  Other,
};

/// Sums since the start or the last restart().
struct SundialsCounts {
  long rejected = 0, newtonFailures = 0, newtonIterations = 0;
};

class SundialsStepper {
 public:
  virtual ~SundialsStepper() = default;
  /// Start at (t, y); steps never pass `end`. firstStep 0 leaves the first step to SUNDIALS.
  virtual void restart(double t, const double* y, double end, double firstStep) = 0;
  /// Steps do not pass this time, which is at or before that end.
  virtual void stopAt(double t) = 0;
  /// One step, however short. Rethrows exceptions of the model; a ConvergenceError (a delay shorter
  /// than the step) only if shorter steps fail too.
  virtual SundialsTrouble step() = 0;
  /// End time of the last step, and its length.
  virtual double time() const = 0;
  virtual double lastStep() const = 0;
  /// Length proposed for the next step.
  virtual double nextStep() const = 0;
  /// Solution at a time within the last step, by an interpolation as accurate as the method.
  virtual void at(double t, double* y) = 0;
  virtual SundialsCounts counts() const = 0;
  /// Position in y with the largest error of the last try, relative to its tolerance.
  virtual int worstPosition() = 0;
  /// Last message of SUNDIALS.
  virtual const std::string& message() const = 0;
};

std::unique_ptr<SundialsStepper> makeArkode(FirstOrderForm& form, const SundialsOptions& options);
std::unique_ptr<SundialsStepper> makeCvode(FirstOrderForm& form, const SundialsOptions& options);

}  // namespace tooljoint::transient
