// SPDX-License-Identifier: BSD-3-Clause
#include "app/commands/Commands.hpp"
#include "cases/CaseKinds.hpp"
#include "cases/PartsExport.hpp"

namespace tooljoint::app {

const std::map<std::string, io::ExportFormat>& exportFormats() {
  static const std::map<std::string, io::ExportFormat> formats{
      {"hdf5", io::ExportFormat::Hdf5},
      {"mtx", io::ExportFormat::MatrixMarket},
      {"dmig", io::ExportFormat::NastranDmig},
      {"extptfm", io::ExportFormat::ExtPtfm}};
  return formats;
}

void exportReduced(const RunOptions& options) {
  const auto one = cases::readCase(options.deck, options.overrides);
  cases::exportCase(*one, exportFormats().at(options.format), options.output);
}

}  // namespace tooljoint::app
