// SPDX-License-Identifier: BSD-3-Clause
#include "common/Text.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>

namespace tooljoint {
namespace {

/// Lower case without blanks, "_" and "-": "Time_Step" and "timestep" then compare equal.
std::string normalised(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const auto u = static_cast<unsigned char>(c);
    if (std::isspace(u) == 0 && c != '_' && c != '-') result += static_cast<char>(std::tolower(u));
  }
  return result;
}

/// Length in bytes of the printable character at the start of the text; 0 if there is none.
std::size_t characterOfUtf8(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  if (first < 0x80U) return first >= 0x20U && first != 0x7FU ? 1 : 0;
  const std::size_t length = first >= 0xF0U ? 4 : first >= 0xE0U ? 3 : 2;
  if (first < 0xC2U || first > 0xF4U || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xC0U) != 0x80U) return 0;
  return first == 0xC2U && byte(1) < 0xA0U ? 0 : length;  // control characters of Latin 1
}

}  // namespace

std::size_t editDistance(std::string_view a, std::string_view b) {
  // Optimal string alignment: d(i,j) = min(d(i-1,j)+1, d(i,j-1)+1, d(i-1,j-1)+[a_i != b_j], swap
  // d(i-2,j-2)+1)
  std::vector<std::size_t> before(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] =
          std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0U : 1U)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

std::string closest(std::string_view name, const std::vector<std::string>& candidates) {
  const std::string mine = normalised(name);
  std::string best;
  std::size_t bestDistance = std::numeric_limits<std::size_t>::max();
  for (const std::string& candidate : candidates) {
    const std::string theirs = normalised(candidate);
    const std::size_t longer = std::max(mine.size(), theirs.size()),
                      shorter = std::min(mine.size(), theirs.size());
    const std::size_t allowed = 2 * std::max<std::size_t>(1, longer / 3);
    // The distance is at least the difference of the lengths: texts with very different lengths
    // need no table.
    std::size_t distance = 2 * (longer - shorter);
    if (distance <= allowed) distance = 2 * editDistance(mine, theirs);
    // A whole word of the candidate, or its beginning, is also a good match: "Young" for "Young
    // Modulus".
    const bool begins = mine.size() >= 3 && theirs.compare(0, mine.size(), mine) == 0;
    const bool extends = theirs.size() >= 3 && mine.compare(0, theirs.size(), theirs) == 0;
    if (begins || extends) distance = std::min(distance, allowed);
    if (distance <= allowed && distance < bestDistance) {
      best = candidate;
      bestDistance = distance;
    }
  }
  return best;
}

std::string formatNumber(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value < 0.0 ? "-inf" : "inf";
  std::array<char, 64> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return std::string(buffer.data(), result.ptr);
}

std::string formatNumber(int value) { return std::to_string(value); }

std::string countText(double count) {
  return count < 1e6 ? fmt::format("{:.0f}", count) : fmt::format("{:.3g}", count);
}

std::string trim(std::string_view text) {
  const auto isBlank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return std::string(text);
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = text.find(separator, begin);
    parts.emplace_back(text.substr(begin, end - begin));
    if (end == std::string_view::npos) return parts;
    begin = end + 1;
  }
}

std::string join(const std::vector<std::string>& parts, const std::string& separator) {
  return fmt::format("{}", fmt::join(parts, separator));
}

std::string firstLines(std::vector<std::string> lines, std::size_t most, const std::string& where) {
  if (lines.size() > most) {
    const auto more = lines.size() - most;
    lines.resize(most);
    lines.push_back(more == 1 ? where + ": one more error follows."
                              : fmt::format("{}: {} more errors follow.", where, more));
  }
  return join(lines, "\n");
}

std::string printable(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = characterOfUtf8(text);
    if (length > 0)
      out += text.substr(0, length);
    else
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
    text.remove_prefix(std::max<std::size_t>(1, length));
  }
  return out;
}

std::string excerpt(std::string_view text, std::size_t most) {
  constexpr std::string_view dots = "...";
  const std::string shown = printable(text.substr(0, most + 1));
  if (shown.size() <= most) return shown;
  std::size_t end = most - std::min(most, dots.size());
  while (end > 0 && (static_cast<unsigned char>(shown[end]) & 0xC0U) == 0x80U)
    --end;  // not within a UTF-8 character
  return shown.substr(0, end).append(dots);
}

std::string inShellQuotes(const std::string& text) {
  const char* plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_./=+-:,%@";
  if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string inQuotes(std::string_view text) { return "\"" + excerpt(text) + "\""; }

std::string quotedList(const std::vector<std::string>& parts) {
  std::string result;
  for (const std::string& part : parts) result += (result.empty() ? "" : ", ") + inQuotes(part);
  return result;
}

}  // namespace tooljoint
