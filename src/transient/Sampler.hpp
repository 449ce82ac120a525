// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// From accepted steps to samples at equal times.
#pragma once

#include <exception>

#include "transient/ranks/ShareSink.hpp"

namespace tooljoint::transient {

/// Hands out samples at start + k * interval.
class Sampler {
 public:
  /// \param done   samples handed out before
  /// \param share  of this rank, null for a motion that is not divided
  Sampler(const CompiledModel& model, const TransientOptions& options, SampleSink& sink, long done,
          const RankShare* share);
  long count() const { return count_; }
  /// What the sink of this rank has thrown. The other ranks of a divided motion do not know of it:
  /// the run collects from all of them and then throws on all.
  const std::exception_ptr& failure() const { return failure_; }

  /// All samples in (from.t, to.t]; those that fall on the end of the step are the state itself.
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
  ShareSink* gathering_ = nullptr;  ///< the sink, where it gathers
  long count_;
  State middle_;
  Vector q_, v_, a_;  ///< of the whole, in dofs
  Vector x_;          ///< states of the point laws of all ranks
  std::exception_ptr failure_;
};

}  // namespace tooljoint::transient
