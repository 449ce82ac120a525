// SPDX-License-Identifier: BSD-3-Clause
#include "deck/tables/LasFile.hpp"

#include <cctype>
#include <utility>

#include "common/Error.hpp"
#include "common/Text.hpp"

namespace tooljoint::deck {
namespace {

/// "MNEM.UNIT  DATA : DESCRIPTION": the mnemonic ends at the first dot, the unit at the first blank
/// after it, the data at the last colon.
struct HeaderLine {
  std::string name, unit, value;
};

bool isBlank(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

std::vector<std::string> words(const std::string& line) {
  std::vector<std::string> found;
  bool inWord = false;
  for (const char c : line) {
    if (!isBlank(c) && !inWord) found.emplace_back();
    inWord = !isBlank(c);
    if (inWord) found.back() += c;
  }
  return found;
}

class Parser {
 public:
  Parser(const std::string& text, std::string file) : text_(text), file_(std::move(file)) {}

  LasFile parse() {
    for (const auto& line : split(text_, '\n')) {
      ++line_;
      const std::string content = trim(line);
      if (content.empty() || content[0] == '#') continue;
      if (content[0] == '~')
        begin(content);
      else
        take(content);
    }
    finish();
    return std::move(las_);
  }

 private:
  [[noreturn]] void fail(int line, const std::string& sentence) const {
    throw DeckError(file_ + ":" + std::to_string(line) + ": " + sentence);
  }

  void begin(const std::string& content) {
    const char section =
        content.size() > 1 ? static_cast<char>(std::toupper(static_cast<unsigned char>(content[1])))
                           : ' ';
    if (section_ == '\0' && section != 'V')
      fail(line_, "the first section is " + inQuotes(content) +
                      ", a LAS file begins with \"~Version\". Put it in front.");
    if (section_ == 'A')
      fail(line_, "the section " + inQuotes(content) +
                      " comes after the data; ~A is the last section of a LAS file.");
    if (section == 'A') beforeData();
    if (section == 'C') las_.curveLine = line_;
    section_ = section;
  }

  void take(const std::string& content) {
    if (section_ == '\0')
      fail(line_, "found " + inQuotes(content) +
                      " before the first section; a LAS file begins with \"~Version\".");
    if (section_ == 'A') return data(content);
    const bool isNull = section_ == 'W' && upper(content).rfind("NULL", 0) == 0;
    if (section_ != 'V' && section_ != 'C' && !isNull) return;
    const HeaderLine found = header(content);
    if (section_ == 'V') version(found);
    if (isNull) null(found);
    if (section_ == 'C') las_.curves.push_back({found.name, found.unit});
  }

  HeaderLine header(const std::string& content) const {
    const auto dot = content.find('.');
    const auto colon = content.rfind(':');
    if (dot == std::string::npos || colon == std::string::npos || colon < dot ||
        trim(content.substr(0, dot)).empty())
      fail(line_,
           "found " + inQuotes(content) + ", expected is \"MNEMONIC.UNIT  DATA : DESCRIPTION\".");
    auto end = dot + 1;
    while (end < colon && !isBlank(content[end])) ++end;
    return {trim(content.substr(0, dot)), content.substr(dot + 1, end - dot - 1),
            trim(content.substr(end, colon - end))};
  }

  void version(const HeaderLine& found) {
    if (upper(found.name) == "VERS") {
      const auto number = cellNumber(found.value);
      if (!number || (number->value != 2.0 && number->value != 1.2))
        fail(line_, "the version is " + inQuotes(found.value) +
                        ", read are 2.0 and 1.2. Export the log as LAS 2.0 or as CSV.");
      versioned_ = true;
    }
    if (upper(found.name) == "WRAP") {
      const std::string answer = upper(found.value);
      if (answer != "YES" && answer != "NO")
        fail(line_, "WRAP is " + inQuotes(found.value) + ", expected is YES or NO.");
      wrapped_ = answer == "YES";
    }
  }

  void null(const HeaderLine& found) {
    const auto number = cellNumber(found.value);
    if (!number) fail(line_, "NULL is " + inQuotes(found.value) + ", expected is a number.");
    las_.null = number->value;
  }

  void beforeData() {
    if (!versioned_)
      fail(line_, "the section ~V has no VERS. Write \"VERS. 2.0 : CWLS LOG ASCII STANDARD\".");
    if (!wrapped_)
      fail(line_, "the section ~V has no WRAP. Write \"WRAP. NO : ONE LINE PER STEP\".");
    if (las_.curves.empty()) fail(line_, "no section ~C names the curves of the data. Add one.");
  }

  void data(const std::string& content) {
    auto cells = words(content);
    const auto count = las_.curves.size();
    const bool continues = *wrapped_ && !las_.rows.empty() && las_.rows.back().cells.size() < count;
    if (!continues) las_.rows.push_back({line_, {}});
    auto& row = las_.rows.back();
    for (auto& cell : cells) row.cells.push_back(std::move(cell));
    if (row.cells.size() > count || (!*wrapped_ && row.cells.size() < count))
      fail(line_, "found " + std::to_string(row.cells.size()) + " values where ~C names " +
                      std::to_string(count) +
                      " curves (values are separated by blanks; a value not measured is NULL).");
  }

  void finish() const {
    const int last = line_ > 0 ? line_ : 1;
    if (section_ == '\0') fail(last, "the file holds no section of a LAS file.");
    if (section_ != 'A') fail(last, "the section ~A with the data is missing.");
    if (!las_.rows.empty() && las_.rows.back().cells.size() < las_.curves.size())
      fail(las_.rows.back().line,
           "the last step has " + std::to_string(las_.rows.back().cells.size()) + " of " +
               std::to_string(las_.curves.size()) + " values. The file was cut.");
  }

  const std::string& text_;
  std::string file_;
  LasFile las_;
  int line_ = 0;
  char section_ = '\0';
  bool versioned_ = false;
  std::optional<bool> wrapped_;
};

}  // namespace

bool looksLikeLas(const std::string& text) {
  for (const auto& line : split(text.substr(0, 4096), '\n')) {
    const std::string content = trim(line);
    if (content.empty() || content[0] == '#') continue;
    return content[0] == '~';
  }
  return false;
}

LasFile parseLas(const std::string& text, const std::string& file) {
  return Parser(text, file).parse();
}

}  // namespace tooljoint::deck
