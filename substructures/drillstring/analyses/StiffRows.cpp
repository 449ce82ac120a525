// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/analyses/StiffRows.hpp"

#include <exception>
#include <fmt/format.h>
#include <string>

#include "cases/CaseLists.hpp"
#include "cases/ListText.hpp"
#include "cases/run/KeptRows.hpp"
#include "common/Error.hpp"
#include "common/Interrupt.hpp"
#include "common/Sha256.hpp"
#include "common/ranks/DealtRows.hpp"
#include "common/report/Log.hpp"
#include "common/report/Stopwatch.hpp"
#include "deck/PrintedUnits.hpp"

namespace tooljoint::drillstring {
namespace {

using Row = std::vector<StiffLoads>;

constexpr int storeFormat = 2;  ///< raised when the meaning of a kept depth changes

/// Without an equilibrium there is nothing to slide from: the first operation has that failure, the
/// others refer to it.
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
      row[k].failure = "Without friction there is no equilibrium at this depth.";
    return row;
  }
}

/// What decides a depth beside the depth: the deck but its other analyses, and the operations.
std::string identity(const cases::Case& owner,
                     const std::vector<softstring::Operation>& operations) {
  Teuchos::ParameterList list(owner.deck().list());
  for (const char* name : {"Output", "Torque and Drag", "Buckling", "Bottom-Hole Assembly"})
    list.remove(name, false);
  for (const auto& analysis : cases::AnalysisLists::instance().lists())
    list.remove(analysis.name, false);
  std::string text = "torque and drag " + std::to_string(storeFormat) + "\n" +
                     cases::programStamp() + "\n" + cases::canonicalText(list) + owner.files();
  for (const auto& one : operations)
    text += fmt::format("\n{} {} {} {} {}", one.name, one.axialSpeed, one.rotarySpeed,
                        one.weightOnBit, one.torqueOnBit);
  return text;
}

class StiffRows {
 public:
  StiffRows(const Scene& scene, const std::vector<double>& depths,
            const std::vector<softstring::Operation>& operations, const StiffStore& store)
      : scene_(scene),
        depths_(depths),
        operations_(operations),
        store_(store),
        rows_(depths.size()),
        whose_(identity(store.owner, operations)) {
    parallel::broadcast(whose_);  // the files are known to rank 0 alone
  }

  std::vector<Row> find() {
    parallel::agree([&] {
      const cases::KeptRows kept(store_.folder);
      if (store_.fresh) kept.clear();
    });
    restore();
    if (known_ > 0)
      log::info(fmt::format("{} of {} depths are known from before (--fresh forgets them)", known_,
                            depths_.size()));
    else if (others_ > 0)
      log::info(
          "The folder holds depths of another deck, other settings or another program. They are "
          "not used: all depths are computed.");
    std::vector<std::size_t> missing;
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (rows_[i].empty()) missing.push_back(i);
    try {
      parallel::dealRows<Row>(missing, rows_, [&](std::size_t i) { return compute(i); });
    } catch (const InterruptedError&) {
      restore();
      throw InterruptedError(fmt::format(
          "Interrupted with {} of {} depths done. They are kept in {}; the same command goes on "
          "from there.",
          known_, depths_.size(), store_.folder));
    }
    return rows_;
  }

 private:
  /// What is in the folder, on all ranks.
  void restore() {
    parallel::agree([&] {
      const cases::KeptRows kept(store_.folder);
      others_ = kept.count();
      for (std::size_t i = 0; i < depths_.size(); ++i) {
        rows_[i].clear();
        if (const auto text = kept.restoreText(key(i))) read(*text, rows_[i]);
      }
    });
    parallel::broadcast(rows_);
    known_ = 0;
    for (const auto& row : rows_) known_ += row.empty() ? 0 : 1;
  }
  std::string key(std::size_t i) const { return sha256(whose_ + fmt::format("\n{}", depths_[i])); }
  /// A file that was damaged counts as absent.
  static void read(const std::string& text, Row& row) {
    try {
      fromBytes(text, row);
    } catch (const std::exception&) {
      row.clear();
    }
  }

  /// On one rank, which is alone meanwhile.
  Row compute(std::size_t i) const {
    const Stopwatch watch;
    auto row = rowAt(scene_, depths_[i], operations_);
    cases::KeptRows(store_.folder).keepText(key(i), toBytes(row));
    const deck::PrintedUnit length("m");
    log::info(fmt::format("stiff string, bit at {:.0f} {} ({} of {} depths): {:.2g} s",
                          length(depths_[i]), length.name(), i + 1, depths_.size(), watch.wall()));
    return row;
  }

  const Scene& scene_;
  const std::vector<double>& depths_;
  const std::vector<softstring::Operation>& operations_;
  const StiffStore& store_;
  std::vector<Row> rows_;
  std::string whose_;
  int known_ = 0, others_ = 0;
};

}  // namespace

std::vector<Row> stiffRows(const Scene& scene, const std::vector<double>& depths,
                           const std::vector<softstring::Operation>& operations,
                           const StiffStore& store) {
  if (depths.empty()) return {};
  return StiffRows(scene, depths, operations, store).find();
}

}  // namespace tooljoint::drillstring
