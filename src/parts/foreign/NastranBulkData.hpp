// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Entries of a Nastran bulk data section in small-field (8 columns), large-field (16 columns) and
/// free (comma) format, according to the MSC and NX Nastran Quick Reference Guides, "Bulk Data
/// Entries".
#pragma once

#include <string>
#include <vector>

#include "common/InputFile.hpp"

namespace tooljoint::parts {

/// One field of an entry, without blanks.
struct BulkField {
  std::string text;
  long line = 0;
  int number = 0;  ///< on its line; the name of the entry is field 1
};

/// An entry with its continuations: fields from the second one on, in groups of eight (small
/// field) or four (large field) per line.
struct BulkEntry {
  std::string name;  ///< upper case, without "*"
  long line = 0;
  std::vector<BulkField> fields;
};

/// Reads entry by entry. Lines before BEGIN BULK, from ENDDATA on, and comments ($) are skipped.
class NastranBulkData {
 public:
  /// FileError when the file cannot be read.
  explicit NastranBulkData(const std::string& path);

  /// The next entry; false at the end. DeckError with file and line for a continuation without an
  /// entry, and for text outside the fields.
  bool next(BulkEntry& entry);

 private:
  struct Line {
    std::string name;
    bool continues = false;
    std::vector<BulkField> fields;
  };
  bool nextLine();
  void split(const std::string& text);
  [[noreturn]] void fail(const std::string& what) const;

  std::string path_;
  InputFile in_;
  long line_ = 0, begin_ = 0;
  Line current_;
  bool waiting_ = false, ended_ = false;  ///< a line is read ahead; the end is reached
};

}  // namespace tooljoint::parts
