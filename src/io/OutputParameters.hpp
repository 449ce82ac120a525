// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The deck list `Output`: what a run leaves behind.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <string>
#include <vector>

#include "deck/ListSpec.hpp"

namespace tooljoint::io {

/// How reduced parts are written.
enum class ExportFormat { None, Hdf5, MatrixMarket, NastranDmig, ExtPtfm };

struct OutputSettings {
  std::string folder;  ///< "" when the deck names none; the command line goes first
  std::vector<std::string> fields{"displacement", "velocity", "normal_force"};
  bool csv = true;
  bool report = true;
  bool xdmf = true;
  double xdmfInterval = 0.05;  ///< [s]
  bool reducedBases = false;
  ExportFormat exportFormat = ExportFormat::None;
  int compression = 0;

  bool hasField(const std::string& name) const;
};

/// The deck list `Output`; a deck without it means all defaults.
deck::ListSpec parameters();

/// From the validated deck list `Output`. DeckError when a field stands twice.
OutputSettings readOutput(const Teuchos::ParameterList& list);

}  // namespace tooljoint::io
