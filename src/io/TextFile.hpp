// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Writes whole text files such that a file under its final name is always complete.
#pragma once

#include <cstdint>
#include <string>

namespace tooljoint::io {

/// Writes `text` to `path`.part (rank 0 only). FileError with the reason of the system when that
/// fails.
void stageText(const std::string& path, const std::string& text);

/// Renames `path`.part to `path`, replacing an existing file (rank 0 only). FileError when that
/// fails.
void publishStaged(const std::string& path);

/// Both: `path` either keeps its old content or has the complete new one.
void writeText(const std::string& path, const std::string& text);

/// Largest text that is read whole [bytes].
constexpr std::uint64_t largestText = 1ULL << 32U;

/// Content of a file. FileError if it cannot be read, is not a regular file or is longer than
/// largestText.
std::string readText(const std::string& path);

}  // namespace tooljoint::io
