// SPDX-License-Identifier: BSD-3-Clause
#include "study/map/MapRows.hpp"

#include <nlohmann/json.hpp>

#include "cases/ListText.hpp"
#include "cases/recording/SampleRecovery.hpp"
#include "cases/run/ResultsWriter.hpp"
#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/Sha256.hpp"
#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "common/report/Stopwatch.hpp"
#include "io/summary/Summary.hpp"
#include "study/engine/StudyPlan.hpp"

namespace tooljoint::study {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kStoreFormat = 2;  ///< raised when the meaning of a stored row changes

/// Data that determine a point: the deck without Output, and the window of the results.
std::string identity(const cases::Case& scene) {
  std::string text = contentOf(scene);
  if (!scene.list().isSublist("Output")) return text;
  const auto& output = scene.list().sublist("Output");
  if (output.isSublist("Figures")) text += "\n" + cases::canonicalText(output.sublist("Figures"));
  return text;
}

/// All numbers below a value, with their keys joined by dots; rows of arrays are omitted.
void collect(const Json& value, const std::string& key, std::map<std::string, double>& to) {
  if (value.is_number()) to[key] = value.get<double>();
  if (!value.is_object()) return;
  for (const auto& [name, child] : value.items())
    collect(child, key.empty() ? name : key + "." + name, to);
}

}  // namespace

std::optional<double> MapRow::number(const std::string& key) const {
  const auto found = numbers.find(key);
  if (found == numbers.end()) return std::nullopt;
  return found->second;
}

std::string MapRow::toJson() const {
  const Json json{{"status", status},  {"reason", reason},     {"cpu", cpu},
                  {"wall", wall},      {"warnings", warnings}, {"given_up", givenUpAfter},
                  {"numbers", numbers}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

void MapRow::fromJson(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    status = json.at("status").get<std::string>();
    reason = json.at("reason").get<std::string>();
    cpu = json.at("cpu").get<double>();
    wall = json.at("wall").get<double>();
    warnings = json.at("warnings").get<std::vector<std::string>>();
    givenUpAfter = json.at("given_up").get<double>();
    numbers = json.at("numbers").get<std::map<std::string, double>>();
  } catch (const Json::exception& error) {
    throw FileError(std::string("A row of a map cannot be read: ") + error.what());
  }
}

MapRows::MapRows(const MapPlan& plan, const std::string& folder)
    : plan_(plan), rows_(plan.points.size()) {
  parallel::agree([&] { store_.emplace(folder); });
  makeKeys();
  find();
}

void MapRows::makeKeys() {
  keys_.assign(plan_.points.size(), "");
  parallel::agree([&] {
    if (parallel::rank() != 0) return;
    const auto program =
        "map " + std::to_string(kStoreFormat) + "\n" + cases::programStamp() + "\n";
    for (std::size_t i = 0; i < plan_.points.size(); ++i)
      if (plan_.points[i].scene) keys_[i] = sha256(program + identity(*plan_.points[i].scene));
  });
}

/// Reads the stored points on rank 0 for all ranks. A point stopped by the time limit is reused if
/// the limit has not been raised.
void MapRows::find() {
  const auto limit = plan_.settings.timeLimit;
  complete_.assign(rows_.size(), 0);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (const auto& fault = plan_.points[i].fault; !fault.empty()) {
      rows_[i].status = "failed";
      rows_[i].reason = fault;
      complete_[i] = 1;
    }
    const auto text = keys_[i].empty() ? std::nullopt : store_->restoreText(keys_[i]);
    if (!text) continue;
    try {
      MapRow row;
      row.fromJson(*text);
      if (row.givenUpAfter > 0.0 && (!limit || *limit > row.givenUpAfter)) continue;
      rows_[i] = row;
      complete_[i] = 1;
    } catch (const FileError&) {
      continue;  // computed again
    }
  }
  parallel::broadcast(complete_);
}

std::size_t MapRows::completed() const {
  std::size_t count = 0;
  for (int one : complete_) count += one != 0 ? 1 : 0;
  return count;
}

void MapRows::compute(std::size_t i) {
  const Stopwatch watch;
  const log::Hearing heard;
  MapRow row;
  const auto fail = [&](const Error& error) {
    row.status = "failed";
    row.reason = error.what();
  };
  try {
    execute(*plan_.points[i].scene, row);
    row.status = "done";
  } catch (const TimeLimitError& error) {
    fail(error);
    row.givenUpAfter = plan_.settings.timeLimit.value_or(0.0);
  } catch (const Error& error) {
    const auto code = error.code();
    if (code != ExitCode::InvalidDeck && code != ExitCode::ModelNotBuilt &&
        code != ExitCode::NotConverged)
      throw;
    fail(error);
  }
  row.warnings = heard.lines();
  row.cpu = parallel::sum(watch.cpu());
  row.wall = parallel::maximum(watch.wall());
  rows_[i] = row;
  complete_[i] = 1;
  parallel::agree([&] { store_->keepText(keys_[i], row.toJson()); });
}

/// Runs the stages of a run without its files; the row gets the numbers of its summary.
void MapRows::execute(const cases::Case& scene, MapRow& row) {
  io::Summary summary;
  scene.summarise(summary);
  const auto prepared = runner_.prepare(scene, 0);
  prepared.rest->summarise(summary);
  if (prepared.reduced)
    cases::summarise(prepared.reduction, prepared.basis, prepared.setupWall, summary);
  if (scene.moves()) {
    const auto record = prepared.rest->record(prepared.model());
    cases::RecordSink sink(prepared.model(), *record);
    const auto execution =
        runner_.move(scene, prepared, {"", false, 0.0, plan_.settings.timeLimit, &sink});
    cases::summarise(execution.report, prepared.reduced, summary);
    record->summarise(summary);
  }
  collect(Json::parse(summary.text()), "", row.numbers);
}

}  // namespace tooljoint::study
