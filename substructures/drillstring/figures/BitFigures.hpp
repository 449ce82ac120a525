// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Results for the bit: stick-slip, weight and torque, mechanical specific energy.
#pragma once

#include <optional>
#include <vector>

#include "cases/figures/SignalFigures.hpp"
#include "io/summary/Summary.hpp"

namespace tooljoint::drillstring {

/// The bit at one instant; null for quantities that the deck does not model.
struct BitSample {
  double imposed = 0.0;           ///< Omega, of the rotary speed [rad/s]
  double speed = 0.0;             ///< omega_b = Omega + dtheta_z/dt [rad/s]
  std::optional<double> weight;   ///< on bit, positive in compression [N]
  std::optional<double> torque;   ///< on bit, positive against rotation [N m]
  std::optional<double> advance;  ///< v_b into the rock, if a law of the bit gives it [m/s]
};

class BitFigures {
 public:
  /// \param stuckSpeed  the bit sticks below this speed [rad/s]
  /// \param area        of the hole at the bit [m2]
  BitFigures(double stuckSpeed, double area) : stuckSpeed_(stuckSpeed), area_(area) {}

  /// \param late  true in the second half of the window
  void add(const BitSample& sample, bool late);

  const cases::SignalFigures& speed() const { return speed_; }
  const cases::SignalFigures& weight() const { return weight_; }
  const cases::SignalFigures& torque() const { return torque_; }
  /// (max - min)/(2 |mean|) of the bit speed; null without rotation.
  std::optional<double> stickSlipIndex() const;
  /// Fraction of the samples with |omega_b| below the threshold; null without rotation.
  std::optional<double> stuckShare() const;
  /// Range of omega_b - Omega in the second half of the window over that in the first: far above 1
  /// for a growing vibration. Null without rotation, and if the later range is rounding.
  std::optional<double> growth() const;
  /// Mean v_b [m/s]; null if no law gives it.
  std::optional<double> rateOfPenetration() const;
  /// Fraction of the advance made while the bit turned backward; null if no law gives the advance.
  std::optional<double> backwardAdvance() const;
  /// sum(W v_b + T omega_b)/(A sum v_b) [Pa]: work at the bit per volume of rock (R. Teale, Int. J.
  /// Rock Mech. Mining Sci. 2 (1965) 57-73). Null if the bit does not advance.
  std::optional<double> specificEnergy() const;

  /// Keys below transient.figures.
  void summarise(io::Summary& summary) const;
  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  double stuckSpeed_, area_;
  cases::SignalFigures speed_, weight_, torque_, advance_;
  cases::SignalFigures early_, late_;  ///< omega_b - Omega in either half of the window
  double stuck_ = 0.0;                 ///< samples
  double backward_ = 0.0;              ///< sum of v_b at omega_b < 0 [m/s]
  double turned_ = 0.0;                ///< samples with nonzero Omega
  double power_ = 0.0;                 ///< sum of W v_b + T omega_b [W]
};

}  // namespace tooljoint::drillstring
