// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/analyses/StiffRows.hpp"

#include <fmt/format.h>
#include <string>

#include "common/Error.hpp"
#include "common/Interrupt.hpp"
#include "common/Message.hpp"
#include "common/Parallel.hpp"
#include "common/RankGroups.hpp"
#include "common/report/Log.hpp"
#include "common/report/Stopwatch.hpp"
#include "deck/PrintedUnits.hpp"

namespace tooljoint::drillstring {
namespace {

using Row = std::vector<StiffLoads>;

/// Without an equilibrium there is nothing to slide from: the first operation has that failure, the
/// others refer to it.
Row rowAt(const Scene& scene, double bit, const std::vector<softstring::Operation>& operations) {
  try {
    const StiffString string(scene, bit);
    Row row;
    for (const auto& operation : operations) {
      if (interruptRequested()) throw InterruptedError("Interrupted. No table was written.");
      row.push_back(string.under(operation));
    }
    return row;
  } catch (const ConvergenceError& error) {
    StiffLoads none;
    none.failure = error.what();
    Row row(operations.size(), none);
    for (std::size_t k = 1; k < row.size(); ++k)
      row[k].failure = "Without friction there is no equilibrium at this depth.";
    return row;
  }
}

}  // namespace

std::vector<Row> stiffRows(const Scene& scene, const std::vector<double>& depths,
                           const std::vector<softstring::Operation>& operations) {
  std::vector<Row> rows(depths.size());
  parallel::RankGroups groups(1);
  groups.apart([&] {
    for (int i = groups.next(); i >= 0 && i < static_cast<int>(depths.size()); i = groups.next()) {
      const Stopwatch watch;
      const auto k = static_cast<std::size_t>(i);
      rows[k] = rowAt(scene, depths[k], operations);
      const deck::PrintedUnit length("m");
      log::info(fmt::format("stiff string, bit at {:.0f} {} ({} of {} depths): {:.2g} s",
                            length(depths[k]), length.name(), i + 1, depths.size(), watch.wall()));
    }
  });
  for (auto& row : rows) {
    const int owner = row.empty() ? -1 : parallel::rank();
    parallel::broadcast(row, static_cast<int>(parallel::maximum(owner)));
  }
  return rows;
}

}  // namespace tooljoint::drillstring
