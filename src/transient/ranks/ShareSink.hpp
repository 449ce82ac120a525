// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A sink that brings together itself what the ranks have of a motion that they divide, so that not
/// every rank gets the whole of every sample.
#pragma once

#include "transient/Transient.hpp"
#include "transient/ranks/RankShare.hpp"

namespace tooljoint::transient {

/// What one rank has of a sample; vectors in the dofs of share.model().
struct SampleShare {
  double t;  ///< [s]
  const RankShare& share;
  const Vector &q, &qDot, &qDDot;
  const Vector& states;  ///< of the point laws, of all ranks
};

class ShareSink : public SampleSink {
 public:
  /// Whether sampleShare() is called instead of sample() where ranks divide the motion. The same on
  /// all ranks.
  virtual bool gathers() const { return true; }
  /// Called on all ranks at once. May throw on one of them behind its last message; the ranks then
  /// call on until all know of it.
  virtual void sampleShare(const SampleShare& mine) = 0;
};

}  // namespace tooljoint::transient
