// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The deck list `Transient`.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <string>

#include "deck/ListSpec.hpp"

namespace tooljoint::transient {

/// Description of the list `Transient`, with one sublist per registered integrator.
deck::ListSpec parameters();

/// How several ranks compute one motion.
enum class RankUse { Automatic, Divide, Alike };

/// The list as values.
struct TransientOptions {
  std::string integrator = "Generalized-alpha";
  double start = 0;         ///< [s]
  double end = 0;           ///< [s]
  double step = 0;          ///< [s]; 0: the integrator's default
  double sampling = 0.005;  ///< [s]
  bool progress = true;
  bool ledger = true;
  double checkpointInterval =
      0;  ///< simulated time between checkpoints [s]; 0: only at an interrupt
  /// A run warns above the first value and is refused above the second.
  double stepErrorWarning = 0.05, stepErrorLimit = 0.2;
  double energyResidualWarning = 0.05, energyResidualLimit = 0.2;
  RankUse ranks = RankUse::Automatic;
  Teuchos::ParameterList own;  ///< the integrator's sublist
};

/// Read a validated list. Throws DeckError for errors that the registry cannot detect (End Time not
/// after Start Time).
TransientOptions readOptions(const Teuchos::ParameterList& transient);

/// Whether the integrator of the list has a step bounded by the largest frequency of the model.
bool isExplicit(const Teuchos::ParameterList& transient);

}  // namespace tooljoint::transient
