// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Assembled matrices in Harwell-Boeing format (I. S. Duff, R. G. Grimes and J. G. Lewis, Users'
/// Guide for the Harwell-Boeing Sparse Matrix Collection, TR/PA/92/86), as written by HBMAT of
/// Ansys, with its mapping file "equation, node, dof" (Mechanical APDL Command Reference, HBMAT).
#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <utility>

#include "common/InputFile.hpp"
#include "common/Text.hpp"
#include "io/MatrixMarket.hpp"
#include "parts/foreign/PartFormat.hpp"

namespace tooljoint::parts {

namespace {

namespace fs = std::filesystem;

/// Ansys names of the components 1 to 6.
const std::vector<std::string> ansysDofs{"UX", "UY", "UZ", "ROTX", "ROTY", "ROTZ"};

std::vector<std::string> wordsOf(const std::string& text) {
  std::vector<std::string> out;
  std::string word;
  for (const char c : text + " ") {
    if (std::isspace(static_cast<unsigned char>(c)) == 0 && c != ',')
      word += c;
    else if (!word.empty()) {
      out.push_back(word);
      word.clear();
    }
  }
  return out;
}

/// A Fortran format of equal fields, "(8I10)", "(1P,5E16.8)", "(3(1PE25.13))".
struct FieldFormat {
  std::size_t count = 1, width = 0;
};

/// Reads one matrix, column by column.
class HbFile {
 public:
  explicit HbFile(const std::string& path) : path_(path), in_(path) {}

  struct Content {
    std::int64_t size = 0;
    bool symmetric = false;
    std::vector<std::int64_t> starts, rows;  ///< from 1
    std::vector<double> values, rightSide;
  };

  Content read() {
    Content out;
    line();  // title and key
    line();
    const auto counts = lineCounts();
    const bool rightSide = counts[4] > 0;
    line();
    auto words = wordsOf(text_);
    const auto type = words.empty() ? "" : upper(words[0]);
    requireType(type);
    std::vector<std::int64_t> sizes;
    for (std::size_t i = 1; i < words.size(); ++i) sizes.push_back(wholeNumber(words[i]));
    if (sizes.size() < 3 || *std::min_element(sizes.begin(), sizes.end()) < 0 || sizes[0] < 1)
      fail("should be \"type rows columns entries\": found " + inQuotes(text_));
    if (sizes[0] != sizes[1])
      fail("gives " + std::to_string(sizes[0]) + " rows and " + std::to_string(sizes[1]) +
           " columns; expected a square matrix");
    const std::int64_t shortest = static_cast<std::int64_t>(in_.size()) + 1;
    if (sizes[0] > io::largestDimension || sizes[2] > shortest || sizes[0] > shortest)
      fail("announces " + std::to_string(sizes[0]) + " rows and " + std::to_string(sizes[2]) +
           " entries, for which the file of " + std::to_string(in_.size()) + " bytes is too short");
    out.size = sizes[0];
    out.symmetric = type[1] == 'S';
    line();
    const auto formats = formatsOf();
    if (rightSide) {
      line();
      words = wordsOf(text_);
      if (words.empty() || upper(words[0])[0] != 'F')
        fail("describes the right-hand sides, expected \"F\" (full): found " + inQuotes(text_));
      if (words.size() > 1 && words[1] != "1")
        fail("announces " + words[1] +
             " right-hand sides, expected one: it is the constant load of the part");
    }
    const auto n = static_cast<std::size_t>(out.size), entries = static_cast<std::size_t>(sizes[2]);
    checkCounts(counts, {n + 1, entries, entries}, formats);
    out.starts = whole(n + 1, formats[0], "a pointer to the first entry of a column", sizes[2] + 1);
    for (std::size_t j = 0; j + 1 < out.starts.size(); ++j)
      if (out.starts[j] > out.starts[j + 1])
        fail("ends the column pointers, of which number " + std::to_string(j + 2) + " is " +
             std::to_string(out.starts[j + 1]) + ", less than the one before");
    if (out.starts.front() != 1 || out.starts.back() != sizes[2] + 1)
      fail("ends the column pointers, which go from " + std::to_string(out.starts.front()) +
           " to " + std::to_string(out.starts.back()) + ", expected 1 to " +
           std::to_string(sizes[2] + 1));
    out.rows = whole(entries, formats[1], "a row", out.size);
    out.values = real(entries, formats[2], "values");
    const long end = number_ + static_cast<long>(counts[4]);
    if (rightSide) out.rightSide = real(n, formats[3].width > 0 ? formats[3] : formats[2], "loads");
    while (next())
      if (number_ > end && !text_.empty())
        fail("follows the last number of the matrix: found " + inQuotes(text_));
    return out;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw DeckError(path_ + ":" + std::to_string(number_) + " " + what + ".");
  }

