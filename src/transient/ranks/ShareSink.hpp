// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Sink that gathers the samples of a divided motion itself, so that not every rank receives the
/// whole of every sample.
#pragma once

#include "transient/Transient.hpp"
#include "transient/ranks/RankShare.hpp"

namespace tooljoint::transient {

/// Part of a sample on one rank; vectors in the dofs of share.model().
struct SampleShare {
  double t;  ///< [s]
  const RankShare& share;
  const Vector &q, &qDot, &qDDot;
  const Vector& states;  ///< states of the point laws of all ranks
};

class ShareSink : public SampleSink {
 public:
  /// Whether sampleShare() is called instead of sample() for a divided motion. The same on all
  /// ranks.
  virtual bool gathers() const { return true; }
  /// Called on all ranks at once. It may throw on one rank after its last message; the others
  /// continue to call until all ranks know of it.
  virtual void sampleShare(const SampleShare& mine) = 0;
};

}  // namespace tooljoint::transient
