// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Whether a reduced motion vibrates near the cut-off frequency of its basis. With the modal
/// coordinates p_i of a part, w_i^2 = k_ii / m_ii, and the frequency w_c at which its modes end,
///
///     sum over w_i > w_c / 2 of m_ii p'_i^2 over v'M v
///
/// averaged over the samples, is the fraction of the kinetic energy in the upper half of the kept
/// frequencies. An excitation of these modes, such as an impact shorter than their periods, also
/// excites modes that are not kept.
#pragma once

#include <vector>

#include "transient/Integrator.hpp"

namespace tooljoint::transient {

class CutOffEnergy {
 public:
  /// \param cutOffs w_c of each part [rad/s], by DofLabel::entity; infinite if no mode is missing
  CutOffEnergy(const CompiledModel& model, const std::vector<double>& cutOffs);
  /// Call at each sample.
  void look(const State& state);
  /// 0 to 1. Collective.
  double share() const;

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  struct Mode {
    int position;
    double mass;
  };
  const CompiledModel* model_;
  std::vector<Mode> high_;          ///< modes above half the cut-off
  double highest_ = 0, whole_ = 0;  ///< sums on this rank: m p'^2 of these modes, v'M v
};

}  // namespace tooljoint::transient
