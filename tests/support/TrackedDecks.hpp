// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The decks of a folder that belong to the project. Decks that git does not track belong to the
/// user and are not tested.
#pragma once

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tooljoint::testing_ {

/// Output of a shell command, line by line; empty if it fails.
inline std::optional<std::vector<std::string>> linesOf(const std::string& command) {
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  std::string text;
  std::array<char, 4096> buffer{};
  for (std::size_t count = 0; (count = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    text.append(buffer.data(), count);
  if (pclose(pipe) != 0) return std::nullopt;
  std::vector<std::string> lines;
  for (std::size_t begin = 0, end = 0; (end = text.find('\n', begin)) != std::string::npos;
       begin = end + 1)
    lines.push_back(text.substr(begin, end - begin));
  return lines;
}

/// Names of the *.xml of `folder`, sorted, without those of folders inside it: the ones git tracks,
/// or all of them where git tracks nothing there (sources that were unpacked from an archive).
inline std::vector<std::string> trackedDecks(const std::string& folder) {
  auto names =
      linesOf("git -C '" + folder + "' ls-files 2>/dev/null").value_or(std::vector<std::string>());
  if (names.empty())
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      names.push_back(entry.path().filename().string());
  const auto isDeck = [&](const std::string& name) {
    return std::filesystem::path(name).extension() == ".xml" &&
           name.find('/') == std::string::npos && std::filesystem::exists(folder + "/" + name);
  };
  names.erase(
      std::remove_if(names.begin(), names.end(), [&](const auto& name) { return !isDeck(name); }),
      names.end());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace tooljoint::testing_