  bool next() {
    if (!in_.line(text_, longestLine)) return false;
    ++number_;
    while (!text_.empty() && std::isspace(static_cast<unsigned char>(text_.back())) != 0)
      text_.pop_back();
    return true;
  }
  void line() {
    if (!next()) fail("is the last line, but the matrix goes on: the file is cut short");
  }

  /// Line 2: numbers of lines in total, of pointers, rows, values and right-hand sides (0 if it
  /// ends earlier).
  std::vector<std::int64_t> lineCounts() const {
    std::vector<std::int64_t> out;
    for (const auto& word : wordsOf(text_)) out.push_back(wholeNumber(word));
    if (out.size() < 4 || std::count(out.begin(), out.end(), -1) > 0)
      fail("should give the numbers of lines \"total pointers rows values\": found " +
           inQuotes(text_));
    out.resize(5);
    return out;
  }

  /// Checks that the counts of line 2 match the number of lines of `numbers` in their formats.
  void checkCounts(const std::vector<std::int64_t>& counts,
                   const std::array<std::size_t, 3>& numbers,
                   const std::array<FieldFormat, 4>& formats) const {
    const auto check = [&](const std::string& what, std::int64_t given, std::int64_t expected) {
      if (given != expected)
        throw DeckError(path_ + ":2 announces " + std::to_string(given) + " lines of " + what +
                        ", expected " + std::to_string(expected) +
                        ". The file is damaged, or was changed by hand.");
    };
    const std::array<const char*, 3> names{"pointers", "rows", "values"};
    std::int64_t sum = counts[4];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto lines = (numbers[k] + formats[k].count - 1) / formats[k].count;
      check(names[k], counts[k + 1], static_cast<std::int64_t>(lines));
      sum += counts[k + 1];
    }
    check("numbers in all", counts[0], sum);
  }

  void requireType(const std::string& type) const {
    if (type.size() == 3 && type[0] == 'C')
      fail("gives the complex type " + inQuotes(type) + ". A part is real: expected RSA or RUA");
    if (type != "RSA" && type != "RUA")
      fail("gives the type " + inQuotes(type) +
           ", expected RSA (real, symmetric, assembled) or RUA (unsymmetric)");
  }

  std::array<FieldFormat, 4> formatsOf() const {
    std::array<FieldFormat, 4> out;
    std::size_t at = 0;
    for (auto& format : out) {
      const auto open = text_.find('(', at);
      if (open == std::string::npos) break;
      const auto close = closing(open);
      if (close == std::string::npos) break;
      format = formatOf(upper(text_.substr(open + 1, close - open - 1)));
      at = close;
    }
    for (std::size_t i = 0; i < 3; ++i)
      if (out[i].width == 0)
        fail(
            "should give the Fortran formats of pointers, rows and values, such as \"(8I10) "
            "(8I10) (4D20.12)\": found " +
            inQuotes(text_));
    return out;
  }

  /// Position of the bracket that closes the one at `open`, npos if there is none.
  std::size_t closing(std::size_t open) const {
    int depth = 0;
    for (auto i = open; i < text_.size(); ++i) {
      if (text_[i] == '(') ++depth;
      if (text_[i] == ')' && --depth == 0) return i;
    }
    return std::string::npos;
  }

  /// Repeat counts and the width before the point: 1P,4E20.12 -> 4 fields of 20 columns,
  /// 3(1PE25.13) -> 3 of 25, 3ES26.16 -> 3 of 26.
  static FieldFormat formatOf(std::string text) {
    constexpr std::int64_t most = 1024;
    const auto letter = text.find_first_of("(IEDFGP");
    if (letter == std::string::npos) return {};
    if (text[letter] == 'P') return formatOf(text.substr(letter + 1));
    const auto repeat = trim(text.substr(0, letter));
    const auto digits = repeat.find_first_not_of(", ");
    const auto count = digits == std::string::npos ? 1 : wholeNumber(repeat.substr(digits));
    FieldFormat field;
    if (text[letter] == '(') {
      field = formatOf(text.substr(letter + 1, text.rfind(')') - letter - 1));
    } else {
      const bool twoLetters =
          text.compare(letter, 2, "ES") == 0 || text.compare(letter, 2, "EN") == 0;
      const auto first = letter + (twoLetters ? 2 : 1);
      const auto width = wholeNumber(text.substr(first, text.find('.') - first));
      if (width >= 1 && width <= most) field.width = static_cast<std::size_t>(width);
    }
    if (count < 1 || count > most || field.count > most) return {};
    return {static_cast<std::size_t>(count) * field.count, field.width};
  }

