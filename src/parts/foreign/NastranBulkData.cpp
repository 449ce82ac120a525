// SPDX-License-Identifier: BSD-3-Clause
#include "parts/foreign/NastranBulkData.hpp"

#include <algorithm>
#include <cctype>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "parts/foreign/PartFormat.hpp"

namespace tooljoint::parts {

namespace {

constexpr std::size_t smallField = 8, largeField = 16, lastColumn = 80, dataColumns = 72;

/// Removes the comment and replaces tabs by blanks up to the next column of a small field.
std::string plainLine(const std::string& text) {
  std::string out;
  for (const char c : text.substr(0, text.find('$'))) {
    if (c != '\t') {
      out += c;
      continue;
    }
    do out += ' ';
    while (out.size() % smallField != 0);
  }
  while (!out.empty() && std::isspace(static_cast<unsigned char>(out.back())) != 0) out.pop_back();
  return out;
}

std::string words(const std::string& text) {
  std::string out;
  for (const char c : upper(trim(text)))
    if (c != ' ' || (!out.empty() && out.back() != ' ')) out += c;
  return out;
}

}  // namespace

NastranBulkData::NastranBulkData(const std::string& path) : path_(path), in_(path) {
  InputFile once(path);
  long line = 0;
  for (std::string text; once.line(text, longestLine);) {
    ++line;
    const auto opening = words(text.substr(0, text.find('$')));
    if (opening.rfind("BEGIN BULK", 0) != 0 && opening.rfind("BEGIN SUPER", 0) != 0) continue;
    if (begin_ > 0)
      throw DeckError(path_ + ":" + std::to_string(line) +
                      " begins a second section of bulk data; the first begins in line " +
                      std::to_string(begin_) +
                      ". A part is one of them: write each to a separate file.");
    begin_ = line;
  }
}

void NastranBulkData::fail(const std::string& what) const {
  throw DeckError(path_ + ":" + std::to_string(line_) + " " + what + ".");
}

bool NastranBulkData::nextLine() {
  for (std::string text; !ended_ && in_.line(text, longestLine);) {
    ++line_;
    const auto plain = plainLine(text);
    if (line_ <= begin_ || plain.empty()) continue;
    if (words(plain) == "ENDDATA") break;
    split(plain);
    return true;
  }
  ended_ = true;
  return false;
}

void NastranBulkData::split(const std::string& text) {
  current_ = {};
  const bool free = text.find(',') != std::string::npos;
  std::vector<std::string> texts;
  std::string head;
  if (free) {
    texts = tooljoint::split(text, ',');
    head = trim(texts.front());
    texts.erase(texts.begin());
  } else {
    if (text.size() > lastColumn)
      fail("has text beyond column 80. Fields have 8 or 16 columns, or are separated by commas");
    head = trim(text.substr(0, smallField));
  }
  const bool large = !head.empty() && (head.back() == '*' || head.front() == '*');
  const std::size_t count = large ? 4 : 8;
  if (!free)
    for (std::size_t at = smallField; at < std::min(text.size(), dataColumns);
         at += large ? largeField : smallField)
      texts.push_back(text.substr(at, large ? largeField : smallField));
  if (free && texts.size() > count + 1)
    fail("has " + std::to_string(texts.size()) + " fields after the first, expected at most " +
         std::to_string(count) + " and a continuation mark");
  texts.resize(count);
  for (std::size_t i = 0; i < count; ++i)
    current_.fields.push_back({trim(texts[i]), line_, static_cast<int>(i) + 2});
  current_.continues = head.empty() || head.front() == '+' || head.front() == '*';
  if (!current_.continues && large) head.pop_back();
  current_.name = upper(trim(head));
}

bool NastranBulkData::next(BulkEntry& entry) {
  if (!waiting_ && !nextLine()) return false;
  if (current_.continues) fail("continues no entry: its first field is blank, \"+\" or \"*\"");
  entry = {current_.name, line_, current_.fields};
  waiting_ = false;
  while (nextLine()) {
    if (!current_.continues) {
      waiting_ = true;
      break;
    }
    entry.fields.insert(entry.fields.end(), current_.fields.begin(), current_.fields.end());
  }
  return true;
}

}  // namespace tooljoint::parts
