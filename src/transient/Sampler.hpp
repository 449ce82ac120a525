// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Samples at equal times from accepted steps.
#pragma once

#include <exception>

#include "transient/ranks/ShareSink.hpp"

namespace tooljoint::transient {

/// Samples at start + k * interval.
class Sampler {
 public:
  /// \param done samples written before
  /// \param share share of this rank, null for an undivided motion
  Sampler(const CompiledModel& model, const TransientOptions& options, SampleSink& sink, long done,
          const RankShare* share);
  long count() const { return count_; }
  /// Exception of the sink of this rank. In a divided motion the run collects it from all ranks and
  /// then throws on all.
  const std::exception_ptr& failure() const { return failure_; }

  /// All samples in (from.t, to.t]. A sample at the end of the step is the state itself.
  void step(const State& from, const State& to);
  void first(const State& state) { give(state.t, state); }

 private:
  const State& between(const State& from, const State& to, double x);
  void give(double t, const State& state);
  void pass(double t);
  template <class Work>
  void guard(const Work& work);

  const CompiledModel& model_;
  const RankShare* share_;
  double begin_, end_, interval_;
  SampleSink& sink_;
  ShareSink* gathering_ = nullptr;  ///< the sink, if it gathers from the ranks
  long count_;
  State middle_;
  Vector q_, v_, a_;  ///< of the whole model, in dofs
  Vector x_;          ///< states of the point laws of all ranks
  std::exception_ptr failure_;
};

}  // namespace tooljoint::transient
