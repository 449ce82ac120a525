// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A-posteriori error of the motion of a coupled reduced model, from its samples.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "coupling/Synthesis.hpp"
#include "transient/Transient.hpp"

namespace tooljoint::estimate {

struct MotionOptions {
  std::vector<int> components{0, 1};  ///< measured components of the recovered nodes: u and v
  double damping = 0.5;  ///< weight of the end of an interval in the error equation, 0.5 to 1; 0.5
                         ///< has no damping
};

/// The estimate at the end of a motion.
struct MotionEstimate {
  double error = 0;  ///< |x - x_full| / |x - x_static| over all recovered nodes and samples: the
                     ///< estimate of the vibration error
  std::optional<double> ofEverySecond;  ///< the same from every second sample; empty if a law
                                        ///< cannot be evaluated at this distance
  double largest =
      0;  ///< the same for the worst sample, against the mean of |x - x_static| over the samples
  Vector byPart;  ///< squared size of the truncated motion of each part, as a fraction of the
                  ///< sum over the parts
  long samples = 0;
  double motion = 0;  ///< |x - x_static|^2, summed over all recovered nodes and samples
  /// Sum of (h x')^2 over that of (x(t + h) - x(t))^2, h the time between two samples: 1 for a
  /// motion that the samples resolve, (omega h)^2 / (2 - 2 cos(omega h)) for a vibration.
  double roughness = 1;
  double reached = 1;  ///< computed fraction of the window, below 1 if the motion was stopped
  double wall = 0;     ///< wall time of the estimate [s]

  /// The motion is faster than the samples, or its error grows with more samples: the error may be
  /// larger than the estimate.
  bool isTooFast() const {
    return error > 0.0 &&
           (roughness > roughest || (ofEverySecond && *ofEverySecond < slowest * error));
  }
  /// For a vibration with three samples per period.
  static constexpr double roughest = 1.45;
  /// Estimate from every second sample over that from all, for a resolved motion.
  static constexpr double slowest = 0.6;
};

/// A limit at which a motion is stopped: sum |x - x_full|^2 so far exceeds error^2 sum |x -
/// x_static|^2, the latter being the larger of its value so far and its expected value at the
/// end.
struct MotionLimit {
  double error = std::numeric_limits<double>::infinity();
  double motion = 0;  ///< MotionEstimate::motion of a model that went to the end, 0: unknown
};

/// Integrates the error of a motion in parallel with it. With D = Phi q the motion of all parts
/// and the residual r = M D'' + C D' + K D - F - f_c of the full equations, r is zero in the
/// coupled coordinates and the error obeys
///
///     M e'' + C e' + (K - df_c/dD) e = -r,   e = Phi z + w.
///
/// w, the error outside the basis, is quasi-static: w = -F r with the residual flexibility
/// of each part. It loads the coupled model, and with u = z + P w, P = m^-1 Phi' M, no
/// derivative of w is needed:
///
///     m u'' + c u' + k u = Phi' (K s + C s'),   e = Phi u - s,   s = Phi P w - w,
///
/// The part of the initial state e(0) outside the modes does not depend on r: it vibrates in the
/// interiors (TruncatedStart) and is added to w. k and c contain the tangents of the point laws
/// along the motion, and the errors of their states (StateErrors). One step per sample; residuals
/// are means over the interval (M D'' is M times the change of velocity), and all matrices are
/// those of the model at that time. Not included: motion faster than the samples, which a second
/// estimate from half of them shows (MotionEstimate::isTooFast), and the error of the time
/// integration. Compare the dual-weighted residuals of W. Bangerth and R. Rannacher, Adaptive
/// Finite Element Methods for Differential Equations (2003), chapter 1, of which this is the
/// forward form.
class MotionEstimator : public transient::SampleSink {
 public:
  /// All arguments must outlive the estimator. Throws ModelError if the mass of the coupled model
  /// is singular. \param rest recovered displacement at rest, rows of the recovery of the coupled
  /// model
  MotionEstimator(const std::vector<model::Substructure>& parts,
                  const coupling::Synthesis& synthesis, Vector rest, MotionOptions options = {});
  ~MotionEstimator() override;
  MotionEstimator(const MotionEstimator&) = delete;
  MotionEstimator& operator=(const MotionEstimator&) = delete;

  /// ConvergenceError: the delay of a point law is shorter than the time between two samples.
  void sample(double t, const Vector& q, const Vector& qDot, const Vector& qDDot) override;
  void states(const Vector& x) override;
  MotionEstimate result() const;
  bool exceeds(const MotionLimit& limit) const;

 private:
  struct Impl;
  void look(Impl& at, double t, const Vector& q, const Vector& qDot);

  std::unique_ptr<Impl> impl_;
  std::unique_ptr<Impl> coarse_;  ///< for every second sample
};

/// Integrates `model`, the coupled one of the estimator, to its end or until its error exceeds the
/// limit. The error of a stopped motion is extrapolated with the mean rate of its square: at least
/// sqrt(1 / reached) times the limit. Throws InterruptedError if the user stops it, and the errors
/// of transient::integrate.
MotionEstimate watchMotion(MotionEstimator& estimator, const model::SecondOrderModel& model,
                           const transient::TransientOptions& options,
                           const MotionLimit& limit = {},
                           const std::string& title = "choice of modes");

}  // namespace tooljoint::estimate
