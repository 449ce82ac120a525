// SPDX-License-Identifier: BSD-3-Clause
#include "deck/tables/ClockTime.hpp"

#include <cmath>
#include <cstdlib>
#include <regex>

#include "common/Text.hpp"

namespace tooljoint::deck {
namespace {

/// Days from 1970-01-01 to a date of the Gregorian calendar. Years begin in March here, so that the
/// leap day is the last day of a year.
long daysSinceEpoch(long year, long month, long day) {
  constexpr long daysOfFourCenturies = 146097, epoch = 719468;
  if (month <= 2) --year;
  const long century = year / 400, yearOfCentury = year % 400;
  const long dayOfYear = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  return century * daysOfFourCenturies + yearOfCentury * 365 + yearOfCentury / 4 -
         yearOfCentury / 100 + dayOfYear - epoch;
}

}  // namespace

std::optional<ClockTime> clockTime(const std::string& cell) {
  static const std::regex form(
      R"((?:(\d{4})[-/](\d{1,2})[-/](\d{1,2})[T ]+)?(\d{1,2}):(\d{2}):(\d{2}(?:[.,]\d+)?)Z?)");
  std::smatch found;
  const std::string text = trim(cell);
  if (!std::regex_match(text, found, form)) return {};
  const auto whole = [&found](int group) {
    return std::strtol(found[group].str().c_str(), nullptr, 10);
  };
  std::string seconds = found[6].str();
  if (const auto comma = seconds.find(','); comma != std::string::npos) seconds[comma] = '.';
  const double second = std::strtod(seconds.c_str(), nullptr);
  const long hour = whole(4), minute = whole(5);
  if (hour > 23 || minute > 59 || !(second < 60.0)) return {};
  ClockTime time;
  time.dated = found[1].matched;
  time.seconds = static_cast<double>(60 * (60 * hour + minute)) + second;
  if (!time.dated) return time;
  const long month = whole(2), day = whole(3);
  if (month < 1 || month > 12 || day < 1 || day > 31) return {};
  time.seconds += dayLength * static_cast<double>(daysSinceEpoch(whole(1), month, day));
  return time;
}

}  // namespace tooljoint::deck
