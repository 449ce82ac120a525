// SPDX-License-Identifier: BSD-3-Clause
#include "app/commands/Commands.hpp"
#include "cases/CaseKinds.hpp"
#include "cases/PartsExport.hpp"

namespace tooljoint::app {

void exportReduced(const RunOptions& options) {
  const auto one = cases::readCase(options.deck, options.overrides);
  cases::exportCase(
      *one, options.format == "mtx" ? io::ExportFormat::MatrixMarket : io::ExportFormat::Hdf5,
      options.output);
}

}  // namespace tooljoint::app
