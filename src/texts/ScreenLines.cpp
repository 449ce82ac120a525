// SPDX-License-Identifier: BSD-3-Clause
#include "texts/ScreenLines.hpp"

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <unistd.h>

#include "common/report/Detail.hpp"
#include "common/report/Log.hpp"
#include "common/report/StageTimes.hpp"
#include "common/report/Terminal.hpp"
#include "deck/PrintedUnits.hpp"

namespace tooljoint::texts::screen {

namespace {

constexpr std::size_t column = 20;  ///< width of the names and of the values

/// A command in lines that a shell joins, broken before its options where it is long.
std::vector<std::string> shellLines(const std::string& command) {
  constexpr std::size_t widest = 80;
  std::vector<std::string> lines(1);
  for (std::size_t begin = 0; begin < command.size();) {
    const auto end = std::min(command.find(" --", begin + 1), command.size());
    const auto piece = command.substr(begin, end - begin);
    if (lines.back().size() + piece.size() > widest && !lines.back().empty()) {
      lines.back() += " \\";
      lines.push_back(" " + piece);
    } else {
      lines.back() += piece;
    }
    begin = end;
  }
  return lines;
}

}  // namespace

std::string fixed(double value, int decimals) {
  std::ostringstream out;
  out << std::fixed << std::setprecision(decimals) << value;
  const std::string text = out.str();
  return text.find_first_not_of("-0.") == std::string::npos ? text.substr(text.find('0')) : text;
}

std::string brief(double value, int digits) {
  std::ostringstream out;
  out << std::setprecision(digits) << value;
  return out.str();
}

std::string quantity(double si, const char* usual, int decimals) {
  const deck::PrintedUnit unit(usual);
  return fixed(unit(si), decimals) + " " + unit.name();
}

std::string padded(const std::string& text) {
  return text + std::string(text.size() < column ? column - text.size() : 1, ' ');
}

std::optional<double> number(const Json& summary, const char* path) {
  const Json::json_pointer pointer(path);
  if (!summary.contains(pointer)) return std::nullopt;
  const auto& value = summary.at(pointer);
  if (!value.is_number()) return std::nullopt;
  return value.get<double>();
}

void line(const std::string& name, const std::string& value, const std::string& remark) {
  log::info(terminal::coloured(padded(name), terminal::Colour::Bold, STDOUT_FILENO) +
            (remark.empty() ? value : padded(value) + remark));
}

void details(const Json& summary) {
  const auto times = stageTimes(0.0);
  if (!times.empty()) log::detail("stages      " + times);
  std::string counters;
  for (const char* name : {"steps", "newton_iterations", "factorisations", "right_hand_sides",
                           "halved", "rejected", "unconverged_steps"}) {
    if (const auto count = number(summary, (std::string("/transient/") + name).c_str()))
      counters += (counters.empty() ? "" : ", ") + std::string(name) + " " + fixed(*count, 0);
  }
  if (!counters.empty()) log::detail("counters    " + counters);
  if (const auto memory = number(summary, "/peak_memory_mb"))
    log::detail("memory      " + fixed(*memory, 0) + " MB at most");
}

void openAndNext(const std::string& folder, const std::vector<std::string>& commands) {
  const auto report = std::filesystem::path(folder) / "report.html";
  log::info("");
  log::info(std::filesystem::exists(report)
                ? "open        " + report.string() + " in a browser"
                : "report      none was written: tooljoint report " + folder);
  const char* label = "next        ";
  for (const auto& command : commands)
    for (const auto& part : shellLines(command)) {
      std::cout << label << part << std::endl;  // to be copied
      label = "            ";
    }
}

}  // namespace tooljoint::texts::screen
