// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "common/InputFile.hpp"
#include "common/Text.hpp"
#include "io/MatrixMarket.hpp"
#include "io/ResultsReader.hpp"
#include "parts/file/PartSource.hpp"

namespace tooljoint::parts {

namespace {

/// An HDF5 file whose matrices are dense datasets, or groups with row, column (0-based) and value.
class Hdf5Source : public PartSource {
 public:
  explicit Hdf5Source(const std::string& path) : file_(path) {
    const std::string reason = whyUnreadable(path);
    if (!reason.empty()) throw DeckError(path + " cannot be read: " + reason + ".");
    read([&] { reader_ = std::make_unique<io::ResultsReader>(path); });
    for (const auto& name : reader_->datasets()) datasets_.insert(name.substr(1));
  }

  std::string file() const override { return file_; }
  bool has(const std::string& path) const override {
    return datasets_.count(path) > 0 || isGroup(path) || isAttribute(path);
  }

  std::vector<std::string> names(const std::string& group) const override {
    if (!group.empty() && !isGroup(group)) fail(group, "must be a group");
    const std::string prefix = group.empty() ? "" : group + "/";
    std::vector<std::string> out;
    for (const auto& path : datasets_) {
      if (path.compare(0, prefix.size(), prefix) != 0) continue;
      const auto name = path.substr(prefix.size(), path.find('/', prefix.size()) - prefix.size());
      if (out.empty() || out.back() != name) out.push_back(name);
    }
    return out;
  }

  std::string text(const std::string& path) const override {
    std::string value;
    if (!isAttribute(path)) need(path);
    std::vector<std::string> values;
    read([&] {
      if (isAttribute(path))
        value = reader_->textAttribute("/", path);
      else
        values = reader_->texts("/" + path);
    });
    if (isAttribute(path)) return value;
    if (values.size() != 1) fail(path, "must be one text");
    return values.front();
  }

  std::vector<std::string> texts(const std::string& path) const override {
    need(path);
    std::vector<std::string> values;
    read([&] { values = reader_->texts("/" + path); });
    return values;
  }

  std::vector<DofName> dofs(const std::string& path) const override {
    need(path);
    const auto shape = shapeOf(path);
    const auto values = numbers(path);
    const std::size_t width = shape.size() == 2 ? shape[1] : 1;
    if (shape.empty() || shape.size() > 2 || width < 1 || width > 2)
      fail(path, "must be a list of nodes, or rows (node, component)");
    std::vector<DofName> out(values.size() / width);
    for (std::size_t i = 0; i < out.size(); ++i) {
      out[i].node = whole(path, values[i * width]);
      if (width == 2) out[i].number = static_cast<int>(whole(path, values[i * width + 1]));
      out[i].mode = width == 2 && out[i].node == 0;
    }
    return out;
  }

  Sparse matrix(const std::string& path) const override {
    if (isGroup(path)) return coordinates(path);
    need(path);
    const Matrix dense = table(path);
    return dense.sparseView(0.0, 0.0);
  }

  Matrix table(const std::string& path) const override {
    if (isGroup(path)) {
      const Sparse matrix = coordinates(path);
      io::requireDense(file_ + ": " + inQuotes(path), matrix, std::filesystem::file_size(file_));
      return Matrix(matrix);
    }
    need(path);
    const auto shape = shapeOf(path);
    if (shape.empty() || shape.size() > 2) fail(path, "must be a matrix or a vector");
    const auto values = numbers(path);
    const auto rows = static_cast<Eigen::Index>(shape[0]),
               columns = static_cast<Eigen::Index>(shape.size() == 2 ? shape[1] : 1);
    Matrix out(rows, columns);
    for (Eigen::Index i = 0; i < rows; ++i)
      for (Eigen::Index j = 0; j < columns; ++j) {
        out(i, j) = values[static_cast<std::size_t>(i * columns + j)];
        checkFinite(path, static_cast<int>(i), static_cast<int>(j), out(i, j));
      }
    return out;
  }

  std::vector<NamedTerm> terms(const std::string& path) const override {
    if (!isGroup(path) || isCoordinates(path)) return {term(path, path)};
    std::vector<NamedTerm> out;
    for (const auto& name : names(path)) out.push_back(term(path + "/" + name, name));
    return out;
  }

 private:
  [[noreturn]] void fail(const std::string& path, const std::string& what) const {
    throw DeckError(file_ + ": " + inQuotes(path) + " " + what + ".");
  }

