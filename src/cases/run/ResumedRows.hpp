// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Stored rows of an analysis, so that the same command continues after an interruption:
/// independent rows, distributed to the ranks, or rows that each need the previous one.
#pragma once

#include <exception>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "cases/Case.hpp"
#include "cases/run/KeptRows.hpp"
#include "common/Error.hpp"
#include "common/ranks/DealtRows.hpp"

namespace tooljoint::cases {

/// Folder of stored rows, and the analysis they belong to.
struct RowFolder {
  const Case& owner;
  std::string folder;
  bool fresh = false;  ///< remove stored rows
};

/// Data that determine the rows of an analysis, except its own list: the program, the deck without
/// Output and without the lists of analyses, and the files it names. Collective.
std::string identity(const Case& owner);

/// Keys of rows.
struct RowKeys {
  std::string plural;  ///< in messages and names of files: "depths"
  std::string whose;   ///< data that determine all rows
  /// Data that determine a single row in addition: empty texts if each row needs the previous one,
  /// no texts if the number of rows is unknown.
  std::vector<std::string> rows;
};

/// Key of the file of a row.
std::string fileKey(const RowKeys& keys, const std::string& row);
/// Logs the number of known rows, or that the `files` of the folder have other keys.
void announceKnown(const RowKeys& keys, int known, int files);
/// The sentence of an InterruptedError.
std::string interruptedSentence(const RowKeys& keys, int known, const std::string& folder);

/// Reads the row of a file; false for a damaged file.
template <class Row>
bool readRow(const std::string& bytes, Row& row) {
  try {
    fromBytes(bytes, row);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

/// Computes compute(i) for all rows (parallel::dealRows) except those stored in the folder with the
/// same keys. Collective. Errors of compute(); FileError; InterruptedError with the number of
/// stored rows.
template <class Row>
std::vector<Row> resumedRows(const RowFolder& where, const RowKeys& keys,
                             const std::function<Row(std::size_t)>& compute) {
  std::vector<std::string> names;
  for (const auto& row : keys.rows) names.push_back(fileKey(keys, row));
  std::vector<Row> rows(names.size());
  std::vector<char> known(names.size(), 0);
  int files = 0;
  const auto restore = [&] {
    parallel::agree([&] {
      const KeptRows kept(where.folder, keys.plural);
      files = kept.count();
      for (std::size_t i = 0; i < names.size(); ++i) {
        const auto text = kept.restoreText(names[i]);
        known[i] = text && readRow(*text, rows[i]) ? 1 : 0;
      }
    });
    parallel::broadcast(known);
    parallel::broadcast(rows);
    int count = 0;
    for (const char each : known) count += each;
    return count;
  };
  if (where.fresh) parallel::agree([&] { KeptRows(where.folder, keys.plural).clear(); });
  const int before = restore();
  announceKnown(keys, before, files);
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (known[i] == 0) missing.push_back(i);
  try {
    parallel::dealRows<Row>(missing, rows, [&](std::size_t i) {
      auto row = compute(i);
      KeptRows(where.folder, keys.plural).keepText(names[i], toBytes(row));
      return row;
    });
  } catch (const InterruptedError&) {
    throw InterruptedError(interruptedSentence(keys, restore(), where.folder));
  }
  return rows;
}

/// Restores the progress of an analysis whose rows need each other, from one file. Its member
/// `done` counts the rows, 0 if none is stored. Collective.
template <class Reached>
Reached restoreReached(const RowFolder& where, const RowKeys& keys) {
  Reached reached;
  int files = 0;
  parallel::agree([&] {
    const KeptRows kept(where.folder, keys.plural);
    if (where.fresh) kept.clear();
    files = kept.count();
    Reached found;
    const auto text = kept.restoreText(fileKey(keys, ""));
    if (text && readRow(*text, found)) reached = std::move(found);
  });
  parallel::broadcast(reached);
  announceKnown(keys, static_cast<int>(reached.done), files);
  return reached;
}

/// Stores the progress; rank 0 writes. Collective.
template <class Reached>
void keepReached(const RowFolder& where, const RowKeys& keys, const Reached& reached) {
  parallel::agree(
      [&] { KeptRows(where.folder, keys.plural).keepText(fileKey(keys, ""), toBytes(reached)); });
}

}  // namespace tooljoint::cases
