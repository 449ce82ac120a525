// SPDX-License-Identifier: BSD-3-Clause
#include "io/Csv.hpp"

#include <cmath>
#include <filesystem>
#include <utility>

#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "io/TextFile.hpp"

namespace tooljoint::io {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

void requireCount(std::size_t given, std::size_t wanted) {
  if (given != wanted) {
    throw Error(ExitCode::Internal, "A table of " + std::to_string(wanted) +
                                        " columns was given a row of " + std::to_string(given) +
                                        ".");
  }
}

}  // namespace

Csv::Csv(std::vector<Column> columns) : columns_(std::move(columns)) {
  std::vector<std::string> header;
  for (const auto& column : columns_) {
    const bool pure = column.unit.empty() || column.unit == "1";
    header.push_back(quoted(pure ? column.name : column.name + " [" + column.unit + "]"));
  }
  text_ = join(header, ",") + "\n";
}

void Csv::row(const std::vector<double>& values) {
  requireCount(values.size(), columns_.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) {
      throw Error(ExitCode::Internal, "The table column \"" + columns_[i].name +
                                          "\" was given the value " + formatNumber(values[i]) +
                                          "; tables hold finite numbers only.");
    }
    text_ += (i > 0 ? "," : "") + formatNumber(values[i] + 0.0);  // turns -0 into 0
  }
  text_ += "\n";
}

void Csv::row(const std::vector<std::string>& values) {
  requireCount(values.size(), columns_.size());
  for (std::size_t i = 0; i < values.size(); ++i) text_ += (i > 0 ? "," : "") + quoted(values[i]);
  text_ += "\n";
}

void Csv::stage(const std::string& path) const { stageText(path, text_); }
void Csv::write(const std::string& path) const { writeText(path, text_); }

void Csv::writeInto(const std::string& folder, const std::string& name) const {
  parallel::agree([&] {
    if (parallel::rank() != 0) return;
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    if (failed)
      throw FileError("The folder \"" + folder + "\" cannot be made: " + failed.message() + ".");
    write((std::filesystem::path(folder) / name).string());
  });
}

}  // namespace tooljoint::io
