// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The deck list `Measured Log`: a file of measured signals and the quantities they are compared
/// with.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cases/Case.hpp"
#include "cases/figures/SignalComparison.hpp"
#include "cases/nodes/NodeDofs.hpp"
#include "deck/ListSpec.hpp"

namespace tooljoint::cases {

/// Name of the list.
inline constexpr const char* measuredLogName = "Measured Log";

/// A quantity that a measured signal can be compared with.
struct MeasuredQuantity {
  std::string name;    ///< in the deck
  std::string si;      ///< unit; "" for a component of a node
  std::string usual;   ///< unit it is printed in
  std::string source;  ///< name of its channel or of its column of motion.csv
  int rates = 0;       ///< of a component of a node: 0 displacement, 1 velocity, 2 acceleration
  bool ofNode() const { return source.empty(); }
};
const std::vector<MeasuredQuantity>& measuredQuantities();

/// A column of the log and its quantity.
struct MeasuredColumn {
  std::string name;    ///< of its list
  std::string column;  ///< in the header of the file
  std::string unit;    ///< given in the deck; "": unit of the file
  MeasuredQuantity quantity;
  NodeDof dof;  ///< for a quantity of a node
};

struct MeasuredLogSettings {
  std::string file;        ///< path
  std::string timeColumn;  ///< "": recognised by its name
  std::string timeUnit;
  double offset = 0.0;               ///< time of the motion at log time 0 [s]
  std::optional<double> begin, end;  ///< of the window, in the time of the motion [s]
  double blockWeight = 0.0;          ///< subtracted from measured hook loads [N]
  SpectrumSettings spectra;
  std::vector<MeasuredColumn> columns;
};
deck::ListSpec measuredLogParameters();
/// From the validated list. DeckError: no column, a node missing or given needlessly, a window that
/// ends before it begins.
MeasuredLogSettings readMeasuredLog(const Teuchos::ParameterList& list);

/// The signals of the file at times of the motion, in the order of the columns.
struct MeasuredLog {
  MeasuredLogSettings settings;
  double begin = 0.0, end = 0.0;  ///< window in the motion [s]
  std::vector<SampledSignal> signals;

  bool isCompared() const { return !settings.columns.empty(); }
};
/// Empty if the deck has no such list. DeckError: a scene without motion, a quantity that the scene
/// does not compute, a file that cannot be read as a log, a column with fewer than two samples in
/// the window of the motion.
MeasuredLog loadMeasuredLog(const Case& one);

/// "0.5 to 10 s of log.csv: bit (RPM) with bit speed, ...".
std::string describe(const MeasuredLog& log);

}  // namespace tooljoint::cases
