// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Vibration that a scheme itself damps. In the first 64 steps and one in eleven after them the
/// energy e that the scheme takes in a step (NumericalDamping) is set beside the energy of
/// vibration, twice its kinetic energy: at the rate <e / h> / (2 E) of its energy the amplitude
/// falls in T by exp(-d),
///
///     d = T <e / h> / (4 <v'M v / 2>)
///
/// v'M v from the speeds of the nodes. In the same steps it is checked whether contact rests on
/// walls too stiff for them: vibration of such contact is held down by steps and halves alike.
#pragma once

#include <vector>

#include "transient/accuracy/MotionNorm.hpp"
#include "transient/accuracy/NumericalDamping.hpp"

namespace tooljoint::transient {

class DampingSamples {
 public:
  /// \param scheme  null: it damps nothing \param like  a displacement
  DampingSamples(const NumericalDamping* scheme, const Vector& like)
      : scheme_(scheme), difference_(like) {}
  /// After each step.
  void look(const MotionNorm& norm, const State& from, const State& to);
  /// 1 - exp(-d): part of its amplitude that vibration loses in `span` [s].
  double damped(const MotionNorm& norm, double span) const;
  /// Contact rests on walls too stiff for the steps in more than a tenth of them.
  bool hasUnresolvedContact() const;
  const NumericalDamping* scheme() const { return scheme_; }

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  long next() const;

  const NumericalDamping* scheme_;
  Vector difference_;
  // over all steps, from some of them
  double lost_ = 0, vibrated_ = 0;  ///< sum of e [J], integral of |v|^2
  double rested_ = 0;               ///< steps with unresolved contact
  long taken_ = 0;                  ///< steps, those of cut ones one by one
  long looks_ = 0;                  ///< at steps after the first ones
};

}  // namespace tooljoint::transient
