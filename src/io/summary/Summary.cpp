// SPDX-License-Identifier: BSD-3-Clause
#include "io/summary/Summary.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "common/Version.hpp"
#include "io/TextFile.hpp"
#include "io/summary/SummaryKeys.hpp"

namespace tooljoint::io {
namespace {

using Json = nlohmann::ordered_json;

Json::json_pointer pointer(const std::string& path) {
  Json::json_pointer where;
  for (const auto& key : split(path, '.')) where /= key;
  return where;
}

/// All keys with null; arrays of rows are also null before the first row.
Json skeleton() {
  Json json;
  for (const auto& key : documentedKeys()) {
    json[pointer(key.substr(0, key.find("[]")))] = nullptr;
  }
  return json;
}

[[noreturn]] void undocumented(const std::string& path) {
  throw Error(ExitCode::Internal, "\"" + path + "\" is no documented key of summary.json.");
}

void requireFinite(const std::string& path, double value) {
  if (!std::isfinite(value)) {
    throw Error(ExitCode::Internal, "The summary key \"" + path + "\" was given the value " +
                                        formatNumber(value) +
                                        "; summary.json holds finite numbers only.");
  }
}

}  // namespace

struct SummaryRow::Data {
  Json json = Json::object();
};
struct Summary::Data {
  Json json = skeleton();

  /// The entry of a documented value; rows and groups are not values.
  Json& at(const std::string& path) {
    for (const auto& key : documentedKeys()) {
      if (key == path) return json[pointer(path)];
    }
    undocumented(path);
  }
};

SummaryRow::SummaryRow() : data_(std::make_unique<Data>()) {}
SummaryRow::~SummaryRow() = default;
SummaryRow::SummaryRow(const SummaryRow& other) : data_(std::make_unique<Data>(*other.data_)) {}

SummaryRow& SummaryRow::set(const std::string& key, double value) {
  requireFinite(key, value);
  data_->json[key] = value;
  return *this;
}
SummaryRow& SummaryRow::set(const std::string& key, long value) {
  data_->json[key] = value;
  return *this;
}
SummaryRow& SummaryRow::set(const std::string& key, bool value) {
  data_->json[key] = value;
  return *this;
}
SummaryRow& SummaryRow::set(const std::string& key, const std::string& value) {
  data_->json[key] = value;
  return *this;
}

Summary::Summary() : data_(std::make_unique<Data>()) {
  set("format_version", summaryFormatVersion);
  set("program.version", programVersion());
  set("program.git", gitHash());
  set("ranks", parallel::size());
}
Summary::~Summary() = default;

void Summary::set(const std::string& path, double value) {
  requireFinite(path, value);
  data_->at(path) = value;
}
void Summary::set(const std::string& path, long value) { data_->at(path) = value; }
void Summary::set(const std::string& path, bool value) { data_->at(path) = value; }
void Summary::set(const std::string& path, const std::string& value) { data_->at(path) = value; }
void Summary::set(const std::string& path, const std::vector<std::string>& values) {
  data_->at(path) = values;
}

void Summary::append(const std::string& path, const SummaryRow& row) {
  const std::string prefix = path + "[].";
  Json complete = Json::object();
  for (const auto& key : documentedKeys()) {
    if (key.rfind(prefix, 0) == 0) complete[key.substr(prefix.size())] = nullptr;
  }
  if (complete.empty()) undocumented(path);
  for (const auto& [key, value] : row.data_->json.items()) {
    if (!complete.contains(key)) undocumented(prefix + key);
    complete[key] = value;
  }
  Json& array = data_->json[pointer(path)];
  if (array.is_null()) array = Json::array();
  array.push_back(complete);
}

std::vector<std::string> Summary::keys() { return documentedKeys(); }

std::string Summary::text() const {
  // external texts (file names, messages) may contain bytes that are not UTF-8; they are replaced
  return data_->json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void Summary::stage(const std::string& path) const { stageText(path, text()); }
void Summary::write(const std::string& path) const { writeText(path, text()); }

PreviousRun readPreviousRun(const std::string& path) {
  PreviousRun run;
  std::string text;
  try {
    text = readText(path);
  } catch (const FileError&) {
    return run;  // none there
  }
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return run;
  if (json.contains("status") && json["status"].is_string())
    run.status = json["status"].get<std::string>();
  if (json.contains("files") && json["files"].is_array()) {
    for (const auto& name : json["files"]) {
      if (name.is_string()) run.files.push_back(name.get<std::string>());
    }
  }
  return run;
}

}  // namespace tooljoint::io
