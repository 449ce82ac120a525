// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Common interface of the two kinds of part files: named values in groups.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/Error.hpp"
#include "common/Types.hpp"

namespace tooljoint::parts {

/// A dof or a node as named in a file.
struct DofName {
  std::int64_t node = 0;
  int number = 0;         ///< component, 1-based; 0: by name, or the whole node
  std::string component;  ///< empty: by number, or the whole node
  bool mode = false;      ///< a coordinate without a node; `number` is its number
  bool whole() const { return !mode && number == 0 && component.empty(); }
};

/// A matrix or vector (one column) times a law of time.
struct NamedTerm {
  std::string name;
  std::string law = "1";
  std::string where;  ///< for messages: "stiffness (K.mtx)"
  Sparse matrix;
};

/// Paths are names joined by "/". Every getter throws DeckError, or io::MatrixFileError for an
/// entry, if the value does not exist or has another type.
class PartSource {
 public:
  virtual ~PartSource() = default;
  virtual std::string file() const = 0;
  virtual bool has(const std::string& path) const = 0;
  /// Names in a group, "" is the file itself.
  virtual std::vector<std::string> names(const std::string& group) const = 0;
  virtual std::string text(const std::string& path) const = 0;
  virtual std::vector<std::string> texts(const std::string& path) const = 0;
  virtual std::vector<DofName> dofs(const std::string& path) const = 0;
  virtual Sparse matrix(const std::string& path) const = 0;
  /// Rows of numbers; a list of numbers is one column.
  virtual Matrix table(const std::string& path) const = 0;
  /// One value or a collection of them.
  virtual std::vector<NamedTerm> terms(const std::string& path) const = 0;
};

/// Selects the kind of file: a folder or *.json, a format of parts/foreign/, otherwise HDF5.
std::unique_ptr<PartSource> openPart(const std::string& path);
std::unique_ptr<PartSource> openJsonPart(const std::string& path);
std::unique_ptr<PartSource> openHdf5Part(const std::string& path);

}  // namespace tooljoint::parts
