// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Steps of an AlphaStep taken again as two halves, from what it remembers of the steps before.
#pragma once

#include <vector>

#include "transient/accuracy/HalvedStep.hpp"
#include "transient/schemes/AlphaStep.hpp"

namespace tooljoint::transient {

class AlphaHalves final : public HalvedStep {
 public:
  /// Looks at steps that `step`, which must outlive this, has just taken and not kept.
  explicit AlphaHalves(const AlphaStep& step);
  void prepare(CompiledModel& model, const State& state, double h) override;
  bool take(const State& from, State& end) override;
  void clean(Vector& start, Vector& run, Vector& halves) const override;
  void save(std::vector<double>& memory) const override { halves_.save(memory); }
  void restore(const double*& memory) override { halves_.restore(memory); }

 private:
  const AlphaStep& step_;
  AlphaStep halves_;
  State start_, middle_;
  Counters unused_;
  double h_ = 0;
};

}  // namespace tooljoint::transient
