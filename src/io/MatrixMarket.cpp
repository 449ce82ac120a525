// SPDX-License-Identifier: BSD-3-Clause
#include "io/MatrixMarket.hpp"

#include <Teuchos_MatrixMarket_Banner.hpp>
#include <Teuchos_MatrixMarket_CoordDataReader.hpp>
#include <Teuchos_MatrixMarket_SymmetrizingAdder.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <sstream>
#include <vector>

#include "common/InputFile.hpp"
#include "common/Text.hpp"

namespace tooljoint::io {

namespace {

namespace market = Teuchos::MatrixMarket;

constexpr std::size_t longestLine = 1024;  // NISTIR 5935
constexpr long shortestEntry = 6;          // "1 1 1\n"
constexpr long shortestNumber = 2;         // "1\n"

/// Receives the entries from Teuchos and checks them against the sizes.
struct Entries {
  using index_type = int;
  using value_type = double;

  void operator()(int i, int j, double value, bool given = true) {
    if (i < 1 || i > rows || j < 1 || j > columns)
      throw std::out_of_range("stands outside of the " + std::to_string(rows) + " x " +
                              std::to_string(columns) + " matrix");
    if (given && i != j) (i > j ? below : above) = true;
    triplets.emplace_back(i - 1, j - 1, value);
  }

