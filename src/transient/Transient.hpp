// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// From a model and the deck list `Transient` to sampled motion and a report, for full and reduced
/// models alike.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "common/Types.hpp"
#include "model/SecondOrderModel.hpp"
#include "transient/Checkpoint.hpp"
#include "transient/Integrator.hpp"
#include "transient/MissingModes.hpp"
#include "transient/TransientParameters.hpp"
#include "transient/accuracy/EnergyLedger.hpp"

namespace tooljoint::transient {

/// Receives the motion at every multiple of the sampling interval, including the start; vectors are
/// in the dofs of the model.
class SampleSink {
 public:
  virtual ~SampleSink() = default;
  virtual void sample(double t, const Vector& q, const Vector& qDot, const Vector& qDDot) = 0;
  /// States of the point laws of the next sample, set by set in the order of the model's points.
  /// Called only for a model with such states. Recorders of laws with states use them
  /// (model::record()).
  virtual void states(const Vector& /*x*/) {}
};

/// Result of a run. Counts and seconds are of this run (a restarted run continues the counts of its
/// checkpoint).
struct TransientReport {
  std::string integrator;
  int size = 0;       ///< dofs of the model
  int ranks = 1;      ///< ranks that shared the motion
  int ownSize = 0;    ///< largest number of dofs of a rank, its cuts included
  long messages = 0;  ///< messages between the ranks in the motion, without samples
  double start = 0;   ///< [s]
  double end = 0;     ///< time reached [s]
  bool interrupted = false;
  Counters counters;
  long contactEvaluations = 0;  ///< points evaluated, summed over all force evaluations
  long samples = 0;
  double wall = 0;            ///< [s]
  double cpu = 0;             ///< [s]
  double realTimeFactor = 0;  ///< simulated seconds per second of wall time
  double stepError = 0;       ///< of equal steps (StepVerdict.hpp), 0 if not known
  double cutOffEnergy = 0;    ///< CutOffEnergy.hpp
  double missingEnergy = 0;   ///< MissingModes.hpp
  bool hasEnergy = false;
  EnergyAccount energy;
};

/// Options of a run beyond its model and its list.
struct RunHooks {
  std::string title = "transient";     ///< in front of the progress bar
  const Checkpoint* resume = nullptr;  ///< continue from here instead of the initial state
  /// Called at every checkpoint and at an interrupt. An integrator that cannot continue from any
  /// state calls it at the start instead of at an interrupt. Checkpoints are taken at multiples of
  /// the interval even without this function, because some integrators restart there.
  std::function<void(const Checkpoint&)> keep;
  std::function<bool()> stop;  ///< read each step; default: the interrupt flag
  /// For a reduced model: frequencies [rad/s] at which the modes of each part end, infinite if no
  /// mode is missing. With them the report has a cutOffEnergy.
  std::vector<double> cutOffs;
  /// For a reduced model: modes of parts without modes. With them the report has a missingEnergy.
  std::vector<MissingMode> missing;
  /// Also receives the motion, at multiples of its own interval [s]; not in a restarted run.
  SampleSink* watcher = nullptr;
  double watchInterval = 0;
};

/// Integrate. Samples go to `sink`; with hooks.resume only those after the checkpoint. Throws
/// ModelError (a model the integrator cannot treat), ConvergenceError with time and dof (Newton,
/// divergence, not a number), DeckError.
TransientReport integrate(const model::SecondOrderModel& model,
                          const Teuchos::ParameterList& transient, SampleSink& sink,
                          const RunHooks& hooks = {});
TransientReport integrate(const model::SecondOrderModel& model, const TransientOptions& options,
                          SampleSink& sink, const RunHooks& hooks = {});

}  // namespace tooljoint::transient
