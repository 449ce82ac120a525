// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The deck list `Output`: files of a run.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <optional>
#include <string>
#include <vector>

#include "deck/ListSpec.hpp"

namespace tooljoint::io {

/// Format of exported reduced parts.
enum class ExportFormat { None, Hdf5, MatrixMarket, NastranDmig, ExtPtfm };

/// Life of a section under cycles of one stress range S: N = cycles (stressRange/S)^slope.
struct SnLine {
  double slope = 0.0;        ///< m
  double stressRange = 0.0;  ///< [Pa]
  double cycles = 0.0;
};

/// Window and parameters for the results of a motion.
struct FigureSettings {
  std::optional<double> begin, end;  ///< [s]; the second half of the motion unless given
  double stuckSpeed = 0.5;           ///< the bit sticks below it [rad/s]
  std::optional<SnLine> snLine;
};

struct OutputSettings {
  std::string folder;  ///< "" if the deck names none; the command line takes precedence
  std::vector<std::string> fields{"displacement", "velocity", "normal_force"};
  bool csv = true;
  bool report = true;
  bool xdmf = true;
  double xdmfInterval = 0.05;  ///< [s]
  bool reducedBases = false;
  ExportFormat exportFormat = ExportFormat::None;
  int compression = 1;
  FigureSettings figures;

  bool hasField(const std::string& name) const;
};

/// The deck list `Output`; a deck without it uses all defaults.
deck::ListSpec parameters();

/// From the validated deck list `Output`. DeckError for a repeated field.
OutputSettings readOutput(const Teuchos::ParameterList& list);

}  // namespace tooljoint::io