  int rows = 0, columns = 0;
  bool below = false, above = false;
  Triplets triplets;
};

using Adder = market::SymmetrizingAdder<Entries>;

/// Teuchos' reader of coordinate lines, one line at a time.
struct Lines : market::CoordDataReader<Adder, int, double> {
  using market::CoordDataReader<Adder, int, double>::CoordDataReader;
  using market::CoordDataReader<Adder, int, double>::readLine;
};

/// True if the whole text is one finite number.
bool isNumber(const std::string& text) {
  double value = 0;
  const char* begin = text.data() + (!text.empty() && text[0] == '+' ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(begin, end, value);
  return result.ec == std::errc() && result.ptr == end && std::isfinite(value);
}

/// Hint for a number with a Fortran exponent.
std::string hint(const std::string& text) {
  return text.find_first_of("dD") == std::string::npos
             ? ""
             : ". Write exponents with E: the format has no D";
}

/// Reads one file from its banner to its last line.
class File {
 public:
  explicit File(const std::string& path) : path_(path), in_(path) {}

  Sparse read() {
    readBanner();
    const bool array = banner_->matrixType() == "array";
    const auto sizes = readSizes(array ? 2 : 3);
    entries_ = Teuchos::rcp(new Entries);
    entries_->rows = static_cast<int>(sizes[0]);
    entries_->columns = static_cast<int>(sizes[1]);
    requireRoom(array ? sizes[0] * (symmetric() ? sizes[0] - 1 : 2 * sizes[1]) / 2 : sizes[2],
                array ? shortestNumber : shortestEntry);
    if (banner_->symmType() != "general" && sizes[0] != sizes[1])
      fail("is " + size() + " and " + banner_->symmType() + "; only a square matrix can be that");
    if (array)
      readArray();
    else
      readCoordinates(sizes[2]);
    Sparse matrix(entries_->rows, entries_->columns);
    matrix.setFromTriplets(entries_->triplets.begin(), entries_->triplets.end());
    return matrix;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw MatrixFileError(path_ + (line_ > 0 ? ":" + std::to_string(line_) : "") + " " + what +
                          ".");
  }
  [[noreturn]] void failAt(int row, int column, const std::string& what) const {
    throw MatrixFileError(path_ + ":" + std::to_string(line_) + ": the entry in row " +
                              std::to_string(row) + ", column " + std::to_string(column) + " " +
                              what + ".",
                          row - 1, column - 1);
  }
  std::string size() const {
    return std::to_string(entries_->rows) + " x " + std::to_string(entries_->columns);
  }
  bool symmetric() const { return banner_->symmType() != "general"; }

  /// Goes to the next line that is neither comment nor empty.
  bool next() {
    while (in_.line(text_, longestLine)) {
      ++line_;
      text_ = trim(text_);
      if (!text_.empty() && text_[0] != '%') return true;
    }
    return false;
  }

  void readBanner() {
    ++line_;
    if (!in_.line(text_, longestLine))
      fail(
          "is empty; it should begin with the line \"%%MatrixMarket matrix coordinate real "
          "general\"");
    try {
      banner_.emplace(trim(text_));
    } catch (const std::exception&) {
      fail(
          "does not begin with a Matrix Market banner such as \"%%MatrixMarket matrix coordinate "
          "real general\": found " +
          inQuotes(trim(text_)));
    }
    if (banner_->dataType() != "real" && banner_->dataType() != "integer")
      fail("holds a matrix of the kind " + inQuotes(banner_->dataType()) +
           "; only real or integer ones can be used");
    if (banner_->symmType() == "hermitian")
      fail("is hermitian; a real matrix is general, symmetric or skew-symmetric");
  }

  std::vector<long> readSizes(std::size_t count) {
    std::vector<long> sizes;
    if (next()) {
      std::istringstream words(text_);
      for (long value = 0; words >> value;) sizes.push_back(value);
      words.clear();
      std::string rest;
      if (words >> rest) sizes.clear();
    }
    const bool good = sizes.size() == count && sizes[0] >= 1 && sizes[1] >= 1 &&
                      sizes.back() >= 0 && sizes[0] <= largestDimension &&
                      sizes[1] <= largestDimension;
    if (!good)
      fail(std::string("should give the sizes here, ") +
           (count == 2 ? "\"rows columns\"" : "\"rows columns entries\"") + ", with at most " +
           std::to_string(largestDimension) + " rows and columns: found " + inQuotes(text_));
    return sizes;
  }

  /// Rejects a file that is too short for its announced content, before anything is stored.
  void requireRoom(long announced, long bytesEach) const {
    const auto possible = static_cast<long>(in_.size()) / bytesEach + 1;
    if (announced > possible || announced > std::numeric_limits<int>::max())
      fail("announces " + std::to_string(announced) + " entries, for which the file of " +
           std::to_string(in_.size()) + " bytes is too short");
  }

  void readCoordinates(long count) {
    Lines lines(Teuchos::rcp(new Adder(entries_, banner_->symmType())));
    long seen = 0;
    while (next()) {
      if (++seen > count)
        fail("is one entry more than the " + std::to_string(count) + " announced");
      readEntry(lines);
    }
    if (seen < count)
      fail("is the last line, but only " + std::to_string(seen) + " of the " +
           std::to_string(count) + " entries announced were there");
    if (symmetric() && entries_->below && entries_->above)
      fail("ends a " + banner_->symmType() +
           " matrix with entries above and below its diagonal; give one triangle, or call it "
           "general");
  }

  void readEntry(Lines& lines) {
    std::istringstream words(text_);
    int row = 0, column = 0;
    std::string value, rest;
    if (!(words >> row >> column >> value) || words >> rest)
      fail("should be \"row column value\": found " + inQuotes(text_));
    if (banner_->symmType() == "skew-symmetric" && row == column)
      failAt(row, column, "is on the diagonal of a skew-symmetric matrix");
    try {
      if (isNumber(value) && lines.readLine(text_, static_cast<std::size_t>(line_), false)) return;
    } catch (const std::out_of_range& outside) {
      failAt(row, column, outside.what());
    } catch (const std::exception&) {
      // the fault is reported below
    }
    failAt(row, column, "is " + inQuotes(value) + ", which is no finite number" + hint(value));
  }

  /// Reads the columns one after the other; for symmetric matrices the part on and below the
  /// diagonal.
  void readArray() {
    Adder add(entries_, banner_->symmType());
    const int first = banner_->symmType() == "skew-symmetric" ? 1 : 0;
    for (int j = 1; j <= entries_->columns; ++j)
      for (int i = symmetric() ? j + first : 1; i <= entries_->rows; ++i) {
        if (!next())
          fail("is the last line, but the " + size() + " matrix has no entry for row " +
               std::to_string(i) + ", column " + std::to_string(j));
        if (!isNumber(text_))
          failAt(i, j, "is " + inQuotes(text_) + ", which is no finite number" + hint(text_));
        const double value = std::stod(text_);
        if (value != 0) add(i, j, value);
      }
    if (next()) fail("is more than the entries of a " + size() + " matrix");
  }

  std::string path_;
  InputFile in_;
  std::string text_;
  long line_ = 0;
  std::optional<market::Banner> banner_;
  Teuchos::RCP<Entries> entries_;
};

}  // namespace

Sparse readMatrixMarket(const std::string& path) {
  try {
    return File(path).read();
  } catch (const FileError& fault) {
    throw MatrixFileError(std::string("The matrix file ") + fault.what());
  }
}

Matrix readMatrixMarketDense(const std::string& path) {
  const Sparse matrix = readMatrixMarket(path);
  requireDense(path, matrix, std::filesystem::file_size(path));
  return Matrix(matrix);
}

void requireDense(const std::string& who, const Sparse& matrix, std::uint64_t fileSize) {
  const auto numbers =
      static_cast<std::uint64_t>(matrix.rows()) * static_cast<std::uint64_t>(matrix.cols());
  if (numbers > std::max(smallDense, fileSize))
    throw MatrixFileError(
        who + " is " + std::to_string(matrix.rows()) + " x " + std::to_string(matrix.cols()) +
        ", too large for a dense matrix: the limit is " + std::to_string(smallDense) +
        " numbers, or the number of bytes of the file when that is larger.");
}

std::string matrixMarketText(const Sparse& matrix) {
  std::string text = "%%MatrixMarket matrix coordinate real general\n" +
                     std::to_string(matrix.rows()) + " " + std::to_string(matrix.cols()) + " " +
                     std::to_string(matrix.nonZeros()) + "\n";
  for (int k = 0; k < matrix.outerSize(); ++k)
    for (Sparse::InnerIterator it(matrix, k); it; ++it)
      text += std::to_string(it.row() + 1) + " " + std::to_string(it.col() + 1) + " " +
              formatNumber(it.value()) + "\n";
  return text;
}

std::string matrixMarketText(const Matrix& matrix) {
  std::string text = "%%MatrixMarket matrix array real general\n" + std::to_string(matrix.rows()) +
                     " " + std::to_string(matrix.cols()) + "\n";
  for (Eigen::Index j = 0; j < matrix.cols(); ++j)
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) text += formatNumber(matrix(i, j)) + "\n";
  return text;
}

}  // namespace tooljoint::io
