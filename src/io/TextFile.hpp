// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Writing whole text files so that a file under its own name is always complete.
#pragma once

#include <cstdint>
#include <string>

namespace tooljoint::io {

/// Write `text` to `path`.part (rank 0 only). FileError with the system's reason when that fails.
void stageText(const std::string& path, const std::string& text);

/// Give `path`.part its own name, replacing what was there (rank 0 only). FileError when that
/// fails.
void publishStaged(const std::string& path);

/// Both: `path` either keeps its old content or has the new one whole.
void writeText(const std::string& path, const std::string& text);

/// Largest text that is read whole [bytes].
constexpr std::uint64_t largestText = 1ULL << 32U;

/// Content of a file; FileError when it cannot be read, is no regular file or longer than
/// largestText.
std::string readText(const std::string& path);

}  // namespace tooljoint::io
