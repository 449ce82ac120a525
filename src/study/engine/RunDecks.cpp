// SPDX-License-Identifier: BSD-3-Clause
#include "study/engine/RunDecks.hpp"

#include <charconv>

#include "common/Error.hpp"
#include "common/Text.hpp"

namespace tooljoint::study {

void RunDecks::fault(const std::string& path, const std::string& sentence) {
  faults_.add(path + ' ' + sentence, "", scene_.deck().error(path, sentence));
}

void RunDecks::raise() const {
  if (!faults_.empty()) throw DeckError(join(faults_.told("run"), "\n"));
}

std::unique_ptr<cases::Case> RunDecks::read(const PlannedRun& run,
                                            const std::vector<std::string>& common) {
  auto overrides = scene_.deck().overrides();
  for (const char* name : {"Study", "Map"})
    if (scene_.list().isSublist(name)) overrides.push_back(std::string("!") + name);
  overrides.insert(overrides.end(), common.begin(), common.end());
  for (const auto& item : run.overrides) overrides.push_back(item.text);
  try {
    return scene_.with(overrides);
  } catch (const DeckError& error) {
    for (const auto& line : split(error.what(), '\n')) relocate(run, line);
  } catch (const ModelError& error) {
    throw ModelError(scene_.deck().error(
        run.source, "makes a model that cannot be built (" + run.label + "): " + error.what()));
  }
  return nullptr;
}

/// "--set Transient/Stepp=1: /scene/Transient/Stepp is ..." -> the line of the list with the
/// override.
void RunDecks::relocate(const PlannedRun& run, const std::string& line) {
  for (const auto& item : run.overrides) {
    const auto place =
        (item.text[0] == '!' ? "--without " + item.text.substr(1) : "--set " + item.text) + ": ";
    if (line.rfind(place, 0) != 0) continue;
    const auto reason = line.substr(place.size());
    faults_.add(item.source + ' ' + item.text, reason,
                scene_.deck().error(item.source, "says " + inQuotes(item.text) + ": " + reason));
    return;
  }
  faults_.add(run.source, line,
              scene_.deck().error(run.source,
                                  "makes a deck that is not valid (" + run.label + "): " + line));
}

std::size_t rowNumber(const std::string& row, std::size_t rows, const std::string& what) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(row.data(), row.data() + row.size(), number);
  if (error != std::errc() || end != row.data() + row.size() || number < 1 || number > rows)
    throw UsageError("--row " + row + ": the " + what + " has the rows 1 to " +
                     std::to_string(rows) + (what == "study" ? ", and \"reference\"." : "."));
  return number - 1;
}

}  // namespace tooljoint::study
