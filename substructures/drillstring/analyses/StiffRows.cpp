// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/analyses/StiffRows.hpp"

#include <fmt/format.h>
#include <string>

#include "common/Error.hpp"
#include "common/Interrupt.hpp"
#include "common/report/Log.hpp"
#include "common/report/Stopwatch.hpp"
#include "deck/PrintedUnits.hpp"

namespace tooljoint::drillstring {
namespace {

using Row = std::vector<StiffLoads>;

constexpr int storeFormat = 4;  ///< raised when the meaning of a stored depth changes

/// Without an equilibrium there is no start for sliding: the first operation reports that failure,
/// the others refer to it.
Row rowAt(const Scene& scene, double bit, const std::vector<softstring::Operation>& operations) {
  try {
    const StiffString string(scene, bit);
    Row row;
    for (const auto& operation : operations) {
      if (interruptRequested()) throw InterruptedError("Interrupted.");
      row.push_back(string.under(operation));
    }
    return row;
  } catch (const ConvergenceError& error) {
    StiffLoads none;
    none.failure = error.what();
    Row row(operations.size(), none);
    for (std::size_t k = 1; k < row.size(); ++k)
      row[k].failure =
          "No equilibrium without friction was found at this depth; more, shorter elements may "
          "find "
          "one.";
    return row;
  }
}

/// Data that determine the result at a depth: the deck without its analyses, and the operations.
std::string whoseDepths(const cases::Case& owner,
                        const std::vector<softstring::Operation>& operations) {
  std::string text =
      "torque and drag " + std::to_string(storeFormat) + "\n" + cases::identity(owner);
  for (const auto& one : operations)
    text += fmt::format("\n{} {} {} {} {}", one.name, one.axialSpeed, one.rotarySpeed,
                        one.weightOnBit, one.torqueOnBit);
  return text;
}

}  // namespace

std::vector<Row> stiffRows(const Scene& scene, const std::vector<double>& depths,
                           const std::vector<softstring::Operation>& operations,
                           const cases::RowFolder& store) {
  if (depths.empty()) return {};
  cases::RowKeys keys{"depths", whoseDepths(store.owner, operations), {}};
  for (const double depth : depths) keys.rows.push_back(fmt::format("{}", depth));
  // on one rank at a time, without communication
  return cases::resumedRows<Row>(store, keys, [&](std::size_t i) {
    const Stopwatch watch;
    auto row = rowAt(scene, depths[i], operations);
    const deck::PrintedUnit length("m");
    int iterations = 0;
    for (const auto& one : row) iterations += one.iterations;
    log::info(fmt::format(
        "stiff string, bit at {:.0f} {} ({} of {} depths): {:.2g} s, {} iterations",
        length(depths[i]), length.name(), i + 1, depths.size(), watch.wall(), iterations));
    return row;
  });
}

}  // namespace tooljoint::drillstring
