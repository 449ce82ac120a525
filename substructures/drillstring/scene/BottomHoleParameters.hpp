// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Deck list `Bottom-Hole Assembly`: hole, loads and tool faces for the computation of the lower
/// part of the string.
#pragma once

#include <optional>
#include <vector>

#include "deck/ListSpec.hpp"

namespace Teuchos {
class ParameterList;
}

namespace tooljoint::drillstring {

struct BottomHoleSettings {
  std::vector<double> weights;       ///< on bit [N]; empty: that of the list Loads
  std::vector<double> inclinations;  ///< of the hole at the bit [rad]; empty: the deck's hole
  double buildRate = 0.0;            ///< of these holes [rad/m]
  double turnRate = 0.0;             ///< change of azimuth of these holes [rad/m]
  std::vector<double> toolFaces;     ///< [rad]; empty: that of the list Drillstring
  std::optional<double> surveyTool;  ///< distance from the bit [m]
  std::optional<double> length;      ///< modelled above the bit [m]; none: found
  double elementLength = 0.0;        ///< longest element [m]
  int rotatingToolFaces = 0;         ///< number of tool faces in the average of a turning string
};

/// Description of the list.
deck::ListSpec bottomHoleParameters();

/// From the validated list.
BottomHoleSettings readBottomHole(const Teuchos::ParameterList& list);

}  // namespace tooljoint::drillstring