  /// Calls take(text) for `count` fields.
  template <class Take>
  void fields(std::size_t count, const FieldFormat& format, const std::string& what,
              const Take& take) {
    for (std::size_t done = 0; done < count;) {
      if (!next())
        fail("is the last line, with number " + std::to_string(done) + " of " +
             std::to_string(count) + " " + what + ": the file is cut short");
      // numbers between blanks may be in other columns than the format specifies (as in SciPy's
      // files)
      const auto apart = wordsOf(text_);
      const bool counted = apart.size() == std::min(format.count, count - done);
      for (std::size_t i = 0; i < format.count && done < count; ++i, ++done) {
        const auto at = i * format.width;
        const auto text = counted             ? apart[i]
                          : at < text_.size() ? trim(text_.substr(at, format.width))
                                              : "";
        if (text.empty())
          fail("has " + std::to_string(i) + " numbers, expected " +
               std::to_string(std::min(format.count, count - done + i)) + " in fields of " +
               std::to_string(format.width) + " columns");
        take(text, i + 1);
      }
    }
  }

  std::vector<std::int64_t> whole(std::size_t count, const FieldFormat& format,
                                  const std::string& what, std::int64_t most) {
    std::vector<std::int64_t> out;
    fields(count, format, "pointers and rows", [&](const std::string& text, std::size_t field) {
      const auto value = wholeNumber(text);
      if (value < 1 || value > most)
        fail("has " + inQuotes(text) + " in field " + std::to_string(field) + ", expected " + what +
             " from 1 to " + std::to_string(most));
      out.push_back(value);
    });
    return out;
  }

  std::vector<double> real(std::size_t count, const FieldFormat& format, const std::string& what) {
    std::vector<double> out;
    fields(count, format, what, [&](const std::string& text, std::size_t field) {
      double value = 0.0;
      // without a point Fortran counts the decimals of the format from the right
      if (!fortranNumber(text, true, value))
        fail("has " + inQuotes(text) + " in field " + std::to_string(field) +
             ", expected a finite number with a decimal point");
      out.push_back(value);
    });
    return out;
  }

  std::string path_;
  InputFile in_;
  std::string text_;
  long number_ = 0;
};

/// Labels of the rows.
std::vector<PointDof> readMapping(const std::string& path, std::int64_t rows,
                                  const std::string& matrix) {
  InputFile in(path);
  std::vector<PointDof> out(static_cast<std::size_t>(rows));
  std::string text;
  std::int64_t seen = 0;
  for (long line = 1; in.line(text, longestLine); ++line) {
    const auto words = wordsOf(text);
    if (words.empty() || (seen == 0 && wholeNumber(words[0]) < 0)) continue;  // heading
    const auto fail = [&](const std::string& what) {
      throw DeckError(path + ":" + std::to_string(line) + " " + what + ".");
    };
    if (words.size() != 3)
      fail("has " + std::to_string(words.size()) +
           " words, expected 3: \"equation node dof\", such as \"1 12 UX\"");
    const auto row = wholeNumber(words[0]), node = wholeNumber(words[1]);
    if (row < 1 || row > rows)
      fail("has the equation " + inQuotes(words[0]) + ", expected 1 to " + std::to_string(rows) +
           ", the rows of " + matrix);
    if (node < 1) fail("has the node " + inQuotes(words[1]) + ", expected a number from 1");
    const auto dof = std::find(ansysDofs.begin(), ansysDofs.end(), upper(words[2]));
    if (dof == ansysDofs.end())
      fail("has the dof " + inQuotes(words[2]) + ", expected one of " + quotedList(ansysDofs));
    auto& label = out[static_cast<std::size_t>(row - 1)];
    if (label.point > 0) fail("gives equation " + words[0] + " twice");
    label = {node, static_cast<int>(dof - ansysDofs.begin()) + 1};
    ++seen;
  }
  if (seen < rows)
    throw DeckError(path + " gives the dofs of " + std::to_string(seen) + " equations, but " +
                    matrix + " has " + std::to_string(rows) + " rows.");
  std::map<PointDof, std::size_t> rowOf;
  for (std::size_t i = 0; i < out.size(); ++i)
    if (const auto [it, isNew] = rowOf.emplace(out[i], i + 1); !isNew)
      throw DeckError(path + " gives " + describe(out[i]) + " to equations " +
                      std::to_string(it->second) + " and " + std::to_string(i + 1) + ".");
  return out;
}

class HarwellBoeing : public PartFormat {
 public:
  std::vector<std::string> extensions() const override {
    return {".hb", ".rsa", ".rua", ".matrix"};
  }
  bool recognises(const std::string&) const override { return false; }

