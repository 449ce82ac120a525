// SPDX-License-Identifier: BSD-3-Clause
#include "cases/run/RunDeck.hpp"

#include <Kokkos_Core.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "cases/CaseKinds.hpp"
#include "cases/run/Run.hpp"
#include "common/Communicator.hpp"
#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "io/OutputFolder.hpp"
#include "io/TextFile.hpp"
#include "io/summary/SummaryKeys.hpp"

namespace tooljoint {

namespace {

using Json = nlohmann::json;

std::string pathIn(const std::string& folder, const char* name) {
  return (std::filesystem::path(folder) / name).string();
}

/// The value of a leaf, or UsageError.
template <class T>
T as(const std::string& key, const std::string& text, const char* kind) {
  try {
    return Json::parse(text).get<T>();
  } catch (const Json::exception&) {
    throw UsageError("The value of \"" + key + "\" in summary.json is " + text + ", which is no " +
                     kind + ".");
  }
}

/// All leaves below a value, with their keys joined by dots.
void flatten(const Json& value, const std::string& key, std::map<std::string, std::string>& to) {
  if (!value.is_structured()) to[key] = value.dump();
  for (const auto& [name, child] : value.items())
    if (value.is_structured()) flatten(child, key.empty() ? name : key + "." + name, to);
}

}  // namespace

Results::Results(std::string folder) : folder_(std::move(folder)) {
  const auto file = pathIn(folder_, io::summaryName);
  std::string text;
  parallel::agree([&] {
    if (parallel::rank() == 0) text = io::readText(file);
  });
  parallel::broadcast(text);
  try {
    flatten(Json::parse(text), "", values_);
  } catch (const Json::exception& error) {
    throw FileError(file + " is no summary of a run: " + error.what());
  }
}

bool Results::has(const std::string& key) const {
  const auto it = values_.find(key);
  return it != values_.end() && it->second != "null";
}

const std::string& Results::find(const std::string& key) const {
  const auto it = values_.find(key);
  if (it == values_.end()) {
    if (const auto now = io::renamedKey(key); !now.empty())
      throw UsageError("\"" + key + "\" of summary.json is now called \"" + now + "\".");
    std::vector<std::string> keys;
    for (const auto& [name, value] : values_) keys.push_back(name);
    const auto meant = closest(key, keys);
    throw UsageError("summary.json has no value \"" + key + "\"." +
                     (meant.empty() ? "" : " Did you mean \"" + meant + "\"?"));
  }
  if (it->second == "null")
    throw UsageError("\"" + key +
                     "\" of summary.json is null: the stage that computes it did not run.");
  return it->second;
}

double Results::number(const std::string& key) const {
  return as<double>(key, find(key), "number");
}
std::string Results::text(const std::string& key) const {
  return as<std::string>(key, find(key), "text");
}
bool Results::flag(const std::string& key) const { return as<bool>(key, find(key), "truth value"); }

std::vector<std::string> Results::list(const std::string& key) const {
  std::vector<std::string> values;
  for (int i = 0; has(key + "." + std::to_string(i)); ++i)
    values.push_back(text(key + "." + std::to_string(i)));
  return values;
}

io::ResultsReader Results::histories() const {
  return io::ResultsReader(pathIn(folder_, io::resultsName));
}

Results runDeck(const std::string& file, const std::vector<std::string>& overrides, MPI_Comm comm,
                const cases::RunOptions& options) {
  if (!Kokkos::is_initialized())
    throw UsageError(
        "runDeck() needs MPI and Kokkos: make a Tpetra::ScopeGuard at the beginning of main().");
  const parallel::CommunicatorScope ranks(comm);
  log::clearWarnings();
  return Results(cases::run(*cases::readCase(file, overrides), options));
}

}  // namespace tooljoint
