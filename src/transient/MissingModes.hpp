// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Whether a reduced motion excites modes of its parts that the basis lacks. A part without modes
/// follows its boundary like a spring; its own motion does not show what is missing. A mode phi of
/// its interior with its boundary held, phi' M phi = 1, would obey
///
///     eta'' + c eta' + w^2 eta = -l q'',   l = phi' M Phi,   c = phi' C phi,
///
/// with q the coordinates of the coupled model. The sum of eta'^2 over that of v'M v, both averaged
/// over the samples, is the fraction of the kinetic energy that such modes would have. Their
/// reaction on the boundary is neglected.
#pragma once

#include <vector>

#include "transient/Integrator.hpp"

namespace tooljoint::transient {

/// A mode of a part that the basis does not contain.
struct MissingMode {
  double omega = 0;    ///< w [rad/s]
  double damping = 0;  ///< c [1/s]
  Vector row;          ///< l, one entry for each dof of the model
};

class MissingModes {
 public:
  MissingModes(const CompiledModel& model, const std::vector<MissingMode>& modes,
               const State& start);
  /// After an accepted step.
  void step(const State& from, const State& to);
  /// At a sample.
  void look(const State& state);
  /// 0 to 1. Collective.
  double share() const;

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  struct Entry {
    int position;
    double value;
  };
  struct Mode {
    double omega, damping;
    std::vector<Entry> row;  ///< empty on ranks that hold only a part of it
    double drive = 0;        ///< l q'
    double eta = 0, velocity = 0;
    double energy = 0;  ///< sum of eta'^2
  };
  static double driveOf(const Mode& mode, const State& state);

  const CompiledModel* model_;
  std::vector<Mode> modes_;
  double whole_ = 0;  ///< sum of v'M v on this rank
};

}  // namespace tooljoint::transient
