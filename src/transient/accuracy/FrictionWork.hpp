// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Work of friction of point laws by the forces in the steps. Friction that stops a point within a
/// step is far smaller at the end of the step than in its middle, where the law at the mean
/// velocity is at its peak. With the mean velocity, hard contact with friction would lose energy
/// that the motion still has. With f_n the friction at the end of a step,
///
///     W = sum (f_n + f_{n+1})/2 . (d_{n+1} - d_n),   friction = drive - W,
///     drive = h (P_n + P_{n+1})/2, P the power of the prescribed motion
///
/// and f_{n+1}, P_{n+1} alone for an impact (PointBatch::scale() other than 1), whose force acts in
/// full over its step and not beyond.
#pragma once

#include <memory>
#include <vector>

#include "model/laws/Friction.hpp"
#include "transient/compiled/CompiledModel.hpp"

namespace tooljoint::transient {

struct State;

class FrictionWork {
 public:
  void start(CompiledModel& model, const State& state);
  /// After every step. Allocates nothing.
  void step(CompiledModel& model, const State& to);
  /// Whether friction of a batch is booked here: its law has a frictionless version.
  bool has(std::size_t batch) const { return sets_[batch].smooth != nullptr; }
  /// [J] since the last forget(), points of this rank.
  double friction() const { return friction_; }
  double drive() const { return drive_; }
  void forget() { friction_ = drive_ = 0; }

  void save(std::vector<double>& memory) const;
  void restore(const CompiledModel& model, const double*& memory);

 private:
  struct Set {
    const model::Frictional* law = nullptr;
    std::shared_ptr<const model::PointLaw> smooth;  ///< the law without friction
    std::vector<double> force;                      ///< friction f_n, rows; 0 if inactive
    std::vector<int> points;                        ///< points with friction
    double power = 0;                               ///< P_n
  };
  void allocate(const CompiledModel& model);
  double work(PointBatch& batch, Set& set, const State& to);

  std::vector<Set> sets_;
  std::vector<int> looked_, steady_, impacts_, left_;
  std::vector<double> with_, without_, step_;  ///< forces, `with_` finally friction of impacts; dq
  Vector q_, dq_;
  double time_ = 0, friction_ = 0, drive_ = 0;
  double h_ = 0;
};

}  // namespace tooljoint::transient
