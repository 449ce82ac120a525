// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Numerical damping of vibration by the scheme. It is measured in the first 64 steps and in one of
/// eleven after them. e is the energy that the scheme takes in a step (NumericalDamping), 2 E the
/// energy of vibration, twice its kinetic energy. With the energy loss rate <e / h> / (2 E) the
/// amplitude decreases in T by exp(-d),
///
///     d = T <e / h> / (4 <v'M v / 2>)
///
/// with v'M v from the speeds of the nodes. The same steps show whether contact rests on walls too
/// stiff for the step: steps and halves alike damp vibration of such contact.
#pragma once

#include <vector>

#include "transient/accuracy/MotionNorm.hpp"
#include "transient/accuracy/NumericalDamping.hpp"

namespace tooljoint::transient {

class DampingSamples {
 public:
  /// \param scheme null: no numerical damping
  /// \param like a displacement
  DampingSamples(const NumericalDamping* scheme, const Vector& like)
      : scheme_(scheme), difference_(like) {}
  /// After each step.
  void look(const MotionNorm& norm, const State& from, const State& to);
  /// 1 - exp(-d): fraction of the amplitude that vibration loses in `span` [s].
  double damped(const MotionNorm& norm, double span) const;
  /// Whether contact rests on walls too stiff for the step in more than a tenth of the steps.
  bool hasUnresolvedContact() const;
  const NumericalDamping* scheme() const { return scheme_; }

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  long next() const;

  const NumericalDamping* scheme_;
  Vector difference_;
  // estimates for all steps, from the measured ones
  double lost_ = 0, vibrated_ = 0;  ///< sum of e [J], integral of |v|^2
  double rested_ = 0;               ///< steps with unresolved contact
  long taken_ = 0;                  ///< steps, counting the parts of a cut step
  long looks_ = 0;                  ///< measurements after the first steps
};

}  // namespace tooljoint::transient