  LabelledPart read(const PartFiles& files) const override {
    if (!files.whole.empty())
      throw DeckError(files.whole +
                      " holds one matrix. Name a part.json with \"matrices\": {\"stiffness\": "
                      "\"K.hb\", \"mass\": \"M.hb\"} instead.");
    LabelledPart part;
    part.file = files.main();
    for (const auto& [key, file] : files.named)
      if (key == "loads")
        throw DeckError(file +
                        " is named as \"loads\". In Harwell-Boeing files the loads are the "
                        "right-hand side of the stiffness.");
      else if (key != "mapping")
        readMatrix(files, key, file, part);
    return part;
  }

  std::vector<std::string> companions(const std::string& path) const override {
    if (auto mapping = mappingBeside(path); !mapping.empty()) return {mapping};
    return {};
  }

 private:
  static void readMatrix(const PartFiles& files, const std::string& key, const std::string& file,
                         LabelledPart& part) {
    const auto content = HbFile(file).read();
    const auto mapping = mappingOf(files, file);
    const auto labels = readMapping(mapping, content.size, file);
    const auto label = [&](std::int64_t row) { return labels[static_cast<std::size_t>(row - 1)]; };
    LabelledMatrix out;
    out.quantity = key == "stiffness" ? Quantity::Stiffness
                   : key == "mass"    ? Quantity::Mass
                                      : Quantity::Damping;
    out.name = key;
    out.where = file;
    std::vector<std::int64_t> columnOf(static_cast<std::size_t>(content.size), 0);
    for (std::int64_t j = 1; j <= content.size; ++j)
      for (auto k = content.starts[static_cast<std::size_t>(j - 1)];
           k < content.starts[static_cast<std::size_t>(j)]; ++k) {
        const auto row = content.rows[static_cast<std::size_t>(k - 1)];
        const double value = content.values[static_cast<std::size_t>(k - 1)];
        if (content.symmetric && row < j)
          throw DeckError(file +
                          ": the symmetric matrix (RSA) has an entry above its diagonal, in "
                          "row " +
                          std::to_string(row) + ", column " + std::to_string(j) +
                          ". Expected the lower triangle.");
        if (std::exchange(columnOf[static_cast<std::size_t>(row - 1)], j) == j)
          throw DeckError(file + " gives the entry in row " + std::to_string(row) + ", column " +
                          std::to_string(j) + " twice. An assembled matrix has it once.");
        out.entries.push_back({label(row), label(j), value});
        if (content.symmetric && row != j) out.entries.push_back({label(j), label(row), value});
      }
    part.matrices.push_back(std::move(out));
    if (key != "stiffness") return;
    LabelledLoad load{"right-hand side", "1", file + ": the right-hand side", {}};
    for (std::size_t i = 0; i < content.rightSide.size(); ++i)
      if (content.rightSide[i] != 0.0) load.forces[labels[i]] = content.rightSide[i];
    if (!load.forces.empty()) part.loads.push_back(std::move(load));
  }

  /// The mapping file of a matrix; "" without one.
  static std::string mappingBeside(const std::string& file) {
    std::error_code ignored;
    for (const char* extension : {".mapping", ".MAPPING"})
      if (const auto path = fs::path(file).replace_extension(extension); fs::exists(path, ignored))
        return path.string();
    return "";
  }

  static std::string mappingOf(const PartFiles& files, const std::string& file) {
    if (const auto it = files.named.find("mapping"); it != files.named.end()) return it->second;
    if (auto mapping = mappingBeside(file); !mapping.empty()) return mapping;
    throw DeckError(file + " has no mapping file " +
                    fs::path(file).replace_extension(".mapping").string() +
                    " beside it, so the dofs of its rows are not known. Write it with Mapping = "
                    "YES in HBMAT, or name it in \"matrices\" as \"mapping\".");
  }
};

const bool harwellBoeingRegistered = PartFormats::instance().add(
    "Harwell-Boeing", {"Assembled matrices of HBMAT with their mapping.", {}, [] {
                         return std::make_unique<HarwellBoeing>();
                       }});

}  // namespace

}  // namespace tooljoint::parts