  /// Converts messages on a results file to messages on a file of the deck.
  template <class Work>
  void read(const Work& work) const {
    try {
      work();
    } catch (const FileError& fault) {
      std::string reason = fault.what();
      const std::string opening = "The results file " + file_ + " ";
      if (reason.rfind(opening, 0) == 0) reason = reason.substr(opening.size());
      throw DeckError(file_ + " is not a part file: it " + reason);
    }
  }
  void need(const std::string& path) const {
    if (datasets_.count(path) == 0)
      fail(path, isGroup(path) ? "must be a dataset, but is a group" : "is missing");
  }
  std::int64_t whole(const std::string& path, double value) const {
    if (!(std::abs(value) < 2147483648.0) || value != std::floor(value))
      fail(path, "holds " + formatNumber(value) + ", expected whole numbers");
    return static_cast<std::int64_t>(value);
  }
  bool isGroup(const std::string& path) const {
    const auto next = datasets_.lower_bound(path + "/");
    return next != datasets_.end() && next->compare(0, path.size() + 1, path + "/") == 0;
  }
  bool isCoordinates(const std::string& path) const { return datasets_.count(path + "/value") > 0; }
  bool isAttribute(const std::string& path) const {
    return path.find('/') == std::string::npos && reader_->hasAttribute("/", path);
  }

  std::vector<std::size_t> shapeOf(const std::string& path) const {
    std::vector<std::size_t> shape;
    read([&] { shape = reader_->shape("/" + path); });
    return shape;
  }
  std::vector<double> numbers(const std::string& path) const {
    need(path);
    std::vector<double> values;
    read([&] { values = reader_->numbers("/" + path); });
    return values;
  }

  void checkFinite(const std::string& path, int row, int column, double value) const {
    if (std::isfinite(value)) return;
    throw io::MatrixFileError(file_ + ": the entry of " + inQuotes(path) + " in row " +
                                  std::to_string(row + 1) + ", column " +
                                  std::to_string(column + 1) + " is " + formatNumber(value) +
                                  ", which is not a finite number.",
                              row, column);
  }

  Sparse coordinates(const std::string& path) const {
    if (!isCoordinates(path))
      fail(path, "must be a dataset, or a group with row, column and value");
    const auto values = numbers(path + "/value"), rows = numbers(path + "/row"),
               columns = numbers(path + "/column");
    if (rows.size() != values.size() || columns.size() != values.size())
      fail(path, "has " + std::to_string(values.size()) + " values, " +
                     std::to_string(rows.size()) + " rows and " + std::to_string(columns.size()) +
                     " columns");
    double height = 0, width = 0;
    if (datasets_.count(path + "/shape") > 0) {
      const auto shape = numbers(path + "/shape");
      if (shape.size() != 2) fail(path + "/shape", "must be two numbers");
      for (double extent : shape)
        if (!(extent >= 1 && extent <= static_cast<double>(io::largestDimension)) ||
            extent != std::floor(extent))
          fail(path + "/shape", "holds " + formatNumber(extent) +
                                    ", expected rows and columns from 1 to " +
                                    std::to_string(io::largestDimension));
      height = shape[0];
      width = shape[1];
    } else if (datasets_.count("dofs") > 0) {
      height = width = static_cast<double>(shapeOf("dofs").at(0));
    }
    Triplets entries;
    for (std::size_t i = 0; i < values.size(); ++i) {
      whole(path + "/row", rows[i]);
      whole(path + "/column", columns[i]);
      if (!(rows[i] >= 0 && rows[i] < height && columns[i] >= 0 && columns[i] < width))
        fail(path, "has an entry in row " + formatNumber(rows[i]) + ", column " +
                       formatNumber(columns[i]) + " (numbered from 0), outside the " +
                       formatNumber(height) + " x " + formatNumber(width) + " matrix");
      checkFinite(path, static_cast<int>(rows[i]), static_cast<int>(columns[i]), values[i]);
      entries.emplace_back(static_cast<int>(rows[i]), static_cast<int>(columns[i]), values[i]);
    }
    Sparse out(static_cast<Eigen::Index>(height), static_cast<Eigen::Index>(width));
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
  }

  NamedTerm term(const std::string& path, const std::string& name) const {
    NamedTerm out{name, "1", path, matrix(path)};
    read([&] {
      if (reader_->hasAttribute("/" + path, "law"))
        out.law = reader_->textAttribute("/" + path, "law");
      if (reader_->hasAttribute("/" + path, "name"))
        out.name = reader_->textAttribute("/" + path, "name");
    });
    return out;
  }

  std::string file_;
  std::unique_ptr<io::ResultsReader> reader_;
  std::set<std::string> datasets_;
};

}  // namespace

std::unique_ptr<PartSource> openHdf5Part(const std::string& path) {
  return std::make_unique<Hdf5Source>(path);
}

}  // namespace tooljoint::parts
