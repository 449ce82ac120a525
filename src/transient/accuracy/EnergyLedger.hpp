// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Energy balance: kinetic + strain + contact energy at the end equals the energy at the start plus
/// the work of loads and drive, minus every dissipation. The residual is the numerical dissipation
/// of the integrator and the error of these sums: trapezoidal over the steps, Gauss' rule for point
/// laws (PointBatch::meanPower()).
#pragma once

#include <string>
#include <vector>

#include "transient/accuracy/FrictionWork.hpp"
#include "transient/compiled/CompiledModel.hpp"

namespace tooljoint::transient {

struct State;

/// Energies in J. Stored energies are those at the time reached; exchanged ones are sums from the
/// start.
struct EnergyAccount {
  double kinetic = 0;   ///< v'M v / 2
  double strain = 0;    ///< q'K q / 2
  double contact = 0;   ///< stored in point laws
  double initial = 0;   ///< kinetic + strain + contact at the start
  double loads = 0;     ///< work of F(t)
  double drive = 0;     ///< work of the prescribed motion (rotary drive acting through friction)
  double friction = 0;  ///< dissipated in friction
  double contactDamping = 0;  ///< dissipated in normal damping of point laws
  double circulatory = 0;  ///< work done on skew stiffness (torque) and on time-dependent stiffness
  std::vector<std::string>
      dampingNames;  ///< groups of damping terms with one law, without terms that do no work
  std::vector<double> damping;  ///< dissipated per group
  double exchanged = 0;         ///< sum of the absolute exchanges over all steps
  double supplied = 0;  ///< |initial| and the absolute work of loads, drive and skew stiffness

  /// initial + loads + drive - dissipations - stored: energy lost (> 0) or generated (< 0) by the
  /// integrator.
  double numerical() const;
  /// numerical() over the energy exchanged or stored, whichever is larger.
  double residual() const;
  /// The integrator has generated more energy than was supplied to the model.
  bool runaway() const { return -numerical() > supplied; }
};

class EnergyLedger {
 public:
  /// Books every `stride`-th step (explicit steps are far shorter than the sums need), and every
  /// step that is shorter than the others, because it resolves fast motion.
  void start(CompiledModel& model, const State& state, int stride);
  /// Call after every step. Allocates nothing.
  void book(CompiledModel& model, const State& to);
  /// The account at `state`, at or after the last booked step; the remaining steps are booked
  /// first.
  EnergyAccount account(CompiledModel& model, const State& state);
  /// Whether enough steps have been booked since the last look() for another one, which costs as
  /// much as a booking.
  bool isDue() const { return unwatched_ >= watchStride; }
  /// account() during a run; valid until the next call. Does not allocate.
  const EnergyAccount& look(CompiledModel& model, const State& state);

  void save(std::vector<double>& memory) const;
  void restore(CompiledModel& model, int stride, const double*& memory);

 private:
  struct Powers {
    double stored = 0, damping = 0, friction = 0, drive = 0;
  };
  void allocate(CompiledModel& model);
  double workOfLoads(CompiledModel& model, double begin, const State& to, bool jumps);
  void formWorks(const CompiledModel& model, const State& to, double loads);
  /// Sum of power(batch) over all batches, plus `sum` of this rank.
  template <class Power>
  static Powers sumPowers(CompiledModel& model, const Power& power, Powers sum);
  static double storedNow(CompiledModel& model, const State& state);
  void bindChord(CompiledModel& model, const State& to, double h);

  EnergyAccount account_;
  FrictionWork sliding_;
  std::vector<std::size_t> dissipative_;  ///< damping terms that can do work
  static constexpr std::size_t fewestSums = 3;
  std::vector<double> sums_;   ///< work of loads, q'K q / 2, work of stiffness, dq' C_i dq of each
                               ///< dissipative term
  bool conservative_ = false;  ///< stiffness is constant and symmetric
  void enter(CompiledModel& model, const State& to);

  int stride_ = 1;
  static constexpr int watchStride = 8;
  int unwatched_ = 0;                 ///< steps since the last look()
  int skipped_ = 0;                   ///< steps since the last one booked
  double time_ = 0;                   ///< end of the last booked step
  double reached_ = 0, longest_ = 0;  ///< end of the last step, and the longest step
  Vector q_, v_;
  Vector step_, change_;  ///< changes of q and v in a step
  Vector product_, internal_, load_;
  Vector x_, middle_, rate_;  ///< states of point laws: at the last booking, mid-chord, rates
  double stored_ = 0;         ///< in point laws at the last booking
  double strain_ = 0;
};

}  // namespace tooljoint::transient
