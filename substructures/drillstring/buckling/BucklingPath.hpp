// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// `tooljoint buckling`: static states of a string in its hole under a growing weight on bit,
/// beyond buckling, by continuation. Sides of the hole are its high side h and its right side t x h
/// (t down the hole).
#pragma once

#include <cereal/types/optional.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cases/run/ResumedRows.hpp"
#include "statics/PathContinuation.hpp"
#include "substructures/drillstring/case/DrillstringCase.hpp"
#include "substructures/drillstring/scene/BucklingParameters.hpp"
#include "substructures/drillstring/scene/Scene.hpp"

namespace tooljoint::drillstring {

/// Loads at which some part of the string begins to buckle, as weight on bit [N]; infinite if the
/// formula gives none.
struct BucklingTheory {
  double sinusoidal = 0.0;  ///< softstring::bucklingLimits() at every element
  double helical = 0.0;
  /// 2.8 times the sinusoidal compression: sinusoidal states are stable under a growing load up to
  /// here (R. F. Mitchell, SPE Drilling & Completion 12, 1997). An existing helix remains stable
  /// down to the helical limit.
  double spontaneous = 0.0;
  /// Hinged pipe of this length in a straight hole, min over n of E I (n pi/L)^2 + (w sin/r) (L/(n
  /// pi))^2 (Dawson and Paslay 1984; Euler without weight). 0 for a string of several sections, in
  /// a hole that bends, or if the weight along the hole exceeds a tenth of it.
  double finiteLength = 0.0;
  int finiteHalfWaves = 0;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(sinusoidal, helical, spontaneous, finiteLength, finiteHalfWaves);
  }
};

/// Contact and shape of the middle half of the compressed part above the bit (of the whole string
/// if there is none), away from its ends, and the helix of Lubinski, Althouse and Logan (1962) with
/// the same compression F: N = r F^2/(4 E I), pitch sqrt(8 pi^2 E I/F), shortening r^2 F/(4 E I).
struct BucklingMiddle {
  double compression = 0.0;                              ///< mean [N]
  double contactForce = 0.0, helicalContactForce = 0.0;  ///< per length [N/m]
  double shortening = 0.0, helicalShortening = 0.0;      ///< by bending, per length
  std::optional<double> pitch;                           ///< if the string winds one way [m]
  double helicalPitch = 0.0;                             ///< [m]

  template <class Archive>
  void serialize(Archive& archive) {
    archive(compression, contactForce, helicalContactForce, shortening, helicalShortening, pitch,
            helicalPitch);
  }
};

/// A static state of the path.
struct BucklingState {
  double weight = 0.0;      ///< on bit [N]
  int branch = 0;           ///< number of previous jumps
  double bitAdvance = 0.0;  ///< of the bit down the hole, from the unloaded string [m]
  double shortening = 0.0;  ///< of the string by bending, 1/2 int u'^2 + v'^2 ds [m]
  double lateral = 0.0;     ///< largest displacement from the axis of the hole [m]
  int contacts = 0;         ///< nodes at the wall
  double largestContact = 0.0, totalContact = 0.0;  ///< [N]
  int negativePivots = 0;                           ///< of the tangent; 0: stable
  int halfWaves = 0;  ///< of the deflection to the right side, in a vertical hole to the side of
                      ///< largest deflection
  std::optional<double> halfWaveLength;  ///< median distance of its zeros [m]
  double turns = 0.0;                    ///< of the string about the axis of the hole, net
  BucklingMiddle middle;
  Matrix displacement;  ///< to the high and to the right side, 2 x nodes [m]
  Vector contactForce;  ///< per node [N]
  Vector compression;   ///< per element [N]

  template <class Archive>
  void serialize(Archive& archive) {
    archive(weight, branch, bitAdvance, shortening, lateral, contacts, largestContact, totalContact,
            negativePivots, halfWaves, halfWaveLength, turns, middle, displacement, contactForce,
            compression);
  }
};

struct BucklingPath {
  BucklingTheory theory;
  /// Weight on bit at which the straight string has the first negative pivot, or deflects in half
  /// waves; none: not up to the last weight.
  std::optional<double> limit;
  bool limitIsSmooth = false;             ///< half waves without a negative pivot
  double crookedness = 0.0, pitch = 0.0;  ///< amplitude and length of a turn [m]
  std::vector<double> depth;              ///< of the nodes [m]
  std::vector<BucklingState> states;
  statics::PathReport report;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(theory, limit, limitIsSmooth, crookedness, pitch, depth, states, report);
  }
};

/// The deck's list `Buckling`, or its defaults if the deck has none. DeckError: there is no last
/// weight.
BucklingSettings bucklingSettings(const Scene& scene);

/// Static states from zero to the last weight on bit, without friction and laws of bit and drive,
/// with walls that only push. DeckError: the string has no wall, the bit is held along the hole, or
/// the geometric stiffness is switched off; ConvergenceError: the first state is not found. The
/// report of a path that ends early says so. The path up to its last jump is stored in the folder
/// and continued from there for the same deck and program. InterruptedError after a signal. The
/// same on every rank. Collective.
BucklingPath bucklingPath(const Scene& scene, const BucklingSettings& settings,
                          const cases::RowFolder& store);

/// Prints the path and writes buckling.csv, buckling.h5 and summary.json. Then throws
/// ConvergenceError if the path did not reach the last weight. Collective.
void reportBuckling(const DrillstringCase& one, const std::string& folder, bool fresh);

}  // namespace tooljoint::drillstring
